// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/barrier/seeds/leak_probes.hpp"

namespace terratet {
namespace {

constexpr std::uint32_t leaf_size = 6;

}  // namespace

LeakProbes::LeakProbes(std::vector<LeakProbe> probes)
    : tree_(
          std::move(probes), leaf_size, [](auto& node, const LeakProbe& probe) { node.box.extend(probe.place); },
          [](const LeakProbe& probe, int axis) { return probe.place[axis]; }),
      retired_(tree_.items().size(), 0) {}

void LeakProbes::retire_within(const Vec3& center, double radius) {
    static_cast<void>(any_within(center, radius, [&](const LeakProbe& probe) {
        retired_[number_of(probe)] = 1;
        return false;
    }));
}

}  // namespace terratet
