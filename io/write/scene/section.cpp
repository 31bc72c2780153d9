// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// Sections and isosurfaces as a user writes them.

#include <cmath>
#include <numbers>

#include "io/base/parse_number.hpp"
#include "io/export.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

std::vector<double> numbers(const std::string& list, const std::string& whole, const char* field) {
    std::vector<double> result;
    for (std::size_t begin = 0; begin <= list.size();) {
        const std::size_t end = std::min(list.find(',', begin), list.size());
        const auto number = parse_number(list.substr(begin, end - begin));
        if (!number || !std::isfinite(*number)) {
            throw UsageError("`" + std::string(field) + "`: '" + list.substr(begin, end - begin) + "' in '" + whole +
                             "' is not a number");
        }
        result.push_back(*number);
        begin = end + 1;
    }
    return result;
}

}  // namespace

Section parse_section(const std::string& text) {
    if (text.starts_with("z=") || text.starts_with("Z=")) {
        const std::vector<double> level = numbers(text.substr(2), text, "section");
        if (level.size() == 1) {
            return {text, {0, 0, level[0]}, {0, 0, 1}, {}};
        }
    } else {
        const std::vector<double> n = numbers(text, text, "section");
        if (n.size() == 3) {
            const double azimuth = n[0] * std::numbers::pi / 180;
            return {text, {n[1], n[2], 0}, {std::cos(azimuth), -std::sin(azimuth), 0}, {}};
        }
        if (n.size() == 4) {
            const Vec3 a{n[0], n[1], 0};
            const Vec3 b{n[2], n[3], 0};
            if (a == b) {
                throw UsageError("`section`: '" + text + "' has both its ends at one place");
            }
            const Vec3 along = (b - a) / distance(a, b);
            return {text, a, {along.y, -along.x, 0}, std::array{a, b}};
        }
    }
    throw UsageError("`section`: '" + text + "' is none of x1,y1,x2,y2 and z=V and AZIMUTH,x,y");
}

IsoLevels parse_iso(const std::string& text) {
    const std::size_t equals = text.rfind('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size()) {
        throw UsageError("`iso`: '" + text + "' is not PROPERTY=VALUE[,VALUE]");
    }
    return {text.substr(0, equals), numbers(text.substr(equals + 1), text, "iso")};
}

}  // namespace terratet
