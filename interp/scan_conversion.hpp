// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Private to resampling: which voxels of a block lie in a tetrahedron, row by row. Coordinates are voxel indices
/// relative to the block's first voxel, so voxel (x,y,z) has its centre at (x,y,z).
///
/// A facet's plane is computed from its three vertices in the order of their indices, so the two cells that share it
/// see the same numbers, bit for bit, and no voxel falls between them. Where more than two cells meet, at edges and
/// vertices, rounding could still leave a voxel out; so each plane is moved outwards by scan_tolerance, and a voxel
/// that near to several cells is claimed by all of them.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "tess/geometry.hpp"

namespace terratet {

/// In voxels, outwards from each facet's plane (in the 1-norm of its unit normal: at most √3 times this). Rounding is
/// about 1e-16 times the larger of the cell and the block.
inline constexpr double scan_tolerance = 1e-9;

/// A tetrahedron thinner than this (in voxels) is no cell to sample: its linear function is noise, and its neighbours'
/// tolerance covers it.
inline constexpr double thinnest_cell = 1e-10;

/// A tetrahedron with its corners in ascending order of vertex index.
struct ScanCell {
    std::array<Vec3, 4> corner;
    std::array<Vec3, 4> normal;  ///< of the facet opposite corner k, from its corners in order
    double determinant = 0;      ///< six times the signed volume
    std::array<int, 3> lo{};     ///< voxels within its bounding box and the block
    std::array<int, 3> hi{};

    [[nodiscard]] bool empty() const { return lo[0] > hi[0] || lo[1] > hi[1] || lo[2] > hi[2]; }
};

namespace detail {

/// Bounds on z along a row (x,y): z ≥ or ≤ a·x + b·y + c.
struct Slope {
    double a, b, c;
};

inline double norm1(const Vec3& v) {
    return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
}

/// The voxels of [lo,hi] on one axis that lie between the corners' extremes.
inline void voxel_range(const std::array<Vec3, 4>& corner, int axis, int size, int& lo, int& hi) {
    const double a = std::min(std::min(corner[0][axis], corner[1][axis]), std::min(corner[2][axis], corner[3][axis]));
    const double b = std::max(std::max(corner[0][axis], corner[1][axis]), std::max(corner[2][axis], corner[3][axis]));
    const double last = static_cast<double>(size - 1);
    lo = static_cast<int>(std::ceil(std::clamp(a - scan_tolerance, 0.0, last + 1)));
    hi = static_cast<int>(std::floor(std::clamp(b + scan_tolerance, -1.0, last)));
}

/// Half-planes over (x,y) from facets parallel to z: p·x + q·y + r ≥ 0.
struct Walls {
    std::array<Vec3, 4> wall;  ///< (p, q, r)
    int count = 0;

    /// Narrows [ya,yb] to what the walls leave of it at x.
    void narrow(int x, int& ya, int& yb) const {
        for (int w = 0; w < count; ++w) {
            const auto& [p, q, r] = wall[static_cast<std::size_t>(w)];
            const double rest = p * x + r;
            if (q > 0) {
                const double bound = -rest / q;
                ya = bound > yb ? yb + 1 : bound > ya ? static_cast<int>(std::ceil(bound)) : ya;
            } else if (q < 0) {
                const double bound = -rest / q;
                yb = bound < ya ? ya - 1 : bound < yb ? static_cast<int>(std::floor(bound)) : yb;
            } else if (rest < 0) {
                yb = ya - 1;
            }
        }
    }
};

template <int Below, int Above, class Row>
void scan_rows(const ScanCell& cell, const std::array<Slope, 4>& below, const std::array<Slope, 4>& above,
               const Walls& walls, Row&& row) {
    const double z_lo = cell.lo[2];
    const double z_hi = cell.hi[2];
    for (int x = cell.lo[0]; x <= cell.hi[0]; ++x) {
        int ya = cell.lo[1];
        int yb = cell.hi[1];
        walls.narrow(x, ya, yb);
        std::array<double, static_cast<std::size_t>(Below)> lower;
        std::array<double, static_cast<std::size_t>(Above)> upper;
        for (std::size_t k = 0; k < lower.size(); ++k) {
            lower[k] = below[k].a * x + below[k].c;
        }
        for (std::size_t k = 0; k < upper.size(); ++k) {
            upper[k] = above[k].a * x + above[k].c;
        }
        for (int y = ya; y <= yb; ++y) {
            double lo = z_lo;
            double hi = z_hi;
            for (std::size_t k = 0; k < lower.size(); ++k) {
                const double z = lower[k] + below[k].b * y;
                lo = z > lo ? z : lo;
            }
            for (std::size_t k = 0; k < upper.size(); ++k) {
                const double z = upper[k] + above[k].b * y;
                hi = z < hi ? z : hi;
            }
            if (lo > hi) {
                continue;
            }
            // Both are in [0, size): truncation is the floor, and needs no call on machines without SSE 4.
            int za = static_cast<int>(lo);
            za += static_cast<double>(za) < lo ? 1 : 0;
            const int zb = static_cast<int>(hi);
            if (za <= zb) {
                row(x, y, za, zb);
            }
        }
    }
}

}  // namespace detail

/// Geometry of a cell relative to a block of the given size. `corner` in ascending order of vertex index.
/// Empty if it holds no voxel or is too thin.
inline ScanCell make_scan_cell(const std::array<Vec3, 4>& corner, const std::array<int, 3>& size) {
    ScanCell cell;
    cell.corner = corner;
    for (int axis = 0; axis < 3; ++axis) {
        const auto k = static_cast<std::size_t>(axis);
        detail::voxel_range(corner, axis, size[k], cell.lo[k], cell.hi[k]);
    }
    if (cell.empty()) {
        return cell;
    }
    const Vec3 e1 = corner[1] - corner[0];
    const Vec3 e2 = corner[2] - corner[0];
    const Vec3 e3 = corner[3] - corner[0];
    cell.normal = {cross(corner[2] - corner[1], corner[3] - corner[1]), cross(e2, e3), cross(e1, e3), cross(e1, e2)};
    cell.determinant = dot(cell.normal[3], e3);
    double widest = 0;
    for (const Vec3& n : cell.normal) {
        widest = std::max(widest, detail::norm1(n));
    }
    if (!(std::abs(cell.determinant) > thinnest_cell * widest)) {
        cell.hi[0] = cell.lo[0] - 1;
    }
    return cell;
}

/// Calls row(x, y, za, zb) for each row of voxels (x, y, za…zb) in the cell, x and y ascending.
/// \pre cell is not empty.
template <class Row>
void scan(const ScanCell& cell, Row&& row) {
    constexpr double unbounded = 1e300;
    std::array<detail::Slope, 4> below;
    std::array<detail::Slope, 4> above;
    below.fill({0, 0, -unbounded});
    above.fill({0, 0, unbounded});
    detail::Walls walls;
    std::size_t n_below = 0;
    std::size_t n_above = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        // Facets opposite corners 0 and 2 turn the other way than those opposite 1 and 3.
        const Vec3& n = cell.normal[k];
        const Vec3& anchor = cell.corner[k == 0 ? 1 : 0];
        const bool inwards = (cell.determinant > 0) == (k % 2 == 1);
        const double slack = scan_tolerance * detail::norm1(n);
        if (std::abs(n.z) <= 1e-14 * detail::norm1(n)) {
            const double sign = inwards ? 1 : -1;
            walls.wall[static_cast<std::size_t>(walls.count++)] = {sign * n.x, sign * n.y,
                                                                   slack - sign * (n.x * anchor.x + n.y * anchor.y)};
            continue;
        }
        const double inverse = 1 / n.z;
        const double a = -n.x * inverse;
        const double b = -n.y * inverse;
        const double c = anchor.z - a * anchor.x - b * anchor.y;
        const double widening = slack * std::abs(inverse);
        if (inwards == (n.z > 0)) {
            below[n_below++] = {a, b, c - widening};
        } else {
            above[n_above++] = {a, b, c + widening};
        }
    }
    if (n_below == 2 && n_above == 2) {
        detail::scan_rows<2, 2>(cell, below, above, walls, row);
    } else if (n_below == 1 && n_above == 3) {
        detail::scan_rows<1, 3>(cell, below, above, walls, row);
    } else if (n_below == 3 && n_above == 1) {
        detail::scan_rows<3, 1>(cell, below, above, walls, row);
    } else {
        detail::scan_rows<3, 3>(cell, below, above, walls, row);  // with walls: up to three on either side
    }
}

}  // namespace terratet
