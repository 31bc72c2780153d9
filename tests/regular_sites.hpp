// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Samples on lattices, planes, lines and spheres, the same jittered, and the places at which E3 compares their costs.

#include <cmath>
#include <string>
#include <vector>

#include "sites.hpp"

namespace terratet::testing {

struct RegularSites {
    std::string name;
    std::vector<Vec3> sites;
    double limit;  ///< E3's: of its cost over that of the same number jittered
};

inline std::vector<Vec3> grid_sites(std::size_t nx, std::size_t ny, std::size_t nz, const Vec3& step) {
    std::vector<Vec3> sites;
    for (std::size_t i = 0; i < nx; ++i) {
        for (std::size_t j = 0; j < ny; ++j) {
            for (std::size_t k = 0; k < nz; ++k) {
                sites.push_back({double(i) * step.x, double(j) * step.y, double(k) * step.z});
            }
        }
    }
    return sites;
}

/// Steps of 10; of the sphere all integer points at one distance.
inline std::vector<RegularSites> regular_sites(std::size_t count) {
    const auto n = static_cast<double>(count);
    const auto cube = static_cast<std::size_t>(std::lround(std::cbrt(n)));
    const auto square = static_cast<std::size_t>(std::lround(std::sqrt(n)));
    const auto layer = static_cast<std::size_t>(std::lround(std::sqrt(n / 5)));
    return {{"lattice", grid_sites(cube, cube, cube, {10, 10, 10}), 1.5},
            {"plane", grid_sites(square, square, 1, {10, 10, 10}), 1.5},
            {"line", grid_sites(count, 1, 1, {10, 10, 10}), 1.5},
            {"five layers", grid_sites(layer, layer, 5, {10, 10, 37}), 1.5},
            {"one sphere", cospherical_sites(count > 2000 ? 50'006 : 5'006), 5}};
}

/// Each moved by at most half a unit along each axis.
inline std::vector<Vec3> jittered(std::vector<Vec3> sites) {
    Random random(5);
    for (auto& p : sites) {
        p = p + random.in({{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}});
    }
    return sites;
}

/// In turns all over the box, at half steps, and up to four steps beyond.
inline std::vector<Vec3> places_around(const std::vector<Vec3>& sites, std::size_t count) {
    Random random(3);
    const Box3 box = bounding_box(sites), grown = box.grown(40);
    std::vector<Vec3> places;
    for (std::size_t i = 0; i < count; ++i) {
        Vec3 p = random.in(i % 3 == 2 ? grown : box);
        if (i % 3 == 1) {
            p = {5 * std::round(p.x / 5), 5 * std::round(p.y / 5), 5 * std::round(p.z / 5)};
        }
        places.push_back(p);
    }
    return places;
}

}  // namespace terratet::testing
