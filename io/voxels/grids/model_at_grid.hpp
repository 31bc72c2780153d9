// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// A model's values at the places of somebody else's grid, whatever its coordinate system.

#include <memory>

#include "interp/model_estimator.hpp"
#include "interp/voxels/bricks.hpp"
#include "io/voxels/voxel_grid.hpp"
#include "tess/barrier_query.hpp"
#include "tess/model.hpp"

namespace terratet {

/// Fields: the model's properties, then the extrapolation; what `query value` says at each voxel's centre. None beyond
/// the extent, the ground or the domain, nor where the extrapolation exceeds `max_extrapolation`.
class ModelAtGrid final : public BrickSource {
  public:
    /// \param places  origin, spacing, size and system of the grid; one that says no system is in the model's
    /// \pre model, barriers and estimator outlive it. Throws InputError when PROJ knows no way between the systems.
    ModelAtGrid(const Model& model, const BarrierQuery& barriers, const ModelEstimator& estimator, VoxelGrid places,
                double max_extrapolation);
    ~ModelAtGrid() override;

    /// Of the fields, at the grid's places in its own system.
    [[nodiscard]] const VoxelGrid& grid() const;
    [[nodiscard]] const Lattice& lattice() const override;
    [[nodiscard]] std::size_t fields() const override;
    void fill(Brick& brick) const override;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace terratet
