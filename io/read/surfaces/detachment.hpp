// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The surface at which faults end below.

#include <cstdint>
#include <vector>

#include "tess/base/box_tree.hpp"
#include "tess/geometry.hpp"
#include "tess/surface.hpp"

namespace terratet {

class Detachment {
  public:
    Detachment() = default;

    /// Made of all triangles. O(n log n).
    explicit Detachment(const std::vector<Surface>& surfaces);

    [[nodiscard]] bool empty() const { return tree_.items().empty(); }

    /// Height at which the way from a place along a direction first meets it; NaN: it never does. About O(log n).
    [[nodiscard]] double met_from(const Vec3& place, const Vec3& direction) const;

  private:
    struct Triangle {
        Vec3 a, b, c;
    };
    BoxTree<Triangle> tree_;
};

}  // namespace terratet
