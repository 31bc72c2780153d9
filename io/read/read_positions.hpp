// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Positions of a table's rows, from columns or from its geometry, and the CRS they are in.

#include <string>
#include <vector>

#include "io/base/crs.hpp"
#include "io/read/tables/null_codes.hpp"
#include "io/read/tables/read_table.hpp"
#include "io/site_inputs.hpp"
#include "tess/diagnostics.hpp"

namespace terratet {

/// A table whose rows have places.
struct PlacedTable {
    Table table;
    Crs crs;                            ///< of `points`
    std::vector<Vec3> points;           ///< a row each; NaN on all axes where the record was rejected
    std::vector<double> own_heights{};  ///< after to_crs: in the original CRS
    std::vector<double> north_deg{};    ///< after to_crs: direction of the original CRS's north, clockwise from `crs`'s

    [[nodiscard]] bool usable(std::size_t row) const { return is_finite(points[row]); }
};

/// How a table's coordinates are to be understood.
struct PlaceOptions {
    ZPositive z_positive = ZPositive::automatic;
    std::vector<NullValue> nulls{};
    bool some_usable = true;  ///< of the rows, or InputError
};

/// Reads positions. Columns count, unless the layer has points in a known CRS that differ from them (noted): those are
/// sure to be in that CRS. Heights come from a column, else from the geometry. Rejects records without numbers, with a
/// coordinate beyond max_coordinate, with a latitude or longitude that is none, or with one that stands for no value
/// (PlaceOptions::nulls; usual codes far outside the others). Longitudes and latitudes may be in degrees, minutes and
/// seconds. Heights in columns called depths are turned (noted). Places outside the CRS's area of use are noted. Throws
/// InputError: no coordinates, no height, no CRS (in the source, in the file, or `general_crs`), degrees in a projected
/// CRS, no usable row.
PlacedTable place(Table table, const Source& source, const std::string& general_crs, const ColumnNames& columns,
                  Diagnostics& diagnostics, const PlaceOptions& options = {});

/// Transforms the points; rejects records that PROJ cannot transform. Throws InputError when no row is left, unless
/// that is allowed.
void to_crs(PlacedTable& placed, const Crs& target, Diagnostics& diagnostics, bool some_usable = true);

/// The CRS of an input: its own srs=, else the file's, else the general one. Throws InputError naming -s_srs when there
/// is none; `hint` is appended.
Crs resolved_crs(const Source& source, const Crs& in_file, const std::string& general_crs,
                 const std::string& hint = {});

/// Throws InputError "FILE: no usable row…" with the first reason among the rejections from `first_rejection` on.
[[noreturn]] void throw_no_usable_row(const Table& table, const Diagnostics& diagnostics, std::size_t first_rejection);

}  // namespace terratet
