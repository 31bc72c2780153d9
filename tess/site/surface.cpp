// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/surface.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

namespace terratet {

const char* to_string(SurfaceKind kind) {
    constexpr const char* names[] = {"fault", "horizon", "topography", "domain"};
    return names[static_cast<std::size_t>(kind)];
}
namespace {

constexpr double degrees = 180 / std::numbers::pi;

/// A horizontal direction is undefined where the mean normal leans from the vertical by less than rounding can tell.
constexpr double least_lean = 1e-12;

/// Triangles without a usable corner count for nothing: surfaces are put in order before they are repaired.
double area(const Surface& surface) {
    double twice = 0;
    for (const Triangle& t : surface.triangles) {
        if (std::ranges::all_of(
                t, [&](std::uint32_t v) { return v < surface.vertices.size() && is_finite(surface.vertices[v]); })) {
            const Vec3& a = surface.vertices[t[0]];
            twice += length(cross(surface.vertices[t[1]] - a, surface.vertices[t[2]] - a));
        }
    }
    return twice / 2;
}

}  // namespace

bool canonical_before(const Surface& a, const Surface& b) {
    if (a.name != b.name) {
        return a.name < b.name;
    }
    const double area_a = area(a);
    const double area_b = area(b);
    return std::tie(area_a, a.vertices, a.triangles, a.kind, a.file) <
           std::tie(area_b, b.vertices, b.triangles, b.kind, b.file);
}

SurfaceStatistics statistics(const Surface& surface) {
    SurfaceStatistics result;
    Vec3 upward_sum;
    double dip_sum = 0;
    for (const Triangle& t : surface.triangles) {
        const Vec3& a = surface.vertices[t[0]];
        const Vec3 twice_area = cross(surface.vertices[t[1]] - a, surface.vertices[t[2]] - a);
        const double area = length(twice_area) / 2;
        if (!(area > 0)) {
            continue;
        }
        const double dip = std::atan2(std::hypot(twice_area.x, twice_area.y), std::abs(twice_area.z)) * degrees;
        const bool first = result.area == 0;
        result.dip_min_deg = first ? dip : std::min(result.dip_min_deg, dip);
        result.dip_max_deg = first ? dip : std::max(result.dip_max_deg, dip);
        result.area += area;
        dip_sum += area * dip;
        upward_sum = upward_sum + (twice_area.z < 0 ? -0.5 : 0.5) * twice_area;
    }
    if (result.area > 0) {
        result.dip_mean_deg = dip_sum / result.area;
        if (std::hypot(upward_sum.x, upward_sum.y) > least_lean * result.area) {
            const double direction = std::atan2(upward_sum.x, upward_sum.y) * degrees;
            result.dip_direction_deg = direction < 0 ? direction + 360 : direction;
        }
    }
    return result;
}

}  // namespace terratet
