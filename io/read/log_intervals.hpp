// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Intervals that a log writes otherwise than as a column of tops and one of bases.

#include "io/read/read_boreholes.hpp"

namespace terratet {

/// A column of ranges ("0-10", "0 – 10 m", "10 to 20") for want of columns from and to becomes these two, noted. It is
/// called interval, range, depth or from, and nine of ten of its cells are ranges; the others stay as they are, to be
/// rejected.
void split_ranges(Table& log, const ColumnNames& columns, Diagnostics& diagnostics);

/// Tops without bases: each interval reaches to the next top of its hole, the last to the hole's end as its collar or
/// its survey states it, noted. Where nothing states it, or it is above the top, the last top has no base, and its
/// record will be rejected.
void complete_bases(Table& log, const Holes& holes, const Crs& target, const SiteInputs& inputs,
                    Diagnostics& diagnostics);

}  // namespace terratet
