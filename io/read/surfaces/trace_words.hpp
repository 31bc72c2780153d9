// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Dips and directions as databases of faults write them.

#include <optional>
#include <string_view>

namespace terratet {

/// Degrees from the horizontal: a number ("60", "60°"), the first of a tuple ("(60,50,70)": best, least, most), the
/// middle of a range ("50-70", "50 to 70"), "vertical". nullopt for anything else and beyond 0…90.
std::optional<double> parse_dip(std::string_view text);

/// Degrees clockwise from north: a number, tuple or range as for a dip, or letters ("SE", "NNW", "south-east"). Letters
/// say a quarter, not an angle.
struct Direction360 {
    double degrees = 0;
    bool letters = false;
};
std::optional<Direction360> parse_direction(std::string_view text);

/// A number, the first of a tuple, the middle of a range.
std::optional<double> parse_estimate(std::string_view text);

}  // namespace terratet
