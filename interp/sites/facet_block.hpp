// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// BoundaryFacet (stolen_volumes.hpp) for four facets at a time, most of what a query costs: one instruction does four
/// where the processor can (AVX2), and the bits are the same where it can't.

#include <array>
#include <cstddef>

#include "tess/geometry.hpp"

namespace terratet {

class FacetBlock {
  public:
    static constexpr std::size_t lanes = 4;

    /// Corners and split relative to the query. \pre lane < lanes
    void set(std::size_t lane, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& split) {
        const std::array<double, 12> all = {a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z, split.x, split.y, split.z};
        for (std::size_t i = 0; i < all.size(); ++i) {
            in_[i][lane] = all[i];
        }
    }

    /// Of all lanes. Every lane must have been set once, to anything.
    void sibson();
    void laplace();

    /// What sibson() or laplace() found for corner k of the facet in this lane.
    [[nodiscard]] double term(std::size_t k, std::size_t lane) const { return out_[k][lane]; }

  private:
    using Row = std::array<double, lanes>;
    alignas(32) std::array<Row, 12> in_{};
    alignas(32) std::array<Row, 3> out_{};

    friend struct FacetBlockLoops;
};

}  // namespace terratet
