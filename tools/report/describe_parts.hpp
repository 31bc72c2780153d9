// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Pieces that descriptions of models and of files share.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include <nlohmann/json.hpp>

#include "tess/geometry.hpp"

namespace terratet::tools {

/// Smallest and largest of what is there.
struct Range {
    double lo = INFINITY;
    double hi = -INFINITY;
    std::size_t count = 0;

    void add(double value) {
        if (std::isfinite(value)) {
            lo = std::min(lo, value);
            hi = std::max(hi, value);
            ++count;
        }
    }
};

inline nlohmann::ordered_json box_json(const Box3& box) {
    return box.empty() ? nlohmann::ordered_json()
                       : nlohmann::ordered_json{box.lo.x, box.lo.y, box.lo.z, box.hi.x, box.hi.y, box.hi.z};
}

inline std::string crs_text(const std::string& name) {
    return name.empty() ? "none" : name;
}

}  // namespace terratet::tools
