// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// A fault complex remeshed to the seeds' spacing, all sheets at once, so that junctions stay conforming.

#include <memory>
#include <span>

#include "tess/barrier/complex/sheet_complex.hpp"
#include "tess/base/poll.hpp"
#include "tess/base/size_field.hpp"

namespace terratet {

/// Sheets under remeshing, to be gone on with when other sizes are wanted or a surface is left out.
class SheetRemesher {
  public:
    /// In later passes short edges, left over from smoothing, are contracted where sizes have changed, or everywhere.
    /// The former keeps triangles as regular as they are, which certificates depend on (exact mode); the latter keeps
    /// their points, and so mirrored pairs, from standing too close (paired mode).
    enum class Contract { where_changed, everywhere };

    /// Points nearer than `snap` edge lengths to a sheet they do not belong to are merged into it. `sizes` must outlive
    /// the remesher and may change between passes. `bounds`, by sheet, marks those the model ends at: they go before
    /// all others, whose points join them and never the other way round, so that bounds in a plane stay in it.
    SheetRemesher(const SheetComplex& complex, const SizeField& sizes, double snap, Contract later,
                  std::span<const char> bounds = {});
    ~SheetRemesher();

    struct Result {
        SheetComplex complex;
        std::vector<std::array<std::uint32_t, 2>> crossings;  ///< left over: triangles of the complex
    };

    /// Near-equilateral triangles of the wanted edge length (split above 4/3 of it, contract below 0.7, Delaunay flips,
    /// points centred and projected back onto the sheets as given; after Botsch and Kobbelt 2004, carried over to edges
    /// with any number of triangles). Snapping zips wedges below about 15°; rounds of that follow until no triangles
    /// cross and no wedge is below 10°, or nothing helps. Deterministic. About 0.3 ms a point the first time; later
    /// passes change the last one's triangles where sizes have changed, a tenth of that, and leave them less regular.
    Result pass(const Poll& poll = {});

    /// Leaves out the surfaces not marked; where they met others, those keep their points on the line.
    void keep(const std::vector<char>& active);

  private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace terratet
