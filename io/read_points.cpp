// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read_points.hpp"

#include "io/read_positions.hpp"

namespace terratet {

PointTable read_points(const Source& source, const Frame& frame, const std::string& source_crs,
                       const ColumnNames& columns, Diagnostics& diagnostics) {
    Table table = read_table(source);
    for (const auto& note : table.notes) {
        diagnostics.note(note);
    }
    const std::string general = source_crs.empty() ? frame.crs_wkt : source_crs;
    PlacedTable placed = place(std::move(table), source, general, columns, diagnostics);
    to_crs(placed, crs_from_wkt(frame.crs_wkt), diagnostics);
    for (Vec3& p : placed.points) {
        p = frame.to_local(p);
    }
    return {std::move(placed.table), std::move(placed.points)};
}

}  // namespace terratet
