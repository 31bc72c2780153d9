// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read/read_points.hpp"

#include <limits>
#include <utility>

#include "io/read/read_positions.hpp"
#include "tess/error.hpp"

namespace terratet {

PointReader::PointReader(Source source, const Frame& frame, std::string source_crs, ColumnNames columns)
    : source_(source),
      frame_(frame),
      source_crs_(std::move(source_crs)),
      columns_(std::move(columns)),
      rows_(std::move(source)) {}

std::optional<PointTable> PointReader::next(std::size_t most, Diagnostics& diagnostics) {
    std::optional<Table> table = rows_.next(most);
    if (!table) {
        if (!any_usable_) {
            throw InputError(source_.describe() + ": none of its rows is usable");
        }
        return std::nullopt;
    }
    for (const auto& note : table->notes) {
        diagnostics.note(note);
    }
    const bool whole = times_++ == 0 && table->rows() < most;
    // A local frame has no WKT of its own.
    const std::string& wkt = frame_.crs_wkt;
    const Crs target = wkt.empty() ? parse_crs("local") : crs_from_wkt(wkt);
    const std::string general = !source_crs_.empty() ? source_crs_ : wkt.empty() ? "local" : wkt;
    PlaceOptions options;
    options.some_usable = whole;
    PlacedTable placed = place(*std::move(table), source_, general, columns_, diagnostics, options);
    to_crs(placed, target, diagnostics, whole);
    for (Vec3& p : placed.points) {
        any_usable_ = any_usable_ || is_finite(p);
        p = frame_.to_local(p);
    }
    return PointTable{std::move(placed.table), std::move(placed.points)};
}

PointTable read_points(const Source& source, const Frame& frame, const std::string& source_crs,
                       const ColumnNames& columns, Diagnostics& diagnostics) {
    return *PointReader(source, frame, source_crs, columns).next(std::numeric_limits<std::size_t>::max(), diagnostics);
}

}  // namespace terratet
