// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Exact mode: the balls about the corners of certified triangles, given other radii so that four of the seeds on them
/// make no sliver.

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "tess/barrier/complex/sheet_complex.hpp"
#include "tess/barrier/seeds/settle.hpp"
#include "tess/barrier/seeds/slivers.hpp"
#include "tess/base/seed_grid.hpp"
#include "tess/frame.hpp"

namespace terratet {

inline constexpr double ball_tolerance = 1e-8;  ///< relative, on the radii: rounding of the seeds,
inline constexpr double ball_depth = 5e-9;      ///< and that they stand in general position

/// The point of the triangle's plane with equal power to the balls about its corners, and what is left of it for the
/// height; without height where nothing is.
BallPair radical_pair(const TriangleCorners& corners, const std::array<double, 3>& radii);

struct BallTask {
    const SheetComplex& complex;
    const SeedGrid& points;  ///< of the complex
    const Frame& frame;
    std::span<double> radii;               ///< by point
    std::span<BallPair> pairs;             ///< by triangle: the radical pairs of those that are certified
    std::span<const std::size_t> numbers;  ///< by triangle: of its pair among all movable ones
    std::span<const char> certified;       ///< by point: is it the corner of a certified triangle?
    std::span<char> placed;                ///< by triangle: is it certified still?
    std::function<bool(std::uint32_t triangle, const Vec3& seed)> sees;
};

/// Proposes radii, a little larger than they were given, but for a surface's largest: its protection radius stays.
/// Every seed stays out of the balls of certified corners, and every triangle sees its own, so that all stay certified.
/// As a last resort a triangle's seeds are lifted out of its corners' balls: it alone is not certified then.
class BallRadii {
  public:
    BallRadii(const BallTask& task, std::span<const Vec3> places);

    /// As in LinkedPairs. About 20 µs.
    std::vector<PairMove> propose(std::size_t pair, std::uint64_t number, const std::vector<MovablePair>& now);
    void accept();

  private:
    [[nodiscard]] double highest(std::uint32_t triangle) const;
    std::vector<PairMove> lifted(std::size_t pair, std::uint64_t number);
    [[nodiscard]] bool clear_of_balls(const PairMove& move, double tolerance) const;
    [[nodiscard]] bool fits(std::uint32_t point, double radius, const std::vector<PairMove>& moves,
                            const std::vector<MovablePair>& now) const;
    [[nodiscard]] std::vector<std::uint32_t> round(std::span<const std::uint32_t> triangles) const;

    const BallTask task_;
    SeedGrid seeds_;                                ///< where they were: site 2k is the + seed of pair k
    std::vector<std::vector<std::uint32_t>> star_;  ///< by point: certified triangles
    std::vector<double> given_;                     ///< radii, by point
    std::vector<double> most_;                      ///< radius, by point
    std::vector<std::int64_t> triangle_;            ///< by pair; −1: none of these
    std::int64_t lifted_ = -1;                      ///< a triangle, if that was proposed last
    std::uint32_t point_ = 0;                       ///< whose radius was proposed last,
    double radius_ = 0;
    std::vector<std::pair<std::uint32_t, BallPair>> pairs_;  ///< and its triangles' pairs
};

}  // namespace terratet
