// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Rows of a table that are no records: titles above the header, and units below it.

#include <span>
#include <string>
#include <vector>

#include "io/base/table.hpp"

namespace terratet {

/// How far down a header is looked for.
inline constexpr std::size_t most_title_rows = 30;

/// Do at least two of them carry a meaning (id, x, from, …)?
bool names_columns(const std::vector<std::string>& names);

/// Which of the first records of a text is the header: the first, or, where that names no columns, the first one below
/// that does and holds no number. 0 when none does.
std::size_t header_record(std::span<const std::vector<std::string>> records);

/// The same for a table whose columns were called by its first row: notes, a title or groups of columns (noted).
void promote_header(Table& table);

/// A first row that holds units and nothing else (m, ft, %, g/t, [ppm], …) becomes the columns' units (noted).
void take_units_row(Table& table);

}  // namespace terratet
