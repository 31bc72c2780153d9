// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/conformity.hpp"
#include "tess/base/tetrahedron.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <cmath>

namespace terratet {
namespace {

constexpr std::size_t listed = 20;  ///< places of offenders

/// One cell's side of a facet.
template <class Key>
struct Side {
    std::array<Key, 3> key;  ///< sorted
    std::uint32_t cell = 0;
    std::uint32_t facet = 0;
    bool odd = false;  ///< the outward order is an odd permutation of the key
};

template <class Key>
Side<Key> side_of(std::array<Key, 3> corners, std::uint32_t cell, std::uint32_t facet) {
    bool odd = false;
    for (const auto& [i, j] : {std::pair{0U, 1U}, {1U, 2U}, {0U, 1U}}) {
        if (corners[j] < corners[i]) {
            std::swap(corners[i], corners[j]);
            odd = !odd;
        }
    }
    return {corners, cell, facet, odd};
}

/// Calls visit(begin, end) for each run of equal keys.
template <class Key, class Visit>
void for_each_facet(std::vector<Side<Key>>& sides, Visit&& visit) {
    std::ranges::sort(sides, [](const auto& a, const auto& b) {
        return std::tie(a.key, a.cell, a.facet) < std::tie(b.key, b.cell, b.facet);
    });
    for (auto begin = sides.begin(); begin != sides.end();) {
        const auto end = std::find_if(begin, sides.end(), [&](const auto& s) { return s.key != begin->key; });
        visit(begin, end);
        begin = end;
    }
}

/// Exactly: the computed volume of a sliver may be 0, or below.
bool is_positive(const TetMesh& mesh, const std::array<std::uint32_t, 4>& cell) {
    const auto point = [&](std::size_t k) {
        const Vec3& p = mesh.points[cell[k]];
        return CGAL::Exact_predicates_inexact_constructions_kernel::Point_3(p.x, p.y, p.z);
    };
    return CGAL::orientation(point(0), point(1), point(2), point(3)) == CGAL::POSITIVE;
}

bool on_face(const Box3& box, const std::array<Vec3, 3>& corners) {
    for (int axis = 0; axis < 3; ++axis) {
        for (const double at : {box.lo[axis], box.hi[axis]}) {
            if (std::ranges::all_of(corners, [&](const Vec3& p) { return p[axis] == at; })) {
                return true;
            }
        }
    }
    return false;
}

}  // namespace

Conformity check_conformity(const TetMesh& mesh, std::span<const std::int32_t> region, const Box3& hull) {
    Conformity result;
    const auto offends = [&](std::size_t& count, std::uint32_t cell) {
        ++count;
        if (result.places.size() < listed) {
            const auto& v = mesh.cells[cell];
            result.places.push_back(0.25 *
                                    (mesh.points[v[0]] + mesh.points[v[1]] + mesh.points[v[2]] + mesh.points[v[3]]));
        }
    };

    std::vector<Side<std::uint32_t>> sides;
    sides.reserve(4 * mesh.cells.size());
    for (std::uint32_t c = 0; c < mesh.cells.size(); ++c) {
        const auto& v = mesh.cells[c];
        const Vec3& a = mesh.points[v[0]];
        const double volume = dot(cross(mesh.points[v[1]] - a, mesh.points[v[2]] - a), mesh.points[v[3]] - a) / 6;
        result.volume += volume;
        if (!is_positive(mesh, v)) {
            offends(result.not_positive, c);
        }
        for (std::uint32_t k = 0; k < 4; ++k) {
            const auto& o = facet_corners[k];
            sides.push_back(side_of(Triangle{v[o[0]], v[o[1]], v[o[2]]}, c, k));
        }
    }
    result.volume_error = std::abs(result.volume - hull.volume()) / hull.volume();

    std::vector<Side<Vec3>> single;
    for_each_facet(sides, [&](auto begin, auto end) {
        if (end - begin == 1) {
            const auto& v = mesh.cells[begin->cell];
            const auto& o = facet_corners[begin->facet];
            single.push_back(
                side_of(std::array<Vec3, 3>{mesh.points[v[o[0]]], mesh.points[v[o[1]]], mesh.points[v[o[2]]]},
                        begin->cell, begin->facet));
        } else if (end - begin > 2 || begin->odd == (begin + 1)->odd) {
            offends(result.overlapping, begin->cell);
        } else {
            ++result.interior_facets;
            const std::int32_t here = region[begin->cell];
            const std::int32_t there = region[(begin + 1)->cell];
            if (here >= 0 && there >= 0 && here != there) {
                offends(result.leaking, begin->cell);
            }
        }
    });
    for_each_facet(single, [&](auto begin, auto end) {
        if (end - begin == 2 && begin->odd != (begin + 1)->odd) {
            ++result.mirrored_facets;
        } else if (end - begin == 1 && on_face(hull, begin->key)) {
            ++result.boundary_facets;
        } else {
            offends(result.unmatched, begin->cell);
        }
    });
    return result;
}

}  // namespace terratet
