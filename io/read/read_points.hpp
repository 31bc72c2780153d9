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

}  // namespace terratet
