// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The resolution in force: Criteria's l_min and l_max, or those of the overrides, and finer where samples ask for it.
///
/// l_min is a matter of places: it guards where a new vertex would go. l_max is a matter of cells: a cell has to meet
/// the finest l_max of all parts that its bounding box touches, so that a small box is not overlooked by large cells.

#include <memory>
#include <span>

#include "tess/barrier.hpp"
#include "tess/criteria.hpp"
#include "tess/domain.hpp"
#include "tess/mesh/quality.hpp"
#include "tess/model/graded_sizes.hpp"

namespace terratet {

class ResolutionField {
  public:
    /// Barrier blocks are BlockFinder' (tess/model/block_finder.hpp). Throws UsageError when the point that names a
    /// block lies outside the extent or in a fault's gap. `criteria` and `domain` must outlive the field.
    ResolutionField(const Criteria& criteria, const Domain& domain, std::span<const Barrier> barriers);
    ~ResolutionField();
    ResolutionField(ResolutionField&&) noexcept;

    /// No overrides: the same everywhere but for fine places.
    [[nodiscard]] bool uniform() const { return criteria_.overrides.empty(); }

    /// How near to another an inserted vertex may come there. O(overrides), logarithmic in the fine places, and a short
    /// walk when there are blocks among the overrides. Not for several threads at once.
    [[nodiscard]] double l_min(const Vec3& place) const { return fine_.at(place, part_l_min(place, between_)); }

    /// How near to another a sample is kept there; likewise.
    [[nodiscard]] double sample_l_min(const Vec3& place) const {
        return fine_.at(place, part_l_min(place, criteria_.l_min));
    }

    /// Puts others in the place of the criteria's fine places.
    void set_fine(std::span<const FinePlace> places) { fine_ = GradedSizes(places); }

    /// l_min of inserted vertices where neither overrides nor fine places say otherwise.
    [[nodiscard]] double between() const { return between_; }
    void set_between(double l_min) { between_ = l_min; }

    /// What the cell's longest edge must not exceed.
    [[nodiscard]] double l_max(const CellPoints& cell) const {
        return uniform() ? criteria_.l_max : l_max_by_part(cell);
    }

    [[nodiscard]] double smallest_l_min() const;
    [[nodiscard]] double largest_l_min() const;         ///< of inserted vertices
    [[nodiscard]] double largest_sample_l_min() const;  ///< of samples

    /// R1: no more vertices fit, each at least its place's l_min from the others of its part.
    [[nodiscard]] double packing_bound() const;

  private:
    struct Blocks;

    [[nodiscard]] double part_l_min(const Vec3& place, double elsewhere) const {
        return uniform() ? elsewhere : l_min_by_part(place, elsewhere);
    }
    [[nodiscard]] double l_min_by_part(const Vec3& place, double elsewhere) const;
    [[nodiscard]] double largest_by_part(double elsewhere) const;
    [[nodiscard]] double l_max_by_part(const CellPoints& cell) const;

    const Criteria& criteria_;
    const Domain& domain_;
    double between_;
    GradedSizes fine_;
    std::unique_ptr<Blocks> blocks_;  ///< null when no override needs them
};

/// √2·|Ω ⊕ l_min/2| / l_min³: no more points at mutual distance l_min fit into the box (Kepler).
double packing_bound(const Box3& hull, double l_min);

}  // namespace terratet
