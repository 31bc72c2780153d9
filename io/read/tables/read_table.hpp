// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Attribute tables of any GDAL vector source as text columns: numbers are parsed by whoever knows what a column means,
/// so that ids stay text ("0.0", "Dec-35") and a word among numbers is found and named.

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/base/parse_number.hpp"
#include "io/base/table.hpp"
#include "io/read/tables/columns.hpp"
#include "io/source.hpp"

namespace terratet {

/// Columns without a name and without any cell (trailing separators) are left out. Where no number of a column has a
/// decimal point and some can only have a decimal comma, commas become points (noted). Throws InputError: not found,
/// not a table, no such layer (lists those there are), no row. Opens with a list of allowed drivers only (GDAL's DXF
/// reader can hang on hostile input, its GML one writes beside the file).
Table read_table(const Source& source);

/// The same some rows at a time, where the source is a text, in memory that does not grow; what is no text comes whole.
/// Which columns are left out is decided by the first rows, how numbers are written by those read together.
class TableReader {
  public:
    explicit TableReader(Source source);
    ~TableReader();
    TableReader(TableReader&&) noexcept;

    /// Up to `most` further rows; nothing: at the end. Throws as read_table does.
    std::optional<Table> next(std::size_t most);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace terratet
