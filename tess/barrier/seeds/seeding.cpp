// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/barrier/seeds/seeding.hpp"

#include <algorithm>
#include <numbers>

#include "tess/base/seed_tree.hpp"

namespace terratet {
namespace {

constexpr double last_resort_lower = 2.5;  ///< times the freedom of heights
constexpr double height_freedom = 0.15;    ///< by which part pairs may be lowered whose places cover more than theirs

}  // namespace

SeedCollector::SeedCollector(const SeedTask& task)
    : task_(task), seeds_(task.surface_count), freedom_(task.surface_count) {}

bool SeedCollector::add(std::uint32_t surface, const Vec3& plus, const Vec3& minus, const Freedom& freedom) {
    const Vec3 above = task_.frame.snapped(plus);
    const Vec3 below = task_.frame.snapped(minus);
    if (above == below || taken_.contains(above) || taken_.contains(below)) {
        return false;
    }
    taken_.insert({above, below});
    places_.insert(places_.end(), {above, below});
    seeds_[surface].push_back({above, 1});
    seeds_[surface].push_back({below, -1});
    const bool stays = !task_.bounds.empty() && task_.bounds[surface] != 0;
    freedom_[surface].push_back(stays ? Freedom{} : freedom);
    return true;
}

std::size_t SeedCollector::first_pair(std::uint32_t surface) const {
    std::size_t first = 0;
    for (std::uint32_t before = 0; before < surface; ++before) {
        first += freedom_[before].size();
    }
    return first;
}

std::vector<double> SeedCollector::mend(const std::function<bool(const Vec3& seed)>& fits, const LinkedPairs& linked) {
    std::vector<double> farthest(task_.surface_count, 0);
    if (task_.mend_within == nullptr) {
        return farthest;
    }
    std::vector<MovablePair> pairs;
    for (std::uint32_t surface = 0; surface < task_.surface_count; ++surface) {
        for (std::size_t k = 0; k < freedom_[surface].size(); ++k) {
            const auto& [along, height] = freedom_[surface][k];
            pairs.push_back(
                {seeds_[surface][2 * k].position, seeds_[surface][2 * k + 1].position, surface, along, height});
        }
    }
    const std::vector<MovablePair> given = pairs;
    SliverTask task;
    task.rule = {widest_sliver * task_.sizes.spacing(), *task_.mend_within,
                 [&](const Vec3& a, const Vec3& b) { return task_.wall.between(a, b); }};
    task.may_move = [&](std::size_t pair, const Vec3& plus, const Vec3& minus) {
        return !taken_.contains(plus) && !taken_.contains(minus) && fits(plus) && fits(minus) &&
               !task_.wall.between(given[pair].plus, plus) && !task_.wall.between(given[pair].minus, minus);
    };
    task.linked = linked;
    const bool bounded = std::ranges::any_of(task_.bounds, [](char bound) { return bound != 0; });
    task.lower = bounded ? 1 : last_resort_lower;  // seeds beside ground and walls shape where the model ends
    const SliversMended mended = mend_slivers(pairs, task, task_.frame, task_.poll);
    places_.clear();
    std::vector<std::size_t> next(task_.surface_count, 0);
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        const std::uint32_t surface = pairs[k].owner;
        for (const Vec3& seed : {pairs[k].plus, pairs[k].minus}) {
            seeds_[surface][next[surface]++].position = seed;
            places_.push_back(seed);
        }
        if (mended.moved[k] != 0) {
            farthest[surface] = std::max(farthest[surface], pairs[k].along);
        }
    }
    taken_ = {places_.begin(), places_.end()};
    return farthest;
}

void SeedCollector::cover_all(const std::vector<TriMesh>& skirts, double clear, SeededComplex& result) {
    const double covered = task_.sizes.spacing() * std::numbers::sqrt2 / 2 * (1 + 1e-6);
    constexpr std::size_t any_number = std::numeric_limits<std::size_t>::max();
    for (std::uint32_t surface = 0; surface < task_.surface_count; ++surface) {
        ask(task_.poll);
        const TriMesh sheet = sheet_of(task_.complex, surface);
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
            add(surface, base[k].position + half, base[k].position - half, {0, height_freedom});
        }
        TriMesh all = sheet;
        append(all, skirts[surface]);
        result.covering_radius.push_back(all.triangles.empty() ? 0 : covering_radius(all, base, covered));
    }
}

void SeedCollector::test_separation(SeededComplex& result) const {
    const SheetComplex& complex = task_.complex;
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
                if (nearest == no_index || task_.wall.between(place, seeds.point(nearest))) {
                    result.separated[t] = 0;
                }
            }
        }
    }
}

}  // namespace terratet
