// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// What is wrong with boreholes as tables have them, before a model is made of them: what a geologist looks for first
/// (overlaps, gaps, missing surveys, kinks, duplicates, holes without logs), with counts and places.

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "io/site_inputs.hpp"
#include "tess/diagnostics.hpp"

namespace terratet {

/// Kinds of findings, by the names that reports have for them.
enum class HoleDefect {
    overlap,             ///< an interval begins above the end of the one before
    gap,                 ///< between two intervals of a log
    missing_survey,      ///< surveys are given, none for this hole, and its collar says no direction
    kink,                ///< the direction turns by more than `kink_deg_per_30m` between two stations
    duplicate_collar,    ///< the id comes again
    duplicate_place,     ///< another hole begins at the same place
    duplicate_station,   ///< a station at the same depth comes again
    duplicate_interval,  ///< the same interval, or depth, of one log comes again
    without_log,         ///< logs are given, none for this hole
    without_collar,      ///< a survey's or a log's hole that no collar table has
    beyond_length,       ///< a record deeper than the length that the collar states
    turned_interval,     ///< FROM below TO
    bad_record,          ///< depths, places or angles that are none
};
const char* to_string(HoleDefect defect);

struct HoleFinding {
    HoleDefect defect;
    std::string hole;
    std::string file;
    std::int64_t line = 0;  ///< 0: none
    double from = 0;        ///< metres along the hole; NaN: nowhere on it
    double to = 0;
    std::string text;
};

/// An interval or a depth of a log, in metres; for pictures.
struct LoggedInterval {
    double from = 0;
    double to = 0;
};

struct HoleRecord {
    std::string id;
    double length_m = 0;  ///< stated; else the deepest record
    std::vector<SurveyStation> stations;
    std::map<std::string, std::vector<LoggedInterval>> logs;  ///< by file (and layer), ascending
    std::size_t findings = 0;
};

struct HoleQuality {
    std::vector<HoleRecord> holes;      ///< by id
    std::vector<HoleFinding> findings;  ///< by hole, then depth
    std::map<HoleDefect, std::size_t> counts;
    std::size_t surveyed = 0;
    std::size_t logged = 0;

    /// The hole with the most findings (the first by id of those); null without holes.
    [[nodiscard]] const HoleRecord* worst() const;
};

/// Dog-leg severity that no drill string makes on its own.
inline constexpr double kink_deg_per_30m = 10;

/// Reads `boreholes`, `surveys` and `logs`. A system of coordinates need not be known. O(n log n). Throws InputError as
/// read_site does for what cannot be read at all.
HoleQuality hole_quality(const SiteInputs& inputs, Diagnostics& diagnostics);

}  // namespace terratet
