// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// A mesh whose cells were cut, while it is being mended: its cells by their corners, what must stay, and how
/// good a cell is.

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "tess/base/no_index.hpp"
#include "tess/base/tetrahedron.hpp"
#include "tess/geometry.hpp"

namespace terratet {

using Corners = std::array<std::uint32_t, 4>;

/// The points of the facet opposite corner k, ascending.
inline Triangle ascending_facet(const Corners& corners, std::size_t k) {
    Triangle facet{corners[(k + 1) % 4], corners[(k + 2) % 4], corners[(k + 3) % 4]};
    std::ranges::sort(facet);
    return facet;
}

/// What is to be mended. Points of different numbers may be at one place: the nodes on both sides of a fault without
/// width, whose facets have no cell beyond.
struct MendableMesh {
    struct Cell {
        Corners corners{};         ///< positively oriented; all alike: gone
        std::uint32_t parent = 0;  ///< carried along: a new cell has the least of those it replaces
        std::int32_t part = 0;     ///< facets between cells of two parts stay
        bool judged = true;        ///< its shape counts; of others the volume must be positive, no more
        bool touched = false;      ///< was cut, or made since: mended if bad
    };
    std::vector<Vec3> points;
    enum class Hold : std::uint8_t {
        free,
        surface,  ///< not moved; but may give way to a point of the same surface on the box
        fixed,    ///< neither moved nor taken away
    };
    std::vector<Hold> hold;   ///< of points
    std::vector<char> moved;  ///< of points: by mending
    std::vector<Cell> cells;
    std::vector<Triangle> walls;  ///< facets, their points ascending, that stay though cells of one part share them
    Box3 box;                     ///< the mesh ends at its faces, or at surfaces that stay
    double least_edge = 0;        ///< a cell with a shorter one is worse for it
};

/// A mesh with the cells at each point, and what follows from them.
class MendableStars {
  public:
    /// The mesh must outlive it, and is changed by apply() and move() alone.
    explicit MendableStars(MendableMesh& mesh);

    [[nodiscard]] const MendableMesh& mesh() const { return mesh_; }
    [[nodiscard]] const MendableMesh::Cell& cell(std::uint32_t c) const { return mesh_.cells[c]; }
    [[nodiscard]] const Vec3& point(std::uint32_t v) const { return mesh_.points[v]; }
    [[nodiscard]] const std::vector<std::uint32_t>& star(std::uint32_t v) const { return star_[v]; }

    static bool has(const MendableMesh::Cell& cell, std::uint32_t v);
    [[nodiscard]] static bool gone(const MendableMesh::Cell& cell) { return cell.corners[0] == cell.corners[1]; }

    /// The cell beyond facet k of c; none: there is none.
    [[nodiscard]] std::uint32_t beyond(std::uint32_t c, std::size_t k) const;

    /// Faces of the box that a point is on, a bit each.
    [[nodiscard]] std::uint8_t faces(std::uint32_t v) const { return faces_[v]; }

    /// Is the facet one of the mesh's walls?
    [[nodiscard]] bool is_wall(std::uint32_t c, std::size_t k) const;
    /// Must the facet stay: a wall, between two parts, or where the mesh ends but not at the box?
    [[nodiscard]] bool is_kept(std::uint32_t c, std::size_t k) const;
    /// Is the point on a facet that must stay?
    [[nodiscard]] bool on_kept(std::uint32_t v);

    /// It and, if it is on a facet that must stay, all others at its place that are, ascending.
    [[nodiscard]] std::vector<std::uint32_t> at_place_of(std::uint32_t v);

    /// The square of the sine of the smallest dihedral angle (1 from a right angle on), less where an edge is too
    /// short, if edges count; 0 without volume but for rounding, −1 when turned inside out. Of a cell that is not
    /// judged: 1 with a volume.
    ///
    /// \param floor  what is not above it need not be exact, but at most it; then less has to be looked at
    [[nodiscard]] double goodness(const MendableMesh::Cell& cell, double floor = -2) const;
    /// Of one of the mesh's cells, computed once for each change of it.
    [[nodiscard]] double goodness(std::uint32_t c) const;
    void let_edges_count(bool count) { edges_count_ = count; }

    /// Of a cell, squared.
    [[nodiscard]] double shortest_edge(const MendableMesh::Cell& cell) const;

    /// Of these cells if v were elsewhere, as each cell's goodness is added to it; minus infinity when it falls to
    /// `floor` or a cell would have no volume. \param cell_floor  of each cell's own goodness, as for goodness()
    template <class Add>
    [[nodiscard]] double score_with(std::span<const std::uint32_t> cells, std::uint32_t v, const Vec3& at, double score,
                                    double floor, double cell_floor, const Add& add) const {
        for (const std::uint32_t c : cells) {
            const double there = goodness_with(cell(c), v, at, cell_floor);
            score = add(score, there);
            if (!(there > 0 && score > floor)) {
                return -std::numeric_limits<double>::infinity();
            }
        }
        return score;
    }

    /// Counts the changes.
    [[nodiscard]] std::uint32_t now() const { return now_; }
    /// Was a cell at one of the cell's corners changed after that?
    [[nodiscard]] bool changed_round(const MendableMesh::Cell& cell, std::uint32_t since) const;

    /// The cells `old` are gone, `fresh` are there instead.
    void apply(std::span<const std::uint32_t> old, std::span<const MendableMesh::Cell> fresh);
    void move(std::uint32_t v, const Vec3& to);

  private:
    [[nodiscard]] double goodness_with(const MendableMesh::Cell& cell, std::uint32_t v, const Vec3& at,
                                       double floor) const;
    [[nodiscard]] double goodness(const std::array<Vec3, 4>& points, bool judged, double floor) const;
    void forget(std::uint32_t c);
    [[nodiscard]] std::array<Vec3, 4> points_of(const MendableMesh::Cell& cell) const;

    MendableMesh& mesh_;
    bool edges_count_ = true;
    std::vector<std::vector<std::uint32_t>> star_;
    std::vector<std::uint8_t> faces_;
    std::vector<std::uint32_t> by_place_;  ///< points by place, then number
    std::vector<std::uint32_t> rank_;      ///< of a point in it
    std::vector<std::int8_t> on_kept_;     ///< −1: not known yet
    std::vector<std::uint32_t> changed_;   ///< of points: when a cell there was last
    std::uint32_t now_ = 0;
    mutable std::array<std::vector<double>, 2> known_;  ///< goodness of cells, with edges or without; NaN: not yet
};

}  // namespace terratet
