// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/options/site_options.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include <filesystem>

#include "interp/plan/composite.hpp"
#include "io/base/crs.hpp"
#include "io/read/tables/null_codes.hpp"
#include "io/read/tables/read_table.hpp"
#include "tess/error.hpp"
#include "tess/property.hpp"
#include "tools/options/values.hpp"

namespace terratet::tools {
namespace {

std::pair<std::string, std::string> parse_column(const std::string& text) {
    const auto equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size()) {
        throw UsageError(fmt::format("--columns: '{}' is not MEANING=COLUMN, such as id=WELL", text));
    }
    return {text.substr(0, equals), text.substr(equals + 1)};
}

/// -where and its like name columns of one table: with several inputs each says its own.
void apply_to_single_input(const SiteArguments& arguments, std::vector<Source*>& sources) {
    if (arguments.layer.empty() && arguments.where.empty() && arguments.sql.empty()) {
        return;
    }
    if (sources.size() != 1) {
        const char* name = !arguments.layer.empty() ? "layer" : !arguments.where.empty() ? "where" : "sql";
        throw UsageError(fmt::format("--{0} is for a single input; with several, say which: --log 'FILE,{0}=…'", name));
    }
    if (!arguments.layer.empty()) {
        sources.front()->layer = arguments.layer;
    }
    if (!arguments.where.empty()) {
        sources.front()->where = arguments.where;
    }
    if (!arguments.sql.empty()) {
        sources.front()->sql = arguments.sql;
    }
}

/// A length above 0, in whatever unit, or the file of a surface.
std::string checked_fault_depth(const std::string& text) {
    if (text.starts_with("/vsi") || std::filesystem::exists(text)) {
        return text;
    }
    double length = 0;
    try {
        length = parse_length(text).value;
    } catch (const UsageError& error) {
        throw UsageError(fmt::format("{}, nor is it the file of a surface", error.what()));
    }
    if (!(length > 0)) {
        throw UsageError(fmt::format("'{}' is not above 0; give a depth, as in 12km", text));
    }
    return text;
}

std::string checked_unit(const std::string& text) {
    metres_in_unit(text);
    return text;
}

double parse_z_scale(const std::string& text) {
    const double scale = parse_number(text).value_or(0);
    if (!(scale >= 1e-3 && scale <= 1e3)) {
        throw UsageError(fmt::format("'{}' is not a number between 0.001 and 1000", text));
    }
    return scale;
}

void take_azimuth(const std::string& text, SiteInputs& inputs) {
    if (const std::string magnetic = "magnetic:"; text.starts_with(magnetic)) {
        const auto declination = parse_number(text.substr(magnetic.size()));
        if (!declination || std::abs(*declination) > 180) {
            throw UsageError(fmt::format("'{}' carries no declination in degrees, as in magnetic:-7.5", text));
        }
        inputs.azimuth = AzimuthReference::magnetic;
        inputs.declination_deg = *declination;
    } else if (text == "grid" || text == "true") {
        inputs.azimuth = text == "grid" ? AzimuthReference::grid : AzimuthReference::true_north;
    } else {
        throw UsageError(fmt::format("'{}' is not one of grid, true, magnetic:DEGREES{}", text,
                                     did_you_mean(text, {"grid", "true", "magnetic:"})));
    }
}

}  // namespace

std::vector<OptionGroup> site_options(SiteArguments& a) {
    return {
        {"Inputs (FILE is anything GDAL opens, as FILE[,layer=L][,srs=CRS][,where=SQL])",
         {
             {{"boreholes"},
              "FILE",
              "collar table: hole, x, y, z; a workbook or database with all three; LAS, AGS, GEF, wells",
              &a.boreholes},
             {{"survey"}, "FILE", "hole, depth, azimuth, dip; without it holes are vertical", &a.surveys},
             {{"log"},
              "FILE",
              "values along holes: hole, from, to (or depth), properties; LAS, AGS, GEF; a folder",
              &a.logs},
             {{"samples"}, "FILE", "loose points: x, y, z, properties", &a.samples},
             {{"faults"}, "FILE", "GOCAD TSurf, TIN or triangles, or points x, y, z, fault", &a.faults},
             {{"surface"},
              "FILE",
              "a horizon, as a fault or a raster: it parts regions, and bars what --horizon says",
              &a.surfaces},
             {{"topography"}, "FILE", "the ground, a raster mostly: nothing is modelled above it", &a.topography},
             {{"domain"}, "FILE", "a polygon in plan: nothing is modelled outside it", &a.domain},
         }},
        {"What they mean",
         {
             {{"property"},
              "NAME[:log10][:categorical][:unit=U]",
              "what to model; every numeric column by default",
              &a.properties},
             {{"columns"},
              "MEANING=COLUMN",
              "a column not found by its name: id, x, y, z, from, to, depth, azimuth, dip, length, name, qualifier "
              "(of bounds), dip-direction and lower-depth (of traces)",
              &a.columns},
             {{"time-column"},
              "COLUMN",
              "of logs and samples that were measured more than once: one tessellation, at the time T the property P "
              "is P@T",
              &a.time_column},
             {{"s_srs", "source-crs"}, "CRS", "of the inputs that carry none", &a.source_crs},
             {{"t_srs", "target-crs"}, "CRS", "of the model: the first projected one by default", &a.target_crs},
             {{"desurvey"},
              "HOW",
              "minimum-curvature, tangential, balanced-tangential",
              one_of(a.inputs.desurvey, {{"minimum-curvature", Desurvey::minimum_curvature},
                                         {"tangential", Desurvey::tangential},
                                         {"balanced-tangential", Desurvey::balanced_tangential}})},
             {{"dip-convention"},
              "HOW",
              "auto, down-positive, down-negative, inclination",
              one_of(a.inputs.dip, {{"auto", DipConvention::automatic},
                                    {"down-positive", DipConvention::down_positive},
                                    {"down-negative", DipConvention::down_negative},
                                    {"inclination", DipConvention::inclination}})},
             {{"azimuth"},
              "FROM",
              "grid (default), true, or magnetic:DECLINATION",
              Parsed{[&a](const std::string& text) { take_azimuth(text, a.inputs); }}},
             {{"depth-unit"},
              "UNIT",
              "of depths along holes, m or ft: the model's by default",
              single(a.inputs.depth_unit, checked_unit)},
             {{"null"},
              "[NAME=]VALUE",
              "a number or word that stands for no value, in all columns or in one; usual codes far from all values "
              "are kept out by themselves",
              &a.nulls},
             {{"z-positive"},
              "WAY",
              "auto (default: up, but down in columns called depth, TVD, TVDSS), up, down; of tables and of meshes "
              "that "
              "do not say it",
              one_of(a.inputs.z_positive,
                     {{"auto", ZPositive::automatic}, {"up", ZPositive::up}, {"down", ZPositive::down}})},
             {{"intervals"},
              "WHAT",
              "tops and bottoms of logs: auto (default: depths, but heights where they fall from the collars'), depth, "
              "elevation",
              one_of(
                  a.inputs.intervals,
                  {{"auto", Intervals::automatic}, {"depth", Intervals::depth}, {"elevation", Intervals::elevation}})},
             {{"fault-depth"},
              "LENGTH|FILE",
              "depth below zero, or surface, to which the faults of traces reach",
              single(a.inputs.fault_depth, checked_fault_depth)},
             {{"z-scale"},
              "K",
              "for flat sites: tessellate in K times stretched z, where lengths and shapes are judged; by default 1, "
              "more for "
              "data flatter than 10 : 1",
              single(a.inputs.z_scale, parse_z_scale)},
             {{"composite"},
              "LENGTH",
              "bring logs to intervals of this length before all else",
              length_value(a.composite)},
             {{"layer"}, "NAME", "layer of a single input", &a.layer},
             {{"where"}, "SQL", "which rows of a single input", &a.where},
             {{"sql"}, "SQL", "a statement instead of a layer, for a single input", &a.sql},
             {{"oo"}, "KEY=VALUE", "open option for GDAL's driver", &a.open_options},
         }},
    };
}

std::vector<OptionGroup> hole_options(SiteArguments& a) {
    static constexpr std::array<std::string_view, 8> wanted{
        "boreholes", "survey", "log", "columns", "s_srs", "desurvey", "dip-convention", "depth-unit"};
    std::vector<OptionGroup> groups = site_options(a);
    for (OptionGroup& group : groups) {
        std::erase_if(group.options, [](const Option& option) {
            return std::ranges::find(wanted, option.names.front()) == wanted.end();
        });
    }
    return groups;
}

ColumnNames column_names(const std::vector<std::string>& texts) {
    ColumnNames names;
    for (const auto& text : texts) {
        names.push_back(parse_column(text));
    }
    return names;
}

SiteInputs site_inputs(const SiteArguments& a, bool strict) {
    SiteInputs inputs = a.inputs;
    std::vector<Source*> all;
    const auto add = [&](const std::vector<std::string>& texts, std::vector<Source>& sources) {
        for (const auto& text : texts) {
            Source source = parse_source(text);
            source.open_options.insert(source.open_options.end(), a.open_options.begin(), a.open_options.end());
            sources.push_back(std::move(source));
        }
    };
    add(a.boreholes, inputs.boreholes);
    add(a.surveys, inputs.surveys);
    add(a.logs, inputs.logs);
    add(a.samples, inputs.samples);
    add(a.faults, inputs.faults);
    add(a.surfaces, inputs.surfaces);
    add(a.topography, inputs.topography);
    add(a.domain.empty() ? std::vector<std::string>{} : std::vector{a.domain}, inputs.domain);
    for (auto* sources : {&inputs.boreholes, &inputs.surveys, &inputs.logs, &inputs.samples, &inputs.faults,
                          &inputs.surfaces, &inputs.topography, &inputs.domain}) {
        for (auto& source : *sources) {
            all.push_back(&source);
        }
    }
    if (all.empty()) {
        throw UsageError("no input: give --boreholes with --log, or --samples");
    }
    if (!inputs.logs.empty() && inputs.boreholes.empty()) {
        throw UsageError("--log needs the holes' collars: give --boreholes");
    }
    if (!inputs.surveys.empty() && inputs.boreholes.empty()) {
        throw UsageError("--survey needs the holes' collars: give --boreholes");
    }
    apply_to_single_input(a, all);

    for (const auto& crs : {a.source_crs, a.target_crs}) {
        if (!crs.empty()) {
            parse_crs(crs);  // refused before anything is read
        }
    }
    inputs.source_crs = a.source_crs;
    inputs.target_crs = a.target_crs;
    for (const auto& property : a.properties) {
        parse_property(property);
    }
    inputs.properties = a.properties;
    inputs.columns = column_names(a.columns);
    if (!a.time_column.empty()) {
        inputs.columns.emplace_back("time", a.time_column);
    }
    for (const auto& null : a.nulls) {
        parse_null(null);
    }
    inputs.nulls = a.nulls;
    inputs.strict = strict;
    return inputs;
}

void composite_as_asked(Site& site, const SiteArguments& a, Diagnostics& diagnostics) {
    if (!a.composite) {
        return;
    }
    const CompositeReport report = composite(site, a.composite->in(site.frame.metres_per_unit));
    diagnostics.note(
        fmt::format("{} intervals are composited into {} of {}; {} values over less than half of one are "
                    "left out",
                    report.intervals, report.composites, a.composite->text, report.dropped));
}

std::vector<std::string> input_paths(const SiteArguments& a) {
    std::vector<std::string> paths;
    for (const auto* list : {&a.boreholes, &a.surveys, &a.logs, &a.samples, &a.faults, &a.surfaces, &a.topography}) {
        paths.insert(paths.end(), list->begin(), list->end());
    }
    if (!a.domain.empty()) {
        paths.push_back(a.domain);
    }
    return paths;
}

}  // namespace terratet::tools
