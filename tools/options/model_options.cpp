// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/options/model_options.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "interp/estimator_spec.hpp"
#include "io/base/memory_limit.hpp"
#include "io/read/tables/read_table.hpp"
#include "io/source.hpp"
#include "tess/error.hpp"
#include "tools/options/choice.hpp"
#include "tools/options/text.hpp"
#include "tools/options/tolerance_option.hpp"

namespace terratet::tools {
namespace {

/// 0 for no text: the default is chosen where the data are known.
double positive_length(const std::string& option, const std::string& text, double metres_per_unit) {
    if (text.empty()) {
        return 0;
    }
    double value = 0;
    try {
        value = parse_length(text, metres_per_unit);
    } catch (const UsageError& error) {
        throw UsageError(fmt::format("{}: {}", option, error.what()));
    }
    if (!(value > 0)) {
        throw UsageError(fmt::format("{}: '{}' is not above 0", option, text));
    }
    return value;
}

constexpr const char* automatic = "auto";

double fault_spacing(const ModelArguments& a, double metres_per_unit) {
    return a.fault_spacing == automatic ? 0 : positive_length("--fault-spacing", a.fault_spacing, metres_per_unit);
}

std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(separator, begin), text.size());
        parts.push_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return parts;
}

std::vector<double> parse_coordinates(const std::string& option, const std::string& text) {
    std::vector<double> numbers;
    for (const std::string& part : split(text, ',')) {
        const auto number = parse_number(part);
        if (!number) {
            throw UsageError(fmt::format("{}: '{}' is not a number", option, part));
        }
        if (!(std::abs(*number) <= max_coordinate)) {
            throw UsageError(fmt::format("{}: a coordinate is beyond {}", option, short_number(max_coordinate)));
        }
        numbers.push_back(*number);
    }
    return numbers;
}

Box3 box_of(const std::string& option, const std::string& text, const std::vector<double>& n) {
    const Box3 box{{n[0], n[1], n[2]}, {n[3], n[4], n[5]}};
    if (!(box.lo.x < box.hi.x && box.lo.y < box.hi.y && box.lo.z < box.hi.z)) {
        throw UsageError(
            fmt::format("{}: '{}' has no volume; the order is xmin,ymin,zmin,xmax,ymax,zmax", option, text));
    }
    return box;
}

/// True coordinates of two corners.
Box3 parse_extent(const std::string& text) {
    const auto numbers = parse_coordinates("--extent", text);
    if (numbers.size() != 6) {
        throw UsageError(fmt::format(
            "--extent: six numbers are needed, xmin,ymin,zmin,xmax,ymax,zmax, and {} are given", numbers.size()));
    }
    return box_of("--extent", text, numbers);
}

/// "xmin,…,zmax=LMIN,LMAX" or "x,y,z=LMIN,LMAX", in true coordinates.
ResolutionOverride parse_resolution(const std::string& text, double metres_per_unit) {
    const auto equals = text.find('=');
    const auto lengths = equals == std::string::npos ? std::vector<std::string>() : split(text.substr(equals + 1), ',');
    const std::string where = text.substr(0, equals);
    const auto numbers = lengths.size() == 2 ? parse_coordinates("--resolution", where) : std::vector<double>();
    if (numbers.size() != 6 && numbers.size() != 3) {
        throw UsageError(
            fmt::format("--resolution: '{}' is neither xmin,ymin,zmin,xmax,ymax,zmax=LMIN,LMAX for a box nor "
                        "x,y,z=LMIN,LMAX for the fault block that holds a point",
                        text));
    }
    ResolutionOverride part;
    if (numbers.size() == 6) {
        part.box = box_of("--resolution", where, numbers);
    } else {
        part.where = ResolutionOverride::Where::block;
        part.point = {numbers[0], numbers[1], numbers[2]};
    }
    part.l_min = positive_length("--resolution", lengths[0], metres_per_unit);
    part.l_max = positive_length("--resolution", lengths[1], metres_per_unit);
    return part;
}

/// "x,y,z=NAME", in true coordinates.
RegionName parse_region_name(const std::string& text) {
    const auto equals = text.find('=');
    const auto numbers = equals == std::string::npos ? std::vector<double>()
                                                     : parse_coordinates("--region-name", text.substr(0, equals));
    if (numbers.size() != 3 || equals + 1 == text.size()) {
        throw UsageError(fmt::format(
            "--region-name: '{}' is not x,y,z=NAME, with a point of the region that is to have the name", text));
    }
    return {{numbers[0], numbers[1], numbers[2]}, text.substr(equals + 1)};
}

struct PropertyLimit {
    std::string property;
    double limit;
};

PropertyLimit parse_limit(const std::string& option, const std::string& text) {
    const auto equals = text.rfind('=');
    const auto limit = equals == std::string::npos ? std::nullopt : parse_number(text.substr(equals + 1));
    if (!limit || equals == 0) {
        throw UsageError(fmt::format("{}: '{}' is not PROPERTY=NUMBER, such as K=0.5", option, text));
    }
    if (*limit < 0) {
        throw UsageError(fmt::format("{}: '{}' is below 0", option, text));
    }
    return {text.substr(0, equals), *limit};
}

/// Which properties horizons bar: none, all, or those named.
struct HardHorizons {
    bool all = false;
    std::vector<std::string> properties;
};

HardHorizons parse_horizon(const std::string& text) {
    if (text == "soft" || text == "hard") {
        return {text == "hard", {}};
    }
    constexpr std::string_view some = "hard=";
    HardHorizons hard;
    if (text.starts_with(some)) {
        hard.properties = split(text.substr(some.size()), ',');
    }
    if (hard.properties.empty() || std::ranges::count(hard.properties, std::string()) > 0) {
        throw UsageError(fmt::format("--horizon: '{}' is not soft, hard, or hard=P,Q with names of properties{}", text,
                                     did_you_mean(text, {"soft", "hard"})));
    }
    return hard;
}

void set_limits(const std::string& option, const std::vector<std::string>& texts, double VariationLimits::*which,
                const std::vector<Property>& properties, Criteria& criteria) {
    for (const auto& text : texts) {
        const auto [name, limit] = parse_limit(option, text);
        const auto found = find_property(option, name, properties);
        criteria.variation.resize(properties.size());
        criteria.variation[static_cast<std::size_t>(found - properties.begin())].*which = limit;
    }
}

bool shape_everywhere(const std::string& text) {
    return choose<bool>("--shape", text, {{"needed", false}, {"everywhere", true}});
}

Criteria criteria_without_variation(const ModelArguments& a, double metres_per_unit) {
    Criteria criteria;
    criteria.l_min_floor = positive_length("--lmin-floor", a.l_min_floor, metres_per_unit);
    criteria.shape_everywhere = shape_everywhere(a.shape);
    criteria.l_min = positive_length("--lmin", a.l_min, metres_per_unit);
    criteria.l_max = positive_length("--lmax", a.l_max, metres_per_unit);
    criteria.radius_edge = a.radius_edge;
    criteria.aspect = a.aspect;
    criteria.dihedral_deg = a.dihedral_deg;
    criteria.v_min = a.v_min;
    criteria.v_max = a.v_max;
    for (const auto& text : a.resolution) {
        criteria.overrides.push_back(parse_resolution(text, metres_per_unit));
    }
    return criteria;
}

/// Contradictions among what is given; lengths left to be chosen contradict nothing.
void validate_given(Criteria criteria) {
    if (criteria.l_min == 0) {
        criteria.l_min = criteria.l_max > 0 ? criteria.l_max / 4 : 1;
    }
    if (criteria.l_max == 0) {
        criteria.l_max = 4 * criteria.l_min;
    }
    validate(criteria);
}

SeedMode fault_mode(const std::string& text) {
    return choose<SeedMode>("--fault-mode", text, {{"paired", SeedMode::paired}, {"exact", SeedMode::exact}});
}

/// From sites to outputs, all told; refinement alone takes half of it.
constexpr std::uint64_t bytes_per_vertex = 2000;

DensityMode density_mode(const std::string& text) {
    return choose<DensityMode>("--density", text,
                               {{"canonical", DensityMode::canonical}, {"paper", DensityMode::paper}});
}

}  // namespace

std::vector<OptionGroup> model_options(ModelArguments& a) {
    return {
        {"Resolution and criteria (lengths in the model's unit, or 20m, 65ft; 0 switches a criterion off)",
         {
             {{"tolerance"},
              "P=T",
              "how far property P may be off (decades if P:log10); P=10% of its range, 10% for all; auto: half the "
              "standard deviation, and samples that keep their variance: the default without --lmin and --df-max",
              &a.tolerance},
             {{"lmin"},
              "LENGTH",
              "no new vertex comes nearer to another; by default a hundredth of the diagonal",
              &a.l_min},
             {{"lmax"}, "LENGTH", "longest edge; by default four times --lmin", &a.l_max},
             {{"resolution"},
              "WHERE=LMIN,LMAX",
              "others in a part: xmin,ymin,zmin,xmax,ymax,zmax=5,20 in a box, x,y,z=5,20 in the fault block of a point",
              &a.resolution},
             {{"lmin-floor"},
              "LENGTH",
              "however much samples differ, --tolerance keeps them no nearer to each other; by default a 10,000th of "
              "the "
              "diagonal",
              &a.l_min_floor},
             {{"shape"},
              "WHERE",
              "needed (default): with --tolerance, cells that vary by less than half of it may be of any shape and "
              "size; "
              "everywhere",
              &a.shape},
             {{"df-min"},
              "P=V",
              "cells in which property P varies less are left as they are (decades if P:log10)",
              &a.df_min},
             {{"df-max"}, "P=V", "largest variation of property P along an edge", &a.df_max},
             {{"radius-edge"},
              "R",
              "largest circumradius over shortest edge; above: skinny. Default 2",
              &a.radius_edge},
             {{"aspect"}, "B", "largest circumradius over inradius; above: flat. Default 8", &a.aspect},
             {{"dihedral"},
              "DEGREES",
              "smallest dihedral angle wanted: the clean-up mends what it can. Default 5",
              &a.dihedral_deg},
             {{"vmin"}, "V", "smallest volume wanted: the clean-up mends what it can", &a.v_min},
             {{"vmax"}, "V", "largest volume", &a.v_max},
             {{"max-vertices"}, "N", "refuse or give up beyond; by default what fits into memory", &a.max_vertices},
         }},
        {"The model",
         {
             {{"te", "extent"},
              "XMIN,YMIN,ZMIN,XMAX,YMAX,ZMAX",
              "what to model; by default the data's box and --pad",
              &a.extent,
              6},
             {{"pad"},
              "LENGTH",
              "around the data's box; by default --lmax in plan, at most half the data's diagonal, and a quarter of "
              "their "
              "height above and below",
              &a.pad},
             {{"density"},
              "HOW",
              "canonical (default) keeps all samples that fit --lmin; paper deletes as the paper does",
              &a.density},
             horizon_option(a.horizon),
             {{"region-name"},
              "X,Y,Z=NAME",
              "what the region (fault block) is called that holds a point",
              &a.region_names},
             {{"fault-mode"},
              "HOW",
              "paired (default): two sheets of mirrored points; exact: faults are walls of the Voronoi cells",
              &a.fault_mode},
             {{"fault-spacing"},
              "LENGTH",
              "between a fault's points; by default --lmin; auto: less where faults run too close together for that, "
              "if "
              "it can be afforded",
              &a.fault_spacing},
             {{"fault-width"}, "LENGTH", "between the two sheets; by default a quarter of the spacing", &a.fault_width},
             {{"fault-snap"},
              "LENGTH",
              "faults that stop this short of another end on it; by default a twentieth of the spacing",
              &a.fault_snap},
             {{"fault-refine"},
              "",
              "finer points on faults where samples come near, so that more of these stay; paired mode",
              &a.fault_refine},
             {{"estimator"},
              "SPEC",
              "natural (default), laplace, linear, idw, kriging, nearest, with options as in idw:power=3; see "
              "'terratet help estimators'",
              &a.estimator},
         }},
    };
}

void check_model_arguments(const ModelArguments& a) {
    if (!a.extent.empty()) {
        parse_extent(a.extent);
        if (!a.pad.empty()) {
            throw UsageError("--pad goes with the data's box: it is not for a given --extent");
        }
    }
    if (!a.pad.empty() && parse_length(a.pad, 1.0) < 0) {
        throw UsageError(fmt::format("--pad: '{}' is below 0", a.pad));
    }
    validate_given(criteria_without_variation(a, 1.0));
    for (const auto& [option, texts] : {std::pair("--df-min", &a.df_min), std::pair("--df-max", &a.df_max)}) {
        for (const auto& text : *texts) {
            parse_limit(option, text);
        }
    }
    for (const auto& text : a.tolerance) {
        check_tolerance(text);
        if (is_automatic(text) && (a.tolerance.size() > 1 || !a.l_min.empty() || !a.df_max.empty())) {
            throw UsageError("--tolerance: auto goes with neither another tolerance nor --lmin nor --df-max");
        }
    }
    if (std::ranges::any_of(a.tolerance, is_automatic) && density_mode(a.density) == DensityMode::paper) {
        throw UsageError("--tolerance: auto is not for --density paper, which deletes samples whatever their values");
    }
    parse_horizon(a.horizon);
    for (const auto& text : a.region_names) {
        parse_region_name(text);
    }
    density_mode(a.density);
    fault_mode(a.fault_mode);
    positive_length("--fault-snap", a.fault_snap, 1.0);
    const double spacing = fault_spacing(a, 1.0);
    const double width = positive_length("--fault-width", a.fault_width, 1.0);
    if (spacing > 0 && width > spacing) {
        throw UsageError("--fault-width: the two sheets of a fault must be nearer to each other than --fault-spacing");
    }
    parse_estimator(a.estimator);
    if (a.max_vertices == 0) {
        throw UsageError("--max-vertices: at least 1 is needed");
    }
}

Option horizon_option(std::string& horizon) {
    return {{"horizon"},
            "HOW",
            "soft (default): values run through horizons; hard: horizons bar, as faults do; hard=P,Q for some "
            "properties",
            &horizon};
}

void set_horizons(const std::string& horizon, Site& site) {
    const HardHorizons hard = parse_horizon(horizon);
    for (Property& property : site.properties) {
        property.hard_horizons = hard.all;
    }
    for (const std::string& name : hard.properties) {
        const auto found = find_property("--horizon", name, site.properties);
        site.properties[static_cast<std::size_t>(found - site.properties.cbegin())].hard_horizons = true;
    }
}

std::uint64_t fitting_vertex_limit() {
    return memory_limit() / bytes_per_vertex;
}

BuildOptions build_options(const ModelArguments& a, const Site& site) {
    const double unit = site.frame.metres_per_unit;
    BuildOptions options;
    if (!a.extent.empty()) {
        const Box3 world = parse_extent(a.extent);
        options.extent = {site.frame.to_local(world.lo), site.frame.to_local(world.hi)};
    }
    options.pad = a.pad.empty() ? -1 : parse_length(a.pad, unit);
    options.criteria = criteria_without_variation(a, unit);
    for (ResolutionOverride& part : options.criteria.overrides) {
        if (part.where == ResolutionOverride::Where::box) {
            part.box = {site.frame.to_local(part.box.lo), site.frame.to_local(part.box.hi)};
        } else {
            part.point = site.frame.to_local(part.point);
        }
    }
    for (const auto& text : a.region_names) {
        RegionName named = parse_region_name(text);
        named.point = site.frame.to_local(named.point);
        options.region_names.push_back(std::move(named));
    }
    set_limits("--df-min", a.df_min, &VariationLimits::df_min, site.properties, options.criteria);
    set_limits("--df-max", a.df_max, &VariationLimits::df_max, site.properties, options.criteria);
    options.default_tolerance = a.tolerance.empty() || std::ranges::any_of(a.tolerance, is_automatic);
    set_tolerances(a.tolerance, site, options.criteria);
    validate_given(options.criteria);
    options.density = density_mode(a.density);
    options.barriers.spacing = fault_spacing(a, unit);
    options.separate_faults = a.fault_spacing == automatic;
    options.barriers.width = positive_length("--fault-width", a.fault_width, unit);
    options.barriers.snap = positive_length("--fault-snap", a.fault_snap, unit);
    options.barriers.mode = fault_mode(a.fault_mode);
    options.barriers.refine = a.fault_refine;
    options.refine.max_vertices = a.max_vertices == fitting_vertices ? fitting_vertex_limit() : a.max_vertices;
    options.estimator = parse_estimator(a.estimator).to_string();
    return options;
}

}  // namespace terratet::tools
