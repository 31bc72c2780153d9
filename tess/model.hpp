// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The model: all that is kept. The tessellation is rebuilt from the vertices.

#include <string>
#include <vector>

#include "tess/barrier.hpp"
#include "tess/barrier_query.hpp"
#include "tess/criteria.hpp"
#include "tess/density.hpp"
#include "tess/domain.hpp"
#include "tess/site.hpp"
#include "tess/tessellation.hpp"

namespace terratet {

/// The name of the region that holds a point.
struct RegionName {
    Vec3 point;
    std::string name;
    friend bool operator==(const RegionName&, const RegionName&) = default;
};

/// A site with its tessellation's recipe and vertices.
struct Model : Site {
    Domain domain;
    Criteria criteria;
    DensityMode density = DensityMode::canonical;
    BarrierOptions barrier_options;
    std::vector<RegionName> region_names;
    std::vector<Barrier> barriers;  ///< prepared from the surfaces: faults, horizons, the ground, walls
    std::vector<Vertex> vertices;   ///< ascending id
    VertexValues vertex_values;     ///< in step with vertices
    std::string estimator;          ///< its full specification, e.g. "idw:power=2:max_points=12"
};

/// The tessellation of a model's vertices.
Tessellation tessellate(const Model& model);

/// A model's barriers with all that bars the estimation of its properties: they go on beyond the extent, and horizons
/// bar where they are hard. \pre The model outlives it.
BarrierQuery model_proximity(const Model& model);

}  // namespace terratet
