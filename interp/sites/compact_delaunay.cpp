// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/sites/compact_delaunay.hpp"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Delaunay_triangulation_cell_base_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "interp/base/morton.hpp"
#include "tess/base/circumsphere.hpp"

namespace terratet {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_3<std::int32_t, Kernel>;
using CellBase =
    CGAL::Triangulation_cell_base_with_info_3<std::int32_t, Kernel, CGAL::Delaunay_triangulation_cell_base_3<Kernel>>;
using Delaunay = CGAL::Delaunay_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<VertexBase, CellBase>>;

// Half the side of the ghosts' cube, in diagonals of the sites' box; the box takes up 0.5 at most. Farther, and places
// outside the hull have more neighbours (on planes in proportion); nearer, and more places inside see a ghost.
constexpr double ghost_distance = 0.6;
constexpr std::size_t sites_per_bin = 4;

Kernel::Point_3 exact(const Vec3& p) {
    return {p.x, p.y, p.z};
}

struct OrderedCell {
    std::uint64_t code;
    std::array<std::int32_t, 4> vertex;
    Delaunay::Cell_handle cell;
};

/// Ascending by their sites' numbers, but for the last two where that would turn the cell inside out: an order that
/// does not depend on how the tessellation was made.
std::array<int, 4> order_of_corners(Delaunay::Cell_handle cell) {
    std::array<int, 4> order{0, 1, 2, 3};
    bool odd = false;
    for (std::size_t i = 1; i < 4; ++i) {
        for (std::size_t j = i; j > 0 && cell->vertex(order[j])->info() < cell->vertex(order[j - 1])->info(); --j) {
            std::swap(order[j], order[j - 1]);
            odd = !odd;
        }
    }
    if (odd) {
        std::swap(order[2], order[3]);
    }
    return order;
}

/// Sign of det(a − q, b − q, c − q), for a, b, c already relative to q.
int side(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& q, const Vec3& full_a, const Vec3& full_b,
         const Vec3& full_c) {
    const double det = dot(a, cross(b, c));
    const double mx = std::max({std::abs(a.x), std::abs(b.x), std::abs(c.x)});
    const double my = std::max({std::abs(a.y), std::abs(b.y), std::abs(c.y)});
    const double mz = std::max({std::abs(a.z), std::abs(b.z), std::abs(c.z)});
    const double error = 1e-14 * (mx * my * mz);  // twice Shewchuk's bound; below 1e-290 products may underflow
    if (std::abs(det) > error && error > 1e-290) [[likely]] {
        return det > 0 ? 1 : -1;
    }
    return CGAL::orientation(exact(q), exact(full_a), exact(full_b), exact(full_c));
}

}  // namespace

CompactDelaunay::CompactDelaunay(std::span<const Vec3> sites) {
    assert(!sites.empty());
    points_.assign(sites.begin(), sites.end());
    box_ = bounding_box(sites);
    // Of sites that differ in their last bits the ghosts still have to stand apart from them.
    const Vec3 farthest{std::max(std::abs(box_.lo.x), std::abs(box_.hi.x)),
                        std::max(std::abs(box_.lo.y), std::abs(box_.hi.y)),
                        std::max(std::abs(box_.lo.z), std::abs(box_.hi.z))};
    const double rounding = 64 * std::numeric_limits<double>::epsilon() * length(farthest);
    const double diagonal = box_.diagonal() > 0 ? std::max(box_.diagonal(), rounding) : 1;
    const Vec3 half = ghost_distance * Vec3{diagonal, diagonal, diagonal};
    cube_ = {box_.center() - half, box_.center() + half};
    for (int corner = 0; corner < ghost_count; ++corner) {
        points_.push_back({(corner & 1 ? cube_.hi : cube_.lo).x, (corner & 2 ? cube_.hi : cube_.lo).y,
                           (corner & 4 ? cube_.hi : cube_.lo).z});
    }
    copy_tessellation();
    fill_starts();
}

CompactDelaunay::~CompactDelaunay() = default;

void CompactDelaunay::copy_tessellation() {
    std::vector<std::pair<Kernel::Point_3, std::int32_t>> numbered;
    numbered.reserve(points_.size());
    for (std::size_t i = 0; i < points_.size(); ++i) {
        numbered.emplace_back(exact(points_[i]), static_cast<std::int32_t>(i));
    }
    const Delaunay delaunay(numbered.begin(), numbered.end());
    assert(delaunay.number_of_vertices() == points_.size() && "sites must be distinct");

    const auto corners = [this](const std::array<std::int32_t, 4>& vertex) {
        std::array<Vec3, 4> p;
        for (std::size_t k = 0; k < 4; ++k) {
            p[k] = points_[static_cast<std::size_t>(vertex[k])];
        }
        return p;
    };

    const MortonCode code(cube_);
    std::vector<OrderedCell> ordered;
    ordered.reserve(delaunay.number_of_finite_cells());
    for (const auto cell : delaunay.finite_cell_handles()) {
        OrderedCell next{0, {}, cell};
        const auto order = order_of_corners(cell);
        for (std::size_t k = 0; k < 4; ++k) {
            next.vertex[k] = cell->vertex(order[k])->info();
        }
        const auto p = corners(next.vertex);
        next.code = code(0.25 * (p[0] + p[1] + p[2] + p[3]));
        ordered.push_back(next);
    }
    std::sort(ordered.begin(), ordered.end(), [](const OrderedCell& a, const OrderedCell& b) {
        return a.code != b.code ? a.code < b.code : a.vertex < b.vertex;
    });
    for (const auto cell : delaunay.all_cell_handles()) {
        cell->info() = -1;
    }
    for (std::size_t i = 0; i < ordered.size(); ++i) {
        ordered[i].cell->info() = static_cast<std::int32_t>(i);
    }

    cells_.resize(ordered.size());
    parts_.resize(ordered.size());
    tbb::parallel_for(std::size_t(0), ordered.size(), [&](std::size_t i) {
        Cell& cell = cells_[i];
        const auto order = order_of_corners(ordered[i].cell);
        cell.vertex = ordered[i].vertex;
        for (std::size_t k = 0; k < 4; ++k) {
            cell.neighbour[k] = ordered[i].cell->neighbor(order[k])->info();
        }
        const auto sphere = certified_circumsphere(corners(cell.vertex), relative_center_error);
        cell.center = sphere.center;
        cell.squared_radius = sphere.certified ? sphere.squared_radius : std::numeric_limits<double>::quiet_NaN();
    });
    tbb::parallel_for(std::size_t(0), ordered.size(), [&](std::size_t i) {
        const auto split_of = [&](std::size_t k) {
            return cells_[static_cast<std::size_t>(split(static_cast<std::int32_t>(i), k))].center;
        };
        parts_[i].of_vertex = cell_parts<Vec3, double>(corners(ordered[i].vertex), cells_[i].center,
                                                       {split_of(0), split_of(1), split_of(2), split_of(3)});
    });
}

void CompactDelaunay::fill_starts() {
    const Vec3 size = box_.size();
    const double longest = std::max({size.x, size.y, size.z});
    const auto wanted = static_cast<double>(1 + points_.size() / sites_per_bin);
    // Cubic bins, smaller where the box is flat or thin, as there is but one layer of them.
    double edge = longest > 0 ? longest / std::cbrt(wanted) : 1;
    const auto along = [&](double extent) { return std::max(1.0, std::ceil(extent / edge)); };
    for (int i = 0; i < 40 && along(size.x) * along(size.y) * along(size.z) < wanted / 2; ++i) {
        edge *= 0.7;
    }
    bins_ = {static_cast<std::int32_t>(along(size.x)), static_cast<std::int32_t>(along(size.y)),
             static_cast<std::int32_t>(along(size.z))};

    starts_.assign(
        static_cast<std::size_t>(bins_[0]) * static_cast<std::size_t>(bins_[1]) * static_cast<std::size_t>(bins_[2]),
        0);
    const auto center = [&](std::int32_t i, int axis) {
        return box_.lo[axis] + (i + 0.5) * size[axis] / bins_[static_cast<std::size_t>(axis)];
    };
    // Boustrophedon, so that each walk starts next door.
    std::int32_t cell = 0;
    std::size_t line = 0;
    for (std::int32_t i = 0; i < bins_[0]; ++i) {
        for (std::int32_t jj = 0; jj < bins_[1]; ++jj, ++line) {
            const std::int32_t j = i % 2 ? bins_[1] - 1 - jj : jj;
            for (std::int32_t kk = 0; kk < bins_[2]; ++kk) {
                const std::int32_t k = line % 2 ? bins_[2] - 1 - kk : kk;
                const Vec3 q{center(i, 0), center(j, 1), center(k, 2)};
                cell = locate(q, cell).cell;
                starts_[bin(q)] = cell;
            }
        }
    }
}

std::size_t CompactDelaunay::bin(const Vec3& q) const {
    std::size_t index = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const std::int32_t n = bins_[static_cast<std::size_t>(axis)];
        const double extent = box_.hi[axis] - box_.lo[axis];
        const double at = extent > 0 ? (q[axis] - box_.lo[axis]) / extent * n : 0;
        // In this order 0 for what is no number.
        index = index * static_cast<std::size_t>(n) + static_cast<std::size_t>(std::min(std::max(0.0, at), n - 1.0));
    }
    return index;
}

CompactDelaunay::Location CompactDelaunay::locate(const Vec3& q, std::int32_t start) const {
    assert(within_reach(q));
    std::int32_t here = start;
    std::int32_t previous = -1;
    for (;;) {
        const Cell& cell = cells_[static_cast<std::size_t>(here)];
        std::array<const Vec3*, 4> full;
        std::array<Vec3, 4> p;
        for (std::size_t k = 0; k < 4; ++k) {
            full[k] = &points_[static_cast<std::size_t>(cell.vertex[k])];
            p[k] = *full[k] - q;
        }
        std::int32_t next = -1;
        bool strictly_inside = true;
        for (std::size_t k = 0; k < 4; ++k) {
            // q is strictly inside of the facet the walk came through, and of the cube.
            if (cell.neighbour[k] < 0 || cell.neighbour[k] == previous) {
                continue;
            }
            const auto a = static_cast<std::size_t>(facet_corners[k][0]);
            const auto b = static_cast<std::size_t>(facet_corners[k][1]);
            const auto c = static_cast<std::size_t>(facet_corners[k][2]);
            const int sign = side(p[a], p[b], p[c], q, *full[a], *full[b], *full[c]);
            if (sign < 0) {
                next = cell.neighbour[k];
                break;
            }
            strictly_inside &= sign > 0;
        }
        if (next < 0) {
            return {here, strictly_inside};
        }
        previous = here;
        here = next;
    }
}

bool CompactDelaunay::contains(const Cell& cell, const Vec3& q) const {
    for (const auto& facet : facet_corners) {
        const auto p = [&](std::size_t i) -> const Vec3& {
            return points_[static_cast<std::size_t>(cell.vertex[static_cast<std::size_t>(facet[i])])];
        };
        if (side(p(0) - q, p(1) - q, p(2) - q, q, p(0), p(1), p(2)) < 0) {
            return false;
        }
    }
    return true;
}

const SphereTree& CompactDelaunay::sphere_tree() const {
    std::call_once(tree_wanted_, [this] { tree_ = std::make_unique<const SphereTree>(*this); });
    return *tree_;
}

std::size_t CompactDelaunay::memory_bytes() const {
    return sizeof(*this) + points_.capacity() * sizeof(Vec3) + cells_.capacity() * sizeof(Cell) +
           parts_.capacity() * sizeof(Parts) + starts_.capacity() * sizeof(std::int32_t) +
           (tree_ ? tree_->memory_bytes() : 0);
}

}  // namespace terratet
