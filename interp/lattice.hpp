// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// A regular lattice of voxels. Index (i,j,k) is a voxel's centre.

#include <array>
#include <cstdint>

#include "tess/frame.hpp"
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

/// No lattice has more voxels along an axis, nor more in all than most_voxels.
inline constexpr std::int64_t most_voxels_along = 1'000'000'000;
inline constexpr std::int64_t most_voxels = 1'000'000'000'000;

/// Voxels of the given size, in map coordinates, that together cover the box (frame-local): their edges are multiples
/// of the size in map coordinates. Throws UsageError as lattice_over does.
Lattice aligned_lattice(const Box3& box, const Frame& frame, const Vec3& voxel_size,
                        std::int64_t max_voxels = most_voxels);

/// Voxels of the given size that together cover the box, centred on it. Throws UsageError when a size is not positive
/// or the lattice would have more than `max_voxels`, naming a size that fits.
Lattice lattice_over(const Box3& box, const Vec3& voxel_size, std::int64_t max_voxels = 2'000'000'000);

}  // namespace terratet
