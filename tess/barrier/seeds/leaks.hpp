// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Finds where the seeds of prepared faults would let an edge through.
///
/// An edge ab of a Delaunay tessellation has a ball with a and b on it and no vertex inside. Whatever vertices there
/// are besides the seeds, an empty ball with seed a on it lies within the circumscribed balls of a's cells in the
/// tessellation of the seeds alone: how much deeper a place is in one ball through a than in another is an affine
/// function of their centres, so it is largest at a corner of a's Voronoi cell. An edge from a to another vertex can
/// therefore cross a sheet only if one of these balls reaches a place outside the protection zone that a sheet hides
/// from a: a *leak*. Looked for in each ball are its centre, the places farthest off the planes of the triangles near
/// its seeds, those right over its seeds, and those over the triangles, just out of the zone (of any other fault's as
/// well: what falls into one is pushed out of it). Edges between seeds of faults that do not both meet the crossed one
/// are leaks as they are. Edges between two other vertices are ruled out likewise, one of them being hidden from a,
/// unless both see a round a rim: so a ball leaks as well that has room for a chord through a triangle whose ends are
/// out of the zone.

#include <array>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "tess/barrier.hpp"
#include "tess/base/no_index.hpp"
#include "tess/base/poll.hpp"

namespace terratet {

class LeakSheets;

struct Leak {
    Vec3 center;  ///< of the empty ball; of an edge between seeds that over it
    double radius = 0;
    bool between_seeds = false;
    std::uint32_t from = 0;       ///< site of the seed that the edge would start from
    Vec3 to;                      ///< and where it could lead
    std::uint32_t barrier = 0;    ///< the one it would cross
    Vec3 place;                   ///< where its sheet runs through the ball
    std::uint32_t protector = 0;  ///< of the faults with seeds on the ball, the one with the widest protection
    std::uint32_t number = 0;     ///< among those found together
};

/// The seeds as sites of a tessellation that pairs join and leave.
class LeakFinder {
  public:
    struct Site {
        Vec3 position;
        Vec3 base;    ///< of its pair, half way between the two
        Vec3 normal;  ///< from the − to the + seed
        std::uint32_t owner = 0;
        std::uint32_t first = 0;  ///< site of its pair's + seed; the − seed is the next
        bool present = true;
    };

    /// Asks the poll on the way. \pre The faults outlive this.
    LeakFinder(std::span<const Barrier> barriers, const Box3& hull, const Poll& poll = {});
    ~LeakFinder();
    LeakFinder(const LeakFinder&) = delete;
    LeakFinder& operator=(const LeakFinder&) = delete;

    /// Where the tessellation changed since the last time; at first everywhere. One for each ball and edge. Tells the
    /// progress the share of the balls that were looked at.
    [[nodiscard]] std::vector<Leak> find(const std::function<void(double)>& progress = {});

    /// Those of the faults, in their order, and of pairs added; then the hull box's corners, without an owner.
    [[nodiscard]] const std::vector<Site>& sites() const;

    /// Other vertices keep out of the ball of the fault's protection radius round the centre as well.
    void protect(std::uint32_t barrier, const Vec3& center);
    [[nodiscard]] bool protects(const Leak& leak) const;  ///< the leak's whole ball, in one such ball

    /// Makes the next find() look at the leak's ball again. \pre The leak is of the last one, and nothing changed.
    void look_again(const Leak& leak);

    std::uint32_t add_pair(std::uint32_t barrier, const Vec3& plus, const Vec3& minus);  ///< returns its first site
    void drop_pair(std::uint32_t first);

    [[nodiscard]] double distance_to_seed(const Vec3& p) const;
    [[nodiscard]] const LeakSheets& sheets() const;
    /// Sites of the cells at a pair's seeds, but for the infinite ones; some twice.
    [[nodiscard]] std::vector<std::array<std::uint32_t, 4>> cells_at(std::uint32_t first) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace terratet
