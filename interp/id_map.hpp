// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// A small hash map from ids to local numbers that stays in the first-level cache and is cleared in the time it took to
/// fill. Open addressing, at most half full.

#include <cstdint>
#include <utility>
#include <vector>

namespace terratet {

class IdMap {
  public:
    IdMap() : slots_(std::size_t(1) << initial_bits, Slot{empty, 0}), shift_(32 - initial_bits) {}

    void clear() {
        for (const std::uint32_t slot : used_) {
            slots_[slot].id = empty;
        }
        used_.clear();
    }

    /// The number of `id`, and whether it is the one given here. \pre id >= 0
    std::pair<std::int32_t, bool> insert(std::int32_t id, std::int32_t number) {
        std::uint32_t slot = first_slot(id);
        for (; slots_[slot].id != empty; slot = next(slot)) {
            if (slots_[slot].id == id) {
                return {slots_[slot].number, false};
            }
        }
        slots_[slot] = {id, number};
        used_.push_back(slot);
        if (2 * used_.size() > slots_.size()) {
            grow();
        }
        return {number, true};
    }

    /// Gives the id inserted last another number.
    void replace_last(std::int32_t number) { slots_[used_.back()].number = number; }

  private:
    struct Slot {
        std::int32_t id;
        std::int32_t number;
    };
    static constexpr std::int32_t empty = -1;
    static constexpr unsigned initial_bits = 8;

    [[nodiscard]] std::uint32_t first_slot(std::int32_t id) const {
        return static_cast<std::uint32_t>(id) * 2654435769u >> shift_;  // Fibonacci hashing
    }
    [[nodiscard]] std::uint32_t next(std::uint32_t slot) const {
        return (slot + 1) & (static_cast<std::uint32_t>(slots_.size()) - 1);
    }
    void grow() {
        std::vector<Slot> old(2 * slots_.size(), Slot{empty, 0});
        old.swap(slots_);
        --shift_;
        for (std::uint32_t& used : used_) {
            const Slot entry = old[used];
            std::uint32_t slot = first_slot(entry.id);
            while (slots_[slot].id != empty) {
                slot = next(slot);
            }
            slots_[slot] = entry;
            used = slot;
        }
    }

    std::vector<Slot> slots_;
    std::vector<std::uint32_t> used_;  ///< in the order of insertion
    unsigned shift_;
};

}  // namespace terratet
