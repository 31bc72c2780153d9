// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read/log_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tess/samples.hpp"

namespace terratet {
namespace {

/// The columns of a log's depths, and the hole of each row.
struct LogDepths {
    int id = -1;
    int from = -1;
    int to = -1;  ///< −1: a point log
    bool one_hole = false;

    LogDepths(const Table& log, const ColumnNames& names)
        : id(find_optional_column(log, Meaning::id, names)),
          from(find_optional_column(log, Meaning::from, names)),
          to(find_optional_column(log, Meaning::to, names)),
          one_hole(!log.stated.hole_names.empty()) {
        if (from < 0 || to < 0) {
            const int depth = find_optional_column(log, Meaning::depth, names);
            from = depth >= 0 ? depth : from;
            to = -1;
        }
    }
    [[nodiscard]] bool usable() const { return (id >= 0 || one_hole) && from >= 0; }
    [[nodiscard]] int deepest() const { return to >= 0 ? to : from; }
};

std::optional<double> number_in(const Table& table, int column, std::size_t row) {
    return parse_number(table.cells[static_cast<std::size_t>(column)][row]);
}

/// Calls `visit` with each row whose hole is known.
template <typename Visit>
void for_each_row(const Table& log, const LogDepths& columns, const Holes& holes, const Visit& visit) {
    std::string_view last;
    auto hole = holes.end();
    for (std::size_t row = 0; row < log.rows(); ++row) {
        const std::string_view id = columns.one_hole ? std::string_view(log.stated.hole_names.front())
                                                     : log.cells[static_cast<std::size_t>(columns.id)][row];
        if (row == 0 || id != last) {
            hole = holes.find(id);
            last = id;
        }
        if (hole != holes.end()) {
            visit(row, hole->second);
        }
    }
}

// --- Elevations ----------------------------------------------------------------------------------------------------

enum class Heights { no, elevations, negative_depths, unclear };

/// What tops that fall are, from the heights of their collars.
Heights meaning_of(const Table& log, const LogDepths& columns, const Holes& holes) {
    struct Top {
        double highest = -HUGE_VAL;
        double collar = 0;
    };
    std::map<std::string, Top> tops;
    const Hole* last = nullptr;
    Top* top = nullptr;
    std::size_t falling = 0;
    std::size_t rising = 0;
    std::size_t positive = 0;
    for_each_row(log, columns, holes, [&](std::size_t row, const Hole& hole) {
        const auto from = number_in(log, columns.from, row);
        const auto to = number_in(log, columns.deepest(), row);
        if (!from || !to) {
            return;
        }
        falling += *from > *to ? 1 : 0;
        rising += *from < *to ? 1 : 0;
        positive += *from > 0 || *to > 0 ? 1 : 0;
        top = &hole == last ? top : &tops[hole.id];
        last = &hole;
        *top = {std::max(top->highest, *from), hole.own_height};
    });
    if (falling == 0 || falling < 9 * rising) {
        return Heights::no;
    }
    std::size_t at_collar = 0;
    std::size_t at_zero = 0;
    for (const auto& [id, found] : tops) {
        at_collar += std::abs(found.highest - found.collar) <= 0.5 ? 1 : 0;
        at_zero += std::abs(found.highest) <= 0.5 ? 1 : 0;
    }
    return 2 * at_collar > tops.size()                  ? Heights::elevations
           : positive == 0 && 2 * at_zero > tops.size() ? Heights::negative_depths
                                                        : Heights::unclear;
}

/// How far along its path a hole has come down by `drop`, in the target's unit; NaN when it never does.
double depth_of_drop(const Hole& hole, double drop) {
    const double top = hole.path.position(0).z;
    if (drop <= 0) {
        return drop;  // above the collar: refused as a negative depth
    }
    double low = 0;
    double high = std::max(drop, 1e-6);
    while (top - hole.path.position(high).z < drop) {
        high *= 2;
        if (high > 64 * drop) {
            return missing;
        }
    }
    if (top - hole.path.position(drop).z == drop) {
        return drop;  // vertical, exactly
    }
    for (int step = 0; step < 100 && high - low > 1e-12 * high; ++step) {
        const double middle = low + (high - low) / 2;
        (top - hole.path.position(middle).z < drop ? low : high) = middle;
    }
    return high;
}

/// A column of heights, or of depths below zero, as depths.
TextColumn as_depths(const Table& log, const LogDepths& columns, int column, const Holes& holes, Heights meaning) {
    const TextColumn& cells = log.cells[static_cast<std::size_t>(column)];
    std::vector<std::string> depths(cells.begin(), cells.end());
    for_each_row(log, columns, holes, [&](std::size_t row, const Hole& hole) {
        const auto height = parse_number(cells[row]);
        if (height && meaning == Heights::negative_depths) {
            depths[row] = fmt::format("{}", *height == 0 ? 0.0 : -*height);
        } else if (height) {
            const double drop = (hole.own_height - *height) * hole.height_factor;
            depths[row] = fmt::format("{}", depth_of_drop(hole, drop) / hole.unit_factor);
        }
    });
    TextColumn result;
    for (const std::string& text : depths) {
        result.push_back(text);
    }
    return result;
}

// --- Lengths -------------------------------------------------------------------------------------------------------

/// The unit in which depths that are `factor` times too great would fit.
std::string fitting_unit(double factor) {
    struct Unit {
        const char* name;
        double factor;
    };
    static constexpr std::array<Unit, 4> units{{{"ft", 3.28084}, {"in", 39.3701}, {"cm", 100}, {"mm", 1000}}};
    for (const Unit& unit : units) {
        if (factor > 0.6 * unit.factor && factor <= 1.05 * unit.factor) {
            return unit.name;
        }
    }
    return "";
}

}  // namespace

void accept_elevations(Table& log, const Holes& holes, const SiteInputs& inputs, Diagnostics& diagnostics) {
    LogDepths columns(log, inputs.columns);
    const bool told = inputs.intervals == Intervals::elevation;
    if (told && columns.from < 0) {
        columns.from = find_optional_column(log, Meaning::z, inputs.columns);
    }
    if (!columns.usable() || inputs.intervals == Intervals::depth || (!told && columns.to < 0)) {
        return;
    }
    const Heights meaning = told ? Heights::elevations : meaning_of(log, columns, holes);
    const std::string names = log.columns[static_cast<std::size_t>(columns.from)] +
                              (columns.to < 0 ? "" : " and " + log.columns[static_cast<std::size_t>(columns.to)]);
    if (meaning == Heights::no) {
        return;
    }
    if (meaning == Heights::unclear) {
        diagnostics.note(fmt::format(
            "{}: columns {} fall down the holes as heights do; `intervals` elevation reads them so", log.file, names));
        return;
    }
    if (!told) {
        diagnostics.note(
            fmt::format("{}: columns {} are read as {} (`intervals` depth says otherwise)", log.file, names,
                        meaning == Heights::elevations ? "heights, since they fall from those of the collars"
                                                       : "depths below zero"));
    }
    for (const int column : {columns.from, columns.to}) {
        if (column >= 0) {
            log.cells[static_cast<std::size_t>(column)] = as_depths(log, columns, column, holes, meaning);
        }
    }
    if (meaning == Heights::elevations) {
        log.stated.metres_per_depth = 0;  // as_depths gives them in the hole's unit
    }
    if (find_optional_column(log, Meaning::from, inputs.columns) < 0 &&
        find_optional_column(log, Meaning::depth, inputs.columns) < 0) {
        log.columns[static_cast<std::size_t>(columns.from)] = "DEPTH";
    }
}

void note_beyond_length(const Table& log, const Holes& holes, const Crs& target, const SiteInputs& inputs,
                        Diagnostics& diagnostics) {
    const LogDepths columns(log, inputs.columns);
    if (!columns.usable()) {
        return;
    }
    std::map<std::string, double> deepest;  // as a share of the stated length
    const Hole* last = nullptr;
    double* share = nullptr;
    std::size_t beyond = 0;
    std::size_t records = 0;
    std::string first;
    for_each_row(log, columns, holes, [&](std::size_t row, const Hole& hole) {
        const auto depth = number_in(log, columns.deepest(), row);
        if (!depth || !(hole.stated_length > 0)) {
            return;
        }
        const double length = hole.stated_length / depth_factor(log, hole.unit_factor, target);
        share = &hole == last ? share : &deepest[hole.id];
        last = &hole;
        *share = std::max(*share, *depth / length);
        ++records;
        if (*depth > 1.01 * length + 1 && ++beyond == 1) {
            first = fmt::format("line {}: {} in hole {} of {:.6g}", log.lines[row], *depth, hole.id, length);
        }
    });
    if (beyond == 0) {
        return;
    }
    std::vector<double> shares;
    shares.reserve(deepest.size());
    for (const auto& [id, of_length] : deepest) {
        shares.push_back(of_length);
    }
    std::ranges::sort(shares);
    const double middle = shares[shares.size() / 2];
    std::string unit;
    if (shares.front() > 1.5) {
        const std::string fits = fitting_unit(shares.back());
        unit = fmt::format("; all holes are exceeded, by a factor of {:.3g}: are the depths in another unit{}?", middle,
                           fits.empty() ? "" : " (`depth_unit` " + fits + ")");
    }
    diagnostics.note(
        fmt::format("{}: {} of {} records lie below the length that their collar states, the first on {}{}", log.file,
                    beyond, records, first, unit));
}

}  // namespace terratet
