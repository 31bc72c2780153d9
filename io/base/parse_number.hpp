// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Cells of a table as numbers.

#include <cstddef>
#include <optional>
#include <string_view>

namespace terratet {

/// A whole cell as a number, independent of the locale; surrounding blanks allowed. nullopt for text or an empty cell;
/// NaN and infinities are refused too.
std::optional<double> parse_number(std::string_view text);

/// A bound in place of a number, "<0.005", ">= 100" or "≤ 3": what is right of the sign.
std::optional<double> parse_bound(std::string_view text);

/// How many bytes at the beginning of a cell are the sign of a bound (<, >, <=, =<, ≤, …); 0: it is none.
std::size_t bound_sign(std::string_view text);

/// Does a bound say that the truth is at or below it?
bool is_upper_bound(std::string_view text);

}  // namespace terratet
