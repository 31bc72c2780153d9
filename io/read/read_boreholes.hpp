// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Collar and survey tables into holes with trajectories.

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "io/read/logs/well_file.hpp"
#include "io/read/read_positions.hpp"
#include "io/site_inputs.hpp"
#include "tess/diagnostics.hpp"

namespace terratet {

/// A hole in the target CRS; lengths along it in the target's unit.
struct Hole {
    std::string id;
    Trajectory path;
    double unit_factor = 1;  ///< target units in a unit of the tables' depths
    double surveyed =
        0;  ///< the last station. Often a stand-in such as 90000, "to the end": it says little of the length
    double own_height = 0;     ///< of the collar, as its table has it
    double height_factor = 1;  ///< target units in a unit of those heights
    double stated_length = 0;  ///< in the target's unit; 0: not stated
    double deepest = 0;        ///< so far: the stated length; logs add theirs
    std::int32_t index = 0;    ///< in the order of ids

    /// Where the hole ends: at its stated length or deepest log record, else at its last station.
    [[nodiscard]] double end() const { return deepest > 0 ? deepest : surveyed; }
};

/// By id.
using Holes = std::map<std::string, Hole, std::less<>>;

/// Depths beyond this are no depths (the deepest hole has 12.3 km).
inline constexpr double max_depth_m = 50e3;

/// Holes from collars that are in the target CRS already. Of collars of one id, and of stations of one hole at one
/// depth, the first counts and the others are rejected: this is the one place where the order of rows matters. A hole
/// without survey takes the direction in its collar's record, else it is vertical (both noted with their number).
/// A path counts instead of a survey. Throws InputError: no id, depth, dip or azimuth column, no usable row in a table.
Holes read_boreholes(const std::vector<PlacedTable>& collars, const std::vector<Crs>& collar_crs,
                     const std::vector<Table>& surveys, const std::vector<HolePath>& paths, const Crs& target,
                     const SiteInputs& inputs, Diagnostics& diagnostics);

/// Lets the depths of a survey or log have the unit that their columns state (io/read/tables/header_units.hpp; noted
/// where it is not the target's), unless the table's format or `inputs` says it. Throws InputError: two columns state
/// different ones.
void take_stated_depth_unit(Table& table, const Crs& target, const SiteInputs& inputs, Diagnostics& diagnostics);

/// Target units in a unit of a table's depths: its own where it states one, else the hole's.
double depth_factor(const Table& table, double hole_factor, const Crs& target);

/// The depth in a cell, in units of `unit_factor`; −1, with the reason in `problem`, when it has none.
double parse_depth(const Table& table, int column, std::size_t row, double unit_factor, double metres_per_unit,
                   std::string& problem);

}  // namespace terratet
