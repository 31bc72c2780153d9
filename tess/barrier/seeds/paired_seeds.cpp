// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "tess/barrier/query/pair_way.hpp"
#include "tess/barrier/seeds/seeding.hpp"

namespace terratet {
namespace {

constexpr double bend_factor = 1.1;      ///< on the protection radius of bent surfaces
constexpr double flat = 0.9999;          ///< cosine of the turn from which a surface counts as bent
constexpr double straight = -0.95;       ///< cosine of the angle from which two half-sheets make no corner
constexpr double height_freedom = 0.15;  ///< by which part pairs may be lowered to mend slivers
constexpr double aside = 2.0 / 3;  ///< share of half a junction's sector that a seed is turned from its half-sheet

/// Triangles round a point that hang together over smooth edges: a sheet, or a half-sheet where others join it.
struct PointFan {
    std::uint32_t surface = 0;
    std::uint32_t triangle = 0;  ///< one of them
    Vec3 normal;
    Vec3 direction;  ///< from the point into the fan
};

class PairedSeeds {
  public:
    explicit PairedSeeds(const SeedTask& task)
        : task_(task),
          complex_(task.complex),
          collector_(task),
          star_(complex_.points.size()),
          at_rim_(complex_.points.size(), 0) {
        for (std::uint32_t t = 0; t < complex_.triangles.size(); ++t) {
            for (const std::uint32_t v : complex_.triangles[t]) {
                star_[v].push_back(t);
            }
        }
        for (const EdgeTable::Edge& e : task_.edges.edges()) {
            if (task_.edges.triangles(e).size() == 1) {
                at_rim_[e.a] = at_rim_[e.b] = 1;
            }
        }
    }

    SeededComplex run(const std::vector<TriMesh>& skirts) {
        SeededComplex result;
        result.certified.assign(complex_.triangles.size(), 0);
        for (std::uint32_t v = 0; v < complex_.points.size(); ++v) {
            if (v % 256 == 0) {
                ask(task_.poll);
            }
            place(v);
        }
        const double spacing = task_.sizes.spacing();
        const double widest = std::sqrt(0.5 * spacing * spacing + 0.25 * task_.width * task_.width);
        collector_.cover_all(skirts, widest, result);
        const std::vector<double> moved = collector_.mend([](const Vec3&) { return true; });
        const std::vector<char> bent = bent_surfaces();
        for (std::size_t surface = 0; surface < result.covering_radius.size(); ++surface) {
            double& rho = result.covering_radius[surface];
            rho = moved[surface] > 0 ? std::min(rho + moved[surface], spacing * std::numbers::sqrt2 / 2) : rho;
            result.protection_radius.push_back((bent[surface] != 0 ? bend_factor : 1.0) *
                                               std::sqrt(rho * rho + 0.25 * task_.width * task_.width));
        }
        collector_.test_separation(result);
        result.seeds = collector_.take();
        return result;
    }

  private:
    /// How far a base point may go and its triangles stay covered. Those near rims may not: they cover the margin too.
    [[nodiscard]] double free_way(std::uint32_t v) const {
        if (task_.mend_within == nullptr) {
            return 0;
        }
        const double covered = task_.sizes.spacing() * std::numbers::sqrt2 / 2;
        double way = pair_way * task_.sizes.at(complex_.points[v]);
        for (const std::uint32_t t : star_[v]) {
            way = std::min(way, covered - terratet::covering_radius(corners(complex_, t)));
            for (const std::uint32_t w : complex_.triangles[t]) {
                way = at_rim_[w] != 0 ? 0 : way;
            }
        }
        return std::max(0.0, way);
    }

    [[nodiscard]] std::vector<PointFan> fans(std::uint32_t v) const {
        const std::vector<std::uint32_t>& star = star_[v];
        std::vector<std::size_t> parent(star.size());
        std::iota(parent.begin(), parent.end(), 0U);
        const auto root = [&](std::size_t k) {
            while (parent[k] != k) {
                k = parent[k];
            }
            return k;
        };
        for (std::size_t k = 0; k < star.size(); ++k) {
            for (const std::uint32_t w : complex_.triangles[star[k]]) {
                const auto of_edge = w == v ? std::span<const std::uint32_t>{} : task_.edges.triangles(v, w);
                if (!is_smooth(complex_, of_edge)) {
                    continue;
                }
                const std::uint32_t other = of_edge[0] == star[k] ? of_edge[1] : of_edge[0];
                const auto at = static_cast<std::size_t>(std::ranges::find(star, other) - star.begin());
                const auto [low, high] = std::minmax({root(k), root(at)});
                parent[high] = low;
            }
        }
        std::vector<PointFan> result;
        std::vector<std::size_t> number(star.size());
        for (std::size_t k = 0; k < star.size(); ++k) {
            if (root(k) == k) {
                number[k] = result.size();
                result.push_back({complex_.sheet[star[k]], star[k], {}, {}});
            }
            PointFan& fan = result[number[root(k)]];
            const TriangleCorners c = corners(complex_, star[k]);
            const Vec3 area = area_vector(c);
            fan.normal = fan.normal + area;
            fan.direction = fan.direction + length(area) * (centroid(c) - complex_.points[v]);
        }
        for (PointFan& fan : result) {
            fan.normal = unit(fan.normal);
            fan.direction = unit(fan.direction);
        }
        return result;
    }

    void place(std::uint32_t v) {
        const std::vector<PointFan> all = fans(v);
        const Vec3& p = complex_.points[v];
        const double half = 0.5 * task_.width * task_.sizes.at(p) / task_.sizes.spacing();
        if (all.size() == 1) {
            collector_.add(all[0].surface, p + half * all[0].normal, p - half * all[0].normal,
                           {free_way(v), height_freedom});
            return;
        }
        const Vec3 tangent = junction_tangent(v);
        const bool at_bound = !task_.bounds.empty() && std::ranges::any_of(all, [&](const PointFan& fan) {
            return task_.bounds[fan.surface] != 0;
        });
        if (all.size() == 2) {
            guard_corner(p, half, tangent, all);
        }
        for (const PointFan& fan : all) {
            Vec3 along = fan.direction - dot(fan.direction, tangent) * tangent;
            along = unit(along - dot(along, fan.normal) * fan.normal);
            const double turn = aside * free_angle(fan, along, tangent, all);
            Vec3 plus = half * (std::cos(turn) * along + std::sin(turn) * fan.normal);
            Vec3 minus = half * (std::cos(turn) * along - std::sin(turn) * fan.normal);
            for (int tries = 0; tries < 4; ++tries) {
                if (sees(fan, p + plus) && sees(fan, p + minus)) {
                    collector_.add(
                        fan.surface, p + plus, p + minus,
                        at_bound ? SeedCollector::Freedom{} : SeedCollector::Freedom{free_way(v), height_freedom});
                    break;
                }
                plus = 0.5 * plus;
                minus = 0.5 * minus;
            }
        }
    }

    /// Where two half-sheets meet in a corner and nothing else does, their own pairs leave its wide side open: one more
    /// stands across it.
    void guard_corner(const Vec3& p, double half, const Vec3& tangent, const std::vector<PointFan>& both) {
        const Vec3 one = unit(both[0].direction - dot(both[0].direction, tangent) * tangent);
        const Vec3 other = unit(both[1].direction - dot(both[1].direction, tangent) * tangent);
        if (dot(one, other) > straight) {
            const Vec3 in = half * unit(one + other);
            const double side = dot(in, both[0].normal) > 0 ? 1 : -1;
            collector_.add(both[0].surface, p + side * in, p - side * in, {0, height_freedom});
        }
    }

    /// Zero where no single line runs through the point.
    [[nodiscard]] Vec3 junction_tangent(std::uint32_t v) const {
        std::vector<std::uint32_t> ends;
        for (const std::uint32_t t : star_[v]) {
            for (const std::uint32_t w : complex_.triangles[t]) {
                if (w != v && std::ranges::find(ends, w) == ends.end()) {
                    const auto of_edge = task_.edges.triangles(v, w);
                    if (of_edge.size() > 1 && !is_smooth(complex_, of_edge)) {
                        ends.push_back(w);
                    }
                }
            }
        }
        return ends.size() == 2 ? unit(complex_.points[ends[1]] - complex_.points[ends[0]]) : Vec3{};
    }

    /// Half the angle to the nearest other half-sheet, at most 90°.
    static double free_angle(const PointFan& fan, const Vec3& along, const Vec3& tangent,
                             const std::vector<PointFan>& all) {
        double least = std::numbers::pi / 2;
        for (const PointFan& other : all) {
            if (&other != &fan) {
                const Vec3 way = unit(other.direction - dot(other.direction, tangent) * tangent);
                least = std::min(least, 0.5 * std::acos(std::clamp(dot(way, along), -1.0, 1.0)));
            }
        }
        return least;
    }

    [[nodiscard]] bool sees(const PointFan& fan, const Vec3& seed) const {
        return !task_.wall.between(seed, centroid(corners(complex_, fan.triangle)), fan.triangle);
    }

    [[nodiscard]] std::vector<char> bent_surfaces() const {
        std::vector<char> bent(task_.surface_count, 0);
        for (std::uint32_t v = 0; v < star_.size(); ++v) {
            for (const std::uint32_t s : star_[v]) {
                for (const std::uint32_t t : star_[v]) {
                    if (complex_.sheet[s] == complex_.sheet[t] &&
                        dot(unit(area_vector(corners(complex_, s))), unit(area_vector(corners(complex_, t)))) < flat) {
                        bent[complex_.sheet[s]] = 1;
                    }
                }
            }
        }
        return bent;
    }

    const SeedTask& task_;
    const SheetComplex& complex_;
    SeedCollector collector_;
    std::vector<std::vector<std::uint32_t>> star_;
    std::vector<char> at_rim_;  ///< by point
};

}  // namespace

SeededComplex paired_seeds(const SeedTask& task, const std::vector<TriMesh>& skirts) {
    return PairedSeeds(task).run(skirts);
}

}  // namespace terratet
