// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The triangles of a fault complex as walls: what can be seen from where. Exact predicates.

#include <memory>
#include <optional>

#include "tess/barrier/complex/sheet_complex.hpp"

namespace terratet {

class SheetWall {
  public:
    explicit SheetWall(const SheetComplex& complex);
    ~SheetWall();
    SheetWall(const SheetWall&) = delete;
    SheetWall& operator=(const SheetWall&) = delete;

    /// Does the closed segment meet a triangle other than `except`? O(log n).
    [[nodiscard]] bool between(const Vec3& a, const Vec3& b, std::optional<std::uint32_t> except = {}) const;

    /// Distance from p to the nearest triangle of a surface other than `surface`, up to `limit`.
    [[nodiscard]] double distance_to_others(const Vec3& p, std::uint32_t surface, double limit) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace terratet
