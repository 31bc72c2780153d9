// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Cells of a live tessellation as the insertion rule sees them, and deterministic points around
/// them.

#include <algorithm>

#include "tess/base/random_share.hpp"
#include "tess/mesh/delaunay.hpp"
#include "tess/refine/insertion_rule.hpp"

namespace terratet {

/// From vertices in any order: sorted by index, which is the order of ids. Without branches, which would be
/// mispredicted.
inline JudgedCell judged(const std::array<std::uint32_t, 4>& vertices, const CellPoints& points) {
    std::array<std::uint64_t, 4> order{};  // the index, and where it stands
    for (std::size_t k = 0; k < 4; ++k) {
        order[k] = std::uint64_t{vertices[k]} << 2U | k;
    }
    for (const auto& [i, j] : {std::pair{0U, 1U}, {2U, 3U}, {0U, 2U}, {1U, 3U}, {1U, 2U}}) {
        const std::uint64_t low = std::min(order[i], order[j]);
        order[j] = std::max(order[i], order[j]);
        order[i] = low;
    }
    JudgedCell result{};
    for (std::size_t k = 0; k < 4; ++k) {
        result.vertices[k] = static_cast<std::uint32_t>(order[k] >> 2U);
        result.points[k] = points[order[k] & 3U];
    }
    result.sphere = circumsphere(result.points);
    return result;
}

inline JudgedCell judged(delaunay::Cell cell) {
    std::array<std::uint32_t, 4> vertices{};
    CellPoints points;
    for (int k = 0; k < 4; ++k) {
        const auto vertex = cell->vertex(k);
        vertices[static_cast<std::size_t>(k)] = vertex->info();
        points[static_cast<std::size_t>(k)] = delaunay::from_cgal(vertex->point());
    }
    return judged(vertices, points);
}

/// Points uniform in the unit ball, seeded by ids: the same whatever happened before (R6), also after a reload (R7).
class BallPoints {
  public:
    explicit BallPoints(std::span<const std::uint64_t> ids) {
        for (const std::uint64_t id : ids) {
            state_ = mixed_key(state_ ^ id);
        }
    }
    Vec3 next() {
        for (;;) {
            const Vec3 p{uniform(), uniform(), uniform()};
            if (squared_length(p) <= 1) {
                return p;
            }
        }
    }

  private:
    double uniform() {
        state_ = mixed_key(state_);
        return static_cast<double>(state_ >> 11U) * 0x1p-52 - 1;
    }
    std::uint64_t state_ = 0;
};

}  // namespace terratet
