// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/run/edit_verbs.hpp"

#include <algorithm>
#include <functional>
#include <map>

#include <fmt/format.h>

#include "io/edit/samples_where.hpp"
#include "io/read/tables/read_table.hpp"
#include "io/read_site.hpp"
#include "tess/base/words.hpp"
#include "tess/error.hpp"
#include "tess/site_edits.hpp"
#include "tools/options/command_line.hpp"
#include "tools/options/model_options.hpp"
#include "tools/options/query_options.hpp"
#include "tools/options/text.hpp"
#include "tools/options/values.hpp"

namespace terratet::tools {
namespace {

const std::string& word(const EditArguments& a, std::size_t i, const char* what) {
    if (a.words.size() <= i) {
        throw UsageError(fmt::format("edit {}: {} is missing", a.words.front(), what));
    }
    return a.words[i];
}

void require_words(const EditArguments& a, std::size_t most) {
    if (a.words.size() > most) {
        throw UsageError(fmt::format("edit {}: '{}' is one word too many", a.words.front(), a.words[most]));
    }
}

/// Categories have to be read as such; what no table has is not asked for.
std::vector<std::string> properties_in(const SiteInputs& inputs, const Site& site) {
    std::vector<std::string> wanted;
    std::vector<Table> tables;
    for (const auto* sources : {&inputs.logs, &inputs.samples}) {
        for (const Source& source : *sources) {
            tables.push_back(read_table(source));
        }
    }
    for (const Property& property : site.properties) {
        if (std::ranges::any_of(tables, [&](const Table& t) { return column_named(t, property.name) >= 0; })) {
            wanted.push_back(property.name + (property.kind == Kind::categorical ? ":categorical" : ""));
        }
    }
    return wanted;
}

/// In the model's coordinate system, which is also that of inputs that carry none.
Site read_more(const SiteArguments& arguments, const Site& site, Diagnostics& diagnostics) {
    SiteInputs inputs = site_inputs(arguments, false);
    inputs.target_crs = site.frame.crs_wkt.empty() ? "local" : site.frame.crs_wkt;
    if (inputs.source_crs.empty()) {
        inputs.source_crs = inputs.target_crs;
    }
    inputs.z_scale = 1;
    if (inputs.properties.empty()) {
        inputs.properties = properties_in(inputs, site);
    }
    Site read = read_site(inputs, diagnostics);
    composite_as_asked(read, arguments, diagnostics);
    return read;
}

void add(const EditArguments& a, ModelPlan& plan, const SiteArguments& arguments, Diagnostics& diagnostics) {
    const Site read = read_more(arguments, plan.site, diagnostics);
    if (const bool faults = a.words.front() == "add-fault"; faults && read.surfaces.empty()) {
        throw InputError(arguments.faults.front() + ": holds no fault");
    }
    for (const std::string& name : add_site(plan.site, read)) {
        diagnostics.note(fmt::format("property {} is not in the model: its values are left out", name));
    }
}

void add_fault(const EditArguments& a, ModelPlan& plan, Diagnostics& diagnostics) {
    SiteArguments arguments = a.site;
    if (a.words.size() > 1) {
        require_words(a, 2);
        arguments.faults.push_back(a.words[1]);
    }
    if (arguments.faults.empty() && arguments.surfaces.empty()) {
        word(a, 1, "FILE");
    }
    add(a, plan, arguments, diagnostics);
}

void replace_fault(const EditArguments& a, ModelPlan& plan, Diagnostics& diagnostics) {
    require_words(a, 3);
    const std::string& name = word(a, 1, "NAME");
    SiteArguments arguments = a.site;
    arguments.faults.push_back(word(a, 2, "FILE"));
    ModelPlan next = plan;
    remove_surface(next.site, name);
    Site read = read_more(arguments, next.site, diagnostics);
    if (read.surfaces.size() > 1) {
        std::erase_if(read.surfaces, [&](const Surface& surface) { return surface.name != name; });
    }
    if (read.surfaces.size() != 1) {
        throw InputError(fmt::format("{}: holds several faults, and none of them is '{}'", a.words[2], name));
    }
    read.surfaces.front().name = name;
    add_site(next.site, read);
    plan = std::move(next);
}

void add_boreholes(const EditArguments& a, ModelPlan& plan, Diagnostics& diagnostics) {
    SiteArguments arguments = a.site;
    require_words(a, 2);
    if (a.words.size() > 1) {
        arguments.boreholes.push_back(a.words[1]);
    }
    if (arguments.boreholes.empty()) {
        throw UsageError("edit add-boreholes: give --boreholes, with --survey and --log as for build");
    }
    add(a, plan, arguments, diagnostics);
}

void add_samples(const EditArguments& a, ModelPlan& plan, Diagnostics& diagnostics) {
    require_words(a, 2);
    SiteArguments arguments = a.site;
    arguments.samples.push_back(word(a, 1, "FILE"));
    add(a, plan, arguments, diagnostics);
}

void move(const EditArguments& a, ModelPlan& plan) {
    require_words(a, 2);
    const std::string& id = word(a, 1, "ID");
    if (a.by.empty() == a.to.empty()) {
        throw UsageError("edit move-borehole: give either --by dx,dy[,dz] or --to x,y,z");
    }
    const Frame& frame = plan.site.frame;
    if (!a.by.empty()) {
        const auto n = option_numbers("--by", a.by, 2, 3);
        move_borehole(plan.site, id, frame.to_local_size({n[0], n[1], n.size() > 2 ? n[2] : 0}));
    } else {
        const auto n = option_numbers("--to", a.to, 3, 3);
        const Vec3 collar = plan.site.boreholes[find_borehole(plan.site, id)].collar;
        move_borehole(plan.site, id, frame.to_local({n[0], n[1], n[2]}) - collar);
    }
}

void remove_where(const EditArguments& a, ModelPlan& plan) {
    require_words(a, 1);
    if (a.site.where.empty()) {
        throw UsageError("edit remove-samples: give --where SQL, such as \"borehole = 'KR1' AND depth > 200\"");
    }
    const auto marked = samples_where(plan.site, a.site.where);
    if (std::ranges::find(marked, true) == marked.end()) {
        throw UsageError(fmt::format("edit remove-samples: no sample is such that {}", a.site.where));
    }
    remove_samples(plan.site, marked);
}

/// As the build's option of that name is understood.
BuildOptions parsed_option(const std::string& option, const std::string& value, const Site& site) {
    ModelArguments arguments;
    const Syntax syntax{"edit", model_options(arguments), {}};
    const bool is_switch = option == "fault-refine" && value == "true";
    parse_arguments(syntax, is_switch ? std::vector{"--" + option} : std::vector{"--" + option, value});
    check_model_arguments(arguments);
    return build_options(arguments, site);
}

void set_limits(const BuildOptions& given, double VariationLimits::*which, ModelPlan& plan) {
    plan.criteria.variation.resize(plan.site.properties.size());
    for (std::size_t p = 0; p < given.criteria.variation.size(); ++p) {
        if (given.criteria.variation[p].*which > 0) {
            plan.criteria.variation[p].*which = given.criteria.variation[p].*which;
        }
    }
}

void set(const EditArguments& a, ModelPlan& plan) {
    require_words(a, 2);
    const std::string& text = word(a, 1, "OPTION=VALUE");
    const auto equals = text.find('=');
    if (equals == std::string::npos || equals == 0) {
        throw UsageError(fmt::format("edit set: '{}' is not OPTION=VALUE, such as lmax=80m", text));
    }
    const std::string option = text.substr(text.find_first_not_of('-'), equals - text.find_first_not_of('-'));
    const std::string value = text.substr(equals + 1);
    using Taken = std::function<void(const BuildOptions&)>;
    Criteria& c = plan.criteria;
    const auto criterion = [&](double Criteria::*field) -> Taken {
        return [&c, field](const BuildOptions& given) { c.*field = given.criteria.*field; };
    };
    const auto barrier = [&](auto field) -> Taken {
        return [&plan, field](const BuildOptions& given) { plan.barriers.*field = given.barriers.*field; };
    };
    const std::map<std::string, Taken> options{
        {"lmin", criterion(&Criteria::l_min)},
        {"lmax", criterion(&Criteria::l_max)},
        {"radius-edge", criterion(&Criteria::radius_edge)},
        {"aspect", criterion(&Criteria::aspect)},
        {"dihedral", criterion(&Criteria::dihedral_deg)},
        {"vmin", criterion(&Criteria::v_min)},
        {"vmax", criterion(&Criteria::v_max)},
        {"df-min", [&](const BuildOptions& given) { set_limits(given, &VariationLimits::df_min, plan); }},
        {"df-max", [&](const BuildOptions& given) { set_limits(given, &VariationLimits::df_max, plan); }},
        {"density", [&](const BuildOptions& given) { plan.density = given.density; }},
        {"estimator", [&](const BuildOptions& given) { plan.estimator = given.estimator; }},
        {"fault-mode", barrier(&BarrierOptions::mode)},
        {"fault-spacing", barrier(&BarrierOptions::spacing)},
        {"fault-width", barrier(&BarrierOptions::width)},
        {"fault-snap", barrier(&BarrierOptions::snap)},
        {"fault-refine", barrier(&BarrierOptions::refine)},
    };
    const auto found = options.find(option);
    if (found == options.end()) {
        std::vector<std::string> known;
        for (const auto& [name, taken] : options) {
            known.push_back(name);
        }
        throw UsageError(fmt::format("edit set: there is no option '{}'; there is {}{}", option, listed(known),
                                     did_you_mean(option, known)));
    }
    found->second(parsed_option(option, value, plan.site));
    validate(c);
}

/// The last part's resolution that holds the place, else the general one.
std::pair<double, double> resolution_at(const Criteria& criteria, const Vec3& p) {
    std::pair<double, double> result{criteria.l_min, criteria.l_max};
    for (const ResolutionOverride& part : criteria.overrides) {
        if (part.where == ResolutionOverride::Where::box && part.box.contains(p)) {
            result = {part.l_min, part.l_max};
        }
    }
    return result;
}

/// A part that is said anew takes the place of what was said of it.
void set_resolution(ModelPlan& plan, const ResolutionOverride& part) {
    std::erase_if(plan.criteria.overrides, [&](const ResolutionOverride& other) {
        return other.where == part.where && other.box == part.box && other.point == part.point;
    });
    plan.criteria.overrides.push_back(part);
}

void refine_box(const EditArguments& a, ModelPlan& plan) {
    require_words(a, 1);
    if (a.box.empty()) {
        throw UsageError("edit refine: give --box xmin,ymin,zmin,xmax,ymax,zmax");
    }
    const auto n = option_numbers("--box", a.box, 6, 6);
    const Box3 box{plan.site.frame.to_local({n[0], n[1], n[2]}), plan.site.frame.to_local({n[3], n[4], n[5]})};
    const auto [l_min, l_max] = resolution_at(plan.criteria, box.center());
    const double unit = plan.site.frame.metres_per_unit;
    ResolutionOverride part;
    part.box = box;
    part.l_min = a.l_min ? a.l_min->in(unit) : l_min / 2;
    part.l_max = a.l_max ? a.l_max->in(unit) : l_max / 2;
    set_resolution(plan, part);
    validate(plan.criteria);
}

}  // namespace

void apply_edit(const EditArguments& a, ModelPlan& plan, Diagnostics& diagnostics) {
    const std::string& verb = a.words.front();
    ModelPlan next = plan;
    if (verb == "add-fault") {
        add_fault(a, next, diagnostics);
    } else if (verb == "remove-fault") {
        require_words(a, 2);
        remove_surface(next.site, word(a, 1, "NAME"));
    } else if (verb == "replace-fault") {
        replace_fault(a, next, diagnostics);
    } else if (verb == "add-boreholes") {
        add_boreholes(a, next, diagnostics);
    } else if (verb == "remove-borehole") {
        require_words(a, 2);
        remove_borehole(next.site, word(a, 1, "ID"));
    } else if (verb == "move-borehole") {
        move(a, next);
    } else if (verb == "add-samples") {
        add_samples(a, next, diagnostics);
    } else if (verb == "remove-samples") {
        remove_where(a, next);
    } else if (verb == "set") {
        set(a, next);
    } else if (verb == "set-resolution") {
        require_words(a, 2);
        set_resolution(
            next, parsed_option("resolution", word(a, 1, "WHERE=LMIN,LMAX"), next.site).criteria.overrides.front());
    } else if (verb == "refine") {
        refine_box(a, next);
    } else {
        throw UsageError(fmt::format("edit: '{}' is no verb; there is {}{}", verb, listed(edit_verbs()),
                                     did_you_mean(verb, edit_verbs())));
    }
    plan = std::move(next);
}

}  // namespace terratet::tools
