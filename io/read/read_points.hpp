// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Places to ask a model about: any table with x, y, z, or points with heights.

#include "io/read/tables/read_table.hpp"
#include "tess/diagnostics.hpp"
#include "tess/frame.hpp"

namespace terratet {

struct PointTable {
    Table table;
    std::vector<Vec3> positions;  ///< a row each, local to the frame; NaN on all axes where the record is rejected
};

/// CRS: the source's own (srs=), else the table's, else `source_crs`, else the frame's. Rows without an acceptable
/// position go to `diagnostics` and keep their place. Throws InputError: no table, no x, y or z, no usable row.
PointTable read_points(const Source& source, const Frame& frame, const std::string& source_crs,
                       const ColumnNames& columns, Diagnostics& diagnostics);

/// The same, some rows at a time (TableReader). That no row at all is usable is thrown at the end, when there were
/// several times.
class PointReader {
  public:
    /// The frame must outlive it.
    PointReader(Source source, const Frame& frame, std::string source_crs, ColumnNames columns);

    /// Nothing: at the end.
    std::optional<PointTable> next(std::size_t most, Diagnostics& diagnostics);

  private:
    Source source_;
    const Frame& frame_;
    std::string source_crs_;
    ColumnNames columns_;
    TableReader rows_;
    std::size_t times_ = 0;
    bool any_usable_ = false;
};

}  // namespace terratet
