// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The cells of a tessellation grouped by their circumspheres, so that a conflict zone of thousands of cells is found
/// and summed by groups. Between two straight rows of n and m samples there are up to nm cells, and most places among a
/// few dense boreholes are in conflict with a quarter of them; but the zone's boundary has only as many facets as twice
/// its vertices, and cells away from the boundary matter only by their sums.
///
/// The power of a place q in a sphere, |q|² − 2q·c + (|c|² − r²), is linear in c and in w = |c|² − r². So bounds of c
/// and w over a group bound the powers of q in all its spheres. A group all of whose cells, and all of whose cells'
/// neighbours, are in conflict lies inside the zone and touches none of its boundary.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "interp/sites/compact_cells.hpp"

namespace terratet {

class SphereTree {
  public:
    struct VertexSum {
        std::int32_t vertex;
        double sum;  ///< of the parts about it of the group's cells
    };

    /// O(n log n); about as many bytes a cell as the cell itself.
    explicit SphereTree(const CompactCells& mesh);

    /// Divides the conflict zone of q into whole groups and single cells. The cells that the latter leave out of the
    /// zone hold none of it. \pre within_reach(q)
    void find(const CompactCells& mesh, const Vec3& q, std::vector<std::uint32_t>& groups,
              std::vector<std::int32_t>& cells) const;

    [[nodiscard]] std::span<const VertexSum> sums(std::uint32_t group) const {
        const Group& g = groups_[group];
        return std::span(sums_).subspan(g.sums_begin, g.sums_end - g.sums_begin);
    }
    [[nodiscard]] std::span<const std::int32_t> cells(std::uint32_t group) const {
        const Group& g = groups_[group];
        return std::span(cells_).subspan(g.begin, g.end - g.begin);
    }
    [[nodiscard]] std::size_t memory_bytes() const;

  private:
    using Lifted = std::array<double, 4>;  ///< c and w of a sphere
    struct Range {
        Lifted lo, hi;
        void extend(const Lifted& p);
        void extend(const Range& other);
    };
    struct Group {
        Range own;   ///< of its cells
        Range halo;  ///< of their neighbours as well
        std::uint32_t begin, end;
        std::uint32_t second = 0;  ///< of its halves; the first follows at once; 0: a leaf
        std::size_t sums_begin = 0, sums_end = 0;
    };

    Lifted lifted(const CompactCells::Cell& cell) const;
    void split(const CompactCells& mesh, std::uint32_t begin, std::uint32_t end);
    void bound(const CompactCells& mesh, Group& leaf) const;

    Vec3 origin_;
    double reach_ = 0;   ///< of places from the origin: what w is divided by to be compared with c
    double margin_ = 0;  ///< more than a power may be off
    std::vector<std::int32_t> cells_;
    std::vector<Group> groups_;
    std::vector<VertexSum> sums_;
};

}  // namespace terratet
