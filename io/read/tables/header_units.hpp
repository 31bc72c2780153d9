// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The unit of length that a table states beside a column of depths, lengths or heights.

#include <optional>
#include <string>

#include "io/base/table.hpp"

namespace terratet {

struct StatedUnit {
    std::string text;  ///< as written: "ft"
    double metres = 1;
};

/// In a row of units below the header, in brackets, or as the last word of the column's name: "Depth (ft)", FROM_FT,
/// "to [m]", "elevation m a.s.l."; none where there is none, or none of length.
std::optional<StatedUnit> stated_length_unit(const Table& table, int column);

}  // namespace terratet
