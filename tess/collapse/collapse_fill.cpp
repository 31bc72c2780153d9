// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/collapse/collapse_fill.hpp"
#include "tess/base/no_index.hpp"
#include "tess/base/tetrahedron.hpp"

#include <algorithm>
#include <map>

namespace terratet {
namespace {

using Edge = std::array<std::uint32_t, 2>;

/// An edge of the fault, from x to y, that is joined with one between seeds, a < b: the cell (x, a, b, y).
struct Sector {
    Edge edge;
    std::uint32_t parent = 0;
};

/// The edges' ends in order; empty when they make up anything but one ring.
std::vector<std::uint32_t> ring_of(const std::vector<Sector>& sectors) {
    std::map<std::uint32_t, std::uint32_t> next;
    for (const Sector& sector : sectors) {
        next.emplace(sector.edge[0], sector.edge[1]);
    }
    std::vector<std::uint32_t> ring;
    for (std::uint32_t at = next.begin()->first; ring.size() < sectors.size(); at = next[at]) {
        if (!next.contains(at) || (!ring.empty() && at == ring.front())) {
            return {};
        }
        ring.push_back(at);
    }
    return ring.size() > 2 && next[ring.back()] == ring.front() ? ring : std::vector<std::uint32_t>{};
}

class Filler {
  public:
    Filler(const TetMesh& mesh, std::span<const FaultNode> nodes) : mesh_(mesh), nodes_(nodes) {
        owner_.assign(mesh.cells.size(), no_index);
        filling_.replaced.assign(mesh.cells.size(), 0);
    }

    Filling run() {
        take_cells();
        join_vertices();
        join_edges();
        join_triangles();
        return std::move(filling_);
    }

  private:
    /// A facet seen from the first of the two whose polyhedra share it.
    struct Shared {
        Triangle corners;
        std::uint32_t parent = 0;
    };

    /// Flat cells in a facet that two share are the first one's.
    void take_cells() {
        std::uint32_t number = static_cast<std::uint32_t>(mesh_.points.size());
        for (const FaultNode& node : nodes_) {
            if (!node.is_vertex()) {
                continue;
            }
            for (const std::uint32_t c : node.cells) {
                if (node.state == FaultNode::State::joined && owner_[c] == no_index) {
                    owner_[c] = number;
                    filling_.replaced[c] = 1;
                }
            }
            ++number;
        }
    }

    void join_vertices() {
        for (std::uint32_t c = 0; c < owner_.size(); ++c) {
            for (std::size_t k = 0; k < 4 && owner_[c] != no_index; ++k) {
                const std::int32_t next = mesh_.neighbours[c][k];
                const std::uint32_t beyond = next < 0 ? no_index : owner_[static_cast<std::size_t>(next)];
                const auto& v = mesh_.cells[c];
                const Triangle facet{v[facet_corners[k][0]], v[facet_corners[k][1]], v[facet_corners[k][2]]};
                if (beyond == no_index) {
                    filling_.cells.push_back({{owner_[c], facet[0], facet[1], facet[2]}, c});
                } else if (owner_[c] < beyond) {
                    shared_[{owner_[c], beyond}].push_back({facet, c});
                }
            }
        }
    }

    void join_edges() {
        for (const auto& [edge, facets] : shared_) {
            std::map<Edge, std::uint32_t> round;  // the facets' outline
            for (const Shared& facet : facets) {
                for (std::size_t k = 0; k < 3; ++k) {
                    const std::uint32_t a = facet.corners[k];
                    const std::uint32_t b = facet.corners[(k + 1) % 3];
                    if (round.erase({b, a}) == 0) {
                        round[{a, b}] = facet.parent;
                    }
                }
            }
            for (const auto& [seeds, parent] : round) {
                const auto [a, b] = seeds;
                const auto [i, j] = edge;
                sectors_[{std::min(a, b), std::max(a, b)}].push_back({a < b ? Edge{i, j} : Edge{j, i}, parent});
            }
        }
    }

    /// The Voronoi face between two seeds is a convex polygon. When it has all its edges, they were joined with both.
    void join_triangles() {
        for (const auto& [seeds, sectors] : sectors_) {
            const auto [a, b] = seeds;
            const std::vector<std::uint32_t> ring = ring_of(sectors);
            for (const Sector& sector : ring.empty() ? sectors : std::vector<Sector>{}) {
                filling_.cells.push_back({{sector.edge[0], a, b, sector.edge[1]}, sector.parent});
            }
            for (std::size_t k = 1; k + 1 < ring.size(); ++k) {
                filling_.cells.push_back({{ring[k], ring[0], ring[k + 1], a}, sectors[0].parent});
                filling_.cells.push_back({{ring[0], ring[k], ring[k + 1], b}, sectors[0].parent});
            }
        }
    }

    const TetMesh& mesh_;
    std::span<const FaultNode> nodes_;
    std::vector<std::uint32_t> owner_;             ///< by cell: the vertex, as numbered in filled cells
    std::map<Edge, std::vector<Shared>> shared_;   ///< by edge of the fault
    std::map<Edge, std::vector<Sector>> sectors_;  ///< by edge between seeds
    Filling filling_;
};

}  // namespace

Filling fill_gaps(const TetMesh& mesh, std::span<const FaultNode> nodes) {
    return Filler(mesh, nodes).run();
}

}  // namespace terratet
