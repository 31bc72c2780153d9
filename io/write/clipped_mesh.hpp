// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// A tessellation cut at the extent's planes (clip.hpp), as the writers read it.

#include <cstdint>
#include <vector>

#include "io/export.hpp"
#include "tess/mending/blend.hpp"

namespace terratet {

struct ClippedMesh {
    /// Places are the model's vertices, followed by the cuts and by the points that mending moved.
    using Place = std::uint32_t;

    /// A place on the edge between two earlier ones.
    struct Cut {
        Place a, b;
        double t;  ///< of its value: 0 as at a, 1 as at b; just these where the other end is across a fault
    };
    /// A place in the tessellation's linear field.
    struct Moved {
        Blend blend;   ///< of the tessellation's vertices
        bool on_face;  ///< of the extent
    };
    /// A facet as seen from outside `cell`.
    struct Facet {
        Triangle corners;     ///< indices into points
        std::uint32_t cell;   ///< index into cells
        std::int64_t beyond;  ///< the cell on the other side; −1: none
        bool on_extent;       ///< on the extent's faces; a facet with neither is a collapsed fault's
    };

    std::vector<Vec3> points;                         ///< frame-local, each used by a cell
    std::vector<Place> place;                         ///< of each point
    std::vector<Cut> cuts;                            ///< place model.vertices.size() + i is cuts[i]
    std::vector<Moved> moved;                         ///< place model.vertices.size() + cuts.size() + i is moved[i]
    std::vector<std::array<std::uint32_t, 4>> cells;  ///< indices into points, positively oriented
    std::vector<std::uint32_t> parent;                ///< of each cell, the tessellation's that it is a part of, or
                                                      ///< was made of and others; ascending
    std::vector<char> changed;                        ///< of each cell: another than its parent
    std::vector<std::int32_t> region;  ///< of each cell; −1 in gap cells. Where a cell's centroid lies outside,
                                       ///< that of the nearest it hangs together with
    std::vector<Facet> facets;         ///< on the extent's faces, between gap and other cells, and between
                                       ///< pieces; each once

    /// A property's values at the points, in measured units, linear between the tessellation's vertices in the
    /// property's scale; a category is the nearest's. Vertices across a fault do not count.
    [[nodiscard]] std::vector<double> values(const Model& model, std::size_t property) const;
    [[nodiscard]] std::vector<double> extrapolation(const Model& model) const;
    /// The vertex that a point is; for a cut one on the domain's boundary, with the side its ends have in common.
    [[nodiscard]] std::vector<Vertex> vertices(const Model& model) const;
};

}  // namespace terratet
