// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Attribute tables of any GDAL vector source as text columns: numbers are parsed by whoever knows what a column means,
/// so that ids stay text ("0.0", "Dec-35") and a word among numbers is found and named.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/crs.hpp"
#include "io/source.hpp"
#include "tess/geometry.hpp"

namespace terratet {

struct Table {
    std::string file;                              ///< for messages
    std::vector<std::string> columns;
    std::vector<std::vector<std::string>> cells;   ///< [column][row]; empty text: null
    std::vector<std::optional<Vec3>> points;       ///< geometry of a point layer; empty when there is none
    std::vector<std::int64_t> lines;               ///< 1-based line (text files) or record of each row
    Crs crs;                                       ///< of the geometry, when the source says so

    [[nodiscard]] std::size_t rows() const { return lines.size(); }
};

/// Throws InputError: not found, not a table, no such layer (lists those there are), no row. Opens with a list of allowed
/// drivers only (GDAL's DXF reader can hang on hostile input, its GML one writes beside the file).
Table read_table(const Source& source);

/// Which column carries a meaning, by the usual aliases in any case (BHID, HOLEID, DHID, …); −1 when none does.
/// `overrides` maps a meaning to a column's name (`--columns id=WELL`); naming a column that is not there is a UsageError.
enum class Meaning { id, x, y, z, from, to, depth, azimuth, dip, length, name };
int find_column(const Table& table, Meaning meaning, const std::vector<std::pair<std::string, std::string>>& overrides);

/// A whole cell as a number, independent of the locale; surrounding blanks allowed. nullopt for text or an empty cell;
/// NaN and infinities are refused too.
std::optional<double> parse_number(const std::string& text);

}  // namespace terratet
