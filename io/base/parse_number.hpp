// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Cells of a table as numbers.

#include <optional>
#include <string>

namespace terratet {

/// A whole cell as a number, independent of the locale; surrounding blanks allowed. nullopt for text or an empty cell;
/// NaN and infinities are refused too.
std::optional<double> parse_number(const std::string& text);

/// A bound in place of a number, "<0.005" or ">= 100": what is right of the sign.
std::optional<double> parse_bound(const std::string& text);

}  // namespace terratet
