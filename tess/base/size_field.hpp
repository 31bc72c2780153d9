// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The edge length wanted for fault triangles, place by place: one spacing everywhere but for places marked
/// finer, from which it grows back gradually.

#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "tess/base/grid.hpp"

namespace terratet {

class SizeField {
  public:
    explicit SizeField(double spacing) : spacing_(spacing), cell_(spacing / 2) {}

    /// Wants `size` at p, growing by `gradation` times the distance from it. O(1): about 700 cells are touched.
    void refine(const Vec3& p, double size) {
        const double reach = (spacing_ - size) / gradation;
        const auto steps = static_cast<std::int64_t>(std::ceil(reach / cell_));
        const GridCell centre = GridCell::of(p, cell_);
        if (const auto found = cells_.find(centre.key()); found != cells_.end() && found->second <= size) {
            return;
        }
        for (std::int64_t i = -steps; i <= steps; ++i) {
            for (std::int64_t j = -steps; j <= steps; ++j) {
                for (std::int64_t k = -steps; k <= steps; ++k) {
                    const double away =
                        cell_ * std::max(0.0, std::sqrt(static_cast<double>(i * i + j * j + k * k)) - 1);
                    const double wanted = size + gradation * away;
                    if (wanted < spacing_) {
                        double& here = cells_.try_emplace(centre.moved(i, j, k).key(), spacing_).first->second;
                        here = std::min(here, wanted);
                    }
                }
            }
        }
    }

    [[nodiscard]] double at(const Vec3& p) const {
        if (cells_.empty()) {
            return spacing_;
        }
        const auto found = cells_.find(GridCell::of(p, cell_).key());
        return found == cells_.end() ? spacing_ : found->second;
    }

    [[nodiscard]] double spacing() const { return spacing_; }
    [[nodiscard]] bool uniform() const { return cells_.empty(); }

  private:
    static constexpr double gradation = 0.4;

    double spacing_;
    double cell_;
    std::unordered_map<std::uint64_t, double> cells_;  ///< where keys wrap, somewhere else is refined as well
};

}  // namespace terratet
