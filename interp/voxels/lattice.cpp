// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/lattice.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "tess/error.hpp"

namespace terratet {
namespace {

/// A box whose side is a whole number of voxels but for rounding gets that number, not one more.
constexpr double rounding = 1e-9;

std::string decimal(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
}

double voxels_along(double side, double voxel) {
    return std::max(1.0, std::ceil(side / voxel - rounding));
}

double voxels_in(const Vec3& side, const Vec3& voxel) {
    return voxels_along(side.x, voxel.x) * voxels_along(side.y, voxel.y) * voxels_along(side.z, voxel.z);
}

/// The given size scaled up until the lattice fits, as a number short enough to type.
Vec3 fitting_size(const Vec3& side, Vec3 voxel, double max_voxels) {
    while (voxels_in(side, voxel) > max_voxels) {
        const double factor = std::max(1.01, std::cbrt(voxels_in(side, voxel) / max_voxels));
        voxel = factor * voxel;
    }
    return (1 + 1e-5) * voxel;  // six digits are printed
}

/// Throws UsageError, naming a size that fits.
void require_lattice(const Box3& box, const Vec3& voxel_size, std::int64_t max_voxels) {
    for (int axis = 0; axis < 3; ++axis) {
        if (!(std::isfinite(voxel_size[axis]) && voxel_size[axis] > 0)) {
            throw UsageError("voxel size " + decimal(voxel_size[axis]) + " is not a positive length");
        }
    }
    if (box.empty()) {
        throw UsageError("there is no box to cover with voxels");
    }
    const Vec3 side = box.size();
    const double along = std::max({side.x / voxel_size.x, side.y / voxel_size.y, side.z / voxel_size.z});
    if (along > static_cast<double>(most_voxels_along)) {
        throw UsageError("a voxel size of " + decimal(voxel_size.x) + " × " + decimal(voxel_size.y) + " × " +
                         decimal(voxel_size.z) + " makes " + decimal(along) +
                         " voxels along an axis; larger ones are needed");
    }
    if (const double count = voxels_in(side, voxel_size); count > static_cast<double>(max_voxels)) {
        const Vec3 fits = fitting_size(side, voxel_size, static_cast<double>(max_voxels));
        throw UsageError("a voxel size of " + decimal(voxel_size.x) + " × " + decimal(voxel_size.y) + " × " +
                         decimal(voxel_size.z) + " makes " + decimal(count) + " voxels, more than " +
                         std::to_string(max_voxels) + "; " + decimal(fits.x) + " × " + decimal(fits.y) + " × " +
                         decimal(fits.z) + " or more fits");
    }
}

}  // namespace

Lattice aligned_lattice(const Box3& box, const Frame& frame, const Vec3& voxel_size, std::int64_t max_voxels) {
    const Box3 map{frame.to_world(box.lo), frame.to_world(box.hi)};
    require_lattice(box.empty() ? box : map, voxel_size, max_voxels);
    Lattice lattice;
    Vec3 first;
    for (int axis = 0; axis < 3; ++axis) {
        const double size = voxel_size[axis];
        const double lo = std::floor(map.lo[axis] / size + rounding);
        const double hi = std::max(lo + 1, std::ceil(map.hi[axis] / size - rounding));
        lattice.size[static_cast<std::size_t>(axis)] = static_cast<std::int64_t>(hi - lo);
        first[axis] = (lo + 0.5) * size;
    }
    lattice.origin = frame.to_local(first);
    lattice.spacing = frame.to_local_size(voxel_size);
    return lattice;
}

Lattice lattice_over(const Box3& box, const Vec3& voxel_size, std::int64_t max_voxels) {
    require_lattice(box, voxel_size, max_voxels);
    Lattice lattice;
    lattice.spacing = voxel_size;
    const Vec3 side = box.size();
    const Vec3 center = box.center();
    for (int axis = 0; axis < 3; ++axis) {
        const double voxels = voxels_along(side[axis], voxel_size[axis]);
        lattice.size[static_cast<std::size_t>(axis)] = static_cast<std::int64_t>(voxels);
        lattice.origin[axis] = center[axis] - 0.5 * (voxels - 1) * voxel_size[axis];
    }
    return lattice;
}

}  // namespace terratet
