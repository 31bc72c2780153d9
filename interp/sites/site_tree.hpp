// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// A static kd-tree for neighbourhood searches with limits. Off-the-shelf trees find the k nearest, but cannot pass
/// over whole branches whose octant or borehole has given all it may: with a sample every metre along holes a hundred
/// metres apart, that is the difference between fifty steps and five thousand.
///
/// Points lie in leaf order, axis by axis in each leaf, so that a leaf's distances are computed together; box and
/// borehole lie in each node's cache line. About 40 bytes a point.

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "tess/base/no_index.hpp"
#include "tess/geometry.hpp"

namespace terratet {

struct NearSite {
    double squared_distance;
    std::uint32_t site;
    std::uint32_t slot;  ///< where the tree keeps it
};

/// Which sites make a neighbourhood: nearest first, those within the radius, unless the octant around the query or the
/// borehole they are in has given its share already, up to max_points. 0: no limit.
struct Neighbourhood {
    std::size_t max_points = 12;
    double radius = std::numeric_limits<double>::infinity();
    std::uint32_t per_octant = 0;
    std::uint32_t per_borehole = 0;
    std::size_t max_looked_at = std::numeric_limits<std::size_t>::max();  ///< points nearest first, taken or not
};

class SiteTree {
  public:
    /// \param points     any number, at least one, distinct, finite
    /// \param boreholes  of each point, −1 for none; empty: none at all
    explicit SiteTree(std::span<const Vec3> points, std::span<const std::int32_t> boreholes = {});

    /// The `count` nearest within a radius, nearest first, ties by coordinates: the same places in any order of points.
    /// `out` is empty or holds what this tree found before: found nearby, it bounds the search from its start.
    /// O(count log n).
    void nearest(const Vec3& query, std::size_t count, double squared_radius, std::vector<NearSite>& out) const;

    /// A neighbourhood of those points that `usable(index)` accepts, in the same order. The limits are tested first.
    template <class Usable>
    void neighbourhood(const Vec3& query, const Neighbourhood& limits, const Usable& usable,
                       std::vector<NearSite>& out) const;

    [[nodiscard]] std::size_t memory_bytes() const;

  private:
    static constexpr std::uint32_t leaf_size = 24;

    struct Node {
        Box3 box;
        std::uint32_t leaf;     ///< the first below it
        std::uint32_t size;     ///< points below it
        std::uint32_t right;    ///< child; the left one follows its parent; 0: a leaf
        std::int32_t borehole;  ///< of all its points, or −1
    };
    static_assert(sizeof(Node) == 64);

    /// The coordinates of its points; beyond the last one infinity, which is near nothing.
    struct Leaf {
        std::array<double, leaf_size> x, y, z;
    };

    /// The plane between an inner node's children: all a descent to the nearer one has to read.
    struct Split {
        double value;  ///< left: coordinates up to it; right: from it on
        std::uint32_t axis;
        std::uint32_t right;  ///< as the node's
    };

    /// What is still to be looked at, by distance: nodes before points, points by coordinates.
    struct Candidate {
        double squared_distance;
        std::uint32_t index;  ///< of a node, or a point's slot
        bool is_point;
    };

    std::uint32_t build(std::span<std::uint32_t> order, std::span<const Vec3> points,
                        std::span<const std::int32_t> boreholes);
    void add_leaf(std::span<const std::uint32_t> order, std::span<const Vec3> points,
                  std::span<const std::int32_t> boreholes);
    [[nodiscard]] Vec3 point(std::uint32_t slot) const {
        const Leaf& leaf = leaves_[slot / leaf_size];
        const std::uint32_t lane = slot % leaf_size;
        return {leaf.x[lane], leaf.y[lane], leaf.z[lane]};
    }
    [[nodiscard]] bool nearer(const NearSite& a, const NearSite& b) const {
        return a.squared_distance != b.squared_distance ? a.squared_distance < b.squared_distance
                                                        : point(a.slot) < point(b.slot);
    }
    friend class NearestPoints;
    [[nodiscard]] bool later(const Candidate& a, const Candidate& b) const;

    static double squared_distance_to(const Box3& box, const Vec3& q) {
        double sum = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const double gap = std::max({box.lo[axis] - q[axis], 0.0, q[axis] - box.hi[axis]});
            sum += gap * gap;
        }
        return sum;
    }

    std::vector<Node> nodes_;
    std::vector<Split> splits_;  ///< of each node
    std::vector<Leaf> leaves_;
    std::vector<std::uint32_t> original_;  ///< of each slot the caller's number
    std::vector<std::int32_t> boreholes_;  ///< of each slot; empty: none
};

/// Counts what octants and boreholes have given to one neighbourhood.
class Shares {
  public:
    Shares(const Vec3& query, const Neighbourhood& limits) : query_(query), limits_(limits) {}

    /// Has this octant or borehole given all it may?
    [[nodiscard]] bool exhausted(int octant, std::int32_t borehole) const {
        if (limits_.per_octant > 0 && octant >= 0 && octants_[static_cast<std::size_t>(octant)] >= limits_.per_octant) {
            return true;
        }
        if (limits_.per_borehole == 0 || borehole < 0) {
            return false;
        }
        const auto found = find(borehole);
        return found != holes_.end() && found->second >= limits_.per_borehole;
    }

    void take(int octant, std::int32_t borehole) {
        ++octants_[static_cast<std::size_t>(octant)];
        if (limits_.per_borehole > 0 && borehole >= 0) {
            const auto found = find(borehole);
            if (found == holes_.end()) {
                holes_.emplace_back(borehole, 1);
            } else {
                ++holes_[static_cast<std::size_t>(found - holes_.begin())].second;
            }
        }
    }

    [[nodiscard]] int octant_of(const Vec3& p) const {
        return (p.x >= query_.x ? 1 : 0) + (p.y >= query_.y ? 2 : 0) + (p.z >= query_.z ? 4 : 0);
    }

    /// −1 for a box in several.
    [[nodiscard]] int octant_of(const Box3& box) const {
        const int octant = octant_of(box.lo);
        return octant == octant_of(box.hi) ? octant : -1;
    }

  private:
    using Holes = std::vector<std::pair<std::int32_t, std::uint32_t>>;
    [[nodiscard]] Holes::const_iterator find(std::int32_t borehole) const {
        return std::find_if(holes_.begin(), holes_.end(), [&](const auto& hole) { return hole.first == borehole; });
    }

    Vec3 query_;
    const Neighbourhood& limits_;
    std::array<std::uint32_t, 8> octants_{};
    Holes holes_;  ///< few: a list is fast
};

template <class Usable>
void SiteTree::neighbourhood(const Vec3& query, const Neighbourhood& limits, const Usable& usable,
                             std::vector<NearSite>& out) const {
    out.clear();
    const double squared_radius = limits.radius * limits.radius;
    thread_local std::vector<Candidate> queue;
    const auto order = [this](const Candidate& a, const Candidate& b) { return later(a, b); };
    const auto push = [&](const Candidate& candidate) {
        if (candidate.squared_distance <= squared_radius) {
            queue.push_back(candidate);
            std::push_heap(queue.begin(), queue.end(), order);
        }
    };
    const auto borehole_of = [&](std::uint32_t slot) { return boreholes_.empty() ? -1 : boreholes_[slot]; };
    Shares shares(query, limits);
    queue.clear();
    std::size_t looked_at = 0;
    push({squared_distance_to(nodes_[0].box, query), 0, false});
    while (!queue.empty() && out.size() < limits.max_points) {
        const Candidate candidate = queue.front();
        std::pop_heap(queue.begin(), queue.end(), order);
        queue.pop_back();
        if (candidate.is_point) {
            if (++looked_at > limits.max_looked_at) {
                break;
            }
            const std::uint32_t slot = candidate.index;
            const int octant = shares.octant_of(point(slot));
            if (!shares.exhausted(octant, borehole_of(slot)) && usable(original_[slot])) {
                shares.take(octant, borehole_of(slot));
                out.push_back({candidate.squared_distance, original_[slot], slot});
            }
            continue;
        }
        const Node& node = nodes_[candidate.index];
        if (shares.exhausted(shares.octant_of(node.box), node.borehole)) {
            continue;
        }
        if (node.right != 0) {
            for (const std::uint32_t child : {candidate.index + 1, node.right}) {
                push({squared_distance_to(nodes_[child].box, query), child, false});
            }
            continue;
        }
        const std::uint32_t first = node.leaf * leaf_size;
        for (std::uint32_t slot = first; slot < first + node.size; ++slot) {
            push({squared_distance(point(slot), query), slot, true});
        }
    }
}

}  // namespace terratet
