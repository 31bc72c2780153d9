// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Faults as the tessellation sees them: a cleaned, remeshed surface, a margin beyond its rims, and mirrored seeds.
///
/// Paired mode (paper 4.1 b; DESIGN §4.2). Seeds stand at p ± (ε/2)n over base points p that cover the surface and its
/// margin within the covering radius ρ. No other vertex comes within the protection radius r_p = √(ρ² + ε²/4) (1.1 r_p
/// where the surface bends). Then no Delaunay edge with an end that is not a seed of the fault crosses the surface:
/// guarantee F1.
///
/// Guarantees
///  F1  Within the extent, no edge of the tessellation crosses a fault unless both its ends are that fault's seeds.
///  F4  Nothing is changed, refused, trimmed or merged silently: every surface handed in is in the report, and the areas
///      in its account add up: in = used + trimmed + outside + refused.

#include <cstdint>
#include <string>
#include <vector>

#include "tess/diagnostics.hpp"
#include "tess/frame.hpp"
#include "tess/geometry.hpp"
#include "tess/progress.hpp"
#include "tess/surface.hpp"

namespace terratet {

struct Seed {
    Vec3 position;
    std::int8_t side = 0;  ///< +1 on the side the normal points to, −1 on the other
    friend bool operator==(const Seed&, const Seed&) = default;
};

/// A prepared fault.
struct Fault {
    std::string name;
    Surface sheet;     ///< what F1 is promised for: the part within the extent, remeshed to the spacing
    Surface margin;    ///< skirt beyond the rims (and beyond the extent), covered by seeds as well; triangles may overlap
    std::vector<Seed> seeds;      ///< mirrored: seeds 2k (+) and 2k+1 (−) stand over the same base point
    double spacing = 0;           ///< s actually used (halved where the requested one could not separate the sides)
    double width = 0;             ///< ε, the distance between the two seeds of a pair
    double covering_radius = 0;   ///< ρ: no point of sheet or margin is farther from a base point
    double protection_radius = 0;  ///< r_p, the factor for bent surfaces included

    friend bool operator==(const Fault&, const Fault&) = default;
};

struct FaultOptions {
    double spacing = 0;      ///< s; 0: l_min
    double width = 0;        ///< ε, at most s; 0: s/4. Below s/20 nearly every gap cell is a sliver. Halved with s
    double snap = 0;         ///< rims nearer than this to the extent's faces are taken to reach them; 0: s
    std::uint64_t max_seeds = 2'000'000;  ///< over all faults: refuses instead of exhausting the memory
};

/// What became of one input surface (F4).
struct FaultAccount {
    std::string name;
    std::string file;
    bool used = false;
    std::string reason;          ///< why refused, unused or used in part; empty when used whole
    std::size_t parts = 0;       ///< connected sheets after repair
    std::size_t seeds = 0;
    double area_in = 0;          ///< of the surface as read
    double area_used = 0;        ///< within the extent, before remeshing
    double area_outside = 0;     ///< beyond the extent
    double area_trimmed = 0;     ///< too near another fault to be separated from it in paired mode
    double area_refused = 0;
    double deviation_max = 0;    ///< between remeshed and repaired surface, both ways, in the extent
    std::size_t dropped_triangles = 0;  ///< degenerate or duplicate, with area below rounding
};

struct FaultPreparation {
    std::vector<Fault> faults;            ///< the used ones, in canonical order (by name, then coordinates)
    std::vector<FaultAccount> accounts;   ///< one per input surface, in canonical order
};

/// The widest any fault could need around the extent: r_p + 2s for the requested spacing and width, DESIGN §4.2. The
/// hull box is the extent grown by it.
double hull_margin(const FaultOptions& options, double l_min);

/// Cleans, cuts to the extent, remeshes, extends and seeds. Never throws for bad geometry: a surface that cannot be used
/// is refused with its reason. Result independent of the order of `surfaces`; positions snapped to the frame. Throws
/// Error when max_seeds would be exceeded, UsageError for lengths that contradict each other (width above spacing,
/// negative, not finite). Roughly 0.1 ms a seed.
/// \pre All coordinates are acceptable (geometry.hpp) and local to `frame`; extent is not empty; l_min > 0.
FaultPreparation prepare_faults(const std::vector<Surface>& surfaces, const Box3& extent, const Frame& frame, double l_min,
                                const FaultOptions& options = {}, const Progress& progress = {});

}  // namespace terratet
