// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/fault_seed.hpp"

#include <algorithm>
#include <numbers>

#include "tess/seed_tree.hpp"

namespace terratet {

SeedCollector::SeedCollector(const SeedTask& task) : task_(task), seeds_(task.surface_count) {}

bool SeedCollector::add(std::uint32_t surface, const Vec3& plus, const Vec3& minus) {
    const Vec3 above = task_.frame.snapped(plus);
    const Vec3 below = task_.frame.snapped(minus);
    if (above == below || taken_.contains(above) || taken_.contains(below)) {
        return false;
    }
    taken_.insert({above, below});
    places_.insert(places_.end(), {above, below});
    seeds_[surface].push_back({above, 1});
    seeds_[surface].push_back({below, -1});
    return true;
}

void SeedCollector::cover_all(const std::vector<FaultMesh>& skirts, double clear, SeededComplex& result) {
    const double covered = task_.sizes.spacing() * std::numbers::sqrt2 / 2 * (1 + 1e-6);
    constexpr std::size_t any_number = std::numeric_limits<std::size_t>::max();
    for (std::uint32_t surface = 0; surface < task_.surface_count; ++surface) {
        ask(task_.poll);
        const FaultMesh sheet = sheet_of(task_.complex, surface);
        const std::vector<Vec3> normals = vertex_normals(sheet);
        std::vector<BasePoint> base;
        for (std::size_t v = 0; v < normals.size(); ++v) {
            base.push_back({sheet.points[v], normals[v]});
        }
        const std::size_t own = base.size();
        cover(
            sheet, covered, any_number, [](const Vec3&) { return true; }, base);
        const auto clear_of_others = [&](const Vec3& p) {
            return task_.wall.distance_to_others(p, surface, clear) >= clear;
        };
        cover(skirts[surface], covered, any_number, clear_of_others, base);
        for (std::size_t k = own; k < base.size(); ++k) {
            const Vec3 half = 0.5 * task_.width * base[k].normal;
            add(surface, base[k].position + half, base[k].position - half);
        }
        FaultMesh all = sheet;
        append(all, skirts[surface]);
        result.covering_radius.push_back(all.triangles.empty() ? 0 : covering_radius(all, base, covered));
    }
}

void SeedCollector::test_separation(SeededComplex& result) const {
    const FaultComplex& complex = task_.complex;
    const SeedTree seeds(places_);
    const double reach = 1.2 * task_.sizes.spacing();
    result.separated.assign(complex.triangles.size(), 1);
    for (std::uint32_t t = 0; t < complex.triangles.size(); ++t) {
        if (t % 256 == 0) {
            ask(task_.poll);
        }
        const TriangleCorners c = corners(complex, t);
        const Vec3 normal = unit(area_vector(c));
        const Vec3 middle = centroid(c);
        const double away = 0.25 * task_.width * task_.sizes.at(middle) / task_.sizes.spacing();
        for (const Vec3& x : {middle, 0.5 * (c[0] + c[1]), 0.5 * (c[1] + c[2]), 0.5 * (c[2] + c[0])}) {
            const Vec3 inner = x + 0.02 * (middle - x);
            for (const double side : {1.0, -1.0}) {
                const Vec3 place = inner + side * away * normal;
                const std::uint32_t nearest = seeds.nearest(place, reach);
                if (nearest == SeedTree::none || task_.wall.between(place, seeds.point(nearest))) {
                    result.separated[t] = 0;
                }
            }
        }
    }
}

}  // namespace terratet
