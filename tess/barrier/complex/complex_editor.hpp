// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// A fault complex under edition: edges split, contracted and flipped, points moved and merged, while rims and
/// junctions stay what they are. Whatever is done, sheets that share a junction go on sharing its points.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "tess/barrier/complex/sheet_complex.hpp"
#include "tess/base/size_field.hpp"

namespace terratet {

/// What a point may do: one inside a patch moves in it, one on a rim or a junction along it, a node stays.
enum class PointKind : std::uint8_t { interior, chain, node };

class ComplexEditor {
  public:
    /// Patches are those of the complex as given; they keep their numbers. `bounds`, by sheet: those the model ends at;
    /// none when empty.
    ComplexEditor(const SheetComplex& complex, const Patches& numbering, const SizeField& sizes,
                  std::span<const char> bounds = {});

    /// What a point is bound to: ascending numbers of pieces of the bounds, each connected within its sheet. Its points
    /// stay on them whatever happens: a point is only ever made one with another that is on the same pieces at least.
    using Ties = std::vector<std::uint32_t>;
    static constexpr std::uint32_t unbound = ~std::uint32_t{0};

    struct WorkTriangle {
        Triangle corners{};
        std::uint32_t patch = 0;
        std::uint32_t sheet = 0;
        std::uint32_t bound = unbound;  ///< piece
        bool alive = true;
    };
    struct Classified {
        PointKind kind = PointKind::interior;
        std::vector<std::uint32_t> along;  ///< the other ends of its rim and junction edges
    };

    [[nodiscard]] std::size_t point_count() const { return points_.size(); }
    [[nodiscard]] const Vec3& point(std::uint32_t v) const { return points_[v]; }
    [[nodiscard]] double size(std::uint32_t v) const { return sizes_of_[v]; }
    [[nodiscard]] const std::vector<WorkTriangle>& triangles() const { return triangles_; }
    [[nodiscard]] const std::vector<std::uint32_t>& star(std::uint32_t v) const { return star_[v]; }
    [[nodiscard]] TriangleCorners corners(std::uint32_t t) const;
    [[nodiscard]] bool has_edge(std::uint32_t u, std::uint32_t v) const { return !edge_triangles(u, v).empty(); }
    [[nodiscard]] double edge_length(std::uint32_t u, std::uint32_t v) const {
        return distance(points_[u], points_[v]);
    }
    /// The length wanted of an edge.
    [[nodiscard]] double target(std::uint32_t u, std::uint32_t v) const { return 0.5 * (size(u) + size(v)); }

    [[nodiscard]] std::vector<std::uint32_t> edge_triangles(std::uint32_t u, std::uint32_t v) const;
    [[nodiscard]] bool is_feature(const std::vector<std::uint32_t>& of_edge) const;
    [[nodiscard]] Classified classify(std::uint32_t v) const;
    [[nodiscard]] Ties ties(const std::vector<std::uint32_t>& of_triangles) const;
    [[nodiscard]] Ties ties_at(std::uint32_t v) const { return bounded_ ? ties(star_[v]) : Ties{}; }

    /// Is `into` on all the bounds that `from` is on?
    [[nodiscard]] bool may_join(std::uint32_t from, std::uint32_t into) const;

    /// All edges, ascending.
    [[nodiscard]] std::vector<std::array<std::uint32_t, 2>> edges() const;

    /// After the field has changed. Points that want another size now.
    std::vector<std::uint32_t> update_sizes();

    /// All points are awake at first, and so are new ones. Only these are moved, have their edges flipped and are
    /// mended, which is the caller's to heed.
    [[nodiscard]] bool awake(std::uint32_t v) const { return awake_[v] != 0; }
    void wake_only(const std::vector<std::uint32_t>& points);
    /// Those that share a triangle with one that is awake, again and again.
    void wake_neighbours(int rings);

    /// Would the triangles round v neither turn over nor shrink to nothing?
    [[nodiscard]] bool stays_sound(std::uint32_t v, const Vec3& to) const;

    void fix(std::uint32_t v) { fixed_[v] = 1; }
    void move(std::uint32_t v, const Vec3& to);

    /// Returns the new point, at the given place.
    std::uint32_t split_edge(std::uint32_t u, std::uint32_t v, const Vec3& at);
    std::uint32_t split_triangle(std::uint32_t t, const Vec3& at);

    /// Moves u into v if the shapes, the topology and the kinds of the two allow it.
    bool contract(std::uint32_t u, std::uint32_t v);

    /// Makes one point of two, come what may; triangles that coincide then become one: that of a bound if there is one.
    /// \pre may_join(from, into)
    void merge(std::uint32_t from, std::uint32_t into);

    void remove_triangle(std::uint32_t t);

    /// Flips an inner edge of a patch that is not Delaunay.
    bool flip(std::uint32_t u, std::uint32_t v);

    /// Others' triangles that lie on a bound with all corners go, and edges of the bound flip for theirs that do: so
    /// sheets that lean against it join it.
    void join_bounds();

    [[nodiscard]] SheetComplex result() const;

  private:
    std::uint32_t add_point(const Vec3& p);
    void add_triangle(const Triangle& t, const WorkTriangle& like);
    void number_bounds(std::span<const char> bounds);
    [[nodiscard]] Ties common_ties(std::uint32_t u, std::uint32_t v) const;
    bool flip_for(std::uint32_t u, std::uint32_t v, std::uint32_t bound);
    bool turn_edge(std::uint32_t u, std::uint32_t v, const std::vector<std::uint32_t>& of_edge);
    [[nodiscard]] std::optional<std::uint32_t> present(const Triangle& t) const;
    [[nodiscard]] bool keeps_topology(std::uint32_t u, std::uint32_t v, std::size_t shared) const;
    [[nodiscard]] bool keeps_shape(std::uint32_t u, std::uint32_t v, bool forced) const;

    const SizeField& field_;
    bool bounded_ = false;
    std::vector<Vec3> points_;
    std::vector<double> sizes_of_;
    std::vector<char> fixed_;
    std::vector<char> awake_;
    std::vector<WorkTriangle> triangles_;
    std::vector<std::vector<std::uint32_t>> star_;  ///< living triangles of each point
};

}  // namespace terratet
