// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The linear field at places that are no vertices, for meshes made from others; always from a place's own
/// side of the faults.

#include <array>
#include <cstdint>
#include <span>

#include "tess/barrier_query.hpp"
#include "tess/model.hpp"
#include "tess/tessellation.hpp"

namespace terratet {

/// Vertices of one cell, those with the largest weights first. Weights sum to 1; after the last one that counts come
/// zeros.
struct Blend {
    std::array<std::uint32_t, 4> vertices{};
    std::array<double, 4> weights{};
};

/// The value there. \param mix of two values and the second's share
template <class Values, class Mix>
auto blended(const Blend& blend, const Values& values, const Mix& mix) {
    auto value = values[blend.vertices[0]];
    double weight = blend.weights[0];
    for (std::size_t k = 1; k < blend.vertices.size() && blend.weights[k] > 0; ++k) {
        weight += blend.weights[k];
        value = mix(value, values[blend.vertices[k]], blend.weights[k] / weight);
    }
    return value;
}

/// Does a fault stand between a place and a vertex? A vertex that stands on it is seen from both sides.
bool is_hidden(const BarrierQuery& barriers, const Vec3& p, const Vec3& vertex);

class OwnSideField {
  public:
    /// \param gap of each cell, the fault between whose sheets it is; −1. All outlive this.
    OwnSideField(const TetMesh& mesh, std::span<const std::int32_t> gap, const BarrierQuery& barriers)
        : mesh_(mesh), gap_(gap), barriers_(barriers) {}

    /// \param cell near p, from which a walk through no gap starts; where it ends at one, the field goes on linearly
    ///             as far as the cell's corners
    [[nodiscard]] Blend at(const Vec3& p, std::uint32_t cell) const;

  private:
    [[nodiscard]] std::array<double, 4> weights_in(std::uint32_t cell, const Vec3& p) const;
    [[nodiscard]] Blend seen_from(const Vec3& p, std::uint32_t cell, const std::array<double, 4>& weights) const;

    const TetMesh& mesh_;
    std::span<const std::int32_t> gap_;
    const BarrierQuery& barriers_;
};

}  // namespace terratet
