// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// What a site is read from, and how its columns are to be understood.

#include <string>
#include <utility>
#include <vector>

#include "io/source.hpp"
#include "tess/borehole.hpp"

namespace terratet {

/// What a column of dips means. automatic, for each table and noted: inclination from the downward vertical when the
/// column is called so (INCLINATION, INCL, INC, DEVI) and all values are 0…180, else down-positive or down-negative by
/// the majority of the signs.
enum class DipConvention { automatic, down_positive, down_negative, inclination };

/// Where azimuths count from. grid: the north of the collars' own CRS (true north when that is geographic).
enum class AzimuthReference { grid, true_north, magnetic };

/// Which way z counts in tables and in meshes that do not say it themselves. automatic: upwards, but downwards in
/// columns called so (TVDSS, TVD, depth), noted.
enum class ZPositive { automatic, up, down };

/// What tops and bottoms of logs are. automatic: depths, but heights where they fall from those of the collars, noted.
enum class Intervals { automatic, depth, elevation };

struct SiteInputs {
    std::vector<Source> boreholes{};  ///< collar tables
    std::vector<Source> surveys{};
    std::vector<Source> logs{};     ///< interval (from, to) or point (depth) logs
    std::vector<Source> samples{};  ///< x, y, z, properties
    std::vector<Source> faults{};
    std::vector<Source> surfaces{};  ///< horizons
    std::vector<Source> topography{};
    std::vector<Source> domain{};  ///< a polygon in plan: one at most

    std::string source_crs{};               ///< -s_srs
    std::string target_crs{};               ///< -t_srs
    std::vector<std::string> properties{};  ///< NAME[:log10][:categorical][:unit=U]; empty: every numeric column
    std::vector<std::pair<std::string, std::string>> columns{};  ///< meaning → column name
    Desurvey desurvey = Desurvey::minimum_curvature;
    DipConvention dip = DipConvention::automatic;
    AzimuthReference azimuth = AzimuthReference::grid;
    double declination_deg = 0;  ///< magnetic only, east positive
    std::string depth_unit{};    ///< of depths and lengths along holes: "m", "ft"; empty: the collars' own CRS's unit
    std::vector<std::string> nulls{};  ///< VALUE or P=VALUE, a number or a word: no value, in all columns or in one
    ZPositive z_positive = ZPositive::automatic;
    Intervals intervals = Intervals::automatic;
    std::string
        fault_depth{};    ///< of traces' surfaces below zero, a length with or without unit; empty: by their table
    double z_scale = 0;   ///< of the frame; 0: chosen for flat data (tess/site/site_box.hpp), with a note
    bool strict = false;  ///< the first dirty record is an InputError
};

}  // namespace terratet
