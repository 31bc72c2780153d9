// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// What of a model is in the next one too: samples by their places, seeds by their barriers or places.

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "tess/barrier.hpp"
#include "tess/samples.hpp"
#include "tess/tet_mesh.hpp"

namespace terratet {

/// Of each sample the index of the one at the same place in `after`; −1: none. \pre No two are at one place.
std::vector<std::int64_t> matched_samples(const Samples& before, const Samples& after);

class MatchedSeeds {
  public:
    MatchedSeeds(std::span<const Barrier> before, std::span<const Barrier> after);

    /// The barrier of the next model that has this seed too; −1: none.
    [[nodiscard]] std::int32_t owner_after(const Vertex& seed) const;

    struct Coming {
        Vec3 position;
        std::int32_t owner;
        std::int8_t side;
    };
    /// Seeds of barriers that are not as they were, in order.
    [[nodiscard]] const std::vector<Coming>& coming() const { return coming_; }

    /// Round the barriers that are no longer as they were, and round those that were not so before: all they keep off.
    [[nodiscard]] const std::vector<Box3>& old_zones() const { return old_zones_; }
    [[nodiscard]] const std::vector<Box3>& new_zones() const { return new_zones_; }

  private:
    std::vector<std::int32_t> next_of_;                        ///< of each barrier before; −1: none is the same
    std::map<Vec3, std::pair<std::int32_t, std::int8_t>> at_;  ///< seeds that come or stay, of changed barriers
    std::vector<Coming> coming_;
    std::vector<Box3> old_zones_;
    std::vector<Box3> new_zones_;
};

}  // namespace terratet
