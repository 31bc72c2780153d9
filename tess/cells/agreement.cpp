// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/cells/agreement.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "tess/mesh/mesh_walk.hpp"

namespace terratet {

namespace {

struct Place {
    Vec3 position;
    CellPosition in;
};

/// In the order of a coarse lattice, so that a walk from one to the next is short.
std::vector<Place> random_places(const Model& model, const TetMesh& mesh, const CellTable& cells, std::size_t count) {
    std::mt19937_64 bits(20'240'917);
    const auto uniform = [&] { return static_cast<double>(bits() >> 11U) * 0x1p-53; };
    const Box3& extent = model.domain.extent;
    const Vec3 size = extent.size();
    std::vector<Vec3> positions;
    for (std::size_t i = 0; i < count; ++i) {
        const double x = uniform();
        const double y = uniform();
        positions.push_back(extent.lo + Vec3{x * size.x, y * size.y, uniform() * size.z});
    }
    const auto row = [&](double x, int axis) { return std::floor(16 * (x - extent.lo[axis]) / size[axis]); };
    std::ranges::sort(positions, {}, [&](const Vec3& p) { return std::tuple(row(p.x, 0), row(p.y, 1), p); });
    MeshWalk walk(mesh);
    std::vector<Place> places;
    for (const Vec3& p : positions) {
        const auto in = walk.locate(p);
        if (in && cells.barrier[in->cell] < 0) {
            places.push_back({p, *in});
        }
    }
    return places;
}

}  // namespace

AgreementCheck check_agreement(const Model& model, const TetMesh& mesh, const CellTable& cells,
                               const ValueSource& source, std::size_t count) {
    const std::vector<Place> places = random_places(model, mesh, cells, count);
    std::vector<ValueQuery> queries;
    for (const Place& place : places) {
        queries.push_back({place.position, -1, 0});
    }
    const ValueBatch batch = source(queries);
    AgreementCheck check;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const auto& [cell, weights] = places[i].in;
        bool known = false;
        bool beyond = false;
        for (std::size_t p = 0; p < model.criteria.variation.size(); ++p) {
            const double tolerance = model.criteria.variation[p].residual;
            if (tolerance <= 0) {
                continue;
            }
            double linear = 0;
            for (std::size_t k = 0; k < 4; ++k) {
                linear +=
                    weights[k] * to_scale(model.properties[p], model.vertex_values.values[p][mesh.cells[cell][k]]);
            }
            const double off = std::abs(linear - to_scale(model.properties[p], batch.values[p][i]));
            known = known || !std::isnan(off);
            beyond = beyond || off > tolerance * (1 + 1e-9);
        }
        const Reason reason = cells.reason[cell];
        const bool excused = reason != Reason::none && reason != Reason::smooth;
        check.places += known ? 1 : 0;
        check.places_excused += known && excused ? 1 : 0;
        (excused ? check.excused : check.beyond) += beyond ? 1 : 0;
    }
    return check;
}

}  // namespace terratet
