// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Sets of, and maps from, small whole numbers that are emptied in no time: an entry counts only if it carries the
/// stamp of the day. Direct addressing, 4 or 8 bytes for each number there may be; no hashing.

#include <algorithm>
#include <cstdint>

#include "interp/base/huge_pages.hpp"

namespace terratet {

/// Numbers below the size given to clear().
class StampedSet {
  public:
    void clear(std::size_t size) {
        if (stamps_.size() < size) {
            stamps_.resize(size, 0);
        }
        if (++today_ == 0) {  // after four billion days
            std::fill(stamps_.begin(), stamps_.end(), 0u);
            today_ = 1;
        }
    }
    [[nodiscard]] bool contains(std::int32_t i) const { return stamps_[static_cast<std::size_t>(i)] == today_; }
    void insert(std::int32_t i) { stamps_[static_cast<std::size_t>(i)] = today_; }

  private:
    HugePageVector<std::uint32_t> stamps_;
    std::uint32_t today_ = 0;
};

/// From numbers below the size given to clear() to others.
class StampedMap {
  public:
    void clear(std::size_t size) {
        if (slots_.size() < size) {
            slots_.resize(size, Slot{0, 0});
        }
        if (++today_ == 0) {
            std::fill(slots_.begin(), slots_.end(), Slot{0, 0});
            today_ = 1;
        }
    }
    [[nodiscard]] bool contains(std::int32_t key) const {
        return slots_[static_cast<std::size_t>(key)].stamp == today_;
    }
    /// \pre contains(key)
    [[nodiscard]] std::int32_t operator[](std::int32_t key) const {
        return slots_[static_cast<std::size_t>(key)].value;
    }
    void insert(std::int32_t key, std::int32_t value) { slots_[static_cast<std::size_t>(key)] = {today_, value}; }

  private:
    struct Slot {
        std::uint32_t stamp;
        std::int32_t value;
    };
    HugePageVector<Slot> slots_;
    std::uint32_t today_ = 0;
};

}  // namespace terratet
