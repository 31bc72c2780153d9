// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/base/seed_tree.hpp"

#include <numeric>

namespace terratet {
namespace {

constexpr std::uint32_t leaf_size = 8;

std::vector<std::uint32_t> numbers(std::size_t count) {
    std::vector<std::uint32_t> result(count);
    std::iota(result.begin(), result.end(), 0U);
    return result;
}

}  // namespace

SeedTree::SeedTree(std::span<const Vec3> points)
    : points_(points),
      tree_(
          numbers(points.size()), leaf_size, [&](auto& node, std::uint32_t i) { node.box.extend(points[i]); },
          [&](std::uint32_t i, int axis) { return points[i][axis]; }) {}

std::uint32_t SeedTree::nearest(const Vec3& p, double radius) const {
    std::uint32_t best = no_index;
    double least = radius * radius;
    const auto wanted = [&](const auto&, double away) { return away <= least; };
    tree_.near_first(p, wanted, [&](std::uint32_t i) {
        const double d = squared_distance(points_[i], p);
        if (d < least || (d == least && best != no_index && i < best)) {
            least = d;
            best = i;
        }
    });
    return best;
}

}  // namespace terratet
