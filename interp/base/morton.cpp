// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/base/morton.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace terratet {
namespace {

constexpr double steps = (1 << 21) - 1;

/// Two zero bits after each of the lowest 21.
std::uint64_t spread(std::uint64_t x) {
    x = (x | x << 32) & 0x001f00000000ffffull;
    x = (x | x << 16) & 0x001f0000ff0000ffull;
    x = (x | x << 8) & 0x100f00f00f00f00full;
    x = (x | x << 4) & 0x10c30c30c30c30c3ull;
    return (x | x << 2) & 0x1249249249249249ull;
}

}  // namespace

MortonCode::MortonCode(const Box3& box) : lo_(box.lo) {
    const Vec3 size = box.size();
    const double longest = std::max({size.x, size.y, size.z});
    scale_ = longest > 0 && std::isfinite(longest) ? steps / longest : 0;
}

std::uint64_t MortonCode::operator()(const Vec3& p) const {
    const auto cell = [this](double x, double lo) {
        return spread(static_cast<std::uint64_t>(std::clamp((x - lo) * scale_, 0.0, steps)));
    };
    return cell(p.x, lo_.x) | cell(p.y, lo_.y) << 1 | cell(p.z, lo_.z) << 2;
}

std::vector<std::uint32_t> morton_order(std::span<const Vec3> places) {
    const MortonCode code(bounding_box(places));
    std::vector<std::pair<std::uint64_t, std::uint32_t>> keys(places.size());
    for (std::uint32_t i = 0; i < keys.size(); ++i) {
        keys[i] = {code(places[i]), i};
    }
    std::sort(keys.begin(), keys.end(), [&](const auto& a, const auto& b) {
        return a.first != b.first ? a.first < b.first : places[a.second] < places[b.second];
    });
    std::vector<std::uint32_t> order(keys.size());
    std::transform(keys.begin(), keys.end(), order.begin(), [](const auto& key) { return key.second; });
    return order;
}

}  // namespace terratet
