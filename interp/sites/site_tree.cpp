// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/sites/site_tree.hpp"

#include <cassert>
#include <numeric>

namespace terratet {

SiteTree::SiteTree(std::span<const Vec3> points, std::span<const std::int32_t> boreholes) {
    assert(!points.empty() && (boreholes.empty() || boreholes.size() == points.size()));
    std::vector<std::uint32_t> order(points.size());
    std::iota(order.begin(), order.end(), 0U);
    const std::size_t leaf_count = (points.size() + leaf_size - 1) / leaf_size;
    nodes_.reserve(2 * leaf_count);
    splits_.reserve(2 * leaf_count);
    leaves_.reserve(leaf_count);
    original_.reserve(leaf_count * leaf_size);
    boreholes_.reserve(boreholes.empty() ? 0 : leaf_count * leaf_size);
    build(order, points, boreholes);
}

std::uint32_t SiteTree::build(std::span<std::uint32_t> order, std::span<const Vec3> points,
                              std::span<const std::int32_t> boreholes) {
    const auto index = static_cast<std::uint32_t>(nodes_.size());
    Node node{{}, static_cast<std::uint32_t>(leaves_.size()), static_cast<std::uint32_t>(order.size()), 0, -1};
    for (const std::uint32_t i : order) {
        node.box.extend(points[i]);
    }
    if (!boreholes.empty()) {
        const std::int32_t first = boreholes[order.front()];
        const bool same = std::all_of(order.begin(), order.end(), [&](auto i) { return boreholes[i] == first; });
        node.borehole = same ? first : -1;
    }
    nodes_.push_back(node);
    splits_.push_back({0, 0, 0});
    if (order.size() <= leaf_size) {
        add_leaf(order, points, boreholes);
        return index;
    }
    const Vec3 size = node.box.size();
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::size_t half = (order.size() / 2 + leaf_size - 1) / leaf_size * leaf_size;  // full leaves on the left
    std::nth_element(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(half), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) {
                         return points[a][axis] != points[b][axis] ? points[a][axis] < points[b][axis]
                                                                   : points[a] < points[b];
                     });
    const double split = points[order[half]][axis];
    build(order.first(half), points, boreholes);
    const std::uint32_t right = build(order.subspan(half), points, boreholes);
    nodes_[index].right = right;
    splits_[index] = {split, static_cast<std::uint32_t>(axis), right};
    return index;
}

void SiteTree::add_leaf(std::span<const std::uint32_t> order, std::span<const Vec3> points,
                        std::span<const std::int32_t> boreholes) {
    Leaf& leaf = leaves_.emplace_back();
    for (std::size_t lane = 0; lane < leaf_size; ++lane) {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        const bool is_point = lane < order.size();
        const Vec3 p = is_point ? points[order[lane]] : Vec3{infinity, infinity, infinity};
        leaf.x[lane] = p.x;
        leaf.y[lane] = p.y;
        leaf.z[lane] = p.z;
        original_.push_back(is_point ? order[lane] : no_index);
        if (!boreholes.empty()) {
            boreholes_.push_back(is_point ? boreholes[order[lane]] : -1);
        }
    }
}

bool SiteTree::later(const Candidate& a, const Candidate& b) const {
    if (a.squared_distance != b.squared_distance) {
        return a.squared_distance > b.squared_distance;
    }
    if (a.is_point != b.is_point) {
        return a.is_point;
    }
    return a.is_point ? point(b.index) < point(a.index) : a.index > b.index;
}

/// The first `capacity` by distance, then by coordinates.
class NearestPoints {
  public:
    NearestPoints(const SiteTree& tree, const Vec3& query, std::size_t capacity, double squared_radius,
                  std::vector<NearSite>& found)
        : tree_(tree),
          capacity_(capacity),
          worst_(std::min(squared_radius, std::numeric_limits<double>::max())),
          found_(found) {
        if (found.size() == capacity) {  // as many are known: none of those wanted is farther than they are
            double farthest = 0;
            for (const NearSite& known : found) {
                farthest = std::max(farthest, squared_distance(tree.point(known.slot), query));
            }
            worst_ = std::min(worst_, farthest);
        }
        found_.clear();
    }

    /// No farther point is wanted. Equal ones may be.
    [[nodiscard]] double worst() const { return worst_; }

    void offer(double squared_distance, std::uint32_t slot) {
        const auto order = [this](const NearSite& a, const NearSite& b) { return tree_.nearer(a, b); };
        const NearSite candidate{squared_distance, 0, slot};
        if (found_.size() == capacity_) {
            if (!order(candidate, capacity_ > few ? found_.front() : found_.back())) {
                return;
            }
            if (capacity_ > few) {
                std::pop_heap(found_.begin(), found_.end(), order);
            }
            found_.pop_back();
        }
        found_.push_back(candidate);
        if (capacity_ > few) {
            std::push_heap(found_.begin(), found_.end(), order);
        } else {
            auto at = found_.end() - 1;
            for (; at != found_.begin() && order(candidate, at[-1]); --at) {
                *at = at[-1];
            }
            *at = candidate;
        }
        if (found_.size() == capacity_) {
            worst_ = (capacity_ > few ? found_.front() : found_.back()).squared_distance;
        }
    }

    /// In order, with the callers' numbers.
    void finish() {
        if (capacity_ > few) {
            std::sort_heap(found_.begin(), found_.end(),
                           [this](const NearSite& a, const NearSite& b) { return tree_.nearer(a, b); });
        }
        for (NearSite& near : found_) {
            near.site = tree_.original_[near.slot];
        }
    }

  private:
    static constexpr std::size_t few = 48;  ///< up to there a sorted list is faster than a heap

    const SiteTree& tree_;
    std::size_t capacity_;
    double worst_;
    std::vector<NearSite>& found_;
};

void SiteTree::nearest(const Vec3& query, std::size_t count, double squared_radius, std::vector<NearSite>& out) const {
    NearestPoints found(*this, query, count, squared_radius, out);
    struct Branch {
        double squared_distance;
        std::uint32_t node;
    };
    std::array<Branch, 64> stack;  // as deep as the tree of 2^32 points, twice over
    std::size_t depth = 0;
    stack[depth++] = {0, 0};
    while (depth > 0) {
        const Branch branch = stack[--depth];
        if (branch.squared_distance > found.worst() ||
            squared_distance_to(nodes_[branch.node].box, query) > found.worst()) {
            continue;
        }
        std::uint32_t at = branch.node;
        while (splits_[at].right != 0) {  // down the nearer side
            const Split& split = splits_[at];
            const double gap = query[static_cast<int>(split.axis)] - split.value;
            const bool is_left = gap < 0;
            stack[depth] = {gap * gap, is_left ? split.right : at + 1};
            depth += gap * gap <= found.worst() ? 1 : 0;
            at = is_left ? at + 1 : split.right;
        }
        const Leaf& leaf = leaves_[nodes_[at].leaf];
        std::array<double, leaf_size> squared;
        for (std::size_t lane = 0; lane < leaf_size; ++lane) {
            const Vec3 away{leaf.x[lane] - query.x, leaf.y[lane] - query.y, leaf.z[lane] - query.z};
            squared[lane] = dot(away, away);
        }
        std::array<std::uint32_t, leaf_size> within;  // gathered without branches, which no processor could foretell
        std::size_t count_within = 0;
        for (std::uint32_t lane = 0; lane < leaf_size; ++lane) {
            within[count_within] = lane;
            count_within += squared[lane] <= found.worst() ? 1 : 0;
        }
        for (std::size_t i = 0; i < count_within; ++i) {
            if (squared[within[i]] <= found.worst()) {
                found.offer(squared[within[i]], nodes_[at].leaf * leaf_size + within[i]);
            }
        }
    }
    found.finish();
}

std::size_t SiteTree::memory_bytes() const {
    return nodes_.capacity() * sizeof(Node) + splits_.capacity() * sizeof(Split) + leaves_.capacity() * sizeof(Leaf) +
           original_.capacity() * sizeof(std::uint32_t) + boreholes_.capacity() * sizeof(std::int32_t);
}

}  // namespace terratet
