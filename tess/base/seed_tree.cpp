// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/base/seed_tree.hpp"

#include <algorithm>
#include <array>
#include <numeric>

namespace terratet {
namespace {

constexpr std::uint32_t leaf_size = 8;
constexpr std::size_t deepest = 64;  // more than a tree of halves

}  // namespace

SeedTree::SeedTree(std::span<const Vec3> points) : points_(points), order_(points.size()) {
    std::iota(order_.begin(), order_.end(), 0U);
    if (!order_.empty()) {
        split(0, static_cast<std::uint32_t>(order_.size()));
    }
}

void SeedTree::split(std::uint32_t begin, std::uint32_t end) {
    const auto here = nodes_.size();
    Node node{{}, begin, end, 0};
    for (std::uint32_t i = begin; i < end; ++i) {
        node.box.extend(points_[order_[i]]);
    }
    nodes_.push_back(node);
    if (end - begin <= leaf_size) {
        return;
    }
    const Vec3 size = node.box.size();
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::uint32_t middle = begin + (end - begin) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](std::uint32_t a, std::uint32_t b) { return points_[a][axis] < points_[b][axis]; });
    split(begin, middle);
    nodes_[here].right = static_cast<std::uint32_t>(nodes_.size());
    split(middle, end);
}

std::uint32_t SeedTree::nearest(const Vec3& p, double radius) const {
    struct Waiting {
        std::uint32_t node = 0;
        double squared_distance = 0;
    };
    const auto to_box = [&](std::uint32_t node) { return squared_distance(p, nodes_[node].box.clamped(p)); };
    std::array<Waiting, deepest> waiting{};
    std::size_t count = 0;
    std::uint32_t best = none;
    double least = radius * radius;
    if (!nodes_.empty()) {
        waiting[count++] = {0, to_box(0)};
    }
    while (count > 0) {
        const auto [at, away] = waiting[--count];
        if (away > least) {
            continue;
        }
        const Node& node = nodes_[at];
        if (node.right != 0) {
            Waiting near{at + 1, to_box(at + 1)};
            Waiting far{node.right, to_box(node.right)};
            if (far.squared_distance < near.squared_distance) {
                std::swap(near, far);
            }
            waiting[count++] = far;
            waiting[count++] = near;
            continue;
        }
        for (std::uint32_t k = node.begin; k < node.end; ++k) {
            const std::uint32_t i = order_[k];
            const double d = squared_distance(points_[i], p);
            if (d < least || (d == least && best != none && i < best)) {
                least = d;
                best = i;
            }
        }
    }
    return best;
}

}  // namespace terratet
