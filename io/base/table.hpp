// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// A table as a file holds it: columns of text. What it means is found by its columns' names
/// (io/read/tables/columns.cpp), or stated by a format that knows.

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/base/crs.hpp"
#include "io/base/text_column.hpp"
#include "tess/geometry.hpp"

namespace terratet {

/// What a column may be.
enum class Meaning {
    id,
    x,
    y,
    z,
    from,
    to,
    depth,
    azimuth,
    dip,
    length,
    name,
    qualifier,      ///< says that values beside it are bounds
    dip_direction,  ///< of a trace
    lower_depth,    ///< to which a trace's surface reaches
};

/// What a format says of its own table (LAS, AGS, GEF, …), so that nobody need guess by names. All empty: a plain
/// table.
struct StatedColumns {
    std::vector<std::pair<Meaning, int>> meanings;  ///< where not empty, no other column has a meaning by its name
    std::vector<std::string> units;                 ///< a column each, or none at all
    std::vector<int> asides;                        ///< columns that are no properties unless asked for
    std::vector<std::string> hole_names;            ///< of the one hole that all rows belong to, by falling precedence
    double metres_per_depth = 0;                    ///< of depths along the hole; 0: not said
    bool inclination = false;                       ///< the dips count from the downward vertical
    bool one_of_several = false;                    ///< a file's other tables may do where this one gives nothing

    /// The column of a meaning; −1: none.
    [[nodiscard]] int column(Meaning meaning) const {
        for (const auto& [stated, column] : meanings) {
            if (stated == meaning) {
                return column;
            }
        }
        return -1;
    }
};

/// Cells are text without surrounding blanks; numbers of typed sources (XLSX, GeoPackage) are the shortest text that
/// reads back as the same number, whole ones without a decimal point.
struct Table {
    std::string file;                         ///< for messages
    std::vector<std::string> columns;         ///< as written, without surrounding blanks
    std::vector<TextColumn> cells;            ///< [column][row]; empty text: null
    std::vector<std::optional<Vec3>> points;  ///< geometry of a point layer; empty when there is none; z NaN when 2D
    std::vector<std::int64_t> lines;          ///< 1-based line (text files) or record of each row
    Crs crs;                                  ///< of the geometry, when the source says so
    std::vector<std::string> notes;           ///< assumptions made in reading, for Diagnostics::notes
    StatedColumns stated{};

    [[nodiscard]] std::size_t rows() const { return lines.size(); }
};

}  // namespace terratet
