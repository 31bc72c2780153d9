// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Pairs of seeds moved a little, so that no four seeds make a sliver. Where four of them all but lie on a
/// circle and in a plane, a cell without height hangs between the two ways to triangulate them, and nothing that
/// refinement may insert comes near enough to break it up.

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "tess/base/poll.hpp"
#include "tess/frame.hpp"
#include "tess/geometry.hpp"

namespace terratet {

inline constexpr double widest_sliver = 3;  ///< radius of a ball that may stay empty, in spacings

/// Which cells between four seeds are slivers that stay.
struct SliverRule {
    double reach = 0;  ///< balls that are larger do not stay empty
    Box3 extent;       ///< outside nobody looks
    /// Does a fault run between these two? Then a cell with both belongs to its gap.
    std::function<bool(const Vec3& a, const Vec3& b)> apart;
};

struct SliverCorner {
    Vec3 position;
    std::uint32_t owner = 0;
    bool plus = true;
};

/// Has the cell an angle below a degree or little more, is its ball small, and fills it no gap?
bool is_sliver(const std::array<SliverCorner, 4>& corners, const SliverRule& rule);

struct MovablePair {
    Vec3 plus;
    Vec3 minus;
    std::uint32_t owner = 0;
    double along = 0;   ///< how far both may be moved along their sheet
    double height = 0;  ///< by which part of it the height over the sheet may shrink
};

struct PairMove {
    std::size_t pair = 0;
    Vec3 plus;
    Vec3 minus;
};

/// From this number on proposals may cost something.
inline constexpr std::uint64_t last_resort_from = 48;

/// Pairs that cannot be moved one by one, but together.
struct LinkedPairs {
    /// Where a pair and those that go with it may be: the numbers give different answers. Nothing: this time nowhere.
    std::function<std::vector<PairMove>(std::size_t pair, std::uint64_t number, const std::vector<MovablePair>& now)>
        propose;
    std::function<void(std::size_t pair, std::uint64_t number)> accept;  ///< what was proposed last is done
};

struct SliverTask {
    SliverRule rule;
    /// May the pair, of this number, be moved to these places? They are snapped to the frame.
    std::function<bool(std::size_t pair, const Vec3& plus, const Vec3& minus)> may_move;
    double lower = 1;      ///< times their freedom pairs may be lowered as a last resort
    LinkedPairs linked{};  ///< what becomes of pairs without freedom of their own; may be empty
};

struct SliversMended {
    std::size_t before = 0;  ///< cells between four seeds with an angle below a degree or little more, but for gaps'
    std::size_t after = 0;
    std::vector<char> moved;  ///< by pair
};

/// Moves pairs, one after the other or those that are linked at once, where that leaves fewer slivers, no farther than
/// each may go from where it was. Deterministic. About 10 µs a pair, and 1 ms a move that is tried.
SliversMended mend_slivers(std::vector<MovablePair>& pairs, const SliverTask& task, const Frame& frame,
                           const Poll& poll);

}  // namespace terratet
