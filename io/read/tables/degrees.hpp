// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Longitudes and latitudes as maps print them.

#include <optional>
#include <string_view>

namespace terratet {

struct Degrees {
    double value = 0;     ///< decimal degrees; south and west are negative
    char hemisphere = 0;  ///< 'N', 'S', 'E' or 'W'; 0: not said
};

/// Degrees with minutes and seconds (41°17'24"S, S 41 17.4, 174d46m48s E, -41:17:24,5) or with a hemisphere (41.29 S).
/// Signs for degrees, minutes and seconds are of any usual kind; O for Ost is not known, for it is West elsewhere.
/// nullopt for anything else, a plain number too; minutes and seconds are below 60, and only the last part has
/// decimals.
std::optional<Degrees> parse_degrees(std::string_view text);

}  // namespace terratet
