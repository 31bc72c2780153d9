// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <limits>

#include "io/write/clip.hpp"
#include "io/write/clipped_parts.hpp"
#include "tess/mesh/quality.hpp"

namespace terratet {
namespace {

constexpr double good_angle = 10;
constexpr double least_angle = 1;
constexpr double least_share = 0.1;  ///< of l_min: no edge should be shorter

/// Points on facets that stay: of gaps, and where the mesh ends but not at the extent.
std::vector<char> points_on_surfaces(const ModelView& view, const ClippedMesh& mesh) {
    std::vector<char> result(mesh.points.size(), 0);
    const auto is_gap = [&](std::size_t cell) { return view.cells.barrier[mesh.parent[cell]] >= 0; };
    for (const ClippedMesh::Facet& facet : mesh.facets) {
        const bool stays =
            facet.beyond < 0 ? !facet.on_extent : is_gap(facet.cell) != is_gap(static_cast<std::size_t>(facet.beyond));
        for (const std::uint32_t v : facet.corners) {
            result[v] = result[v] != 0 || stays ? 1 : 0;
        }
    }
    return result;
}

}  // namespace

double smallest_l_min(const Criteria& criteria) {
    double smallest = criteria.l_min_between > 0 ? std::min(criteria.l_min, criteria.l_min_between) : criteria.l_min;
    for (const FinePlace& place : criteria.fine) {
        smallest = std::min(smallest, place.l_min);
    }
    for (const ResolutionOverride& part : criteria.overrides) {
        smallest = std::min(smallest, part.l_min);
    }
    return smallest;
}

ClippedShapes clipped_shapes(const ModelView& view, const ClippedMesh& mesh) {
    ClippedShapes shapes;
    shapes.edge_min = std::numeric_limits<double>::infinity();
    const std::vector<char> on_surface = points_on_surfaces(view, mesh);
    const double least_edge = least_share * smallest_l_min(view.model.criteria);
    std::vector<double> angles;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
        if (view.cells.barrier[mesh.parent[c]] >= 0) {
            continue;
        }
        const auto& v = mesh.cells[c];
        const CellQuality quality =
            cell_quality({mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]], mesh.points[v[3]]});
        angles.push_back(quality.dihedral_min_deg);
        shapes.edge_min = std::min(shapes.edge_min, quality.shortest_edge);
        shapes.below_1_deg += quality.dihedral_min_deg < least_angle ? 1 : 0;
        shapes.below_10_deg += quality.dihedral_min_deg < good_angle ? 1 : 0;
        shapes.short_edges += quality.shortest_edge < least_edge ? 1 : 0;
        if (quality.dihedral_min_deg >= good_angle && quality.shortest_edge >= least_edge) {
            continue;
        }
        const auto has_role = [&](Role role) {
            return std::ranges::any_of(v, [&](std::uint32_t p) {
                return mesh.place[p] < view.model.vertices.size() && view.model.vertices[mesh.place[p]].role == role;
            });
        };
        const bool at_fault =
            has_role(Role::seed) || std::ranges::any_of(v, [&](std::uint32_t p) { return on_surface[p] != 0; });
        ++(has_role(Role::sample) ? shapes.at_sample
           : at_fault             ? shapes.at_fault
           : mesh.changed[c] == 0 ? shapes.as_tessellated
                                  : shapes.other);
    }
    shapes.cells = angles.size();
    if (!angles.empty()) {
        std::ranges::sort(angles);
        shapes.dihedral_min_deg = angles.front();
        shapes.dihedral_p1_deg = angles[angles.size() / 100];
    }
    return shapes;
}

}  // namespace terratet
