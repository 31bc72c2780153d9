// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/voxels/grids/model_at_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/voxels/grids/model_at_places.hpp"

namespace terratet {

struct ModelAtGrid::Impl {
    ModelAtPlaces model;
    VoxelGrid grid;
    Lattice lattice;
};

ModelAtGrid::ModelAtGrid(const Model& model, const BarrierQuery& barriers, const ModelEstimator& estimator,
                         VoxelGrid places, double max_extrapolation)
    : impl_(std::make_unique<Impl>(Impl{
          ModelAtPlaces(model, barriers, estimator, places.frame.crs_wkt, max_extrapolation), std::move(places), {}})) {
    VoxelGrid& grid = impl_->grid;
    if (grid.frame.crs_wkt.empty()) {
        grid.frame = model.frame;
    }
    impl_->lattice = {grid.frame.to_local(grid.origin), grid.frame.to_local_size(grid.spacing), grid.size};
    const Lattice any{{}, {1, 1, 1}, {1, 1, 1}};
    std::vector<VoxelLayer> layers = voxel_grid(model, {}, any).layers;
    layers.pop_back();  // the region
    grid.layers = std::move(layers);
}

ModelAtGrid::~ModelAtGrid() = default;

const VoxelGrid& ModelAtGrid::grid() const {
    return impl_->grid;
}

const Lattice& ModelAtGrid::lattice() const {
    return impl_->lattice;
}

std::size_t ModelAtGrid::fields() const {
    return impl_->grid.layers.size();
}

void ModelAtGrid::fill(Brick& brick) const {
    std::vector<Vec3> places;
    std::vector<std::size_t> voxels;
    for (int i = 0; i < brick.size[0]; ++i) {
        for (int j = 0; j < brick.size[1]; ++j) {
            for (int k = 0; k < brick.size[2]; ++k) {
                places.push_back(impl_->grid.center(brick.lo[0] + i, brick.lo[1] + j, brick.lo[2] + k));
                voxels.push_back(Brick::index(i, j, k));
            }
        }
    }
    const ValueBatch found = impl_->model.values(std::move(places));
    if (std::ranges::all_of(found.extrapolation, [](double reach) { return std::isnan(reach); })) {
        return;
    }
    constexpr std::size_t count = std::size_t{Brick::edge} * Brick::edge * Brick::edge;
    for (auto& field : brick.values) {
        field.assign(count, std::numeric_limits<float>::quiet_NaN());
    }
    for (std::size_t n = 0; n < voxels.size(); ++n) {
        brick.values.back()[voxels[n]] = static_cast<float>(found.extrapolation[n]);
        for (std::size_t p = 0; p + 1 < fields(); ++p) {
            brick.values[p][voxels[n]] = static_cast<float>(found.values[p][n]);
        }
    }
}

}  // namespace terratet
