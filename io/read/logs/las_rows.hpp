// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Rows of a LAS data section: delimiters, wrapping, numbers that ran together.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/read/logs/las_header.hpp"
#include "io/read/logs/well_words.hpp"

namespace terratet {

/// Takes lines and fills a table.
class LasRows {
  public:
    /// \param items  of the section's definition; empty: the columns follow from the first row and `titles`
    LasRows(const LasHeader& header, const LasSection& section, std::vector<LasItem> items, const std::string& file);

    /// \param bytes  of the file read so far
    void add(std::string_view line, std::int64_t number, std::uint64_t bytes);

    /// Call at the section's end. Without a row: a table without rows.
    Table finish();

    [[nodiscard]] const std::vector<LasItem>& items() const { return items_; }
    [[nodiscard]] const std::string& name() const { return name_; }

    /// Line and reason.
    std::vector<std::pair<std::int64_t, std::string>> rejected;
    std::vector<std::string> notes;

  private:
    void begin(std::string_view line);
    void split(std::string_view line);
    void split_run_on();
    void take_row(std::int64_t number, std::uint64_t bytes);
    void add_wrapped(std::int64_t number, std::uint64_t bytes);
    void reject(std::int64_t number, std::string reason);
    std::string cell(std::string_view token) const;

    std::string name_;
    std::vector<LasItem> items_;
    std::vector<std::string> titles_;
    LogTable table_;
    char delimiter_;
    bool delimiter_said_;
    bool wrapped_;
    bool begun_ = false;
    bool depth_alone_ = false;  ///< wrapped rows begin with a line of their own for the depth
    std::optional<double> null_;
    std::string null_text_;
    std::vector<std::string_view> tokens_;
    std::vector<std::string> wrapped_cells_;
    std::string open_;  ///< a row whose quotation goes on in the next line
    std::int64_t open_line_ = 0;
    std::uint64_t rejections_ = 0;
    std::size_t short_rows_ = 0;
    std::size_t long_rows_ = 0;
    std::size_t run_on_ = 0;
};

}  // namespace terratet
