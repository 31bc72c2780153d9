// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// How near the tessellation's field comes to what was measured.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tess/model.hpp"

namespace terratet {

/// How well the tessellation's piecewise linear field agrees with all samples, dropped ones included, in the property's
/// scale. A sample in no cell, or in one with a missing value, does not count.
struct Fidelity {
    double rms = 0;
    double max = 0;
    std::size_t count = 0;
};

/// One per property. The field at a sample is what a voxel there would show, beside barriers too
/// (tess/barrier/query/own_side.hpp). `mesh` and `barriers` are the model's own, `gap` is CellRegions::barrier.
std::vector<Fidelity> fidelity(const Model& model, const TetMesh& mesh, std::span<const std::int32_t> gap,
                               const BarrierQuery& barriers);

}  // namespace terratet
