// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Places to look for leaks at, and which of them a ball holds.

#include <array>
#include <cstdint>
#include <vector>

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
        std::array<std::uint32_t, deepest> waiting{};
        std::size_t count = nodes_.empty() ? 0 : 1;
        while (count > 0) {
            const std::uint32_t at = waiting[--count];
            const Node& node = nodes_[at];
            if (squared_distance(center, node.box.clamped(center)) >= radius * radius) {
                continue;
            }
            if (node.right != 0) {
                waiting[count++] = node.right;
                waiting[count++] = at + 1;
                continue;
            }
            for (std::uint32_t i = node.begin; i < node.end; ++i) {
                if (retired_[i] == 0 && squared_distance(probes_[i].place, center) < radius * radius &&
                    test(probes_[i])) {
                    return true;
                }
            }
        }
        return false;
    }

    /// Those in the ball are out of the question from now on.
    void retire_within(const Vec3& center, double radius);

  private:
    static constexpr std::size_t deepest = 64;  // more than a tree of halves
    struct Node {
        Box3 box;
        std::uint32_t begin = 0;
        std::uint32_t end = 0;
        std::uint32_t right = 0;  ///< the second child; the first follows at once; 0: a leaf
    };
    void split(std::uint32_t begin, std::uint32_t end);

    std::vector<LeakProbe> probes_;
    std::vector<char> retired_;
    std::vector<Node> nodes_;
};

}  // namespace terratet
