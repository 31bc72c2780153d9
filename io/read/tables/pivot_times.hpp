// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Tables with a row a place and time, as one row a place.

#include <optional>
#include <string>
#include <vector>

#include "io/read/tables/read_table.hpp"
#include "tess/diagnostics.hpp"

namespace terratet {

/// The times that a table has, as labels (io/base/time_steps.hpp), each once; none where it has no such column.
std::vector<std::string> times_in(const Table& table, const std::string& column);

/// Each column that says no place becomes one for each of `times`: P@T. Rows of one place become one, the first of
/// them. Rejects rows without a time, and those of a place and time that are on a line above.
/// \param wanted  the properties that were asked for
/// \returns for each row the one it was
std::vector<std::size_t> pivot_times(Table& table, const std::string& column, const std::vector<std::string>& times,
                                     const ColumnNames& names, const std::vector<std::string>& wanted,
                                     Diagnostics& diagnostics);

/// Properties that were asked for (NAME[:…]), of those that `table` has over time one for each of them.
std::vector<std::string> properties_over_time(const std::vector<std::string>& wanted, const Table& table,
                                              const std::vector<std::string>& times);

}  // namespace terratet
