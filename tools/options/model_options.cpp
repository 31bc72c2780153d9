// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/options/model_options.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "interp/estimator/estimator_catalogue.hpp"
#include "interp/estimator_spec.hpp"
#include "io/base/memory_limit.hpp"
#include "io/base/parse_number.hpp"
#include "tess/error.hpp"
#include "tools/options/values.hpp"

namespace terratet::tools {
namespace {

Box3 box_of(const std::string& text, const std::vector<double>& n) {
    const Box3 box{{n[0], n[1], n[2]}, {n[3], n[4], n[5]}};
    if (!(box.lo.x < box.hi.x && box.lo.y < box.hi.y && box.lo.z < box.hi.z)) {
        throw UsageError(fmt::format("'{}' has no volume; the order is xmin,ymin,zmin,xmax,ymax,zmax", text));
    }
    return box;
}

/// True coordinates of two corners.
Box3 parse_extent(const std::string& text) {
    const auto numbers = parse_numbers(text, 0, text.size() + 1);
    if (numbers.size() != 6) {
        throw UsageError(
            fmt::format("six numbers are needed, xmin,ymin,zmin,xmax,ymax,zmax, and {} are given", numbers.size()));
    }
    return box_of(text, numbers);
}

/// "xmin,…,zmax=LMIN,LMAX" or "x,y,z=LMIN,LMAX".
GivenResolution parse_resolution(const std::string& text) {
    const auto equals = text.find('=');
    const auto lengths = equals == std::string::npos ? std::vector<std::string>() : split(text.substr(equals + 1), ',');
    const std::string where = text.substr(0, equals);
    const auto numbers = lengths.size() == 2 ? parse_numbers(where, 0, where.size() + 1) : std::vector<double>();
    if (numbers.size() != 6 && numbers.size() != 3) {
        throw UsageError(
            fmt::format("'{}' is neither xmin,ymin,zmin,xmax,ymax,zmax=LMIN,LMAX for a box nor "
                        "x,y,z=LMIN,LMAX for the fault block that holds a point",
                        text));
    }
    GivenResolution given{{}, parse_positive_length(lengths[0]), parse_positive_length(lengths[1])};
    if (numbers.size() == 6) {
        given.part.box = box_of(where, numbers);
    } else {
        given.part.where = ResolutionOverride::Where::block;
        given.part.point = {numbers[0], numbers[1], numbers[2]};
    }
    return given;
}

/// "x,y,z=NAME", in true coordinates.
RegionName parse_region_name(const std::string& text) {
    const auto equals = text.find('=');
    const auto numbers =
        equals == std::string::npos ? std::vector<double>() : parse_numbers(text.substr(0, equals), 0, text.size());
    if (numbers.size() != 3 || equals + 1 == text.size()) {
        throw UsageError(
            fmt::format("'{}' is not x,y,z=NAME, with a point of the region that is to have the name", text));
    }
    return {{numbers[0], numbers[1], numbers[2]}, text.substr(equals + 1)};
}

PropertyLimit parse_limit(const std::string& text) {
    const auto equals = text.rfind('=');
    const auto limit = equals == std::string::npos ? std::nullopt : parse_number(text.substr(equals + 1));
    if (!limit || equals == 0) {
        throw UsageError(fmt::format("'{}' is not PROPERTY=NUMBER, such as K=0.5", text));
    }
    if (*limit < 0) {
        throw UsageError(fmt::format("'{}' is below 0", text));
    }
    return {text.substr(0, equals), *limit};
}

/// A spacing, or "auto": less where faults run side by side, more where samples are few for so many seeds.
void take_spacing(const std::string& text, ModelArguments& a) {
    a.build.separate_faults = text == "auto";
    a.fault_spacing = a.build.separate_faults ? std::nullopt : std::optional(parse_positive_length(text));
}

void set_limits(const std::string& option, const std::vector<PropertyLimit>& limits, double VariationLimits::*which,
                const std::vector<Property>& properties, Criteria& criteria) {
    for (const auto& [name, limit] : limits) {
        const auto found = find_property(option, name, properties);
        criteria.variation.resize(properties.size());
        criteria.variation[static_cast<std::size_t>(found - properties.begin())].*which = limit;
    }
}

/// With the lengths that are given, in that unit; parts stay in true coordinates.
Criteria criteria_without_variation(const ModelArguments& a, double metres_per_unit) {
    Criteria criteria = a.build.criteria;
    criteria.l_min_floor = in_unit(a.l_min_floor, metres_per_unit);
    criteria.l_min = in_unit(a.l_min, metres_per_unit);
    criteria.l_max = in_unit(a.l_max, metres_per_unit);
    for (const GivenResolution& given : a.resolution) {
        criteria.overrides.push_back(given.part);
        criteria.overrides.back().l_min = given.l_min.in(metres_per_unit);
        criteria.overrides.back().l_max = given.l_max.in(metres_per_unit);
    }
    return criteria;
}

/// Can they be compared before the model's unit is known?
bool are_comparable(const ModelArguments& a) {
    std::vector<Length> lengths;
    for (const auto& given : {a.l_min, a.l_max, a.l_min_floor, a.fault_spacing, a.fault_width}) {
        lengths.insert(lengths.end(), given ? 1 : 0, given.value_or(Length{}));
    }
    for (const GivenResolution& given : a.resolution) {
        lengths.insert(lengths.end(), {given.l_min, given.l_max});
    }
    const auto with_unit = std::ranges::count_if(lengths, &Length::has_unit);
    return with_unit == 0 || with_unit == std::ssize(lengths);
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

void validate_lengths(const ModelArguments& a, double metres_per_unit) {
    validate_given(criteria_without_variation(a, metres_per_unit));
    if (a.fault_spacing && in_unit(a.fault_width, metres_per_unit) > a.fault_spacing->in(metres_per_unit)) {
        throw UsageError("--fault-width: the two sheets of a fault must be nearer to each other than --fault-spacing");
    }
}

/// From sites to outputs, all told; refinement alone takes half of it.
constexpr std::uint64_t bytes_per_vertex = 2000;

std::vector<std::string> estimator_names() {
    return names_of(estimator_catalogue(), &EstimatorMethod::name);
}

Parsed estimator_value(EstimatorSpec& target) {
    Parsed value = single(target, parse_estimator);
    value.words = estimator_names();
    value.standard = target.name;
    return value;
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
              each(a.tolerance, parse_tolerance)},
             {{"lmin"},
              "LENGTH",
              "no new vertex comes nearer to another; by default a hundredth of the diagonal",
              length_value(a.l_min)},
             {{"lmax"}, "LENGTH", "longest edge; by default four times --lmin", length_value(a.l_max)},
             {{"resolution"},
              "WHERE=LMIN,LMAX",
              "others in a part: xmin,ymin,zmin,xmax,ymax,zmax=5,20 in a box, x,y,z=5,20 in the fault block of a point",
              each(a.resolution, parse_resolution)},
             {{"lmin-floor"},
              "LENGTH",
              "however much samples differ, --tolerance keeps them no nearer to each other; by default a 10,000th of "
              "the "
              "diagonal",
              length_value(a.l_min_floor)},
             {{"shape"},
              "WHERE",
              "needed: with --tolerance, cells that vary by less than half of it may be of any shape and "
              "size; "
              "everywhere",
              one_of(a.build.criteria.shape_everywhere, {{"needed", false}, {"everywhere", true}})},
             {{"df-min"},
              "P=V",
              "cells in which property P varies less are left as they are (decades if P:log10)",
              each(a.df_min, parse_limit)},
             {{"df-max"}, "P=V", "largest variation of property P along an edge", each(a.df_max, parse_limit)},
             {{"radius-edge"},
              "R",
              "largest circumradius over shortest edge; above: skinny",
              &a.build.criteria.radius_edge},
             {{"aspect"}, "B", "largest circumradius over inradius; above: flat", &a.build.criteria.aspect},
             {{"dihedral"},
              "DEGREES",
              "smallest dihedral angle wanted: the clean-up mends what it can",
              &a.build.criteria.dihedral_deg},
             {{"vmin"}, "V", "smallest volume wanted: the clean-up mends what it can", &a.build.criteria.v_min},
             {{"vmax"}, "V", "largest volume", &a.build.criteria.v_max},
             {{"max-vertices"}, "N", "refuse or give up beyond; by default what fits into memory", &a.max_vertices},
         }},
        {"The model",
         {
             {{"te", "extent"},
              "XMIN,YMIN,ZMIN,XMAX,YMAX,ZMAX",
              "what to model; by default the data's box and --pad",
              single(a.extent, parse_extent),
              6},
             {{"pad"},
              "LENGTH",
              "around the data's box; by default --lmax in plan, at most half the data's diagonal, and a quarter of "
              "their "
              "height above and below",
              length_value(a.pad, true)},
             {{"density"},
              "HOW",
              "canonical keeps all samples that fit --lmin; paper deletes as the paper does",
              one_of(a.build.density, {{"canonical", DensityMode::canonical}, {"paper", DensityMode::paper}})},
             horizon_option(single(a.horizon, parse_horizon)),
             {{"region-name"},
              "X,Y,Z=NAME",
              "what the region (fault block) is called that holds a point",
              each(a.region_names, parse_region_name)},
             {{"fault-mode"},
              "HOW",
              "paired: two sheets of mirrored points; exact: faults are walls of the Voronoi cells",
              one_of(a.build.barriers.mode, {{"paired", SeedMode::paired}, {"exact", SeedMode::exact}})},
             {{"fault-spacing"},
              "LENGTH",
              "between a fault's points; by default --lmin; auto: less where faults run too close together for that, "
              "if "
              "it can be afforded, and more where few samples would have many",
              Parsed{[&a](const std::string& text) { take_spacing(text, a); }, "length"}},
             {{"fault-width"},
              "LENGTH",
              "between the two sheets; by default a quarter of the spacing",
              length_value(a.fault_width)},
             {{"fault-snap"},
              "LENGTH",
              "faults that stop this short of another end on it; by default a twentieth of the spacing",
              length_value(a.fault_snap)},
             {{"fault-refine"},
              "",
              "finer points on faults where samples come near, so that more of these stay; paired mode",
              &a.build.barriers.refine},
             {{"estimator"},
              "SPEC",
              listed(estimator_names()) + ", with options as in idw:power=3; see 'terratet help estimators'",
              estimator_value(a.estimator)},
         }},
    };
}

void check_model_arguments(const ModelArguments& a) {
    if (a.extent && a.pad) {
        throw UsageError("--pad goes with the data's box: it is not for a given --extent");
    }
    if (are_comparable(a)) {
        validate_lengths(a, 1.0);
    }
    if (std::ranges::any_of(a.tolerance, &AskedTolerance::automatic)) {
        if (a.tolerance.size() > 1 || a.l_min || !a.df_max.empty()) {
            throw UsageError("--tolerance: auto goes with neither another tolerance nor --lmin nor --df-max");
        }
        if (a.build.density == DensityMode::paper) {
            throw UsageError(
                "--tolerance: auto is not for --density paper, which deletes samples whatever their values");
        }
    }
    if (a.max_vertices == 0) {
        throw UsageError("--max-vertices: at least 1 is needed");
    }
}

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
        throw UsageError(fmt::format("'{}' is not soft, hard, or hard=P,Q with names of properties{}", text,
                                     did_you_mean(text, {"soft", "hard"})));
    }
    return hard;
}

Option horizon_option(Parsed target) {
    target.words = {"soft", "hard"};
    target.standard = "soft";
    return {{"horizon"},
            "HOW",
            "soft: values run through horizons; hard: horizons bar, as faults do; hard=P,Q for some properties",
            std::move(target)};
}

void set_horizons(const HardHorizons& horizon, Site& site) {
    for (Property& property : site.properties) {
        property.hard_horizons = horizon.all;
    }
    for (const std::string& name : horizon.properties) {
        const auto found = find_property("--horizon", name, site.properties);
        site.properties[static_cast<std::size_t>(found - site.properties.cbegin())].hard_horizons = true;
    }
}

std::uint64_t fitting_vertex_limit() {
    return memory_limit() / bytes_per_vertex;
}

BuildOptions build_options(const ModelArguments& a, const Site& site) {
    const double unit = site.frame.metres_per_unit;
    validate_lengths(a, unit);
    BuildOptions options = a.build;
    if (a.extent) {
        options.extent = {site.frame.to_local(a.extent->lo), site.frame.to_local(a.extent->hi)};
    }
    if (a.pad) {
        options.pad = a.pad->in(unit);
    }
    options.criteria = criteria_without_variation(a, unit);
    for (ResolutionOverride& part : options.criteria.overrides) {
        if (part.where == ResolutionOverride::Where::box) {
            part.box = {site.frame.to_local(part.box.lo), site.frame.to_local(part.box.hi)};
        } else {
            part.point = site.frame.to_local(part.point);
        }
    }
    for (const RegionName& named : a.region_names) {
        options.region_names.push_back({site.frame.to_local(named.point), named.name});
    }
    set_limits("--df-min", a.df_min, &VariationLimits::df_min, site.properties, options.criteria);
    set_limits("--df-max", a.df_max, &VariationLimits::df_max, site.properties, options.criteria);
    options.default_tolerance = a.tolerance.empty() || std::ranges::any_of(a.tolerance, &AskedTolerance::automatic);
    set_tolerances(a.tolerance, site, options.criteria);
    validate_given(options.criteria);
    options.barriers.spacing = in_unit(a.fault_spacing, unit);
    options.barriers.width = in_unit(a.fault_width, unit);
    options.barriers.snap = in_unit(a.fault_snap, unit);
    options.refine.max_vertices = a.max_vertices == fitting_vertices ? fitting_vertex_limit() : a.max_vertices;
    options.estimator = a.estimator.to_string();
    return options;
}

}  // namespace terratet::tools
