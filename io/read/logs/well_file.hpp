// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Files of the trade that hold wells, boreholes and soundings, each by a parser of its own:
///
/// | format | known by | gives |
/// |---|---|---|
/// | LAS 1.2, 2.0, 3.0 (CWLS) | a first line with ~ | the log, in LAS 3 also tops, cores, tests, surveys; a collar
/// where the header has a place | | AGS 3, 4 | a first group | collars (LOCA, HOLE), directions (HORN), every group
/// with depths | | GEF-CPT, GEF-BORE | #GEFID | a collar and a log | | GOCAD well | GOCAD Well | a collar, a path or a
/// survey, markers, zones, curves | | RMS well | its fourth line counts its logs | a collar, a path, logs |
///
/// They give tables with stated columns (io/base/table.hpp): from there on a log is a log.

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/base/table.hpp"
#include "io/base/well_format.hpp"
#include "io/source.hpp"

namespace terratet {

/// A hole's path as a file gives it: points at measured depths.
struct HolePath {
    std::string hole;
    std::vector<double> depths;  ///< ascending
    std::vector<Vec3> points;    ///< heights upwards
};

struct WellFile {
    std::string format;                                      ///< "LAS 2.0", "AGS 4.1", "GEF-CPT", "GOCAD well", …
    std::vector<std::pair<std::string, std::string>> facts;  ///< of the header, for people: {"well", "W-1"}
    Table collars;                   ///< stated id, x, y, z: a row each hole with a place; no rows where none has one
    double metres_per_height = 0;    ///< of the collars' heights; 0: in the unit of their coordinate system
    std::vector<Table> surveys;      ///< stated depth, azimuth, dip
    std::vector<Table> logs;         ///< stated depth or from and to
    std::vector<HolePath> paths;     ///< in the coordinates of the collars
    std::vector<std::string> notes;  ///< assumptions made
    std::vector<std::pair<std::int64_t, std::string>> rejected;  ///< line and reason
};

/// Reads all that the file has. Streams; memory is a small multiple of the file's size. Damaged rows are counted with
/// their line; throws InputError where nothing can be used.
WellFile read_well_file(const Source& source);

WellFile read_las(const Source& source);
WellFile read_ags(const Source& source);
WellFile read_gef(const Source& source);
WellFile read_gocad_well(const Source& source);
WellFile read_rms_well(const Source& source);

}  // namespace terratet
