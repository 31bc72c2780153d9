// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// A length at every place, from lengths wanted at some: the least of length + 0.4 · distance. So it changes by 0.4 a
/// unit of length at most, and cells grow away from where they have to be small.

#include <limits>
#include <span>
#include <vector>

#include "tess/base/box_tree.hpp"
#include "tess/criteria.hpp"

namespace terratet {

class GradedSizes {
  public:
    static constexpr double gradation = 0.4;

    /// O(n log n). The places are copied.
    explicit GradedSizes(std::span<const FinePlace> places = {});

    [[nodiscard]] bool empty() const { return tree_.items().empty(); }

    /// The length at p, or `limit` where that is less. Logarithmic. Safe from many threads.
    [[nodiscard]] double at(const Vec3& p, double limit) const;

    [[nodiscard]] double smallest() const;  ///< infinity without places; linear

    /// At most so many vertices more than a length `limit` everywhere allows: ∫ 4/length³ round each place.
    [[nodiscard]] double packing_bound(double limit) const;

  private:
    struct Least {
        double l_min = std::numeric_limits<double>::infinity();
    };
    BoxTree<FinePlace, Least> tree_;
};

/// Without those that others' growth implies.
std::vector<FinePlace> without_implied(std::vector<FinePlace> places);

}  // namespace terratet
