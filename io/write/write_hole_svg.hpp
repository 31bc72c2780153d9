// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// A borehole as a strip log for its quality: logs as columns of intervals, gaps and overlaps marked, survey beside it.

#include <string>

#include "io/read/site/hole_quality.hpp"

namespace terratet {

/// A whole SVG file: depth downwards in metres; a column each log; dip and azimuth at the stations, kinks marked; the
/// findings in words below, the first forty.
std::string hole_svg(const HoleQuality& quality, const HoleRecord& hole);

/// Writes it whole or not at all. Throws Error as OutputFile does.
void write_hole_svg(const HoleQuality& quality, const HoleRecord& hole, const std::string& path, bool overwrite);

}  // namespace terratet
