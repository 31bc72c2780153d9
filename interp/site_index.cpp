// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/site_index.hpp"

#include <algorithm>
#include <cassert>
#include <nanoflann.hpp>

namespace terratet {
namespace {

/// The sites as nanoflann wants to see them.
struct Cloud {
    std::span<const Vec3> sites;

    [[nodiscard]] std::size_t kdtree_get_point_count() const { return sites.size(); }
    [[nodiscard]] double kdtree_get_pt(std::uint32_t i, std::size_t axis) const {
        return sites[i][static_cast<int>(axis)];
    }
    template <typename Box>
    bool kdtree_get_bbox(Box&) const {
        return false;
    }
};

using KdTree =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Cloud>, Cloud, 3, std::uint32_t>;

struct NearerFirst {
    std::span<const Vec3> sites;

    bool operator()(const NearSite& a, const NearSite& b) const {
        return a.squared_distance != b.squared_distance ? a.squared_distance < b.squared_distance
                                                        : sites[a.site] < sites[b.site];
    }
};

/// The first k of all sites within a radius by distance, then coordinates. A total order, so the k are the first of any
/// more.
class NearestSites {
  public:
    using DistanceType = double;

    NearestSites(std::span<const Vec3> sites, std::size_t capacity, double squared_radius, std::vector<NearSite>& out)
        : before_{sites}, capacity_(capacity), squared_radius_(squared_radius), heap_(out) {
        heap_.clear();
    }

    [[nodiscard]] std::size_t size() const { return heap_.size(); }
    [[nodiscard]] bool full() const { return heap_.size() == capacity_; }

    bool addPoint(double squared_distance, std::uint32_t site) {
        const NearSite candidate{squared_distance, site};
        if (squared_distance > squared_radius_) {
            return true;
        }
        if (full()) {
            if (!before_(candidate, heap_.front())) {
                return true;
            }
            std::pop_heap(heap_.begin(), heap_.end(), before_);
            heap_.pop_back();
        }
        heap_.push_back(candidate);
        std::push_heap(heap_.begin(), heap_.end(), before_);
        return true;
    }

    /// A little more than it is, so that neither ties nor the rounding of the tree's bounds hide a site.
    [[nodiscard]] double worstDist() const {
        const double worst = full() ? heap_.front().squared_distance : squared_radius_;
        return worst * (1 + 1e-12) + std::numeric_limits<double>::min();
    }

    void sort() { std::sort_heap(heap_.begin(), heap_.end(), before_); }

  private:
    NearerFirst before_;
    std::size_t capacity_;
    double squared_radius_;
    std::vector<NearSite>& heap_;
};

}  // namespace

struct SiteIndex::Tree {
    Cloud cloud;
    KdTree index;

    explicit Tree(std::span<const Vec3> sites)
        : cloud{sites}, index(3, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(8)) {}

    void nearest(const Vec3& q, std::size_t count, double radius, std::vector<NearSite>& out) const {
        NearestSites result(cloud.sites, count, radius * radius, out);
        index.findNeighbors(result, &q.x, nanoflann::SearchParams());
        result.sort();
    }
};

SiteIndex::SiteIndex(std::span<const Vec3> sites, const FaultProximity* faults)
    : sites_(sites), faults_(faults && !faults->empty() ? faults : nullptr), tree_(std::make_unique<Tree>(sites)) {
    assert(!sites.empty());
}

SiteIndex::~SiteIndex() = default;

bool SiteIndex::visible(const ValueQuery& query, std::uint32_t site) const {
    return !faults_ || sites_[site] == query.position || !faults_->crosses_any(query.position, sites_[site]);
}

void SiteIndex::nearest(const ValueQuery& query, std::size_t count, std::vector<NearSite>& out, double radius) const {
    std::size_t looked_at = 0;
    std::vector<NearSite> visible_sites;
    for (std::size_t ask = std::min(count, sites_.size());; ask = std::min(4 * ask, sites_.size())) {
        tree_->nearest(query.position, ask, radius, out);
        if (!faults_) {
            return;
        }
        for (; looked_at < out.size() && visible_sites.size() < count; ++looked_at) {
            if (visible(query, out[looked_at].site)) {
                visible_sites.push_back(out[looked_at]);
            }
        }
        if (visible_sites.size() == count || out.size() < ask || ask == sites_.size()) {
            out.swap(visible_sites);
            return;
        }
    }
}

std::size_t SiteIndex::memory_bytes() const {
    return sizeof(Tree) + tree_->index.usedMemory(tree_->index);
}

}  // namespace terratet
