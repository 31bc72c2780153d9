// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Which column of a table carries which meaning.

#include <string>
#include <utility>
#include <vector>

#include "io/base/table.hpp"

namespace terratet {

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
