// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read/read_points.hpp"

#include "io/read/read_positions.hpp"

namespace terratet {

PointTable read_points(const Source& source, const Frame& frame, const std::string& source_crs,
                       const ColumnNames& columns, Diagnostics& diagnostics) {
    Table table = read_table(source);
    for (const auto& note : table.notes) {
        diagnostics.note(note);
    }
    // A local frame has no WKT of its own.
    const Crs target = frame.crs_wkt.empty() ? parse_crs("local") : crs_from_wkt(frame.crs_wkt);
    const std::string general = !source_crs.empty() ? source_crs : frame.crs_wkt.empty() ? "local" : frame.crs_wkt;
    PlacedTable placed = place(std::move(table), source, general, columns, diagnostics);
    to_crs(placed, target, diagnostics);
    for (Vec3& p : placed.points) {
        p = frame.to_local(p);
    }
    return {std::move(placed.table), std::move(placed.points)};
}

}  // namespace terratet
