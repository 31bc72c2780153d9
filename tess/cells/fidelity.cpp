// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/fidelity.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "tess/barrier/query/own_side.hpp"
#include "tess/mesh/mesh_walk.hpp"

namespace terratet {
namespace {

/// The sides as each property sees them: horizons part some properties and not others.
class PropertySides {
  public:
    PropertySides(const Model& model, const TetMesh& mesh, std::span<const std::int32_t> gap,
                  const BarrierQuery& barriers)
        : soft_(mesh, gap, barriers, model.domain.extent) {
        for (std::size_t property = 0; property < model.properties.size(); ++property) {
            const BarrierQuery& seen = barriers.seen_by(property);
            if (&seen != &barriers && !hard_) {
                hard_ = std::make_unique<const OwnSide>(mesh, gap, seen, model.domain.extent);
            }
            of_.push_back(&seen != &barriers ? hard_.get() : &soft_);
        }
    }
    [[nodiscard]] const OwnSide& of(std::size_t property) const { return *of_[property]; }

  private:
    OwnSide soft_;
    std::unique_ptr<const OwnSide> hard_;
    std::vector<const OwnSide*> of_;
};

/// In the property's scale; NaN where the field has no value.
double field_at(const Model& model, std::size_t property, const VertexWeights& own) {
    const Property& kind = model.properties[property];
    std::array<double, 4> values{};
    for (std::size_t k = 0; k < 4; ++k) {
        values[k] = to_scale(kind, model.vertex_values.values[property][own.vertices[k]]);
    }
    return mixed(own.weights, values, kind.kind == Kind::categorical);
}

}  // namespace

std::vector<Fidelity> fidelity(const Model& model, const TetMesh& mesh, std::span<const std::int32_t> gap,
                               const BarrierQuery& barriers) {
    std::vector<Fidelity> result(model.properties.size());
    std::vector<double> squares(model.properties.size(), 0);
    MeshWalk walk(mesh);
    const PropertySides sides(model, mesh, gap, barriers);
    for (std::size_t i = 0; i < model.samples.size(); ++i) {
        const Vec3& p = model.samples.positions[i];
        const auto position = model.domain.hull.contains(p) ? walk.locate(p) : std::nullopt;
        if (!position) {
            continue;
        }
        for (std::size_t property = 0; property < result.size(); ++property) {
            const Property& kind = model.properties[property];
            const double value = field_at(model, property, sides.of(property).at(position->cell, p, position->weights));
            const double measured = to_scale(kind, model.samples.values[property][i]);
            const double error =
                kind.kind == Kind::categorical ? (measured == value ? 0.0 : 1.0) : std::abs(value - measured);
            if (!std::isnan(measured) && !std::isnan(value)) {
                squares[property] += error * error;
                result[property].max = std::max(result[property].max, error);
                ++result[property].count;
            }
        }
    }
    for (std::size_t property = 0; property < result.size(); ++property) {
        if (result[property].count > 0) {
            result[property].rms = std::sqrt(squares[property] / static_cast<double>(result[property].count));
        }
    }
    return result;
}

}  // namespace terratet
