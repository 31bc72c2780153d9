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

/// Meaning → column's name, from `--columns`. A meaning may come several times, for tables that name it differently.
using ColumnNames = std::vector<std::pair<std::string, std::string>>;

/// Which column carries a meaning: the one named in `overrides` if this table has it (in any case), else the first of
/// the usual aliases in any case, punctuation and units left out (BHID, HOLEID, "Hole-ID", Depth_m, "Easting [m]"; all
/// of them in docs/inputs.md); −1 when none does. Throws UsageError when an override names a column that is not there
/// and no alias is either, and for a meaning that does not exist.
int find_column(const Table& table, Meaning meaning, const ColumnNames& overrides);

/// As find_column, but for a table that may do without the meaning: −1 also where find_column would throw.
int find_optional_column(const Table& table, Meaning meaning, const ColumnNames& overrides);

/// The column of that name, in any case; −1 when there is none.
int column_named(const Table& table, const std::string& name);

/// "id", "x", …: as `--columns` names them.
const char* to_string(Meaning meaning);

/// The aliases of a meaning, in the normal form that headers are brought to, by falling precedence.
const std::vector<std::string>& aliases(Meaning meaning);

/// Does a header of heights say that they count downwards (TVDSS, Z_TVD, depth)?
bool names_depth(const std::string& header);

/// A header in normal form: lower case, letters and digits only, without a bracketed or trailing unit.
std::string normal_header(const std::string& header);

}  // namespace terratet
