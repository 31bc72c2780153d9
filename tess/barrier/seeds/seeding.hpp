// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The seeds of a remeshed fault complex, in either mode, and what can be certified of them (DESIGN §4.2).

#include <functional>
#include <set>
#include <span>
#include <vector>

#include "tess/barrier.hpp"
#include "tess/barrier/complex/sheet_complex.hpp"
#include "tess/barrier/complex/sheet_wall.hpp"
#include "tess/barrier/seeds/cover.hpp"
#include "tess/barrier/seeds/slivers.hpp"
#include "tess/base/poll.hpp"
#include "tess/base/size_field.hpp"
#include "tess/frame.hpp"

namespace terratet {

struct SeedTask {
    const SheetComplex& complex;  ///< in exact mode with its margin row
    const SheetWall& wall;        ///< of the complex without the row
    const EdgeTable& edges;       ///< of `complex`
    const SizeField& sizes;
    const Frame& frame;
    std::uint32_t surface_count = 0;
    double width = 0;                 ///< ε at the full spacing; smaller in proportion where triangles are
    std::span<const Vec3> relaxed{};  ///< about an edge length round these nothing need be certified (exact mode)
    Poll poll{};
    const Box3* mend_within =
        nullptr;                     ///< where pairs are moved if four seeds make a sliver: only worth it for the last
    std::span<const char> bounds{};  ///< by surface: does the model end there? Such pairs stay where they are
};

struct SeededComplex {
    std::vector<std::vector<Seed>> seeds;   ///< by surface: mirrored pairs, + first
    std::vector<double> covering_radius;    ///< by surface
    std::vector<double> protection_radius;  ///< by surface
    std::vector<double> radius;             ///< by point: of its ball (exact mode)
    std::vector<char> certified;            ///< by triangle: the nearest seed is on a point's own side (exact mode)
    std::vector<char> separated;            ///< by triangle: so it is at samples a quarter of ε away from it
};

/// Paired: p ± (ε/2)n over the points; at junctions one pair for each half-sheet, turned away from the others.
/// The skirts, by surface, are covered as well but for places nearer than r_p to other surfaces.
SeededComplex paired_seeds(const SeedTask& task, const std::vector<TriMesh>& skirts);

/// Exact: for each triangle g± = c ± h n, h² = r_i² − |c − p_i|², with the corners' radii r_i = 1.01 max R_t and c
/// their radical centre in its plane, if h² > 0, nothing stands between triangle and seed, and no seed is strictly
/// inside the ball of another triangle's corner; where two exclude each other, the one with fewer conflicts has them.
/// The others get h = min(0.15 s, 0.9 d tan(θ/2)) over a foot inside, or as high as such balls reach there, with rings
/// of pairs along their junctions, wherever that enters none of them; else nothing, and sealing sees to it. Certified
/// are triangles with seeds of the first kind and nothing strictly inside their corners' balls.
SeededComplex exact_seeds(const SeedTask& task);

/// Shared by the two.
class SeedCollector {
  public:
    explicit SeedCollector(const SeedTask& task);

    /// How far a pair may be moved: see MovablePair.
    struct Freedom {
        double along = 0;
        double height = 0;
    };

    /// Adds a mirrored pair unless one of the places is taken.
    bool add(std::uint32_t surface, const Vec3& plus, const Vec3& minus, const Freedom& freedom);

    /// Moves pairs where seeds make slivers, if the task asks for it: through no sheet, and only to where they fit.
    /// Returns how far those of each surface went along it at most.
    std::vector<double> mend(const std::function<bool(const Vec3& seed)>& fits, const LinkedPairs& linked = {});

    /// The number that a surface's first pair has while pairs are mended.
    [[nodiscard]] std::size_t first_pair(std::uint32_t surface) const;

    /// Covers sheets and skirts with pairs, the skirts but for places nearer than `clear` to other surfaces. Then finds
    /// the covering radii.
    void cover_all(const std::vector<TriMesh>& skirts, double clear, SeededComplex& result);

    /// Tests each triangle's samples against the nearest seeds.
    void test_separation(SeededComplex& result) const;

    [[nodiscard]] const std::vector<std::vector<Seed>>& seeds() const { return seeds_; }
    [[nodiscard]] const std::vector<Vec3>& places() const { return places_; }
    std::vector<std::vector<Seed>> take() { return std::move(seeds_); }

  private:
    const SeedTask& task_;
    std::vector<std::vector<Seed>> seeds_;
    std::vector<std::vector<Freedom>> freedom_;  ///< by surface and pair
    std::vector<Vec3> places_;
    std::set<Vec3> taken_;
};

}  // namespace terratet
