// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Which voxels of a block lie in a tetrahedron, row by row. Coordinates are voxel indices
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
    std::array<int, 3> hi{-1, -1, -1};

    [[nodiscard]] bool empty() const { return lo[0] > hi[0] || lo[1] > hi[1] || lo[2] > hi[2]; }
};

namespace detail {

/// A bound linear in the coordinates before it: on z at (x,y), a·x + b·y + c; on y at x, a·x + c.
struct Slope {
    double a, b, c;
};

/// Up to six bounds from one side.
struct Slopes {
    std::array<Slope, 6> slope;
    std::size_t count = 0;
    void add(const Slope& s) { slope[count++] = s; }
};

/// ⌈v⌉ and ⌊v⌋ for 0 ≤ v < 2³¹, inline on machines without SSE 4 too.
inline int ceil_of(double v) {
    const int i = static_cast<int>(v);
    return i + (static_cast<double>(i) < v ? 1 : 0);
}
inline int floor_of(double v) {
    return static_cast<int>(v);
}

inline double norm1(const Vec3& v) {
    return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
}

/// The voxels first…last of 0…size−1 that four coordinates enclose; false when there is none.
inline bool voxels_between(double a, double b, double c, double d, int size, int& first, int& last) {
    const double lo = std::min(std::min(a, b), std::min(c, d)) - scan_tolerance;
    const double hi = std::max(std::max(a, b), std::max(c, d)) + scan_tolerance;
    first = ceil_of(std::clamp(lo, 0.0, static_cast<double>(size)));
    last = floor_of(std::clamp(hi, -1.0, static_cast<double>(size - 1)) + 1) - 1;
    return first <= last;
}

/// What bounds the rows of a cell.
struct Bounds {
    Slopes below, above;  ///< of z along a row
    Slopes front, back;   ///< of y at an x: the cell's outline seen along z
};

/// A facet parallel to z, p·x + q·y + r ≥ 0, bounds y, or x if it is parallel to y as well.
inline void add_wall(double p, double q, double r, Bounds& bounds, ScanCell& cell) {
    if (std::abs(q) > 1e-14 * std::abs(p)) {
        (q > 0 ? bounds.front : bounds.back).add({-p / q, 0, -r / q});
    } else if (p > 0) {
        cell.lo[0] = std::max(cell.lo[0], ceil_of(std::clamp(-r / p, 0.0, cell.hi[0] + 1.0)));
    } else {
        cell.hi[0] = std::min(cell.hi[0], floor_of(std::clamp(-r / p, -1.0, double(cell.hi[0])) + 1) - 1);
    }
}

/// Below an edge between a lower and an upper facet no row can hold a voxel: narrows y, generously, as rows decide for
/// themselves.
inline void add_outline(const Slope& lower, const Slope& upper, Bounds& bounds) {
    const double db = upper.b - lower.b;
    const double size = std::abs(lower.a) + std::abs(upper.a) + std::abs(lower.b) + std::abs(upper.b);
    const double inverse = 1 / db;
    const double margin = 1e-12 * (64 * size + std::abs(lower.c) + std::abs(upper.c)) * std::abs(inverse);
    if (!(margin < 0.5)) {
        return;  // nearly parallel: says nothing about y
    }
    const double a = (lower.a - upper.a) * inverse;
    const double c = (lower.c - upper.c) * inverse;
    if (db > 0) {
        bounds.front.add({a, 0, c - margin});
    } else {
        bounds.back.add({a, 0, c + margin});
    }
}

template <std::size_t Below, std::size_t Above, class Row>
void scan_rows(const ScanCell& cell, const Bounds& bounds, Row&& row) {
    const double z_lo = cell.lo[2];
    const double z_hi = cell.hi[2];
    for (int x = cell.lo[0]; x <= cell.hi[0]; ++x) {
        double y_lo = cell.lo[1];
        double y_hi = cell.hi[1];
        for (std::size_t k = 0; k < bounds.front.count; ++k) {
            y_lo = std::max(y_lo, bounds.front.slope[k].a * x + bounds.front.slope[k].c);
        }
        for (std::size_t k = 0; k < bounds.back.count; ++k) {
            y_hi = std::min(y_hi, bounds.back.slope[k].a * x + bounds.back.slope[k].c);
        }
        if (y_lo > y_hi) {
            continue;
        }
        std::array<double, Below> lower;
        std::array<double, Above> upper;
        for (std::size_t k = 0; k < Below; ++k) {
            lower[k] = bounds.below.slope[k].a * x + bounds.below.slope[k].c;
        }
        for (std::size_t k = 0; k < Above; ++k) {
            upper[k] = bounds.above.slope[k].a * x + bounds.above.slope[k].c;
        }
        const int last = floor_of(y_hi);
        for (int y = ceil_of(y_lo); y <= last; ++y) {
            double lo = z_lo;
            double hi = z_hi;
            for (std::size_t k = 0; k < Below; ++k) {
                lo = std::max(lo, lower[k] + bounds.below.slope[k].b * y);
            }
            for (std::size_t k = 0; k < Above; ++k) {
                hi = std::min(hi, upper[k] + bounds.above.slope[k].b * y);
            }
            if (lo <= hi) {
                const int za = ceil_of(lo);
                const int zb = floor_of(hi);
                if (za <= zb) {
                    row(x, y, za, zb);
                }
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
        if (!detail::voxels_between(corner[0][axis], corner[1][axis], corner[2][axis], corner[3][axis], size[k],
                                    cell.lo[k], cell.hi[k])) {
            return cell;
        }
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
void scan(ScanCell cell, Row&& row) {
    detail::Bounds bounds;
    for (std::size_t k = 0; k < 4; ++k) {
        // Facets opposite corners 0 and 2 turn the other way than those opposite 1 and 3.
        const Vec3& n = cell.normal[k];
        const Vec3& anchor = cell.corner[k == 0 ? 1 : 0];
        const bool inwards = (cell.determinant > 0) == (k % 2 == 1);
        const double slack = scan_tolerance * detail::norm1(n);
        if (std::abs(n.z) <= 1e-14 * detail::norm1(n)) {
            const double sign = inwards ? 1 : -1;
            detail::add_wall(sign * n.x, sign * n.y, slack - sign * (n.x * anchor.x + n.y * anchor.y), bounds, cell);
            continue;
        }
        const double inverse = 1 / n.z;
        const double a = -n.x * inverse;
        const double b = -n.y * inverse;
        const double c = anchor.z - a * anchor.x - b * anchor.y;
        const double widening = slack * std::abs(inverse);
        if (inwards == (n.z > 0)) {
            bounds.below.add({a, b, c - widening});
        } else {
            bounds.above.add({a, b, c + widening});
        }
    }
    for (std::size_t i = 0; i < bounds.below.count; ++i) {
        for (std::size_t j = 0; j < bounds.above.count; ++j) {
            detail::add_outline(bounds.below.slope[i], bounds.above.slope[j], bounds);
        }
    }
    if (bounds.below.count == 2 && bounds.above.count == 2) {
        detail::scan_rows<2, 2>(cell, bounds, row);
    } else if (bounds.below.count == 1 && bounds.above.count == 3) {
        detail::scan_rows<1, 3>(cell, bounds, row);
    } else if (bounds.below.count == 3 && bounds.above.count == 1) {
        detail::scan_rows<3, 1>(cell, bounds, row);
    } else {  // walls leave fewer bounds on z
        constexpr double none = 1e300;
        while (bounds.below.count < 3) {
            bounds.below.add({0, 0, -none});
        }
        while (bounds.above.count < 3) {
            bounds.above.add({0, 0, none});
        }
        detail::scan_rows<3, 3>(cell, bounds, row);
    }
}

}  // namespace terratet
