// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/barrier/seeds/leak_probes.hpp"

#include <algorithm>

namespace terratet {
namespace {

constexpr std::uint32_t leaf_size = 6;

}  // namespace

LeakProbes::LeakProbes(std::vector<LeakProbe> probes) : probes_(std::move(probes)), retired_(probes_.size(), 0) {
    if (!probes_.empty()) {
        split(0, static_cast<std::uint32_t>(probes_.size()));
    }
}

void LeakProbes::split(std::uint32_t begin, std::uint32_t end) {
    const auto here = nodes_.size();
    Node node{{}, begin, end, 0};
    for (std::uint32_t i = begin; i < end; ++i) {
        node.box.extend(probes_[i].place);
    }
    nodes_.push_back(node);
    if (end - begin <= leaf_size) {
        return;
    }
    const Vec3 size = node.box.size();
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::uint32_t middle = begin + (end - begin) / 2;
    std::nth_element(probes_.begin() + begin, probes_.begin() + middle, probes_.begin() + end,
                     [&](const LeakProbe& a, const LeakProbe& b) { return a.place[axis] < b.place[axis]; });
    split(begin, middle);
    nodes_[here].right = static_cast<std::uint32_t>(nodes_.size());
    split(middle, end);
}

void LeakProbes::retire_within(const Vec3& center, double radius) {
    static_cast<void>(any_within(center, radius, [&](const LeakProbe& probe) {
        retired_[static_cast<std::size_t>(&probe - probes_.data())] = 1;
        return false;
    }));
}

}  // namespace terratet
