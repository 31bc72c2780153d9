// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Rows of an answer, in batches, to a file: CSV, GeoJSON, or any other format of OGR by its extension.

#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tess/frame.hpp"

namespace terratet {

/// A number, a whole number, a text, or nothing; a NaN is nothing.
struct RowCell {
    enum class Kind { nothing, number, integer, text };

    RowCell() = default;
    RowCell(double value) : kind(std::isnan(value) ? Kind::nothing : Kind::number), number(value) {}
    RowCell(std::int64_t value) : kind(Kind::integer), integer(value) {}
    RowCell(std::string value) : kind(Kind::text), text(std::move(value)) {}

    Kind kind = Kind::nothing;
    double number = 0;
    std::int64_t integer = 0;
    std::string text;
};

struct RowColumn {
    enum class Type { number, integer, text };
    std::string name;
    Type type = Type::number;
};

/// A corner of a section's polygon, in the section.
struct FlatCorner {
    double along = 0;            ///< distance along it, or x
    double up = 0;               ///< height, or y
    std::vector<double> values;  ///< of each property, in its scale
};

struct Row {
    std::vector<RowCell> cells;
    std::vector<Vec3> outline;       ///< true coordinates: none, a point, or a polygon's corners
    std::vector<FlatCorner> flat{};  ///< of a section's polygon
    bool in_plan = false;            ///< those are x and y
};

/// Takes batches of rows.
class RowSink {
  public:
    virtual ~RowSink() = default;
    virtual void begin(const std::vector<RowColumn>& columns) = 0;  ///< once, before the first batch
    virtual void add(const std::vector<Row>& rows) = 0;
    virtual void end() = 0;
};

/// As CSV text.
std::string csv_line(const std::vector<RowColumn>& columns);
std::string csv_lines(const std::vector<Row>& rows);

/// Whole or not at all. The layer is named `layer`, in the frame's CRS; GeoJSON keeps it (and its true coordinates)
/// too. Throws UsageError for an extension that no format has, Error when the file exists and `overwrite` is false, or
/// when writing fails.
std::unique_ptr<RowSink> rows_to_file(const std::string& path, const std::string& layer, const Frame& frame,
                                      bool overwrite);

}  // namespace terratet
