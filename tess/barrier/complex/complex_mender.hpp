// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Repairs of a fault complex under edition. Sheets that all but touch are made to touch, or to part.

#include <numbers>
#include <span>
#include <vector>

#include "tess/barrier/complex/complex_editor.hpp"

namespace terratet {

/// Radians: sheets that meet at less are zipped together, or opened.
inline constexpr double least_wedge = 10 * std::numbers::pi / 180;
/// Height of a triangle in edge lengths: taken out below.
inline constexpr double least_height = 0.05;

/// Works where the editor's points are awake.
class ComplexMender {
  public:
    explicit ComplexMender(ComplexEditor& editor) : editor_(editor) {}

    /// Merges each point that comes nearer than `share` edge lengths to a triangle it is no corner of into that
    /// triangle: into a corner, a new point of an edge, or a new point inside, whichever is near.
    void snap_close(double share);

    /// Takes out triangles almost without height: their long edge gets their third corner.
    void flatten_thin();

    /// Turns triangles that meet at less than the least wedge apart, about their common edge, each by half of what is
    /// missing; one alone where the other's apex is on a rim, a junction or a
    /// bound. The apexes move by less than 0.1 edge
    /// lengths.
    void open_wedges();

    /// Merging may leave a triangle that lies on others of its sheet and hangs on them by some of its edges alone: a
    /// flap, which covers nothing that is not covered.
    void drop_flaps();

  private:
    using Ties = ComplexEditor::Ties;

    struct Nearby {
        std::vector<std::uint32_t> triangles;
        std::vector<std::size_t> begin;  ///< by point

        [[nodiscard]] std::span<const std::uint32_t> of(std::uint32_t v) const {
            return {triangles.data() + begin[v], begin[v + 1] - begin[v]};
        }
    };
    /// A triangle seen from one of its edges.
    struct Wing {
        std::uint32_t apex = 0;
        Vec3 away;  ///< unit vector in the triangle's plane, square to the edge
        Vec3 foot;  ///< of the apex on the edge's line
        double height = 0;
    };

    /// Where a point snaps onto a triangle.
    struct Foot {
        Vec3 place;
        std::vector<std::uint32_t> of;  ///< a corner, the ends of an edge, or all three
        Ties ties;
    };

    [[nodiscard]] Nearby triangles_near_points(double share) const;
    [[nodiscard]] bool is_needle(std::uint32_t t) const;
    [[nodiscard]] Foot foot_on(std::uint32_t t, const Vec3& p, double touching) const;
    bool snap_onto(std::uint32_t v, std::uint32_t t);
    void unite(std::uint32_t u, std::uint32_t v);
    [[nodiscard]] bool is_flap(std::uint32_t t) const;
    [[nodiscard]] Wing wing(std::uint32_t t, std::uint32_t u, std::uint32_t v) const;
    void turn_apart(const Wing& one, const Wing& other);

    ComplexEditor& editor_;
};

}  // namespace terratet
