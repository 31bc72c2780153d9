// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Which fault block a place is in, before there is a model: blocks are those of the faults in the extent, whatever the
/// samples and the refinement; their cells are those between seeds and hull box alone.

#include <span>

#include "tess/barrier.hpp"
#include "tess/domain.hpp"
#include "tess/mesh/mesh_walk.hpp"

namespace terratet {

class BlockFinder {
  public:
    BlockFinder(const Domain& domain, std::span<const Barrier> barriers);
    BlockFinder(const BlockFinder&) = delete;
    BlockFinder& operator=(const BlockFinder&) = delete;

    /// −1 in a gap and outside the extent. A short walk from the last place. Not for several threads at once.
    [[nodiscard]] std::int32_t at(const Vec3& place) const;

  private:
    TetMesh mesh_;
    std::vector<std::int32_t> block_;  ///< by cell
    mutable MeshWalk walk_{mesh_};
};

}  // namespace terratet
