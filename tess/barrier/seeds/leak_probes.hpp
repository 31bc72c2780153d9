// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Places to look for leaks at, and which of them a ball holds.

#include <cstdint>
#include <vector>

#include "tess/base/box_tree.hpp"
#include "tess/geometry.hpp"

namespace terratet {

struct LeakProbe {
    Vec3 place;                 ///< just out of the protection zone
    Vec3 out;                   ///< away from the triangle that it stands over; none when it was pushed out of a zone
    std::uint32_t barrier = 0;  ///< whose triangle that is
};

class LeakProbes {
  public:
    LeakProbes() = default;
    explicit LeakProbes(std::vector<LeakProbe> probes);

    /// Is the test true of one of those in the ball? Asked until it is.
    template <class Test>
    [[nodiscard]] bool any_within(const Vec3& center, double radius, const Test& test) const {
        const double square = radius * radius;
        return tree_.any([&](const auto& node) { return squared_distance(center, node.box.clamped(center)) < square; },
                         [&](const LeakProbe& probe) {
                             return retired_[number_of(probe)] == 0 && squared_distance(probe.place, center) < square &&
                                    test(probe);
                         });
    }

    /// Those in the ball are out of the question from now on.
    void retire_within(const Vec3& center, double radius);

  private:
    [[nodiscard]] std::size_t number_of(const LeakProbe& probe) const {
        return static_cast<std::size_t>(&probe - tree_.items().data());
    }

    BoxTree<LeakProbe> tree_;
    std::vector<char> retired_;  ///< in the order of the tree's items
};

}  // namespace terratet
