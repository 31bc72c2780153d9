// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The bad cells waiting for treatment.
///
/// Worst first, by eighths of an octave of the violation; within one such class the latest first, so that work stays
/// where the caches are warm. The order depends on the order of pushes alone, hence is deterministic when that is.
///
/// A cell carries the slot of its entry as its tag; whoever destroys a cell calls forget() first, so no entry ever
/// refers to a cell that is gone. A tag that others left says nothing: the entry's cell tells whose it is.

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "tess/mesh/delaunay.hpp"

namespace terratet {

class CellQueue {
  public:
    void push(delaunay::Cell cell, double violation) {
        std::uint32_t slot = 0;
        if (free_.empty()) {
            slot = static_cast<std::uint32_t>(cells_.size());
            cells_.push_back(cell);
        } else {
            slot = free_.back();
            free_.pop_back();
            cells_[slot] = cell;
        }
        cell->info().tag = slot;
        const int level = level_of(violation);
        levels_[static_cast<std::size_t>(level)].push_back(slot);
        top_ = std::max(top_, level);
        ++waiting_;
    }

    void forget(delaunay::Cell cell) {
        const std::uint32_t slot = cell->info().tag;
        if (slot < cells_.size() && cells_[slot] == cell) {
            cells_[slot] = delaunay::Cell();
            cell->info().tag = delaunay::none;
            --waiting_;
        }
    }

    /// The next cell, which then is no longer in the queue.
    std::optional<delaunay::Cell> pop() {
        for (; top_ >= 0; --top_) {
            auto& level = levels_[static_cast<std::size_t>(top_)];
            while (!level.empty()) {
                const std::uint32_t slot = level.back();
                level.pop_back();
                free_.push_back(slot);
                if (const delaunay::Cell cell = std::exchange(cells_[slot], delaunay::Cell());
                    cell != delaunay::Cell()) {
                    cell->info().tag = delaunay::none;
                    --waiting_;
                    return cell;
                }
            }
        }
        return std::nullopt;
    }

    [[nodiscard]] std::size_t waiting() const { return waiting_; }

  private:
    static constexpr int level_count = 64;

    static int level_of(double violation) {
        const double level = std::floor(8 * std::log2(violation));
        return level >= level_count - 1 ? level_count - 1 : (level > 0 ? static_cast<int>(level) : 0);
    }

    std::vector<delaunay::Cell> cells_;  ///< by slot; null once forgotten
    std::vector<std::uint32_t> free_;
    std::array<std::vector<std::uint32_t>, level_count> levels_;
    int top_ = -1;
    std::size_t waiting_ = 0;
};

}  // namespace terratet
