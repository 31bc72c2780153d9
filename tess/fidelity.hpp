// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// How near the tessellation's field comes to what was measured.

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "tess/model.hpp"

namespace terratet {

/// Why the field misses a sample.
enum class MissReason : std::uint8_t {
    too_close,   ///< another is kept within the place's l_min
    near_fault,  ///< it lies in a barrier's protection zone, or the field at its place is that of the side it is on
    outside,     ///< beyond the extent
};

/// "too_close" and so on: the report's keys.
std::string to_string(MissReason reason);

/// How well the tessellation's piecewise linear field agrees with all samples, dropped ones included, in the property's
/// scale. A sample in no cell, or in one with a missing value, does not count.
struct Fidelity {
    double rms = 0;
    double max = 0;
    std::size_t count = 0;
    double sd = 0;         ///< of the samples counted
    double r2 = 1;         ///< variance explained: 1 − rms²/sd²; 1 where all are alike and met, but for rounding
    double tolerance = 0;  ///< 0: none
    std::size_t beyond_tolerance = 0;
    std::map<MissReason, std::size_t> reasons;  ///< of those beyond the tolerance
};

/// One per property. The field at a sample is what a voxel there would show, beside barriers too
/// (tess/barrier/query/own_side.hpp). `mesh` and `barriers` are the model's own, `gap` is CellRegions::barrier.
std::vector<Fidelity> fidelity(const Model& model, const TetMesh& mesh, std::span<const std::int32_t> gap,
                               const BarrierQuery& barriers);

}  // namespace terratet
