// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// All inputs of a model into one Site: one frame, one CRS, canonical order (docs/inputs.md).
///
/// CRS: each input's own (given with it, or in the file), else the general one; all are transformed to the target. With
/// no target, the first projected or local CRS among boreholes, samples, faults, surfaces is it; if all are geographic,
/// the UTM zone of the data's middle, noted. An input without any CRS is an InputError that names -s_srs.
///
/// Row order: the same records in any order give the same Site, but where records contradict each other (two collars of
/// one id, two stations at one depth, two values for one interval), of which the first in the file counts.

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "io/source.hpp"
#include "tess/borehole.hpp"
#include "tess/diagnostics.hpp"
#include "tess/model.hpp"
#include "tess/progress.hpp"

namespace terratet {

/// What a column of dips means. automatic, for each table and noted: inclination from the downward vertical when the
/// column is called so (INCLINATION, INCL, INC, DEVI) and all values are 0…180, else down-positive or down-negative by
/// the majority of the signs.
enum class DipConvention { automatic, down_positive, down_negative, inclination };

/// Where azimuths count from. grid: the north of the collars' own CRS (true north when that is geographic).
enum class AzimuthReference { grid, true_north, magnetic };

struct SiteInputs {
    std::vector<Source> boreholes;  ///< collar tables
    std::vector<Source> surveys;
    std::vector<Source> logs;     ///< interval (from, to) or point (depth) logs
    std::vector<Source> samples;  ///< x, y, z, properties
    std::vector<Source> faults;
    std::vector<Source> surfaces;  ///< horizons
    std::vector<Source> topography;
    std::vector<Source> domain;  ///< a polygon in plan: one at most

    std::string source_crs;               ///< -s_srs
    std::string target_crs;               ///< -t_srs
    std::vector<std::string> properties;  ///< NAME[:log10][:categorical][:unit=U]; empty: every numeric column
    std::vector<std::pair<std::string, std::string>> columns;  ///< meaning → column name
    Desurvey desurvey = Desurvey::minimum_curvature;
    DipConvention dip = DipConvention::automatic;
    AzimuthReference azimuth = AzimuthReference::grid;
    double declination_deg = 0;  ///< magnetic only, east positive
    std::string depth_unit;      ///< of depths and lengths along holes: "m", "ft"; empty: the collars' own CRS's unit
    double z_scale = 0;          ///< of the frame; 0: chosen for flat data (tess/site_box.hpp), with a note
    bool strict = false;         ///< the first dirty record is an InputError
};

/// Counts for the report and the summary.
struct ReadCounts {
    std::size_t boreholes = 0;
    std::size_t samples = 0;
    std::size_t faults = 0;
};

/// Reads everything. Boreholes come with their paths to the deepest log record or the length in the collar table; with
/// neither, to the last station. Samples without any value are left out. Dirty records go to `diagnostics`
/// and are skipped; throws InputError when an input cannot be used at all: missing, without CRS, without id or
/// coordinates, no numeric column, no usable row; UsageError when an option cannot be met: a column or property that is
/// in no table, a geographic target, logs without boreholes.
Site read_site(const SiteInputs& inputs, Diagnostics& diagnostics, ReadCounts& counts, const Progress& progress = {});

}  // namespace terratet
