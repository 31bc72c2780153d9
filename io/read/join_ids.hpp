// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Ids of surveys and logs as their collars have them, though tables write or call them otherwise.

#include <vector>

#include "io/read/read_positions.hpp"
#include "tess/diagnostics.hpp"

namespace terratet {

/// Rewrites the id column of a survey or log to the ids under which the collars go (their own id column's):
/// * The columns joined are those that have the most holes in common: of a table with CollarID and HoleId that which
///   the other table has (noted where it is not the usual one). `columns` id= settles it.
/// * An id that is no collar's, but one alone but for leading zeros, case, ".0", blanks, dashes or underlines, is that
///   one's (noted), unless the table has that one too, or another id like it: then it stays, and a note tells.
void join_ids(Table& table, const std::vector<PlacedTable>& collars, const ColumnNames& columns,
              Diagnostics& diagnostics);

/// An id as it is compared: without case, blanks, dashes and underlines, leading zeros, and a trailing ".0".
std::string near_id(std::string_view id);

}  // namespace terratet
