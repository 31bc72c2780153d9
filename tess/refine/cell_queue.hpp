// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Cells waiting: the bad ones for treatment, others for a test.
///
/// Worst first, by eighths of an octave of the violation; within one such class the latest first, so that work stays
/// where the caches are warm. The order depends on the order of pushes alone, hence is deterministic when that is.
///
/// A cell carries the slot of its entry and the queue's mark as its tag, so it waits in one queue at most; whoever
/// destroys a cell calls forget() of all queues first, so no entry ever refers to a cell that is gone. A tag
/// that others left says nothing: the entry's cell tells whose it is.

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "tess/mesh/delaunay.hpp"

namespace terratet {

class CellQueue {
  public:
    struct Entry {
        delaunay::Cell cell;
        double violation;
        std::uint32_t slot;  ///< free for others from now on
    };

    /// Two queues that share cells have different marks.
    explicit CellQueue(std::uint32_t mark = 0) : mark_(mark << 31U) {}

    /// Returns the entry's slot: small numbers, each free again once its entry has been popped.
    std::uint32_t push(delaunay::Cell cell, double violation) {
        std::uint32_t slot = 0;
        if (free_.empty()) {
            slot = static_cast<std::uint32_t>(cells_.size());
            cells_.emplace_back(cell, violation);
        } else {
            slot = free_.back();
            free_.pop_back();
            cells_[slot] = {cell, violation};
        }
        cell->info().tag = slot | mark_;
        const int level = level_of(violation);
        levels_[static_cast<std::size_t>(level)].push_back(slot);
        top_ = std::max(top_, level);
        ++waiting_;
        return slot;
    }

    void forget(delaunay::Cell cell) {
        const std::uint32_t tag = cell->info().tag;
        const std::uint32_t slot = tag & ~mark_bit;
        if ((tag & mark_bit) == mark_ && slot < cells_.size() && cells_[slot].first == cell) {
            cells_[slot].first = delaunay::Cell();
            cell->info().tag = no_index;
            --waiting_;
        }
    }

    /// The next cell, which then is no longer in the queue.
    std::optional<Entry> pop() {
        for (; top_ >= 0; --top_) {
            auto& level = levels_[static_cast<std::size_t>(top_)];
            while (!level.empty()) {
                const std::uint32_t slot = level.back();
                level.pop_back();
                free_.push_back(slot);
                const auto [cell, violation] = std::exchange(cells_[slot], {delaunay::Cell(), 0.0});
                if (cell != delaunay::Cell()) {
                    cell->info().tag = no_index;
                    --waiting_;
                    return Entry{cell, violation, slot};
                }
            }
        }
        return std::nullopt;
    }

    [[nodiscard]] std::size_t waiting() const { return waiting_; }

  private:
    static constexpr int level_count = 64;
    static constexpr std::uint32_t mark_bit = 1U << 31U;

    static int level_of(double violation) {
        const double level = std::floor(8 * std::log2(violation));
        return level >= level_count - 1 ? level_count - 1 : (level > 0 ? static_cast<int>(level) : 0);
    }

    std::uint32_t mark_;
    std::vector<std::pair<delaunay::Cell, double>> cells_;  ///< by slot, with the violation; null once forgotten
    std::vector<std::uint32_t> free_;
    std::array<std::vector<std::uint32_t>, level_count> levels_;
    int top_ = -1;
    std::size_t waiting_ = 0;
};

}  // namespace terratet
