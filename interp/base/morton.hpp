// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Morton order: places that follow each other in it are near each other, so that walks between them are short and the
/// memory they touch is in the cache.

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "tess/geometry.hpp"

namespace terratet {

/// Codes of 21 bits an axis within a box; places outside take the code of its nearest place.
class MortonCode {
  public:
    explicit MortonCode(const Box3& box);
    [[nodiscard]] std::uint64_t operator()(const Vec3& p) const;

  private:
    Vec3 lo_;
    double scale_ = 0;
};

/// The permutation that puts distinct places into Morton order, ties by coordinates: the same sequence of places
/// whatever the order they come in. O(n log n).
std::vector<std::uint32_t> morton_order(std::span<const Vec3> places);

}  // namespace terratet
