// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Rows that others name by number.

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

namespace terratet {

/// Index of a row by its number in the file, which need not count up without gaps once a model was edited.
class RowIndex {
  public:
    void add(std::int64_t row) { rows_.push_back(row); }

    [[nodiscard]] std::optional<std::size_t> find(std::int64_t row) const {
        const std::size_t guess = static_cast<std::size_t>(row) - 1;
        if (guess < rows_.size() && rows_[guess] == row) {
            return guess;
        }
        const auto found = std::lower_bound(rows_.begin(), rows_.end(), row);
        return found != rows_.end() && *found == row ? std::optional(static_cast<std::size_t>(found - rows_.begin()))
                                                     : std::nullopt;
    }

    [[nodiscard]] const std::vector<std::int64_t>& rows() const { return rows_; }

  private:
    std::vector<std::int64_t> rows_;  ///< ascending
};

}  // namespace terratet
