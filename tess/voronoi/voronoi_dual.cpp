// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/voronoi/voronoi_dual.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <numeric>
#include <optional>

#include "tess/base/circumsphere.hpp"
#include "tess/base/poll.hpp"
#include "tess/base/tetrahedron.hpp"

namespace terratet {
namespace {

using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;

constexpr double centre_error = 1e-12;
/// Circumcentres farther apart than that, in radii, are not those of points on one sphere.
constexpr double one_place = 1e-6;
/// In diagonals of the mesh.
constexpr double far_away = 10;

/// Seen from outside.
struct HullFacet {
    std::uint32_t cell;
    std::size_t opposite;
    Triangle corners;
};

/// Corners are numbered by the mesh's cells, then by the facets of its hull.
class DualMaker {
  public:
    DualMaker(const TetMesh& mesh, const Poll& poll) : mesh_(mesh), poll_(poll) {}

    VoronoiComplex run() {
        place_circumcentres();
        place_far_points();
        unite_circumcentres();
        for (std::uint32_t cell = 0; cell < mesh_.cells.size(); ++cell) {
            for (const auto& [i, j, k, l] : opposite_edges) {
                add_wall(cell, {i, j, k, l});
                add_wall(cell, {k, l, i, j});
            }
            poll_();
        }
        close_far_away();
        drop_what_is_united();
        return std::move(dual_);
    }

  private:
    void place_circumcentres() {
        dual_.points.reserve(mesh_.cells.size());
        for (const auto& v : mesh_.cells) {
            const auto& p = mesh_.points;
            dual_.points.push_back(certified_circumsphere({p[v[0]], p[v[1]], p[v[2]], p[v[3]]}, centre_error).center);
            poll_();
        }
    }

    /// One on the ray that leaves each facet of the hull.
    void place_far_points() {
        const double away = far_away * bounding_box(mesh_.points).diagonal();
        for (std::uint32_t cell = 0; cell < mesh_.cells.size(); ++cell) {
            for (std::size_t k = 0; k < 4; ++k) {
                if (mesh_.neighbours[cell][k] >= 0) {
                    continue;
                }
                HullFacet facet{cell, k, {}};
                for (std::size_t i = 0; i < 3; ++i) {
                    facet.corners[i] = mesh_.cells[cell][facet_corners[k][i]];
                }
                const Vec3& a = mesh_.points[facet.corners[0]];
                const Vec3 u = mesh_.points[facet.corners[1]] - a;
                const Vec3 v = mesh_.points[facet.corners[2]] - a;
                const Vec3 normal = cross(u, v);
                const double square = squared_length(normal);
                const Vec3 middle =
                    a + (squared_length(u) * cross(v, normal) + squared_length(v) * cross(normal, u)) / (2 * square);
                hull_.push_back(facet);
                dual_.points.push_back(middle + away / std::sqrt(square) * normal);
            }
        }
        root_.resize(dual_.points.size());
        std::iota(root_.begin(), root_.end(), 0U);
    }

    std::uint32_t root(std::uint32_t i) {
        while (root_[i] != i) {
            i = root_[i] = root_[root_[i]];
        }
        return i;
    }

    void unite(std::uint32_t i, std::uint32_t j) {
        i = root(i);
        j = root(j);
        root_[std::max(i, j)] = std::min(i, j);
    }

    void unite_circumcentres() {
        for (std::uint32_t cell = 0; cell < mesh_.cells.size(); ++cell) {
            const Vec3& center = dual_.points[cell];
            const double near = one_place * distance(center, mesh_.points[mesh_.cells[cell][0]]);
            for (const std::int32_t next : mesh_.neighbours[cell]) {
                const auto neighbour = static_cast<std::uint32_t>(next);
                if (next >= 0 && neighbour > cell && distance(center, dual_.points[neighbour]) <= near &&
                    on_one_sphere(cell, neighbour)) {
                    unite(cell, neighbour);
                }
            }
        }
    }

    [[nodiscard]] Point exact(std::uint32_t i) const {
        const Vec3& p = mesh_.points[i];
        return {p.x, p.y, p.z};
    }

    [[nodiscard]] bool on_one_sphere(std::uint32_t cell, std::uint32_t neighbour) const {
        const auto& v = mesh_.cells[cell];
        const auto& others = mesh_.cells[neighbour];
        const auto apex = std::ranges::find_if(others, [&](std::uint32_t i) { return std::ranges::count(v, i) == 0; });
        return CGAL::side_of_bounded_sphere(exact(v[0]), exact(v[1]), exact(v[2]), exact(v[3]), exact(*apex)) ==
               CGAL::ON_BOUNDARY;
    }

    /// In a plane of the hull.
    [[nodiscard]] bool on_one_circle(const Triangle& a, const Triangle& b) const {
        const auto apex = std::ranges::find_if(b, [&](std::uint32_t i) { return std::ranges::count(a, i) == 0; });
        const Point p = exact(a[0]);
        const Point q = exact(a[1]);
        const Point r = exact(a[2]);
        const Point s = exact(*apex);
        return CGAL::coplanar(p, q, r, s) && CGAL::coplanar_side_of_bounded_circle(p, q, r, s) == CGAL::ON_BOUNDARY;
    }

    /// The corner on the far end of the ray from a cell's facet.
    [[nodiscard]] std::uint32_t far_corner(std::uint32_t cell, std::size_t opposite) const {
        const auto at = std::ranges::lower_bound(hull_, std::pair(cell, opposite), {},
                                                 [](const HullFacet& f) { return std::pair(f.cell, f.opposite); });
        return static_cast<std::uint32_t>(mesh_.cells.size() + static_cast<std::size_t>(at - hull_.begin()));
    }

    enum class Ring : std::uint8_t { closed, open, not_first };

    /// Appends what is met round the edge from a to b, from `first` on, leaving it opposite vertex `left`, with `pivot`
    /// ahead. Another cell than the edge's first has the wall.
    Ring walk(std::uint32_t first, std::uint32_t a, std::uint32_t b, std::uint32_t left, std::uint32_t pivot,
              std::vector<std::uint32_t>& met) const {
        for (std::uint32_t cell = first;;) {
            const auto& v = mesh_.cells[cell];
            const auto opposite = static_cast<std::size_t>(std::ranges::find(v, left) - v.begin());
            const std::int32_t next = mesh_.neighbours[cell][opposite];
            if (next < 0) {
                met.push_back(far_corner(cell, opposite));
                return Ring::open;
            }
            cell = static_cast<std::uint32_t>(next);
            if (cell <= first) {
                return cell == first ? Ring::closed : Ring::not_first;
            }
            met.push_back(cell);
            left = pivot;
            pivot = *std::ranges::find_if(mesh_.cells[cell],
                                          [&](std::uint32_t i) { return i != a && i != b && i != left; });
        }
    }

    /// Across the edge between the first two of a cell's corners, if the cell is the edge's first.
    void add_wall(std::uint32_t cell, const std::array<std::size_t, 4>& order) {
        const auto& v = mesh_.cells[cell];
        auto [a, b] = std::minmax(v[order[0]], v[order[1]]);
        std::uint32_t k = v[order[2]];
        std::uint32_t l = v[order[3]];
        if (is_odd_order(v, {a, b, k, l})) {
            std::swap(k, l);
        }
        ring_.clear();
        const Ring ring = walk(cell, a, b, k, l, ring_);
        if (ring == Ring::not_first) {
            return;
        }
        back_.clear();
        if (ring == Ring::open) {
            if (walk(cell, a, b, l, k, back_) == Ring::not_first) {
                return;
            }
            unite_far_corners(ring_.back(), back_.back());
        }
        std::ranges::reverse(back_);
        back_.push_back(cell);
        back_.insert(back_.end(), ring_.begin(), ring_.end());
        dual_.add(back_, a, static_cast<std::int32_t>(b));
    }

    void unite_far_corners(std::uint32_t i, std::uint32_t j) {
        const auto first = static_cast<std::uint32_t>(mesh_.cells.size());
        if (on_one_circle(hull_[i - first].corners, hull_[j - first].corners)) {
            unite(i, j);
        }
    }

    /// A wall of far corners for each vertex on the hull.
    void close_far_away() {
        struct Turn {
            std::uint32_t vertex, from, to, corner;
        };
        std::vector<Turn> turns;
        for (std::size_t f = 0; f < hull_.size(); ++f) {
            const Triangle& t = hull_[f].corners;
            for (std::size_t i = 0; i < 3; ++i) {
                turns.push_back(
                    {t[i], t[(i + 1) % 3], t[(i + 2) % 3], static_cast<std::uint32_t>(mesh_.cells.size() + f)});
            }
        }
        const auto key = [](const Turn& turn) { return std::pair(turn.vertex, turn.from); };
        std::ranges::sort(turns, {}, key);
        for (std::size_t first = 0; first < turns.size();) {
            const std::uint32_t vertex = turns[first].vertex;
            ring_.clear();
            std::size_t at = first;
            do {
                ring_.push_back(turns[at].corner);
                at = static_cast<std::size_t>(
                    std::ranges::lower_bound(turns, std::pair(vertex, turns[at].to), {}, key) - turns.begin());
            } while (at != first);
            dual_.add(ring_, vertex, beyond_bound);
            while (first < turns.size() && turns[first].vertex == vertex) {
                ++first;
            }
        }
    }

    /// Corners that are one are; walls that have fewer than three are none.
    void drop_what_is_united() {
        VoronoiComplex kept;
        kept.points = std::move(dual_.points);
        kept.corners.reserve(dual_.corners.size());
        kept.walls.reserve(dual_.walls.size());
        for (const VoronoiWall& wall : dual_.walls) {
            ring_.clear();
            for (const std::uint32_t corner : dual_.polygon(wall)) {
                if (const std::uint32_t one = root(corner); ring_.empty() || ring_.back() != one) {
                    ring_.push_back(one);
                }
            }
            while (ring_.size() > 1 && ring_.back() == ring_.front()) {
                ring_.pop_back();
            }
            if (ring_.size() > 2) {
                kept.add(ring_, wall.cell, wall.beyond);
            }
        }
        dual_ = std::move(kept);
    }

    const TetMesh& mesh_;
    PatientPoll poll_;
    VoronoiComplex dual_;
    std::vector<HullFacet> hull_;      ///< by cell and opposite corner
    std::vector<std::uint32_t> root_;  ///< a forest: of each corner one that is the same
    std::vector<std::uint32_t> ring_;
    std::vector<std::uint32_t> back_;
};

}  // namespace

VoronoiComplex voronoi_dual(const TetMesh& mesh, const Poll& poll) {
    return DualMaker(mesh, poll).run();
}

}  // namespace terratet
