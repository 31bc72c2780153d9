// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Columns that say of the values beside them that they are bounds: AS_QUAL "<" beside AS_MGKG 5.

#include <vector>

#include "io/read/tables/read_table.hpp"
#include "tess/samples.hpp"

namespace terratet {

/// Of each column of a table: the column that qualifies it; −1: none. A qualifier is named (`columns` qualifier=NAME,
/// as often as there are), or holds nothing but <, >, <=, >= and = and at least one of them that bounds. It qualifies
/// the column of values that shares its name (AS_QUAL: AS_MGKG, Q_AS: AS), else its right neighbour, else its left one;
/// a named one also where it holds letters of laboratories (ND, U, BDL, LT, GT).
std::vector<int> qualifiers(const Table& table, const ColumnNames& columns);

/// What a qualifier's cell says of the value beside it.
Censoring qualifier_of(std::string_view cell);

}  // namespace terratet
