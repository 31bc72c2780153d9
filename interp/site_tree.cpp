// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/site_tree.hpp"

#include <cassert>
#include <numeric>

namespace terratet {
namespace {

constexpr std::size_t leaf_size = 12;

}  // namespace

SiteTree::SiteTree(std::span<const Vec3> points, std::span<const std::int32_t> boreholes) : original_(points.size()) {
    assert(!points.empty() && (boreholes.empty() || boreholes.size() == points.size()));
    std::iota(original_.begin(), original_.end(), 0U);
    nodes_.reserve(points.size() / 2 + 1);
    build(original_, 0, points, boreholes);
    nodes_.shrink_to_fit();
    points_.reserve(points.size());
    for (const std::uint32_t i : original_) {
        points_.push_back(points[i]);
    }
    if (!boreholes.empty()) {
        boreholes_.reserve(points.size());
        for (const std::uint32_t i : original_) {
            boreholes_.push_back(boreholes[i]);
        }
    }
}

std::uint32_t SiteTree::build(std::span<std::uint32_t> order, std::uint32_t begin, std::span<const Vec3> points,
                              std::span<const std::int32_t> boreholes) {
    const auto index = static_cast<std::uint32_t>(nodes_.size());
    Node node{{}, begin, begin + static_cast<std::uint32_t>(order.size()), 0, -1};
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
        return index;
    }
    const Vec3 size = node.box.size();
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::size_t half = order.size() / 2;
    std::nth_element(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(half), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) {
                         return points[a][axis] != points[b][axis] ? points[a][axis] < points[b][axis]
                                                                   : points[a] < points[b];
                     });
    const double split = points[order[half]][axis];
    build(order.first(half), begin, points, boreholes);
    nodes_[index].right = build(order.subspan(half), begin + static_cast<std::uint32_t>(half), points, boreholes);
    splits_[index] = {split, static_cast<std::uint32_t>(axis), nodes_[index].right};
    return index;
}

bool SiteTree::later(const Candidate& a, const Candidate& b) const {
    if (a.squared_distance != b.squared_distance) {
        return a.squared_distance > b.squared_distance;
    }
    if (a.is_point != b.is_point) {
        return a.is_point;
    }
    return a.is_point ? points_[b.index] < points_[a.index] : a.index > b.index;
}

namespace {

struct NearerFirst {
    std::span<const Vec3> points;

    bool operator()(const NearSite& a, const NearSite& b) const {
        return a.squared_distance != b.squared_distance ? a.squared_distance < b.squared_distance
                                                        : points[a.site] < points[b.site];
    }
};

/// The first `capacity` by distance, then by coordinates.
class NearestPoints {
  public:
    NearestPoints(std::span<const Vec3> points, std::size_t capacity, double squared_radius,
                  std::vector<NearSite>& found)
        : order_{points}, capacity_(capacity), worst_(squared_radius), found_(found) {
        found_.clear();
    }

    /// No farther point is wanted. Equal ones may be.
    [[nodiscard]] double worst() const { return worst_; }

    void offer(double squared_distance, std::uint32_t point) {
        const NearSite candidate{squared_distance, point};
        if (found_.size() == capacity_) {
            if (!order_(candidate, capacity_ > few ? found_.front() : found_.back())) {
                return;
            }
            drop_last();
        }
        found_.push_back(candidate);
        if (capacity_ > few) {
            std::push_heap(found_.begin(), found_.end(), order_);
        } else {
            auto at = found_.end() - 1;
            for (; at != found_.begin() && order_(candidate, at[-1]); --at) {
                *at = at[-1];
            }
            *at = candidate;
        }
        if (found_.size() == capacity_) {
            worst_ = (capacity_ > few ? found_.front() : found_.back()).squared_distance;
        }
    }

    void sort() {
        if (capacity_ > few) {
            std::sort_heap(found_.begin(), found_.end(), order_);
        }
    }

  private:
    static constexpr std::size_t few = 48;  ///< up to there a sorted list is faster than a heap

    void drop_last() {
        if (capacity_ > few) {
            std::pop_heap(found_.begin(), found_.end(), order_);
        }
        found_.pop_back();
    }

    NearerFirst order_;
    std::size_t capacity_;
    double worst_;
    std::vector<NearSite>& found_;
};

}  // namespace

void SiteTree::nearest(const Vec3& query, std::size_t count, double squared_radius, std::vector<NearSite>& out) const {
    NearestPoints found(points_, count, squared_radius, out);
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
        std::array<NearSite, leaf_size> within;  // gathered without branches, which no processor could foretell
        std::size_t count_within = 0;
        for (std::uint32_t point = nodes_[at].begin; point < nodes_[at].end; ++point) {
            const double d = squared_distance(points_[point], query);
            within[count_within] = {d, point};
            count_within += d <= found.worst() ? 1 : 0;
        }
        for (std::size_t i = 0; i < count_within; ++i) {
            if (within[i].squared_distance <= found.worst()) {
                found.offer(within[i].squared_distance, within[i].site);
            }
        }
    }
    found.sort();
    for (auto& near : out) {
        near.site = original_[near.site];
    }
}

std::size_t SiteTree::memory_bytes() const {
    return nodes_.capacity() * sizeof(Node) + points_.capacity() * sizeof(Vec3) +
           original_.capacity() * sizeof(std::uint32_t) + boreholes_.capacity() * sizeof(std::int32_t);
}

}  // namespace terratet
