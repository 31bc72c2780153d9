// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Vertices with what is known of them, and the cells between them, as plain tables.

#include <array>
#include <cstdint>
#include <vector>

#include "tess/geometry.hpp"

namespace terratet {

/// Why a vertex is there.
enum class Role : std::uint8_t {
    sample,    ///< a kept sample; owner: its index in Model::samples
    seed,      ///< one of a fault's mirrored seeds; owner: index in Model::faults; side +1 or −1
    domain,    ///< on the hull box; owner −1
    inserted,  ///< by refinement; owner −1
};

struct Vertex {
    std::uint64_t id = 0;  ///< unique in a model, given in a canonical order of the data, never of arrival
    Vec3 position;         ///< frame-local, snapped (Frame::snapped)
    Role role = Role::inserted;
    std::int32_t owner = -1;
    std::int8_t side = 0;

    friend bool operator==(const Vertex&, const Vertex&) = default;
};

/// Flat copy of the cells for writers, statistics and resampling. Vertex i is vertices()[i]; cells have positive
/// orientation, start with their smallest vertex and are sorted, so that equal tessellations give equal arrays.
struct TetMesh {
    std::vector<Vec3> points;
    std::vector<std::array<std::uint32_t, 4>> cells;
    std::vector<std::array<std::int32_t, 4>> neighbours;  ///< of cell c opposite its vertex k; −1 on the hull
};

/// Values of a tessellation's vertices, in step with them.
struct VertexValues {
    std::vector<std::vector<double>> values;  ///< [property][vertex], measured units
    std::vector<double> extrapolation;        ///< 0…1
};

}  // namespace terratet
