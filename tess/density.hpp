// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Density edition (paper 4.1 c): which samples become vertices. Boreholes are sampled every few metres along and
/// hundreds of metres apart across; cells of both lengths at once are slivers.
///
/// Guarantees
///  D1  No two kept samples are closer than l_min.
///  D2  Every dropped sample has a kept one within l_min, or lies in a fault's protection zone.
///  D3  The result does not depend on the order of the input.
///  V1  Kept samples carry their measured values. (Dropped ones leave the tessellation, never the model.)

#include <cstddef>
#include <cstdint>
#include <vector>

namespace terratet {

/// Which samples become vertices (paper, 4.1 c).
enum class DensityMode {
    canonical,  ///< in canonical order, keep a sample unless a kept one is nearer than l_min. Default
    paper,      ///< while a Delaunay edge is shorter than l_min, delete its end with the smaller nearest-neighbour
                ///< distance; then restore those left without a kept one within l_min
};

struct DensityResult {
    std::vector<std::uint32_t> kept;         ///< indices into the samples, ascending
    std::size_t deleted = 0;                 ///< too near a kept one
    std::vector<std::uint32_t> near_faults;  ///< in a protection zone, ascending
};

}  // namespace terratet
