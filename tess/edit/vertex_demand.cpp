// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/edit/vertex_demand.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "tess/base/box_clip.hpp"
#include "tess/base/grid_steps.hpp"
#include "tess/base/rounding.hpp"

namespace terratet {

namespace {

constexpr double cells_per_vertex = 6.8;  ///< in a Delaunay tessellation of points in no order; fewer in one of order

/// Vertices that a volume takes in cells with edges of at most `edge`: no such cell is larger than the regular one.
double filling(double volume, double edge) {
    return volume / (edge * edge * edge / (6 * std::numbers::sqrt2)) / cells_per_vertex;
}

double demand_of_cells(const Model& model) {
    const Criteria& criteria = model.criteria;
    const Box3& hull = model.domain.hull;
    const double volume = hull.volume();
    double wanted = criteria.v_max > 0 ? volume / criteria.v_max / cells_per_vertex : 0;
    if (std::isinf(longest_on_faces(criteria)) ||
        std::ranges::any_of(criteria.variation, [](const VariationLimits& v) { return v.df_min > 0; })) {
        return wanted;
    }
    double coarsest = criteria.l_max;
    for (const ResolutionOverride& part : criteria.overrides) {
        coarsest = std::max(coarsest, part.l_max);
    }
    wanted = std::max(wanted, filling(volume, coarsest));
    for (const ResolutionOverride& part : criteria.overrides) {
        if (part.where == ResolutionOverride::Where::box && &part == &criteria.overrides.back()) {  // nothing over it
            const Box3 box{hull.clamped(part.box.lo), hull.clamped(part.box.hi)};
            wanted = std::max(wanted, filling(box.volume(), part.l_max));
        }
    }
    return wanted;
}

/// At least: some are left out near samples.
double demand_of_grid(const Model& model) {
    const auto [x, y, z] = grid_steps(model.domain.hull, model.criteria.l_min, longest_on_faces(model.criteria));
    return x * y + y * z + z * x;  // half of them
}

double demand_of_seeds(const Model& model, const BarrierOptions& barriers) {
    const double spacing = barriers.spacing > 0 ? barriers.spacing : model.criteria.l_min;
    double area = 0;
    for (const Surface& surface : model.surfaces) {
        if (surface.kind == SurfaceKind::domain) {
            continue;
        }
        for (const Triangle& t : surface.triangles) {
            const std::vector<Vec3> part =
                clipped({surface.vertices[t[0]], surface.vertices[t[1]], surface.vertices[t[2]]}, model.domain.extent);
            Vec3 twice;
            for (std::size_t k = 2; k < part.size(); ++k) {
                twice = twice + cross(part[k - 1] - part[0], part[k] - part[0]);
            }
            area += length(twice) / 2;
        }
    }
    return 2 * area / (spacing * spacing) / 2;  // half of it may overlap, be refused or lie closer to its neighbours
}

}  // namespace

double VertexDemand::total() const {
    return std::max(edges, grid) + seeds;
}

VertexDemand vertex_demand(const Model& model, const BarrierOptions& barriers) {
    return {demand_of_cells(model), demand_of_grid(model), demand_of_seeds(model, barriers)};
}

void require_affordable(const Model& model, const BuildOptions& options) {
    const VertexDemand demand = vertex_demand(model, options.barriers);
    const auto limit = static_cast<double>(options.refine.max_vertices);
    if (demand.total() <= limit) {
        return;
    }
    std::ostringstream text;
    text.precision(3);
    text << "the criteria ask for at least " << demand.total() << " vertices in the extent of ";
    const Vec3 size = model.frame.to_world_size(model.domain.extent.size());
    text << size.x << " x " << size.y << " x " << size.z << ", more than `max_vertices` " << options.refine.max_vertices
         << " (by default what fits into memory): ";
    if (demand.seeds > limit / 2) {
        const double spacing = options.barriers.spacing > 0 ? options.barriers.spacing : model.criteria.l_min;
        text << "a `barriers.spacing` of " << rounded_up(spacing * std::sqrt(2 * demand.seeds / limit));
    } else if (model.criteria.v_max > 0 && demand.edges > filling(model.domain.hull.volume(), model.criteria.l_max)) {
        text << "a `v_max` of " << rounded_up(2 * model.criteria.v_max * demand.edges / limit);
    } else {
        const double longer = std::max(std::cbrt(2 * demand.edges / limit), std::sqrt(2 * demand.grid / limit));
        const double l_max = rounded_up(model.criteria.l_max * std::max(1.0, longer));
        text << "an `l_max` of " << l_max << " (with an `l_min` of a quarter of it)";
    }
    text << " may fit, or a smaller `extent`";
    throw UsageError(text.str());
}

}  // namespace terratet
