// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/voxels/grids/model_at_grid.hpp"

#include <cmath>
#include <limits>

#include "interp/plan/uncertainty.hpp"
#include "io/base/crs.hpp"
#include "tess/barrier/query/model_bounds.hpp"

namespace terratet {

struct ModelAtGrid::Impl {
    const Model& model;
    const ModelEstimator& estimator;
    ModelBounds bounds;
    VoxelGrid grid;
    Lattice lattice;
    double max_extrapolation;

    [[nodiscard]] bool needs_transform() const {
        return !grid.frame.crs_wkt.empty() && grid.frame.crs_wkt != model.frame.crs_wkt;
    }
    /// Places of a brick in the model's frame, z fastest.
    [[nodiscard]] std::vector<Vec3> places_of(const Brick& brick) const;
};

ModelAtGrid::ModelAtGrid(const Model& model, const BarrierQuery& barriers, const ModelEstimator& estimator,
                         VoxelGrid places, double max_extrapolation)
    : impl_(std::make_unique<Impl>(
          Impl{model, estimator, ModelBounds(model.domain, barriers), std::move(places), {}, max_extrapolation})) {
    VoxelGrid& grid = impl_->grid;
    if (grid.frame.crs_wkt.empty()) {
        grid.frame = model.frame;
    } else if (impl_->needs_transform()) {
        static_cast<void>(CrsTransform(crs_from_wkt(grid.frame.crs_wkt), crs_from_wkt(model.frame.crs_wkt)));
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

std::vector<Vec3> ModelAtGrid::Impl::places_of(const Brick& brick) const {
    std::vector<Vec3> places;
    for (int i = 0; i < brick.size[0]; ++i) {
        for (int j = 0; j < brick.size[1]; ++j) {
            for (int k = 0; k < brick.size[2]; ++k) {
                places.push_back(grid.center(brick.lo[0] + i, brick.lo[1] + j, brick.lo[2] + k));
            }
        }
    }
    if (needs_transform()) {
        CrsTransform(crs_from_wkt(grid.frame.crs_wkt), crs_from_wkt(model.frame.crs_wkt)).apply(places);
    }
    for (Vec3& place : places) {
        place = model.frame.to_local(place);
    }
    return places;
}

void ModelAtGrid::fill(Brick& brick) const {
    const std::vector<Vec3> places = impl_->places_of(brick);
    std::vector<ValueQuery> queries;
    std::vector<std::size_t> voxels;
    std::size_t n = 0;
    for (int i = 0; i < brick.size[0]; ++i) {
        for (int j = 0; j < brick.size[1]; ++j) {
            for (int k = 0; k < brick.size[2]; ++k) {
                const Vec3& place = places[n++];
                if (is_finite(place) && impl_->model.domain.extent.contains(place) && !impl_->bounds.excludes(place)) {
                    queries.push_back({place, -1, 1});
                    voxels.push_back(Brick::index(i, j, k));
                }
            }
        }
    }
    if (queries.empty()) {
        return;
    }
    const ValueBatch values = estimated_properties(impl_->model, impl_->estimator, queries);
    constexpr std::size_t count = std::size_t{Brick::edge} * Brick::edge * Brick::edge;
    for (auto& field : brick.values) {
        field.assign(count, std::numeric_limits<float>::quiet_NaN());
    }
    for (std::size_t q = 0; q < queries.size(); ++q) {
        const double reach = values.extrapolation[q];
        brick.values.back()[voxels[q]] = static_cast<float>(reach);
        for (std::size_t p = 0; reach <= impl_->max_extrapolation && p + 1 < fields(); ++p) {
            brick.values[p][voxels[q]] = static_cast<float>(values.values[p][q]);
        }
    }
}

}  // namespace terratet
