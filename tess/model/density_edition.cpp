// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/model/density_edition.hpp"

#include <algorithm>
#include <set>

#include "tess/base/point_levels.hpp"
#include "tess/base/poll.hpp"
#include "tess/mesh/bulk_insertion.hpp"
#include "tess/mesh/delaunay.hpp"

namespace terratet {

namespace {

using Edge = std::tuple<double, std::uint32_t, std::uint32_t>;  // squared length, ends: shortest first, ties by index

/// Greedy thinning in the order given.
std::vector<std::uint32_t> keep_beside(PointLevels& kept, const Samples& samples, std::span<const std::uint32_t> order,
                                       const ResolutionField& resolution, PatientPoll& go_on) {
    std::vector<std::uint32_t> result;
    for (const std::uint32_t i : order) {
        go_on();
        if (!kept.any_within(samples.positions[i], resolution.sample_l_min(samples.positions[i]))) {
            kept.insert(samples.positions[i]);
            result.push_back(i);
        }
    }
    return result;
}

/// The paper's dynamic deletion on the Delaunay tessellation of the samples alone. The shortest edge goes first; of its
/// ends the one with the smaller nearest-neighbour distance, which in a Delaunay tessellation is its second shortest
/// edge: the shortest is common to both.
class DynamicDeletion {
  public:
    DynamicDeletion(const Samples& samples, const std::vector<std::uint32_t>& candidates,
                    const ResolutionField& resolution, PatientPoll& go_on)
        : samples_(samples), limits_(samples.size()), handles_(samples.size()), go_on_(go_on) {
        std::vector<std::pair<delaunay::Point, std::uint32_t>> points;
        for (const std::uint32_t i : candidates) {
            const double l_min = resolution.sample_l_min(samples.positions[i]);
            limits_[i] = l_min * l_min;
            points.emplace_back(delaunay::to_cgal(samples.positions[i]), i);
        }
        delaunay::insert(triangulation_, points, go_on_);
        for (const auto vertex : triangulation_.finite_vertex_handles()) {
            handles_[vertex->info()] = vertex;
        }
        for (const std::uint32_t i : candidates) {
            go_on_();
            queue_edges_of(i);
        }
    }

    std::vector<std::uint32_t> run() {
        while (!short_edges_.empty()) {
            go_on_();
            const auto [length, a, b] = *short_edges_.begin();
            remove(distance_to_second(a, b) < distance_to_second(b, a) ? a : b);
        }
        std::vector<std::uint32_t> kept;
        for (std::uint32_t i = 0; i < handles_.size(); ++i) {
            if (handles_[i] != delaunay::VertexHandle()) {
                kept.push_back(i);
            }
        }
        return kept;
    }

  private:
    std::vector<std::uint32_t> neighbours(std::uint32_t i) const {
        std::vector<delaunay::VertexHandle> adjacent;
        if (triangulation_.dimension() >= 1) {
            triangulation_.finite_adjacent_vertices(handles_[i], std::back_inserter(adjacent));
        }
        std::vector<std::uint32_t> result;
        for (const auto vertex : adjacent) {
            result.push_back(vertex->info());
        }
        return result;
    }

    Edge edge(std::uint32_t a, std::uint32_t b) const {
        return {squared_distance(samples_.positions[a], samples_.positions[b]), std::min(a, b), std::max(a, b)};
    }

    void queue_edges_of(std::uint32_t i) {
        for (const std::uint32_t j : neighbours(i)) {
            if (const Edge e = edge(i, j); std::get<0>(e) < std::min(limits_[i], limits_[j])) {
                short_edges_.insert(e);
            }
        }
    }

    double distance_to_second(std::uint32_t i, std::uint32_t except) const {
        double nearest = std::numeric_limits<double>::infinity();
        for (const std::uint32_t j : neighbours(i)) {
            if (j != except) {
                nearest = std::min(nearest, std::get<0>(edge(i, j)));
            }
        }
        return nearest;
    }

    void remove(std::uint32_t i) {
        const auto around = neighbours(i);
        for (const std::uint32_t j : around) {
            short_edges_.erase(edge(i, j));
        }
        triangulation_.remove(handles_[i]);
        handles_[i] = {};
        for (const std::uint32_t j : around) {
            queue_edges_of(j);
        }
    }

    const Samples& samples_;
    std::vector<double> limits_;  ///< l_min² by sample
    delaunay::Triangulation triangulation_;
    std::vector<delaunay::VertexHandle> handles_;  ///< by sample; none once removed
    std::set<Edge> short_edges_;
    PatientPoll& go_on_;
};

}  // namespace

std::vector<std::uint32_t> unprotected(const Samples& samples, const BarrierQuery& barriers, const Poll& poll) {
    PatientPoll go_on(poll);
    std::vector<std::uint32_t> result;
    for (std::uint32_t i = 0; i < samples.size(); ++i) {
        go_on();
        if (barriers.protecting_barrier(samples.positions[i]) < 0) {
            result.push_back(i);
        }
    }
    return result;
}

std::vector<std::uint32_t> keep_in_order(const Samples& samples, std::span<const std::uint32_t> candidates,
                                         const ResolutionField& resolution, const Poll& poll) {
    PatientPoll go_on(poll);
    PointLevels kept;
    return keep_beside(kept, samples, candidates, resolution, go_on);
}

DensityResult edit_density(const Samples& samples, const ResolutionField& resolution, DensityMode mode,
                           const BarrierQuery& barriers, const Poll& poll) {
    PatientPoll go_on(poll);
    DensityResult result;
    const std::vector<std::uint32_t> candidates = unprotected(samples, barriers, poll);
    for (std::uint32_t i = 0; i < samples.size(); ++i) {
        if (!std::ranges::binary_search(candidates, i)) {
            result.near_faults.push_back(i);
        }
    }
    PointLevels kept;
    if (mode == DensityMode::paper) {
        result.kept = DynamicDeletion(samples, candidates, resolution, go_on).run();
        for (const std::uint32_t i : result.kept) {
            kept.insert(samples.positions[i]);
        }
    }
    const auto added = keep_beside(kept, samples, candidates, resolution, go_on);
    result.kept.insert(result.kept.end(), added.begin(), added.end());
    std::ranges::sort(result.kept);
    result.deleted = candidates.size() - result.kept.size();
    return result;
}

DensityResult edit_density(const Samples& samples, double l_min, DensityMode mode, const BarrierQuery& barriers) {
    Criteria criteria;
    criteria.l_min = l_min;
    const Domain nowhere;  // only overrides ask for it
    return edit_density(samples, ResolutionField(criteria, nowhere, {}), mode, barriers);
}

Samples dropped_samples(const Model& model, const BarrierQuery& barriers) {
    std::vector<char> is_vertex(model.samples.size(), 0);
    for (const Vertex& vertex : model.vertices) {
        if (vertex.role == Role::sample) {
            is_vertex[static_cast<std::size_t>(vertex.owner)] = 1;
        }
    }
    std::vector<std::uint32_t> dropped;
    for (std::uint32_t i = 0; i < model.samples.size(); ++i) {
        const Vec3& p = model.samples.positions[i];
        if (is_vertex[i] == 0 && model.domain.extent.contains(p) && barriers.protecting_barrier(p) < 0) {
            dropped.push_back(i);
        }
    }
    return selected(model.samples, dropped);
}

}  // namespace terratet
