// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Text for people: wrapping and grouping.

#include <cstdint>
#include <string>
#include <string_view>

namespace terratet::tools {

/// Breaks at blanks so that no line but one of a single word exceeds `width`; lines after the first start with `indent`
/// blanks, and the first has `first_column` columns taken already.
std::string wrapped(std::string_view text, std::size_t first_column, std::size_t indent, std::size_t width = 80);

/// 1292 as "1 292".
std::string grouped(std::uint64_t number);

/// At most six significant digits, without trailing zeros: "80", "1.41421", "1e-12".
std::string short_number(double number);

/// "1.4 MB".
std::string byte_size(std::uint64_t bytes);

/// A message on one line: line ends and runs of blanks become one blank.
std::string one_line(std::string_view text);

}  // namespace terratet::tools
