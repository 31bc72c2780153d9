// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Geometric anisotropy: distances that count differently along three axes at right angles.

#include <array>

#include "tess/geometry.hpp"

namespace terratet {

/// The axes: the first points to `azimuth_deg` (clockwise from grid north, +y), `dip_deg` below the horizontal; the
/// second is at right angles to it, horizontal, then turned about it by `roll_deg`; the third completes them. By
/// default north, west and up. GSLIB's convention (Deutsch and Journel 1998, II.3), but that a positive dip points
/// down.
struct Anisotropy {
    double azimuth_deg = 0;
    double dip_deg = 0;
    double roll_deg = 0;
    double ratio2 = 1;  ///< range along the second axis over that along the first; above 0
    double ratio3 = 1;  ///< the same for the third

    [[nodiscard]] bool isotropic() const { return ratio2 == 1 && ratio3 == 1; }
};

/// The linear map into coordinates in which distances are as along the first axis.
class Metric {
  public:
    explicit Metric(const Anisotropy& anisotropy = {});

    /// Exactly p itself when isotropic.
    Vec3 operator()(const Vec3& p) const {
        return identity_ ? p : Vec3{dot(rows_[0], p), dot(rows_[1], p), dot(rows_[2], p)};
    }

  private:
    std::array<Vec3, 3> rows_;
    bool identity_;
};

}  // namespace terratet
