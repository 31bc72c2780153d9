// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/barrier/complex/places_near.hpp"

#include <cmath>

#include "tess/base/triangle_grid.hpp"

namespace terratet {
namespace {

constexpr double finest = 1.0 / 8;  ///< of the spacing
constexpr double approach = 0.85;   ///< size of a triangle over the distance that its seeds are to allow

}  // namespace

std::vector<WantedSize> places_near(std::span<const Vec3> samples, const SheetComplex& complex, double spacing) {
    std::vector<WantedSize> places;
    const double reach = spacing / approach;
    std::vector<TriangleCorners> triangles;
    for (std::uint32_t t = 0; t < complex.triangles.size(); ++t) {
        triangles.push_back(corners(complex, t));
    }
    const TriangleGrid grid(std::move(triangles), std::vector<double>(complex.triangles.size(), reach));
    for (const Vec3& p : samples) {
        FinerPlace nearest;
        double least = reach * reach;
        for (const std::uint32_t t : grid.candidates(p)) {
            const TriangleCorners& c = grid.triangle(t);
            const Vec3 q = closest_point_on_triangle(p, c[0], c[1], c[2]);
            if (squared_distance(p, q) < least) {
                least = squared_distance(p, q);
                nearest = {q, {complex.sheet[t]}};
            }
        }
        const double wanted = approach * std::sqrt(least);
        if (wanted < spacing && wanted >= finest * spacing) {
            places.push_back({nearest, wanted});
        }
    }
    return places;
}

}  // namespace terratet
