// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/barrier/query/sheet_crossings.hpp"

#include <algorithm>
#include <map>
#include <optional>

namespace terratet {
namespace {

constexpr double tolerance = 1e-9;  ///< of barycentric coordinates: nothing slips through between two triangles
constexpr double same = 1e-6;       ///< crossings nearer to each other, relative, are one

/// Where the segment meets the triangle's plane within the triangle.
std::optional<double> crossing(const TriangleCorners& t, const Vec3& a, const Vec3& b) {
    const Vec3 normal = cross(t[1] - t[0], t[2] - t[0]);
    const double from = dot(a - t[0], normal);
    const double to = dot(b - t[0], normal);
    if ((from > 0 && to > 0) || (from < 0 && to < 0) || from == to) {
        return {};
    }
    const double at = from / (from - to);
    const Vec3 p = a + at * (b - a);
    const double least = -tolerance * squared_length(normal);
    for (std::size_t k = 0; k < 3; ++k) {
        if (dot(cross(t[(k + 1) % 3] - t[k], p - t[k]), normal) < least) {
            return {};
        }
    }
    return at;
}

/// The middle one of an odd number.
std::optional<double> parting(std::vector<double>& places) {
    std::ranges::sort(places);
    places.erase(std::unique(places.begin(), places.end(), [](double a, double b) { return b - a < same; }),
                 places.end());
    return places.size() % 2 == 1 ? std::optional(places[places.size() / 2]) : std::nullopt;
}

}  // namespace

SheetCrossings::SheetCrossings(std::span<const Barrier> barriers, const Box3& extent, const std::vector<char>& selected,
                               double longest)
    : extent_(extent) {
    std::vector<TriangleCorners> triangles;
    for (std::size_t f = 0; f < barriers.size(); ++f) {
        for (const Surface* part : {&barriers[f].sheet, &barriers[f].margin}) {
            for (const Triangle& t : part->triangles) {
                if (selected[f] != 0) {
                    triangles.push_back({part->vertices[t[0]], part->vertices[t[1]], part->vertices[t[2]]});
                    owner_.push_back({static_cast<std::int32_t>(f), part == &barriers[f].margin});
                }
            }
        }
    }
    const std::vector<double> reach(triangles.size(), 0.51 * longest);
    triangles_ = TriangleGrid(std::move(triangles), reach);
}

std::vector<SheetCrossings::Crossing> SheetCrossings::operator()(const Vec3& a, const Vec3& b) const {
    struct Met {
        std::vector<double> sheet;
        std::vector<double> margin;
    };
    std::map<std::int32_t, Met> met;
    for (const std::uint32_t i : triangles_.candidates(0.5 * (a + b))) {
        if (const auto at = crossing(triangles_.triangle(i), a, b)) {
            const auto& [barrier, margin] = owner_[i];
            if (!margin) {
                met[barrier].sheet.push_back(*at);
            } else if (!extent_.contains(a + *at * (b - a))) {
                met[barrier].margin.push_back(*at);
            }
        }
    }
    std::vector<Crossing> result;
    for (auto& [barrier, places] : met) {
        if (const auto at = parting(places.sheet.empty() ? places.margin : places.sheet)) {
            result.push_back({*at, barrier});
        }
    }
    std::ranges::sort(result);
    return result;
}

}  // namespace terratet
