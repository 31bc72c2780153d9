// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Logs against the holes they lie in: depths that are heights, and depths beyond a hole's end.

#include "io/read/read_boreholes.hpp"

namespace terratet {

/// Turns tops and bottoms that are heights into depths along the holes, in the log's own columns, when the user says so
/// or (of `intervals` automatic) when nine of ten fall and the highest of most holes is its collar's height; the same
/// for depths written as 0, -10, -20. Noted. Tops that fall otherwise are left, and the note says what reads them.
void accept_elevations(Table& log, const Holes& holes, const SiteInputs& inputs, Diagnostics& diagnostics);

/// Notes records below the lengths that the collars state, with the first one's line, and the unit that would fit when
/// all holes exceed theirs.
void note_beyond_length(const Table& log, const Holes& holes, const Crs& target, const SiteInputs& inputs,
                        Diagnostics& diagnostics);

}  // namespace terratet
