// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/collapse/collapse_nodes.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "tess/barrier/query/pair_way.hpp"
#include "tess/base/poll.hpp"
#include "tess/base/seed_grid.hpp"
#include "tess/base/tetrahedron.hpp"
#include "tess/mesh/quality.hpp"

namespace terratet {
namespace {

constexpr double own_reach = 1.2;       ///< over the width that goes with a point's edges
constexpr double same_distance = 1e-6;  ///< of the seeds round a fault's vertex, relative
constexpr double inside = 1e-6;         ///< a vertex is in front of a facet by that, over the reach
constexpr double reach = 1.1;  ///< over the spacing: no ball about a fault's vertex is larger (exact_seeds.cpp)

/// How far a point's own seeds are from it at most: their width is in proportion to the triangles. Others may stand by
/// it that were added where the seeds let an edge through.
std::map<Vec3, double> reach_of_own_seeds(const Model& model) {
    struct Edges {
        double sum = 0;
        int count = 0;
    };
    std::map<Vec3, Edges> edges_at;
    for (const Barrier& barrier : model.barriers) {
        for (const Surface* part : {&barrier.sheet, &barrier.margin}) {
            for (const Triangle& t : part->triangles) {
                for (std::size_t k = 0; k < 3; ++k) {
                    const Vec3& a = part->vertices[t[k]];
                    const Vec3& b = part->vertices[t[(k + 1) % 3]];
                    for (const Vec3& end : {a, b}) {
                        edges_at[end].sum += own_reach * barrier.width / barrier.spacing * distance(a, b);
                        ++edges_at[end].count;
                    }
                }
            }
        }
    }
    std::map<Vec3, double> result;
    for (const auto& [p, edges] : edges_at) {
        result[p] = edges.sum / edges.count;
    }
    return result;
}

/// The vertex of its sheet that a pair belongs to; the middle of the pair where it has none.
class OwnVertices {
  public:
    OwnVertices(const Barrier& barrier, const std::map<Vec3, double>& reach_at)
        : barrier_(barrier), reach_at_(reach_at), vertices_({}, own_pair * barrier.spacing) {
        for (const Surface* part : {&barrier.sheet, &barrier.margin}) {
            for (const Vec3& p : part->vertices) {
                vertices_.insert(p);
            }
        }
    }

    [[nodiscard]] Vec3 of_pair(const Vec3& middle) const {
        const std::uint32_t nearest = vertices_.nearest(middle);
        if (nearest == no_index) {
            return middle;
        }
        const Vec3& vertex = vertices_.point(nearest);
        const double edge = reach_at_.at(vertex) * barrier_.spacing / (own_reach * barrier_.width);
        return distance(vertex, middle) <= own_pair * edge ? vertex : middle;
    }

  private:
    const Barrier& barrier_;
    const std::map<Vec3, double>& reach_at_;
    SeedGrid vertices_;
};

/// Each mirrored pair in the vertex it belongs to, or halfway between its seeds; pairs about a junction's point in that
/// point.
std::vector<FaultNode> meeting_seeds(const Model& model, const std::vector<char>& selected, const Poll& poll) {
    PatientPoll go_on(poll);
    std::map<std::pair<std::int32_t, Vec3>, std::uint32_t> vertex_at;
    for (std::uint32_t v = 0; v < model.vertices.size(); ++v) {
        if (model.vertices[v].role == Role::seed) {
            vertex_at.try_emplace({model.vertices[v].owner, model.vertices[v].position}, v);
        }
    }
    std::map<Vec3, std::set<std::size_t>> sheets_at;
    for (std::size_t f = 0; f < model.barriers.size(); ++f) {
        for (const Surface* part : {&model.barriers[f].sheet, &model.barriers[f].margin}) {  // junctions go on outside
            for (const Vec3& p : part->vertices) {
                sheets_at[p].insert(f);
            }
        }
    }
    const std::map<Vec3, double> own_reach_at = reach_of_own_seeds(model);
    std::erase_if(sheets_at, [&](const auto& at) {
        return at.second.size() < 2 || std::ranges::none_of(at.second, [&](std::size_t f) { return selected[f] != 0; });
    });

    std::vector<FaultNode> nodes;
    std::map<Vec3, std::size_t> node_at;  // by base
    for (std::size_t f = 0; f < model.barriers.size(); ++f) {
        const Barrier& barrier = model.barriers[f];
        const OwnVertices own(barrier, own_reach_at);
        for (std::size_t k = 0; k + 1 < barrier.seeds.size(); k += 2) {
            go_on();
            const auto plus = vertex_at.find({static_cast<std::int32_t>(f), barrier.seeds[k].position});
            const auto minus = vertex_at.find({static_cast<std::int32_t>(f), barrier.seeds[k + 1].position});
            if (plus == vertex_at.end() || minus == vertex_at.end()) {
                continue;
            }
            const Vec3 middle = 0.5 * (barrier.seeds[k].position + barrier.seeds[k + 1].position);
            Vec3 base = model.frame.snapped(own.of_pair(middle));
            double nearest = 0.5 * barrier.width * (1 + 1e-6);
            bool meets = selected[f] != 0;
            for (auto at = sheets_at.lower_bound({middle.x - nearest, -max_coordinate, -max_coordinate});
                 at != sheets_at.end() && at->first.x <= middle.x + nearest; ++at) {
                if (at->second.contains(f) && distance(at->first, middle) <= nearest &&
                    distance(at->first, barrier.seeds[k].position) <= own_reach_at.at(at->first)) {
                    nearest = distance(at->first, middle);
                    base = at->first;
                    meets = true;
                }
            }
            if (!meets) {
                continue;
            }
            const auto [entry, fresh] = node_at.try_emplace(base, nodes.size());
            if (fresh) {
                nodes.push_back({base, {}, {}, {}});
            }
            std::vector<std::uint32_t>& seeds = nodes[entry->second].seeds;
            seeds.insert(seeds.end(), {plus->second, minus->second});
            nodes[entry->second].barriers.push_back(static_cast<std::int32_t>(f));
        }
    }
    return nodes;
}

/// Finds the vertices of sheets and margins that get a node among the seeds round them, and the cells it is put into.
class VertexFinder {
  public:
    VertexFinder(const Model& model, const TetMesh& mesh, const std::vector<char>& selected)
        : model_(model), mesh_(mesh), selected_(selected), star_(model.vertices.size()) {
        std::vector<Vec3> places;
        for (std::uint32_t v = 0; v < model.vertices.size(); ++v) {
            if (is_selected_seed(v)) {
                seeds_.push_back(v);
                places.push_back(model.vertices[v].position);
            }
        }
        for (std::uint32_t c = 0; c < mesh.cells.size(); ++c) {
            if (std::ranges::all_of(mesh.cells[c], [&](std::uint32_t v) { return is_selected_seed(v); })) {
                for (const std::uint32_t v : mesh.cells[c]) {
                    star_[v].push_back(c);
                }
            }
        }
        double spacing = 0;
        for (std::size_t f = 0; f < model.barriers.size(); ++f) {
            spacing = std::max(spacing, model.barriers[f].spacing);
            for (const Surface* part : {&model.barriers[f].sheet, &model.barriers[f].margin}) {
                for (const Vec3& p : part->vertices) {
                    if (selected[f] != 0) {
                        faults_at_[p].insert(static_cast<std::int32_t>(f));
                    }
                }
            }
        }
        grid_.emplace(places, reach * spacing);
    }

    std::vector<FaultNode> run(const Poll& poll) const {
        PatientPoll go_on(poll);
        std::vector<FaultNode> nodes;
        std::vector<FaultNode> others;
        for (const auto& [p, barriers] : faults_at_) {
            go_on();
            FaultNode node{p, {}, {barriers.begin(), barriers.end()}, {}};
            node.cells = cells_at_one_distance(p);
            if (!node.cells.empty() && unseen_facets(node).empty()) {
                nodes.push_back(std::move(node));
                continue;
            }
            node.cells = cells_about(p);
            for (auto unseen = unseen_facets(node); !unseen.empty(); unseen = unseen_facets(node)) {
                std::erase_if(node.cells, [&](std::uint32_t c) { return unseen.contains(c); });
            }
            if (!node.cells.empty()) {
                others.push_back(std::move(node));
            }
        }
        std::ranges::move(others, std::back_inserter(nodes));
        return nodes;
    }

  private:
    [[nodiscard]] bool is_selected_seed(std::uint32_t v) const {
        const Vertex& vertex = model_.vertices[v];
        return vertex.role == Role::seed && selected_[static_cast<std::size_t>(vertex.owner)] != 0;
    }

    /// Those between the nearest seeds alone, when these are all at one distance: p is a vertex of the Voronoi diagram.
    [[nodiscard]] std::vector<std::uint32_t> cells_at_one_distance(const Vec3& p) const {
        const std::uint32_t nearest = grid_->nearest(p);
        if (nearest == no_index) {
            return {};
        }
        const double most = distance(grid_->point(nearest), p) * (1 + same_distance);
        return cells_near(p, [&](std::uint32_t c) {
            return std::ranges::all_of(mesh_.cells[c],
                                       [&](std::uint32_t v) { return distance(mesh_.points[v], p) <= most; });
        });
    }

    /// Those with p in their circumsphere: which would make room for it in a Delaunay tessellation.
    [[nodiscard]] std::vector<std::uint32_t> cells_about(const Vec3& p) const {
        return cells_near(p, [&](std::uint32_t c) {
            const auto& v = mesh_.cells[c];
            const Circumsphere sphere =
                circumsphere({mesh_.points[v[0]], mesh_.points[v[1]], mesh_.points[v[2]], mesh_.points[v[3]]});
            return squared_distance(sphere.center, p) < sphere.squared_radius * (1 - same_distance);
        });
    }

    template <class Takes>
    [[nodiscard]] std::vector<std::uint32_t> cells_near(const Vec3& p, const Takes& takes) const {
        std::set<std::uint32_t> cells;
        grid_->visit(p, [&](std::uint32_t i) {
            for (const std::uint32_t c : star_[seeds_[i]]) {
                if (takes(c)) {
                    cells.insert(c);
                }
            }
        });
        return {cells.begin(), cells.end()};
    }

    /// Cells with a facet on the outside that the vertex is not in front of. None: it sees all from within.
    [[nodiscard]] std::set<std::uint32_t> unseen_facets(const FaultNode& node) const {
        std::set<std::uint32_t> result;
        for (const std::uint32_t c : node.cells) {
            for (std::size_t k = 0; k < 4; ++k) {
                const std::int32_t next = mesh_.neighbours[c][k];
                if (next >= 0 && std::ranges::binary_search(node.cells, static_cast<std::uint32_t>(next))) {
                    continue;
                }
                std::array<Vec3, 4> p{};
                for (std::size_t i = 0; i < 4; ++i) {
                    p[i] = i == k ? node.base : mesh_.points[mesh_.cells[c][i]];
                }
                if (!(signed_height(p) > inside * grid_->radius())) {
                    result.insert(c);
                }
            }
        }
        return result;
    }

    const Model& model_;
    const TetMesh& mesh_;
    const std::vector<char>& selected_;
    std::vector<std::uint32_t> seeds_;
    std::vector<std::vector<std::uint32_t>> star_;  ///< of seeds: cells between seeds
    std::map<Vec3, std::set<std::int32_t>> faults_at_;
    std::optional<SeedGrid> grid_;  ///< of the seeds
};

}  // namespace

bool FaultNode::retreat() {
    if (state == State::aside) {
        return false;
    }
    state = state == State::joined && seeds.size() == 2 ? State::apart : State::aside;
    return true;
}

std::vector<FaultNode> fault_nodes(const Model& model, const TetMesh& mesh, const std::vector<char>& selected,
                                   const Poll& poll) {
    return model.barrier_options.mode == SeedMode::exact ? VertexFinder(model, mesh, selected).run(poll)
                                                         : meeting_seeds(model, selected, poll);
}

}  // namespace terratet
