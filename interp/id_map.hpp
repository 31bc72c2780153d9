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
    IdMap() : slots_(initial_size, Slot{empty, 0}), used_(initial_size / 2 + 1) {}

    void clear() {
        for (std::size_t i = 0; i < count_; ++i) {
            slots_[used_[i]].id = empty;
        }
        count_ = 0;
    }

    /// The number of `id`, and whether it is the one given here. \pre id >= 0
    std::pair<std::int32_t, bool> insert(std::int32_t id, std::int32_t number) {
        Slot* const slots = slots_.data();
        std::uint32_t slot = first_slot(id);
        for (; slots[slot].id != empty; slot = next(slot)) {
            if (slots[slot].id == id) {
                return {slots[slot].number, false};
            }
        }
        slots[slot] = {id, number};
        used_[count_++] = slot;
        if (2 * count_ > slots_.size()) {
            grow();
        }
        return {number, true};
    }

    /// Gives the id inserted last another number.
    void replace_last(std::int32_t number) { slots_[used_[count_ - 1]].number = number; }

  private:
    struct Slot {
        std::int32_t id;
        std::int32_t number;
    };
    static constexpr std::int32_t empty = -1;
    static constexpr unsigned initial_bits = 8;
    static constexpr std::size_t initial_size = std::size_t(1) << initial_bits;

    [[nodiscard]] std::uint32_t first_slot(std::int32_t id) const {
        return static_cast<std::uint32_t>(id) * 2654435769u >> shift_;  // Fibonacci hashing
    }
    [[nodiscard]] std::uint32_t next(std::uint32_t slot) const { return (slot + 1) & mask_; }
    void grow() {
        std::vector<Slot> old(2 * slots_.size(), Slot{empty, 0});
        old.swap(slots_);
        mask_ = static_cast<std::uint32_t>(slots_.size()) - 1;
        --shift_;
        used_.resize(slots_.size() / 2 + 1);
        for (std::size_t i = 0; i < count_; ++i) {
            const Slot entry = old[used_[i]];
            std::uint32_t slot = first_slot(entry.id);
            while (slots_[slot].id != empty) {
                slot = next(slot);
            }
            slots_[slot] = entry;
            used_[i] = slot;
        }
    }

    std::vector<Slot> slots_;
    std::vector<std::uint32_t> used_;  ///< slots in the order of insertion, the first count_ of them
    std::size_t count_ = 0;
    std::uint32_t mask_ = initial_size - 1;
    unsigned shift_ = 32 - initial_bits;
};

}  // namespace terratet
