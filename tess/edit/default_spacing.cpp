// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/edit/default_spacing.hpp"

#include <algorithm>
#include <cmath>

#include "tess/barrier_query.hpp"
#include "tess/edit/boundary.hpp"
#include "tess/edit/vertex_demand.hpp"

namespace terratet {
namespace {

constexpr double few_seeds = 5000;
constexpr double seeds_a_sample = 10;
constexpr double step = 1.5;
constexpr double protection_share = 0.75;  ///< protection radius at L_min, in L_min: sqrt(1/2 + 1/64)

bool is_free(const BuildOptions& options, const Model& model) {
    const BarrierOptions& asked = options.barriers;
    return options.separate_faults && asked.spacing == 0 && asked.width == 0 && asked.snap == 0 &&
           std::ranges::none_of(model.surfaces, [](const Surface& surface) { return is_bound(surface.kind); });
}

/// About as many as they take.
double seeds_at(double spacing, const Model& model, BarrierOptions barriers) {
    barriers.spacing = spacing;
    return (barriers.mode == SeedMode::exact ? 4.7 : 2.4) * vertex_demand(model, barriers).seeds;
}

bool follows(const BarrierAccount& account, double l_min) {
    return account.area_refused == 0 && account.deviation_p95 <= l_min / 8 && account.deviation_max <= l_min / 2;
}

/// Samples that leave the tessellation, and would not at L_min.
std::size_t lost_samples(const Model& model) {
    const BarrierQuery barriers(model.barriers);
    const double least = protection_share * model.criteria.l_min;
    return static_cast<std::size_t>(std::ranges::count_if(model.samples.positions, [&](const Vec3& p) {
        if (!model.domain.extent.contains(p) || barriers.protecting_barrier(p) < 0) {
            return false;
        }
        for (std::size_t f = 0; f < model.barriers.size(); ++f) {
            if (barriers.distance_to_sheet(static_cast<std::int32_t>(f), p) < least) {
                return false;
            }
        }
        return true;
    }));
}

bool costs_nothing(const Model& model, const BuildReport& report, double at_l_min) {
    std::size_t seeds = 0;
    for (const Barrier& barrier : model.barriers) {
        seeds += barrier.seeds.size();
    }
    return std::ranges::all_of(report.barriers,
                               [&](const BarrierAccount& a) { return follows(a, model.criteria.l_min); }) &&
           static_cast<double>(seeds) < at_l_min / 2 && 50 * lost_samples(model) <= model.samples.size();
}

}  // namespace

void prepare_boundary_at_default_spacing(const BuildOptions& options, Model& model, BuildReport& report,
                                         const Progress& progress) {
    const double l_min = model.criteria.l_min;
    const double at_l_min = is_free(options, model) ? seeds_at(l_min, model, options.barriers) : 0;
    const double enough = std::max(few_seeds, seeds_a_sample * static_cast<double>(model.samples.size()));
    if (at_l_min <= enough) {
        prepare_boundary(options, model, report, progress);
        return;
    }
    BuildOptions chosen = options;
    double spacing = std::min(l_min * std::sqrt(at_l_min / enough), model.criteria.l_max / std::sqrt(2.0));
    for (; spacing > std::sqrt(2.0) * l_min; spacing /= step) {
        chosen.barriers.spacing = spacing;
        chosen.barriers.refine = options.barriers.mode == SeedMode::paired;
        prepare_boundary(chosen, model, report, progress);
        if (costs_nothing(model, report, at_l_min)) {
            return;
        }
    }
    chosen.barriers = options.barriers;
    chosen.barriers.spacing = l_min;
    prepare_boundary(chosen, model, report, progress);
}

}  // namespace terratet
