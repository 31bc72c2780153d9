// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Surfaces as the tessellation sees them (faults, horizons, the ground, a domain's walls): cleaned sheets that meet in
/// common edges, a margin beyond their rims, and mirrored seeds.
///
/// All surfaces are prepared together (DESIGN §4.2): repaired, rims extended to what they nearly touch, cut along their
/// intersections with exact arithmetic, remeshed as one complex of triangles, seeded.
///
/// Paired mode (paper 4.1 b). Seeds stand at p ± (ε/2)n over base points p that cover the surface and its margin within
/// the covering radius ρ. No other vertex comes within the protection radius r_p = √(ρ² + ε²/4) (1.1 r_p where the
/// surface bends).
///
/// Exact mode (after VoroCrust: Abdelkader et al., ACM Trans. Graph. 39, 2020). A triangle with corners p_i and radii
/// r_i has its seeds at c ± h n, c the radical centre of the three balls in its plane, h² = r_i² − |c − p_i|². Where no
/// seed lies strictly inside a corner's ball, and other vertices keep out of all balls, the triangle lies on a wall of
/// the Voronoi diagram: the nearest vertex tells the side. Such triangles are *certified*.
///
/// Guarantees
///  F1  Within the extent, no edge of the tessellation crosses a fault unless both its ends are seeds: of that fault,
///      or of one that meets it. The seeds are tested for it, ball by ball of their own tessellation, and what is
///      found is closed by more seeds or a wider margin (leaks.hpp, seal.hpp); a fault where that fails is
///      refused. A ball is tested in many places, not in all: what is promised is tested, not proven. No edge was
///      found in a thousand damaged surfaces, nor in thirty groups of real faults.
///  F2  BarrierQuery::side_of is right everywhere; on certified triangles the nearest vertex tells the same.
///  F4  Nothing is changed, refused, trimmed or merged silently: every surface handed in is in the report, and the
///      areas in its account add up: in = used + trimmed + outside + refused.

#include <cstdint>
#include <string>
#include <vector>

#include "tess/geometry.hpp"
#include "tess/surface.hpp"

namespace terratet {

struct Seed {
    Vec3 position;
    std::int8_t side = 0;  ///< +1 on the side the normal points to, −1 on the other
    friend bool operator==(const Seed&, const Seed&) = default;
};

/// A prepared surface.
struct Barrier {
    std::string name;
    Surface sheet;   ///< what F1 is promised for: the part within the extent, remeshed. Sheets that meet share points
    Surface margin;  ///< skirt beyond the rims (and beyond the extent), covered by seeds as well, and flakes off the
                     ///< sheet about which r_p is kept clear too; triangles may overlap
    std::vector<Seed> seeds;       ///< mirrored: seeds 2k (+) and 2k+1 (−) stand over the same place
    double spacing = 0;            ///< s, the length of its triangles' edges where nothing asks for less
    double width = 0;              ///< ε, the distance between the two seeds of a pair in paired mode; smaller with s
    double covering_radius = 0;    ///< ρ: no point of sheet or margin is farther from a base point
    double protection_radius = 0;  ///< r_p, the factor for bent surfaces included
    bool refined = false;          ///< for samples: r_p is smaller where its triangles are (BarrierOptions::refine)

    friend bool operator==(const Barrier&, const Barrier&) = default;
};

enum class SeedMode : std::uint8_t { paired, exact };

struct BarrierOptions {
    double spacing = 0;  ///< s; 0: l_min
    double width = 0;    ///< ε, at most s; 0: s/4. Below s/20 nearly every gap cell is a sliver
    double snap = 0;     ///< rims that stop this short of another fault, or poke this far through it, are taken to
                         ///< end on it; 0: s/20
    std::uint64_t max_seeds = 2'000'000;  ///< over all faults: refuses instead of exhausting the memory
    SeedMode mode = SeedMode::paired;
    bool refine = false;  ///< finer triangles, down to s/8, where samples come near, so that more of these may stay
};

/// What became of one input surface (F4).
struct BarrierAccount {
    std::string name;
    std::string file;
    SurfaceKind kind = SurfaceKind::fault;
    bool used = false;
    std::string reason;     ///< why refused, unused or used in part; empty when used whole
    std::size_t parts = 0;  ///< connected sheets after repair
    std::size_t seeds = 0;
    std::size_t triangles = 0;    ///< of the remeshed fault, in the extent and around it
    std::size_t certified = 0;    ///< of these, in exact mode
    std::size_t unseparated = 0;  ///< of these: the nearest seed is not on the own side at samples ε/4 away
    double finest_spacing = 0;    ///< s, or less where the fault asked for it
    double area_in = 0;           ///< of the surface as read
    double area_used = 0;         ///< within the extent, before remeshing
    double area_outside = 0;      ///< beyond the extent
    double area_trimmed = 0;      ///< stubs, overlaps, crumbs, and where the surface ran through itself
    double area_refused = 0;
    double deviation_median = 0;  ///< between remeshed and repaired surface, both ways, in the extent
    double deviation_p95 = 0;
    double deviation_max = 0;
    std::size_t dropped_triangles = 0;  ///< degenerate or duplicate, with area below rounding
};

struct BarrierPreparation {
    std::vector<Barrier> barriers;         ///< the used ones, in canonical order (by name, then coordinates)
    std::vector<BarrierAccount> accounts;  ///< one per input surface, in canonical order
    std::vector<std::vector<std::uint8_t>> certified;  ///< by fault and triangle of its sheet
};

}  // namespace terratet
