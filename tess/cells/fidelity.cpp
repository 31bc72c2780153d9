// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/fidelity.hpp"

#include <algorithm>
#include <cmath>

#include "tess/barrier/query/own_side.hpp"
#include "tess/mesh/gap_cell.hpp"
#include "tess/mesh/mesh_walk.hpp"

namespace terratet {

std::vector<Fidelity> fidelity(const Model& model, const TetMesh& mesh, const BarrierQuery& barriers) {
    std::vector<Fidelity> result(model.properties.size());
    std::vector<double> squares(model.properties.size(), 0);
    MeshWalk walk(mesh);
    std::vector<OwnSide> sides;
    for (std::size_t property = 0; property < result.size(); ++property) {
        sides.emplace_back(mesh, std::span<const std::int32_t>(), barriers.seen_by(property));
    }
    for (std::size_t i = 0; i < model.samples.size(); ++i) {
        const Vec3& p = model.samples.positions[i];
        if (!model.domain.hull.contains(p)) {
            continue;
        }
        auto position = walk.locate(p);
        if (!position) {
            continue;
        }
        const std::int32_t gap = gap_barrier(mesh.cells[position->cell], model.vertices);
        if (gap >= 0 && model.barriers[static_cast<std::size_t>(gap)].sheet.kind != SurfaceKind::fault) {
            keep_to_own_side(*position, p, mesh, model.vertices);
        }
        for (std::size_t property = 0; property < result.size(); ++property) {
            const Property& kind = model.properties[property];
            const VertexWeights own = sides[property].weights(position->cell, p, position->weights);
            double value = 0;
            double heaviest = -1;
            for (std::size_t k = 0; k < 4; ++k) {
                const double w = own.weights[k];
                const double at_vertex = to_scale(kind, model.vertex_values.values[property][own.vertices[k]]);
                if (kind.kind == Kind::categorical) {
                    value = w > heaviest ? at_vertex : value;
                    heaviest = std::max(heaviest, w);
                } else if (w != 0) {
                    value += w * at_vertex;
                }
            }
            const double measured = to_scale(kind, model.samples.values[property][i]);
            const double error =
                kind.kind == Kind::categorical ? (measured == value ? 0.0 : 1.0) : std::abs(value - measured);
            if (!std::isnan(measured) && !std::isnan(value)) {
                squares[property] += error * error;
                result[property].max = std::max(result[property].max, error);
                ++result[property].count;
            }
        }
    }
    for (std::size_t property = 0; property < result.size(); ++property) {
        if (result[property].count > 0) {
            result[property].rms = std::sqrt(squares[property] / static_cast<double>(result[property].count));
        }
    }
    return result;
}

}  // namespace terratet
