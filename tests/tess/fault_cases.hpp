// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Surfaces to prepare as faults, and the oracle for guarantee F1: a Delaunay tessellation straight from CGAL.

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "support.hpp"
#include "tess/barrier/prepare/prepare.hpp"
#include "tess/barrier_query.hpp"

namespace terratet::testing {

/// A grid of columns × rows cells over the unit square, put in place by `map`.
inline Surface gridded(const std::string& name, int columns, int rows, const std::function<Vec3(double, double)>& map) {
    Surface surface;
    surface.name = name;
    surface.file = name + ".ts";
    for (int j = 0; j <= rows; ++j) {
        for (int i = 0; i <= columns; ++i) {
            surface.vertices.push_back(map(static_cast<double>(i) / columns, static_cast<double>(j) / rows));
        }
    }
    const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(j * (columns + 1) + i); };
    for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < columns; ++i) {
            surface.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            surface.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    }
    return surface;
}

/// A rectangle of two triangles: centre, half its sides.
inline Surface rectangle(const std::string& name, const Vec3& center, const Vec3& u, const Vec3& v) {
    return gridded(name, 1, 1, [=](double a, double b) { return center + (2 * a - 1) * u + (2 * b - 1) * v; });
}

/// A plane by strike and dip in degrees through a point.
inline Surface dipping(const std::string& name, const Vec3& center, double strike_deg, double dip_deg,
                       double half_length, double half_height) {
    const double strike = strike_deg * 0.017453292519943295;
    const double dip = dip_deg * 0.017453292519943295;
    const Vec3 along = {std::sin(strike), std::cos(strike), 0};
    const Vec3 down = {std::cos(strike) * std::cos(dip), -std::sin(strike) * std::cos(dip), -std::sin(dip)};
    return rectangle(name, center, half_length * along, half_height * down);
}

/// Round the y axis, through the middle of a 400 m cube.
inline Surface cylinder(double radius) {
    return gridded("cylinder", 24, 20, [=](double u, double v) {
        const double angle = (u - 0.5) * 320 / radius;
        return Vec3{200 + radius * std::sin(angle), 800 * v - 200, 200 - radius + radius * std::cos(angle)};
    });
}

/// All over a 400 m cube, half way up.
inline Surface wavy() {
    return gridded("wavy", 40, 40, [](double u, double v) {
        return Vec3{600 * u - 100, 600 * v - 100, 200 + 15 * std::sin(10 * u) * std::cos(9 * v)};
    });
}

/// What every preparation promises: a complete account (F4), distinct seeds in the hull box off its faces, mirrored
/// pairs, and covering of sheet and margin within ρ at sampled points.
inline void check_promises(const std::vector<Surface>& surfaces, const BarrierPreparation& preparation,
                           const Box3& extent, double l_min, const BarrierOptions& options = {}) {
    REQUIRE(preparation.accounts.size() == surfaces.size());
    std::size_t used = 0;
    std::size_t seeds = 0;
    for (const BarrierAccount& account : preparation.accounts) {
        INFO(account.name << ": " << account.reason);
        const double sum = account.area_used + account.area_trimmed + account.area_outside + account.area_refused;
        REQUIRE(std::isfinite(account.area_in));
        REQUIRE(std::abs(sum - account.area_in) <= 1e-6 * account.area_in);
        REQUIRE(account.area_used >= 0);
        REQUIRE(account.area_trimmed >= 0);
        REQUIRE(account.area_outside >= 0);
        REQUIRE(account.area_refused >= 0);
        REQUIRE((account.used || !account.reason.empty()));
        REQUIRE((account.used == (account.seeds > 0)));
        used += account.used ? 1 : 0;
        seeds += account.seeds;
    }
    REQUIRE(preparation.barriers.size() == used);
    const bool exact = options.mode == SeedMode::exact;
    std::set<Vec3> places;
    const Box3 clear = extent.grown(hull_margin(options, l_min)).grown(-0.3 * l_min);
    for (const Barrier& fault : preparation.barriers) {
        REQUIRE(fault.seeds.size() % 2 == 0);
        REQUIRE((exact || fault.covering_radius <= fault.spacing / std::numbers::sqrt2 * (1 + 1e-5)));
        for (std::size_t k = 0; k < fault.seeds.size(); k += 2) {
            REQUIRE(fault.seeds[k].side == 1);
            REQUIRE(fault.seeds[k + 1].side == -1);
            const double width = distance(fault.seeds[k].position, fault.seeds[k + 1].position);
            REQUIRE(width > 0);
            REQUIRE(width <= (exact ? 2 * fault.spacing : fault.width * (1 + 1e-6)));
            REQUIRE(clear.contains(fault.seeds[k].position));
            REQUIRE(clear.contains(fault.seeds[k + 1].position));
            places.insert(fault.seeds[k].position);
            places.insert(fault.seeds[k + 1].position);
        }
        for (const Vec3& p : fault.sheet.vertices) {
            REQUIRE(extent.grown(1e-6).contains(p));
        }
    }
    REQUIRE(places.size() == seeds);
}

struct CrossingCount {
    std::size_t background = 0;  ///< other vertices
    std::size_t crossing = 0;    ///< edges that cross a sheet without both ends being its or a meeting fault's seeds
    std::size_t paired = 0;      ///< edges that cross with both ends such seeds
};

/// Tessellates the seeds with background points, half of them right at `limit` protection radii from the faults and
/// none nearer, and counts the edges that cross.
inline CrossingCount count_crossings(const std::vector<Barrier>& faults, const Box3& hull, std::size_t background,
                                     double limit, std::uint64_t random_seed) {
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    using Base = CGAL::Triangulation_vertex_base_with_info_3<int, Kernel>;
    using Delaunay = CGAL::Delaunay_triangulation_3<
        Kernel, CGAL::Triangulation_data_structure_3<Base, CGAL::Delaunay_triangulation_cell_base_3<Kernel>>>;
    std::vector<Barrier> scaled = faults;
    for (Barrier& fault : scaled) {
        fault.protection_radius *= limit;
    }
    const BarrierQuery zone(scaled);
    const BarrierQuery proximity(faults);

    std::vector<std::pair<Kernel::Point_3, int>> points;
    const auto add = [&](const Vec3& p, int owner) { points.push_back({{p.x, p.y, p.z}, owner}); };
    for (std::size_t f = 0; f < faults.size(); ++f) {
        for (const Seed& seed : faults[f].seeds) {
            add(seed.position, static_cast<int>(f));
        }
    }
    for (int corner = 0; corner < 8; ++corner) {
        add({(corner & 1) != 0 ? hull.hi.x : hull.lo.x, (corner & 2) != 0 ? hull.hi.y : hull.lo.y,
             (corner & 4) != 0 ? hull.hi.z : hull.lo.z},
            -1);
    }
    Random random(random_seed);
    CrossingCount count;
    for (std::size_t tries = 0; count.background < background && tries < 100 * background; ++tries) {
        Vec3 p = random.in(hull);
        if (tries % 2 == 1 && !faults.empty()) {
            const Barrier& fault = scaled[random.below(scaled.size())];
            const Surface& part = random.below(3) == 0 && !fault.margin.triangles.empty() ? fault.margin : fault.sheet;
            const Triangle& t = part.triangles[random.below(part.triangles.size())];
            double u = random();
            double v = random();
            if (u + v > 1) {
                u = 1 - u;
                v = 1 - v;
            }
            const Vec3 a = part.vertices[t[0]];
            const Vec3 b = part.vertices[t[1]];
            const Vec3 c = part.vertices[t[2]];
            const Vec3 n = cross(b - a, c - a);
            const double away = fault.protection_radius * (random.below(2) == 0 ? 1.0001 : random(1, 1.5));
            p = a + u * (b - a) + v * (c - a) + (random.below(2) == 0 ? away : -away) / length(n) * n;
        }
        if (hull.contains(p) && zone.protecting_barrier(p) < 0) {
            add(p, -1);
            ++count.background;
        }
    }
    const Delaunay tessellation(points.begin(), points.end());
    for (auto e = tessellation.finite_edges_begin(); e != tessellation.finite_edges_end(); ++e) {
        const auto a = e->first->vertex(e->second);
        const auto b = e->first->vertex(e->third);
        const Vec3 from = {a->point().x(), a->point().y(), a->point().z()};
        const Vec3 to = {b->point().x(), b->point().y(), b->point().z()};
        for (std::size_t f = 0; f < faults.size(); ++f) {
            if (proximity.crosses(static_cast<std::int32_t>(f), from, to)) {
                const auto its_seed = [&](int owner) {
                    return owner >= 0 && proximity.meet(static_cast<std::int32_t>(f), owner);
                };
                const bool both = its_seed(a->info()) && its_seed(b->info());
                ++(both ? count.paired : count.crossing);
            }
        }
    }
    return count;
}

}  // namespace terratet::testing
