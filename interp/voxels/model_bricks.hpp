// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// A model in the bricks of a lattice: a field a property in measured units (a category's index), then the
/// extrapolation, 0…1, then the region's number.

#include <limits>
#include <memory>

#include "interp/model_estimator.hpp"
#include "interp/voxels/bricks.hpp"
#include "tess/cells.hpp"
#include "tess/model.hpp"

namespace terratet {

struct ModelBrickOptions {
    /// When given, each voxel's values are those of all samples at its centre instead of the tessellation's linear
    /// field there: 2 to 20 µs a voxel and property. Of the model, made with uncertainty if there are properties
    /// without samples (interp/plan/uncertainty.hpp).
    const ModelEstimator* estimator = nullptr;
    const BarrierQuery* barriers = nullptr;  ///< of the model, and outlive the bricks; null: made for them
    double max_extrapolation = std::numeric_limits<double>::infinity();  ///< no property has values beyond
};

/// Voxels whose centres lie outside the extent or the mesh have no value, nor have those where no property has one.
class ModelBricks final : public BrickSource {
  public:
    /// \pre model, mesh and cells outlive it.
    ModelBricks(const Model& model, const TetMesh& mesh, const CellTable& cells, const Lattice& lattice,
                const ModelBrickOptions& options = {});
    ~ModelBricks() override;

    [[nodiscard]] const Lattice& lattice() const override;
    [[nodiscard]] std::size_t fields() const override;
    void fill(Brick& brick) const override;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace terratet
