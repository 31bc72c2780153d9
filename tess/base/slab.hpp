// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Two parallel planes with a surface between them. Sheets are rather flat: most segments pass beside their slab, and
/// of the others a short piece is in it.

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "tess/geometry.hpp"

namespace terratet {

class Slab {
  public:
    /// \param normal  0: any
    Slab(const Vec3& origin, const Vec3& normal) : origin_(origin) {
        const double scale = length(normal);
        normal_ = scale > 0 ? normal / scale : Vec3{0, 0, 1};
    }

    void extend(const Vec3& p) {
        const double height = dot(normal_, p - origin_);
        lo_ = std::min(lo_, height - rounding(p));
        hi_ = std::max(hi_, height + rounding(p));
    }

    [[nodiscard]] const Vec3& normal() const { return normal_; }

    /// The part of a segment that may be nearer to the slab than `margin`, with a little more; none when it is beside.
    [[nodiscard]] std::optional<std::pair<Vec3, Vec3>> piece(const Vec3& a, const Vec3& b, double margin = 0) const {
        const double slack = margin + rounding(a) + rounding(b);
        const double lo = lo_ - slack;
        const double hi = hi_ + slack;
        const double from = dot(normal_, a - origin_);
        const double to = dot(normal_, b - origin_);
        if (std::min(from, to) > hi || std::max(from, to) < lo) {
            return std::nullopt;
        }
        const double rise = to - from;
        if (std::abs(rise) <= hi - lo) {  // most of it is inside: not worth the cuts, and rounding would count
            return std::pair(a, b);
        }
        const double first = ((rise > 0 ? lo : hi) - from) / rise - share_more;
        const double last = ((rise > 0 ? hi : lo) - from) / rise + share_more;
        return std::pair(first > 0 ? a + first * (b - a) : a, last < 1 ? a + last * (b - a) : b);
    }

  private:
    static constexpr double share_more = 1e-9;  ///< of the segment: far above rounding

    /// More than the height of p may be off.
    [[nodiscard]] double rounding(const Vec3& p) const {
        return 1e-14 * (std::abs(p.x) + std::abs(p.y) + std::abs(p.z) + std::abs(origin_.x) + std::abs(origin_.y) +
                        std::abs(origin_.z));
    }

    Vec3 origin_;
    Vec3 normal_;
    double lo_ = std::numeric_limits<double>::infinity();
    double hi_ = -std::numeric_limits<double>::infinity();
};

}  // namespace terratet
