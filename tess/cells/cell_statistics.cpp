// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/cell_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tess/base/tetrahedron.hpp"
#include "tess/mesh/quality.hpp"
#include "tess/refine/insertion_rule.hpp"

namespace terratet {
namespace {

double percent(std::size_t part, std::size_t whole) {
    return whole == 0 ? 0 : 100 * static_cast<double>(part) / static_cast<double>(whole);
}

/// Value at fraction q of a sorted sequence, nearest rank.
double quantile(const std::vector<float>& sorted, double q) {
    return sorted.empty() ? 0 : sorted[static_cast<std::size_t>(q * static_cast<double>(sorted.size() - 1))];
}

}  // namespace

CellStatistics cell_statistics(const Model& model, const TetMesh& mesh, const CellTable& cells,
                               const BarrierQuery& barriers) {
    CellStatistics s;
    s.vertices = mesh.points.size();
    s.tetrahedra = mesh.cells.size();
    s.regions = static_cast<std::size_t>(cells.region_count);
    const InsertionRule rule(model.criteria, model.domain, model.frame, barriers, model.properties,
                             model.vertex_values);
    std::size_t skinny = 0;
    std::size_t flat = 0;
    std::size_t bad = 0;
    double shortest = std::numeric_limits<double>::infinity();
    double longest = 0;
    std::vector<float> dihedrals;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
        const bool gap = cells.barrier[c] >= 0;
        s.gap_tetrahedra += gap ? 1 : 0;
        if (cells.in_extent[c] == 0) {
            continue;
        }
        for (const auto& [i, j] : cell_edges) {
            const double d = squared_distance(mesh.points[mesh.cells[c][i]], mesh.points[mesh.cells[c][j]]);
            shortest = std::min(shortest, d);
            longest = std::max(longest, d);
        }
        if (gap) {
            continue;
        }
        const bool is_skinny = model.criteria.radius_edge > 0 && cells.radius_edge[c] > model.criteria.radius_edge;
        const bool is_flat = !is_skinny && model.criteria.aspect > 0 && cells.aspect[c] > model.criteria.aspect;
        skinny += is_skinny ? 1 : 0;
        flat += is_flat ? 1 : 0;
        bad += is_skinny || is_flat || rule.violation(judged(mesh, mesh.cells[c])) > 1 ? 1 : 0;
        dihedrals.push_back(cells.dihedral_min_deg[c]);
        if (cells.dihedral_min_deg[c] < model.criteria.dihedral_deg) {
            ++s.below_dihedral;
            s.below_dihedral_given += std::ranges::all_of(mesh.cells[c], [&](std::uint32_t v) {
                return model.vertices[v].role == Role::sample || model.vertices[v].role == Role::seed;
            });
        }
        s.below_v_min +=
            model.criteria.v_min > 0 && cell_quality(cell_points(mesh, mesh.cells[c])).volume < model.criteria.v_min;
    }
    std::ranges::sort(dihedrals);
    s.skinny_percent = percent(skinny, dihedrals.size());
    s.flat_percent = percent(flat, dihedrals.size());
    s.bad_percent = percent(bad, dihedrals.size());
    s.dihedral_min_deg = quantile(dihedrals, 0);
    s.dihedral_p1_deg = quantile(dihedrals, 0.01);
    s.dihedral_p5_deg = quantile(dihedrals, 0.05);
    s.dihedral_median_deg = quantile(dihedrals, 0.5);
    s.edge_min = std::isinf(shortest) ? 0 : std::sqrt(shortest);
    s.edge_max = std::sqrt(longest);
    return s;
}

std::vector<EmptyBlock> empty_blocks(const Model& model, const TetMesh& mesh, const CellTable& cells) {
    std::vector<EmptyBlock> blocks(static_cast<std::size_t>(cells.region_count));
    std::vector<std::size_t> asked;
    for (std::size_t p = 0; p < model.properties.size(); ++p) {
        if (!std::ranges::all_of(model.samples.values[p], [](double value) { return std::isnan(value); })) {
            asked.push_back(p);
        }
    }
    std::vector<std::vector<char>> valued(asked.size(), std::vector<char>(blocks.size(), 0));
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
        if (cells.region[c] < 0) {
            continue;
        }
        const auto region = static_cast<std::size_t>(cells.region[c]);
        blocks[region].volume += cell_quality(cell_points(mesh, mesh.cells[c])).volume / model.frame.z_scale;
        for (std::size_t i = 0; i < asked.size(); ++i) {
            const auto& values = model.vertex_values.values[asked[i]];
            valued[i][region] |=
                std::ranges::none_of(mesh.cells[c], [&](std::uint32_t v) { return std::isnan(values[v]); });
        }
    }
    for (std::size_t region = 0; region < blocks.size(); ++region) {
        blocks[region].region = static_cast<std::int32_t>(region);
        blocks[region].name = cells.region_name[region];
        for (std::size_t i = 0; i < asked.size(); ++i) {
            if (valued[i][region] == 0) {
                blocks[region].properties.push_back(model.properties[asked[i]].name);
            }
        }
        blocks[region].of_all = blocks[region].properties.size() == asked.size();
    }
    std::erase_if(blocks, [](const EmptyBlock& block) { return block.properties.empty(); });
    return blocks;
}

}  // namespace terratet
