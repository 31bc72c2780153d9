// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// A regular lattice of voxels. Index (i,j,k) is a voxel's centre.

#include <array>
#include <cstdint>

#include "tess/geometry.hpp"

namespace terratet {

struct Lattice {
    Vec3 origin;                         ///< centre of voxel (0,0,0), frame-local
    Vec3 spacing;                        ///< positive
    std::array<std::int64_t, 3> size{};  ///< voxels along x, y, z

    [[nodiscard]] Vec3 center(std::int64_t i, std::int64_t j, std::int64_t k) const {
        return {origin.x + static_cast<double>(i) * spacing.x, origin.y + static_cast<double>(j) * spacing.y,
                origin.z + static_cast<double>(k) * spacing.z};
    }
    [[nodiscard]] std::int64_t count() const { return size[0] * size[1] * size[2]; }
};

/// Voxels of the given size that together cover the box, centred on it. Throws UsageError when a size is not positive
/// or the lattice would have more than `max_voxels`, naming a size that fits.
Lattice lattice_over(const Box3& box, const Vec3& voxel_size, std::int64_t max_voxels = 2'000'000'000);

}  // namespace terratet
