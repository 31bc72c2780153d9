// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/run/pipeline.hpp"

#include <algorithm>
#include <chrono>

#include <fmt/format.h>

#include "interp/estimator_spec.hpp"
#include "tools/options/text.hpp"
#include "tools/options/tolerance_option.hpp"

namespace terratet::tools {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

std::vector<std::pair<std::string, std::string>> chosen_defaults(const ModelArguments& a, bool z_scale_given,
                                                                 const Model& model) {
    std::vector<std::pair<std::string, std::string>> chosen;
    const auto add = [&](bool given, const char* name, double value) {
        if (!given) {
            chosen.emplace_back(name, short_number(value));
        }
    };
    const bool tolerance_chosen = a.tolerance.empty() || std::ranges::any_of(a.tolerance, &AskedTolerance::automatic);
    for (std::size_t p = 0; p < model.properties.size() && tolerance_chosen; ++p) {
        const double tolerance = p < model.criteria.variation.size() ? model.criteria.variation[p].tolerance : 0;
        if (tolerance > 0) {
            chosen.emplace_back("tolerance", model.properties[p].name + "=" + short_number(tolerance));
        }
    }
    add(a.l_min.has_value(), "lmin", model.criteria.l_min);
    add(a.l_max.has_value(), "lmax", model.criteria.l_max);
    if (!a.extent) {
        const Vec3 lo = model.frame.to_world(model.domain.extent.lo);
        const Vec3 hi = model.frame.to_world(model.domain.extent.hi);
        chosen.emplace_back("extent", fmt::format("{:.10g},{:.10g},{:.10g},{:.10g},{:.10g},{:.10g}", lo.x, lo.y, lo.z,
                                                  hi.x, hi.y, hi.z));
    }
    add(model.frame.z_scale == 1 || z_scale_given, "z-scale", model.frame.z_scale);
    if (!model.barriers.empty()) {
        const double spacing = model.barrier_options.spacing > 0 ? model.barrier_options.spacing : model.criteria.l_min;
        add(a.fault_spacing.has_value(), "fault-spacing", spacing);
        add(a.fault_width.has_value(), "fault-width",
            model.barrier_options.width > 0 ? model.barrier_options.width : spacing / 4);
    }
    return chosen;
}

}  // namespace

void check_before_reading(const SiteArguments& site, const ModelArguments& model, const RunArguments& run) {
    site_inputs(site, run.strict);
    check_model_arguments(model);
}

LiveModel read_and_build(const SiteArguments& site_arguments, const ModelArguments& arguments, const RunArguments& run,
                         const Progress& progress, BuildRecord& record) {
    const auto begin = Clock::now();
    Site site = read_site(site_inputs(site_arguments, run.strict), record.diagnostics, record.counts, progress);
    composite_as_asked(site, site_arguments, record.diagnostics);
    set_horizons(arguments.horizon, site);
    record.counts.samples = site.samples.size();
    record.seconds["read"] = seconds_since(begin);

    BuildOptions options = build_options(arguments, site);
    options.refine.progress = progress;
    record.estimator = arguments.estimator;
    LiveModel live(std::move(site), options, record.report, progress);

    record.defaults = chosen_defaults(arguments, site_arguments.inputs.z_scale > 0, live.model());
    record.seconds.insert(record.report.seconds.begin(), record.report.seconds.end());
    auto& all = record.diagnostics;
    const auto& built = record.report.diagnostics;
    all.rejected.insert(all.rejected.end(), built.rejected.begin(), built.rejected.end());
    all.notes.insert(all.notes.end(), built.notes.begin(), built.notes.end());
    return live;
}

std::uint64_t unmet_cells(const RefineReport& report) {
    std::uint64_t unmet = 0;
    for (const auto& [reason, cells] : report.skipped) {
        if (reason != Reason::none && reason != Reason::smooth && reason != Reason::fault_gap) {
            unmet += cells;
        }
    }
    return unmet;
}

}  // namespace terratet::tools
