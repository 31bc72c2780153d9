// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/sites/compact_cells.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

namespace terratet {

bool CompactCells::in_conflict_exact(const Cell& cell, const Vec3& q) const {
    using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
    const auto exact = [](const Vec3& v) { return Point(v.x, v.y, v.z); };
    const auto p = [&](std::size_t k) { return exact(points_[static_cast<std::size_t>(cell.vertex[k])]); };
    return CGAL::side_of_oriented_sphere(p(0), p(1), p(2), p(3), exact(q)) == CGAL::ON_POSITIVE_SIDE;
}

}  // namespace terratet
