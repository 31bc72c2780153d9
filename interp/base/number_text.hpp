// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Numbers as specifications write them.

#include <optional>
#include <string>

namespace terratet {

/// A finite number and nothing else.
std::optional<double> number_in(const std::string& text);

/// The shortest text that reads back as the same number.
std::string shortest(double value);

/// To so many significant digits, as few as it takes to be read by people too.
double rounded(double value, int digits);

}  // namespace terratet
