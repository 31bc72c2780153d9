// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// A tree of boxes round items, halved along their longest side: what most questions about many places or triangles
/// begin with.

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "tess/geometry.hpp"

namespace terratet {

struct NothingMore {};

/// \tparam More what a node knows of the items below besides their box
template <class Item, class More = NothingMore>
class BoxTree {
  public:
    struct Node {
        Box3 box;
        [[no_unique_address]] More more{};
        std::uint32_t begin = 0;
        std::uint32_t end = 0;
        std::uint32_t right = 0;  ///< the second child; the first follows at once; 0: a leaf
    };

    BoxTree() = default;

    /// \param grow  (node, item): makes the node's box hold the item, and notes what more it is to know
    /// \param key   (item, axis): by what items are halved. O(n log n).
    template <class Grow, class Key>
    BoxTree(std::vector<Item> items, std::uint32_t leaf_size, const Grow& grow, const Key& key)
        : items_(std::move(items)) {
        if (!items_.empty()) {
            nodes_.reserve(2 * items_.size() / leaf_size + 1);
            split(0, static_cast<std::uint32_t>(items_.size()), leaf_size, grow, key);
        }
    }

    [[nodiscard]] const std::vector<Item>& items() const { return items_; }  ///< in the order of the leaves

    /// Is the test true of an item at a leaf that is wanted, as are all nodes above it? Asked until it is.
    template <class Wanted, class Test>
    [[nodiscard]] bool any(const Wanted& wanted, const Test& test) const {
        std::array<std::uint32_t, deepest> waiting;
        std::size_t count = 0;
        if (!nodes_.empty()) {
            waiting[count++] = 0;
        }
        while (count > 0) {
            const std::uint32_t at = waiting[--count];
            const Node& node = nodes_[at];
            if (!wanted(node)) {
                continue;
            }
            if (node.right != 0) {
                waiting[count++] = node.right;
                waiting[count++] = at + 1;
                continue;
            }
            for (std::uint32_t i = node.begin; i < node.end; ++i) {
                if (test(items_[i])) {
                    return true;
                }
            }
        }
        return false;
    }

    /// Calls visit(item) at the leaves that are wanted, as are all nodes above them, nearer ones to p first. `wanted`
    /// is asked with the node and the squared distance to its box, when its turn comes: what visit finds may narrow it.
    template <class Wanted, class Visit>
    void near_first(const Vec3& p, const Wanted& wanted, const Visit& visit) const {
        struct Waiting {
            std::uint32_t node = 0;
            double squared_distance = 0;
        };
        const auto to_box = [&](std::uint32_t node) { return squared_distance(p, nodes_[node].box.clamped(p)); };
        std::array<Waiting, deepest> waiting;
        std::size_t count = 0;
        if (!nodes_.empty()) {
            waiting[count++] = {0, to_box(0)};
        }
        while (count > 0) {
            const auto [at, away] = waiting[--count];
            const Node& node = nodes_[at];
            if (!wanted(node, away)) {
                continue;
            }
            if (node.right == 0) {
                std::for_each(items_.begin() + node.begin, items_.begin() + node.end, visit);
                continue;
            }
            Waiting near{at + 1, to_box(at + 1)};
            Waiting far{node.right, to_box(node.right)};
            if (far.squared_distance < near.squared_distance) {
                std::swap(near, far);
            }
            waiting[count++] = far;
            waiting[count++] = near;
        }
    }

  private:
    static constexpr std::size_t deepest = 64;  // more than a tree of halves

    template <class Grow, class Key>
    void split(std::uint32_t begin, std::uint32_t end, std::uint32_t leaf_size, const Grow& grow, const Key& key) {
        const auto here = nodes_.size();
        Node node;
        node.begin = begin;
        node.end = end;
        for (std::uint32_t i = begin; i < end; ++i) {
            grow(node, items_[i]);
        }
        nodes_.push_back(node);
        if (end - begin <= leaf_size) {
            return;
        }
        const Vec3 size = node.box.size();
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const std::uint32_t middle = begin + (end - begin) / 2;
        std::nth_element(items_.begin() + begin, items_.begin() + middle, items_.begin() + end,
                         [&](const Item& a, const Item& b) { return key(a, axis) < key(b, axis); });
        split(begin, middle, leaf_size, grow, key);
        nodes_[here].right = static_cast<std::uint32_t>(nodes_.size());
        split(middle, end, leaf_size, grow, key);
    }

    std::vector<Item> items_;
    std::vector<Node> nodes_;
};

}  // namespace terratet
