// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Questions about faults: how near, and does a segment cross. Immutable after construction; all queries are const and
/// safe from many threads.

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "tess/barrier.hpp"

namespace terratet {

struct EstimationBarriers;
struct RimTurns;

class BarrierQuery {
  public:
    /// The sheets of faults bar estimation, as far as they go. \pre The faults outlive this.
    explicit BarrierQuery(std::span<const Barrier> barriers);

    /// What bars estimation is given (tess/barrier/query/estimation_barriers.hpp): for a model's faults
    /// model_proximity() (model.hpp) does it.
    BarrierQuery(std::span<const Barrier> barriers, const EstimationBarriers& bars);
    ~BarrierQuery();
    BarrierQuery(BarrierQuery&&) noexcept;
    BarrierQuery& operator=(BarrierQuery&&) noexcept;

    [[nodiscard]] std::span<const Barrier> barriers() const;
    [[nodiscard]] bool empty() const;

    /// The first fault (smallest index) whose sheet or margin is nearer to p than its protection radius, which is
    /// smaller where its triangles are smaller than the spacing; −1 when none. Constant time far from all faults.
    [[nodiscard]] std::int32_t protecting_barrier(const Vec3& p) const;

    /// Does the closed segment meet fault f's sheet? Exact predicates. O(log n).
    [[nodiscard]] bool crosses(std::int32_t barrier, const Vec3& a, const Vec3& b) const;

    /// As the estimation of a property sees it: with the horizons as barriers where they are hard for it. Itself else.
    [[nodiscard]] const BarrierQuery& seen_by(std::size_t property) const;
    /// As the strictest of the properties does.
    [[nodiscard]] const BarrierQuery& with_horizons() const;

    /// Does it meet anything that bars estimation, but for what belongs to fault `except` (−1: all count)?
    [[nodiscard]] bool crosses_any(const Vec3& a, const Vec3& b, std::int32_t except = -1) const;

    /// How freely a sees b: 0 where the closed segment meets a barrier, else the distance at which it passes the
    /// nearest free rim, in units of that fault's spacing, but at most 1. Continuous in a and b until one of them meets
    /// a barrier: what estimators weigh samples with whose field is to be continuous round a fault's end.
    [[nodiscard]] double openness(const Vec3& a, const Vec3& b) const;

    /// Does fault f bar it?
    [[nodiscard]] bool bars(std::int32_t barrier) const;

    /// Where ways round what bars turn (rim_turns.hpp). Found when first asked for: some 0.1 s.
    [[nodiscard]] const RimTurns& turns() const;

    /// Where a place that lies exactly on barriers, hard horizons among them, is thought to be: a billionth of the
    /// spacing away or little more, on the given side of `fault` (−1: of all that meet there), and on the + side where
    /// none is given. Any other place stays. A pure function of its arguments.
    [[nodiscard]] Vec3 off_barriers(const Vec3& p, std::int32_t barrier = -1, std::int8_t side = 0) const;

    /// Do the sheets of the two share a point? A fault meets itself.
    [[nodiscard]] bool meet(std::int32_t barrier, std::int32_t other) const;

    /// On which side of fault f's sheet is p: +1 where the normals point, −1, or 0 on the sheet? Told by the exact
    /// orientation to a triangle that nothing of the sheet hides from p (F2). Beyond a rim the sheet is thought to go
    /// on. \pre The fault has triangles. O(log n).
    [[nodiscard]] std::int8_t side_of(std::int32_t barrier, const Vec3& p) const;

    /// Distance from p to fault f's sheet; infinity for a fault without triangles.
    [[nodiscard]] double distance_to_sheet(std::int32_t barrier, const Vec3& p) const;

  private:
    struct Impl;
    struct Made {};
    BarrierQuery(std::unique_ptr<Impl> impl, Made);
    std::unique_ptr<Impl> impl_;
};

/// Above any topography among the surfaces?
bool is_above_ground(const BarrierQuery& barriers, const Vec3& p);

}  // namespace terratet
