// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/vertical_crs.hpp"

#include "tess/error.hpp"

namespace terratet {
namespace {

bool has_heights(const Crs& crs) {
    return crs.wkt.starts_with("COMPOUNDCRS") || crs.wkt.find("CS[ellipsoidal,3]") != std::string::npos ||
           crs.wkt.find("CS[Cartesian,3]") != std::string::npos;
}

}  // namespace

Crs with_vertical(const Crs& crs, const std::string& vertical) {
    if (vertical.empty() || crs.empty() || crs.local) {
        return crs;
    }
    const std::string number = vertical.starts_with("EPSG:") ? vertical.substr(5) : vertical;
    const std::string code = crs.name.substr(0, crs.name.find(' '));  // of "EPSG:3067 ETRS89 / TM35FIN(E,N)"
    if (!code.starts_with("EPSG:")) {
        throw UsageError("VERTICAL_SRS: goes with a coordinate system that has an EPSG code, and '" + crs.name +
                         "' has none; give a compound one instead");
    }
    return parse_crs(code + "+" + number);
}

std::string heights_remark(const Crs& crs, const std::string& vertical) {
    if (crs.empty() || crs.local || !vertical.empty() || has_heights(crs)) {
        return {};
    }
    return "heights are taken as ellipsoidal, since the coordinate system says none: -co VERTICAL_SRS=EPSG:… tells "
           "theirs";
}

}  // namespace terratet
