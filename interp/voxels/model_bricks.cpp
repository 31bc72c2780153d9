// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/voxels/model_bricks.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>

#include "interp/plan/uncertainty.hpp"
#include "interp/voxels/cell_scan.hpp"

namespace terratet {
namespace {

constexpr std::size_t batch = 8192;  ///< queries: enough for all threads, little memory

/// The vertices' extrapolation; none where no property has a value, as above the ground.
std::vector<double> extrapolation_of_values(const VertexValues& vertices) {
    std::vector<double> out = vertices.extrapolation;
    for (std::size_t v = 0; v < out.size(); ++v) {
        if (std::ranges::all_of(vertices.values,
                                [v](const std::vector<double>& values) { return std::isnan(values[v]); })) {
            out[v] = missing;
        }
    }
    return out;
}

/// The block that each vertex is in: of its cells within the extent, or of those it hangs together with.
std::vector<double> vertex_regions(const TetMesh& mesh, const CellTable& cells) {
    std::vector<double> region(mesh.points.size(), missing);
    const auto give = [&](std::size_t cell, double value) {
        bool any = false;
        for (const std::uint32_t v : mesh.cells[cell]) {
            if (std::isnan(region[v])) {
                region[v] = value;
                any = true;
            }
        }
        return any;
    };
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
        if (cells.region[c] >= 0) {
            give(c, cells.region[c]);
        }
    }
    for (bool changed = true; changed;) {
        changed = false;
        for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
            if (cells.barrier[c] < 0 && cells.region[c] < 0) {
                const auto& corners = mesh.cells[c];
                const auto known = std::ranges::find_if(corners, [&](auto v) { return !std::isnan(region[v]); });
                changed |= known != corners.end() && give(c, region[*known]);
            }
        }
    }
    return region;
}

}  // namespace

struct ModelBricks::Impl {
    const Model& model;
    ModelBrickOptions options;
    std::optional<BarrierQuery> made;
    const BarrierQuery& barriers;
    std::map<const BarrierQuery*, OwnSide> sides;  ///< what is seen differs where horizons are hard
    std::vector<std::vector<double>> scaled;       ///< [field][vertex]
    std::unique_ptr<CellScan> scan;

    Impl(const Model& m, const ModelBrickOptions& o)
        : model(m), options(o), barriers(o.barriers != nullptr ? *o.barriers : made.emplace(model_proximity(m))) {}

    [[nodiscard]] std::size_t extrapolation() const { return model.properties.size(); }

    void estimate(Brick& brick) const;
    void set_values(Brick& brick, std::span<const std::size_t> voxels, std::span<const ValueQuery> places) const;
    void cut_off(Brick& brick) const;
};

ModelBricks::ModelBricks(const Model& model, const TetMesh& mesh, const CellTable& cells, const Lattice& lattice,
                         const ModelBrickOptions& options)
    : impl_(std::make_unique<Impl>(model, options)) {
    Impl& own = *impl_;
    std::vector<ScanField> fields;
    const auto add = [&](std::vector<double> values, const BarrierQuery& seen, ScanField field) {
        own.scaled.push_back(std::move(values));
        field.sides = &own.sides.try_emplace(&seen, mesh, cells.barrier, seen, model.domain.extent).first->second;
        fields.push_back(field);
    };
    for (std::size_t p = 0; p < model.properties.size(); ++p) {
        const Property& property = model.properties[p];
        std::vector<double> values = model.vertex_values.values[p];
        for (double& value : values) {
            value = to_scale(property, value);
        }
        ScanField field;
        field.log10 = property.scale == Scale::log10 && property.kind == Kind::continuous;
        field.categorical = property.kind == Kind::categorical;
        add(std::move(values), own.barriers.seen_by(p), field);
    }
    add(extrapolation_of_values(model.vertex_values), own.barriers, {});
    ScanField region;
    region.categorical = true;
    region.cell_values = cells.region;
    add(vertex_regions(mesh, cells), own.barriers, region);
    for (std::size_t f = 0; f < fields.size(); ++f) {
        fields[f].vertex_values = own.scaled[f];  // the vectors stay where they are from here on
    }
    own.scan = std::make_unique<CellScan>(mesh, std::span<const std::uint8_t>{}, std::move(fields), lattice,
                                          model.domain.extent);
}

ModelBricks::~ModelBricks() = default;

const Lattice& ModelBricks::lattice() const {
    return impl_->scan->lattice();
}

std::size_t ModelBricks::fields() const {
    return impl_->scan->fields();
}

void ModelBricks::fill(Brick& brick) const {
    impl_->scan->fill(brick);
    if (impl_->options.estimator != nullptr) {
        impl_->estimate(brick);
    }
    impl_->cut_off(brick);
}

/// Where the tessellation has an extrapolation there is ground to estimate in.
void ModelBricks::Impl::estimate(Brick& brick) const {
    const std::vector<float> ground = brick.values[extrapolation()];
    std::vector<std::size_t> voxels;
    std::vector<ValueQuery> places;
    const auto flush = [&] {
        set_values(brick, voxels, places);
        voxels.clear();
        places.clear();
    };
    if (ground.empty()) {
        return;
    }
    for (std::size_t f = 0; f <= extrapolation(); ++f) {
        brick.values[f].assign(ground.size(), std::numeric_limits<float>::quiet_NaN());
    }
    for (int i = 0; i < brick.size[0]; ++i) {
        for (int j = 0; j < brick.size[1]; ++j) {
            for (int k = 0; k < brick.size[2]; ++k) {
                const std::size_t voxel = Brick::index(i, j, k);
                if (!std::isnan(ground[voxel])) {
                    voxels.push_back(voxel);
                    places.push_back(
                        {scan->lattice().center(brick.lo[0] + i, brick.lo[1] + j, brick.lo[2] + k), -1, 1});
                }
            }
            if (places.size() >= batch) {
                flush();
            }
        }
    }
    flush();
}

void ModelBricks::Impl::set_values(Brick& brick, std::span<const std::size_t> voxels,
                                   std::span<const ValueQuery> places) const {
    if (places.empty()) {
        return;
    }
    const ValueBatch values = estimated_properties(model, *options.estimator, places);
    for (std::size_t p = 0; p < model.properties.size(); ++p) {
        for (std::size_t i = 0; i < voxels.size(); ++i) {
            brick.values[p][voxels[i]] = static_cast<float>(values.values[p][i]);
        }
    }
    for (std::size_t i = 0; i < voxels.size(); ++i) {
        brick.values[extrapolation()][voxels[i]] = static_cast<float>(values.extrapolation[i]);
    }
}

void ModelBricks::Impl::cut_off(Brick& brick) const {
    const std::vector<float>& reach = brick.values[extrapolation()];
    const auto limit = static_cast<float>(options.max_extrapolation);
    for (std::size_t p = 0; p < model.properties.size(); ++p) {
        auto& values = brick.values[p];
        bool any = false;
        for (std::size_t v = 0; v < values.size(); ++v) {
            if (std::isfinite(limit) && !(reach[v] <= limit)) {
                values[v] = std::numeric_limits<float>::quiet_NaN();
            }
            any |= !std::isnan(values[v]);
        }
        if (!any) {
            values.clear();
        }
    }
}

}  // namespace terratet
