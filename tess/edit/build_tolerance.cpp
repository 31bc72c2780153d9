// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/edit/build_tolerance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "tess/model/density_edition.hpp"
#include "tess/model/tolerance.hpp"

namespace terratet {

namespace {

constexpr double floor_share = 1e-4;    ///< of the diagonal
constexpr double between_share = 1e-3;  ///< of the diagonal
constexpr double poor_r2 = 0.9;
constexpr std::uint64_t enough_of_sample = 50;  ///< by default: few samples tell little of the field between
constexpr std::uint64_t enough_at_least = 20'000;
constexpr std::uint64_t enough_at_most = 120'000;
constexpr std::uint64_t enough_asked_for = 1'000'000;

std::vector<double> tolerances(const Criteria& criteria) {
    std::vector<double> result;
    for (const VariationLimits& limits : criteria.variation) {
        result.push_back(limits.tolerance);
    }
    return result;
}

}  // namespace

bool chooses_tolerance(const BuildOptions& options) {
    return options.default_tolerance && options.criteria.l_min == 0 && !options.criteria.has_tolerance() &&
           options.density == DensityMode::canonical &&
           std::ranges::none_of(options.criteria.variation, [](const VariationLimits& v) { return v.df_max > 0; });
}

void set_tolerance_defaults(const BuildOptions& options, double diagonal, Model& model) {
    Criteria& criteria = model.criteria;
    if (chooses_tolerance(options)) {
        for (std::size_t p = 0; p < model.properties.size(); ++p) {
            criteria.variation[p].tolerance = largest_tolerance(model.properties[p], model.samples.values[p]);
        }
    }
    if (!criteria.has_tolerance()) {
        return;
    }
    if (criteria.l_min_floor == 0) {
        criteria.l_min_floor = std::min(criteria.l_min, floor_share * diagonal);
    }
    if (criteria.l_min_between == 0 && options.criteria.l_min == 0) {
        criteria.l_min_between = std::min(criteria.l_min, std::max(between_share * diagonal, criteria.l_min_floor));
    }
}

void retain_samples(const BuildOptions& options, std::span<const std::uint32_t> inside, const BarrierQuery& barriers,
                    Model& model, const Poll& poll) {
    Criteria& criteria = model.criteria;
    if (!criteria.has_tolerance() || !criteria.fine.empty() || options.density == DensityMode::paper) {
        return;
    }
    for (std::size_t p = 0; p < model.properties.size(); ++p) {
        if (criteria.variation[p].tolerance > 0) {
            criteria.variation[p].trend =
                common_trend(model.properties[p], model.samples.positions, model.samples.values[p]);
        }
    }
    const Samples samples = selected(model.samples, {inside.begin(), inside.end()});
    const std::vector<std::uint32_t> candidates = unprotected(samples, barriers, poll);
    ResolutionField resolution(criteria, model.domain, model.barriers);
    const Trial trial = [&](std::span<const double> tolerance) {
        return retain(samples, model.properties, tolerance, candidates, resolution, criteria.l_min_floor, poll);
    };
    if (!chooses_tolerance(options)) {
        criteria.fine = trial(tolerances(criteria)).fine;
        return;
    }
    criteria.fine = settle_retention(samples, model.properties, trial).fine;
}

void set_residual_limits(const BuildOptions& options, Model& model) {
    for (std::size_t p = 0; p < model.properties.size(); ++p) {
        VariationLimits& limits = model.criteria.variation[p];
        const double noise = options.estimator_noise ? options.estimator_noise(model.properties[p]) : 0;
        limits.residual = limits.tolerance > 0 && std::isfinite(noise) ? std::max(limits.tolerance, noise) : 0;
    }
}

std::uint64_t enough_vertices(const BuildOptions& options, const Model& model) {
    const std::uint64_t given = options.refine.enough_vertices;
    if (given > 0 || !model.criteria.has_residual() || options.criteria.l_min > 0 ||
        options.criteria.l_min_between > 0) {
        return given;
    }
    return chooses_tolerance(options)
               ? std::clamp(enough_of_sample * model.samples.size(), enough_at_least, enough_at_most)
               : enough_asked_for;
}

void keep_l_min_between(Model& model, BuildReport& report) {
    if (report.refine.l_min_between > 0 && model.criteria.l_min_between > 0) {
        model.criteria.l_min_between = report.refine.l_min_between;
    }
    if (!report.refine.stopped) {
        return;
    }
    std::ostringstream note;
    note.precision(4);
    note << "vertices between samples keep " << model.criteria.l_min_between
         << " from each other, or there would be too many: where the field asks for nearer ones it may be off by more "
            "than the tolerance. A larger `tolerance` needs fewer; a smaller `l_min` with a `tolerance` allows more";
    report.diagnostics.note(note.str());
}

std::function<double(const Property&)> stored_noise(const Model& model) {
    return [&model](const Property& property) {
        const auto found = std::ranges::find(model.properties, property.name, &Property::name);
        const auto p = static_cast<std::size_t>(found - model.properties.begin());
        const double residual = p < model.criteria.variation.size() ? model.criteria.variation[p].residual : 0;
        return residual > 0 ? residual : std::numeric_limits<double>::infinity();
    };
}

void note_lost_field(const Model& model, BuildReport& report) {
    for (std::size_t p = 0; p < report.fidelity.size(); ++p) {
        const Fidelity& fit = report.fidelity[p];
        const Property& property = model.properties[p];
        if (fit.r2 >= poor_r2 || fit.count < 2 || property.kind == Kind::categorical || fit.tolerance > 0) {
            continue;
        }
        std::ostringstream note;
        note.precision(4);
        note << property.name << ": the tessellation's field explains "
             << (fit.r2 > 0 ? std::to_string(std::lround(100 * fit.r2)) + " % of" : "nothing of")
             << " the samples' variance (R2 " << fit.r2 << "): " << report.density.deleted << " samples left out by "
             << "`l_min` " << model.criteria.l_min
             << (model.density == DensityMode::paper ? ", as `density` paper deletes whatever their values" : "")
             << ". `tolerance` " << property.name << "=" << fit.sd / 4 << " keeps those that matter";
        report.diagnostics.note(note.str());
    }
}

}  // namespace terratet
