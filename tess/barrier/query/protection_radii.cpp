// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/barrier/query/protection_radii.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "tess/barrier/query/pair_way.hpp"
#include "tess/base/seed_grid.hpp"
#include "tess/base/triangle_grid.hpp"

namespace terratet {
namespace {

constexpr double noticeable = 0.7;     ///< of the fault's own radius: more is left as it is
constexpr double neighbourhood = 1.5;  ///< in spacings: nearer seeds of other faults count

/// How far a point of a triangle may be from the nearest corner: the circumradius, but for an obtuse triangle.
double covered_by_corners(const TriangleCorners& t) {
    double radius = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3& a = t[k];
        const Vec3 ab = t[(k + 1) % 3] - a;
        const Vec3 ac = t[(k + 2) % 3] - a;
        const double product = dot(ab, ac);
        if (product <= 0) {  // where the bisectors of the short edges meet the long one
            const auto reach = [](const Vec3& from, const Vec3& apex, const Vec3& to) {
                return squared_distance(apex, from) * distance(to, from) / (2 * dot(apex - from, to - from));
            };
            const Vec3& b = t[(k + 1) % 3];
            const Vec3& c = t[(k + 2) % 3];
            return std::max(reach(b, a, c), reach(c, a, b));
        }
        radius = length(ab) * length(ac) * length(ac - ab) / (2 * length(cross(ab, ac)));
    }
    return radius;
}

/// A pair of seeds over a place.
struct OwnPair {
    double half = 0;  ///< of the width between the two
    double away = 0;  ///< its middle from the place
};

/// The pairs of seeds of a fault.
class PairWidths {
  public:
    explicit PairWidths(const Barrier& barrier) : grid_(middles(barrier), barrier.spacing) {
        for (std::size_t k = 0; k + 1 < barrier.seeds.size(); k += 2) {
            half_.push_back(0.5 * distance(barrier.seeds[k].position, barrier.seeds[k + 1].position));
        }
    }

    /// The nearest, if its middle is so near.
    [[nodiscard]] std::optional<OwnPair> at(const Vec3& p, double within) const {
        const std::uint32_t nearest = grid_.nearest(p);
        const double away = nearest != no_index ? distance(grid_.point(nearest), p) : 0;
        return nearest != no_index && away <= within ? std::optional(OwnPair{half_[nearest], away}) : std::nullopt;
    }

  private:
    static std::vector<Vec3> middles(const Barrier& barrier) {
        std::vector<Vec3> result;
        for (std::size_t k = 0; k + 1 < barrier.seeds.size(); k += 2) {
            result.push_back(0.5 * (barrier.seeds[k].position + barrier.seeds[k + 1].position));
        }
        return result;
    }
    std::vector<double> half_;
    SeedGrid grid_;
};

std::vector<Vec3> seeds_of_others(std::span<const Barrier> barriers, std::size_t barrier) {
    std::vector<Vec3> seeds;
    for (std::size_t f = 0; f < barriers.size(); ++f) {
        for (const Seed& seed : f == barrier ? std::vector<Seed>{} : barriers[f].seeds) {
            seeds.push_back(seed.position);
        }
    }
    return seeds;
}

}  // namespace

std::vector<double> protection_radii(std::span<const Barrier> barriers, std::size_t barrier) {
    const Barrier& own = barriers[barrier];
    std::vector<double> radii(own.sheet.triangles.size() + own.margin.triangles.size(), own.protection_radius);
    const double bare = std::hypot(own.covering_radius, own.width / 2);
    if (!own.refined || own.seeds.empty() || !(own.covering_radius > 0) || own.protection_radius < bare * (1 - 1e-9)) {
        return radii;
    }
    const double factor = own.protection_radius / bare;  // of bent surfaces
    const PairWidths widths(own);
    std::vector<std::pair<std::size_t, Vec3>> smaller;
    for (std::size_t t = 0; t < own.sheet.triangles.size(); ++t) {
        TriangleCorners c;
        for (std::size_t k = 0; k < 3; ++k) {
            c[k] = own.sheet.vertices[own.sheet.triangles[t][k]];
        }
        const double within = own_pair * std::max({distance(c[0], c[1]), distance(c[1], c[2]), distance(c[2], c[0])});
        OwnPair widest;
        bool known = true;
        for (const Vec3& corner : c) {
            const auto pair = widths.at(corner, within);
            known = known && pair;
            widest = {std::max(widest.half, pair ? pair->half : 0), std::max(widest.away, pair ? pair->away : 0)};
        }
        const double radius =
            known ? factor * std::hypot(covered_by_corners(c) + widest.away, widest.half) : own.protection_radius;
        if (radius < noticeable * own.protection_radius) {
            radii[t] = radius;
            smaller.emplace_back(t, (c[0] + c[1] + c[2]) / 3);
        }
    }
    const std::vector<Vec3> others = smaller.empty() ? std::vector<Vec3>{} : seeds_of_others(barriers, barrier);
    if (!others.empty()) {
        const double near = neighbourhood * own.spacing;
        const SeedGrid grid(others, near);
        for (const auto& [t, middle] : smaller) {
            const std::uint32_t nearest = grid.nearest(middle);
            if (nearest != no_index && distance(grid.point(nearest), middle) < near) {
                radii[t] = own.protection_radius;
            }
        }
    }
    return radii;
}

}  // namespace terratet
