// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read/tables/area_of_use.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace terratet {
namespace {

constexpr std::size_t most_looked_at = 10'000;

/// How many lie outside.
std::size_t count_outside(std::vector<Vec3> points, const Crs& crs, const AreaOfUse& area) {
    if (!crs.geographic) {
        CrsTransform(crs, parse_crs("EPSG:4326")).apply(points);
    }
    return static_cast<std::size_t>(
        std::ranges::count_if(points, [&](const Vec3& point) { return !area.nearly_holds(point.x, point.y); }));
}

}  // namespace

std::string outside_area_of_use(const std::vector<Vec3>& points, const Crs& crs) {
    const auto area = crs.local ? std::nullopt : area_of_use(crs);
    if (!area) {
        return "";
    }
    std::vector<Vec3> looked_at;
    const std::size_t step = points.size() / most_looked_at + 1;
    for (std::size_t i = 0; i < points.size(); i += step) {
        if (is_finite(points[i])) {
            looked_at.push_back({points[i].x, points[i].y, 0});
        }
    }
    const std::size_t outside = count_outside(looked_at, crs, *area);
    if (outside == 0) {
        return "";
    }
    std::vector<Vec3> exchanged = looked_at;
    std::ranges::for_each(exchanged, [](Vec3& point) { std::swap(point.x, point.y); });
    const bool swapped = outside == looked_at.size() && count_outside(std::move(exchanged), crs, *area) == 0;
    return fmt::format(
        "{} of {} places lie outside the area of use of {} ({}; {:.6g}° to {:.6g}° E, {:.6g}° to {:.6g}° N): {}",
        outside, looked_at.size(), crs.name, area->name, area->west, area->east, area->south, area->north,
        swapped ? "with x and y exchanged they would lie inside; `columns` x=NAME y=NAME says which is which"
                : "is it the right system?");
}

}  // namespace terratet
