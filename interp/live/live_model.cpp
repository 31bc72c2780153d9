// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/live_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <utility>

#include "interp/estimator_plan.hpp"
#include "interp/plan/estimator_choice.hpp"
#include "tess/edit/matched_rows.hpp"
#include "tess/error.hpp"
#include "tess/site_edits.hpp"

namespace terratet {
namespace {

std::shared_ptr<ModelSnapshot> built(Site site, const BuildOptions& options, BuildReport& report,
                                     const Progress& progress) {
    const EstimatorPlan plan = with_open_chosen(parse_estimator_plan(options.estimator));
    const auto counters = std::make_shared<EstimatorCounters>();
    std::shared_ptr<const ModelEstimator> estimator;
    const auto factory = [&](const Model& model, const BarrierQuery& barriers) -> ValueSource {
        estimator = std::make_shared<const ModelEstimator>(model, barriers, plan, counters);
        return [estimator](std::span<const ValueQuery> queries) { return estimator->values(queries); };
    };
    BuildOptions with_noise = options;
    with_noise.estimator_noise = [&estimator](const Property& property) {
        const EstimatorSpec& spec = estimator->plan().of(property.name);
        return spec.name == "nearest" ? std::numeric_limits<double>::infinity()
                                      : std::sqrt(std::max(0.0, spec.given("nugget").value_or(0)));
    };
    std::unique_ptr<TessellatedModel> made = build(std::move(site), with_noise, factory, report, progress);
    made->model.estimator = estimator->plan().to_string();
    report.fallbacks = counters->fallbacks;
    return std::make_shared<ModelSnapshot>(std::move(made), std::move(estimator));
}

/// Some property was derived from another, for the vertices alone (interp/plan/uncertainty.hpp).
bool has_uncertainty(const Model& model) {
    return std::ranges::any_of(model.properties, [&](const Property& property) {
        return std::ranges::find(model.properties, property.name + "_extrapolation", &Property::name) !=
               model.properties.end();
    });
}

/// What bars estimation reaches past the box of hull and samples.
bool sees_alike(const Model& before, const Model& after) {
    return before.properties == after.properties && before.estimator == after.estimator &&
           (before.barriers.empty() ||
            (before.domain.hull == after.domain.hull &&
             bounding_box(before.samples.positions) == bounding_box(after.samples.positions)));
}

/// Of each sample of `after` its number in `before`; −1: none.
std::vector<std::int64_t> samples_before(const Model& before, const Model& after) {
    std::vector<std::int64_t> numbers(after.samples.size(), -1);
    const auto next_of = matched_samples(before.samples, after.samples);
    for (std::size_t i = 0; i < next_of.size(); ++i) {
        if (next_of[i] >= 0) {
            numbers[static_cast<std::size_t>(next_of[i])] = static_cast<std::int64_t>(i);
        }
    }
    return numbers;
}

std::shared_ptr<ModelSnapshot> changed(const std::shared_ptr<const ModelSnapshot>& before, ModelPlan plan,
                                       ChangeReport& report, const Progress& progress, const RefineOptions& refine) {
    std::shared_ptr<const ModelEstimator> estimator;
    bool inherited = false;
    bool valued = true;
    const auto factory = [&](const Model& model, const BarrierQuery& barriers, bool same_values,
                             bool same_barriers) -> NextValues {
        const ModelEstimator* source = before->source_of_values();
        inherited = same_values;
        valued = !same_values || source != nullptr;
        estimator = same_values ? ModelSnapshot::estimator_of(before)
                                : std::make_shared<const ModelEstimator>(model, barriers,
                                                                         parse_estimator_plan(model.estimator));
        NextValues next([estimator](std::span<const ValueQuery> queries) { return estimator->values(queries); });
        if (!same_values && source != nullptr && same_barriers && sees_alike(before->model(), model)) {
            const auto changes = estimator->changes_since(*source, samples_before(before->model(), model));
            next.differs = [changes](std::span<const ValueQuery> places, std::span<const double> extrapolation) {
                return changes->at(places, extrapolation);
            };
        }
        return next;
    };
    auto made =
        change_model(before->model(), before->take_tessellation(), std::move(plan), factory, report, progress, refine);
    return std::make_shared<ModelSnapshot>(std::move(made), std::move(estimator), false, inherited, valued);
}

/// With the options it was built with, but for what the plan says.
std::shared_ptr<ModelSnapshot> built_again(const Model& before, ModelPlan plan, ChangeReport& report,
                                           const Progress& progress, const RefineOptions& refine) {
    BuildOptions options = options_of(before);
    options.criteria = std::move(plan.criteria);
    options.density = plan.density;
    options.barriers = plan.barriers;
    options.region_names = std::move(plan.region_names);
    options.estimator = std::move(plan.estimator);
    options.refine = refine;
    BuildReport built_report;
    auto next = built(std::move(plan.site), options, built_report, progress);
    report.coincident = built_report.coincident;
    report.outside_extent = built_report.outside_extent;
    report.samples_in = built_report.density.kept.size();
    report.seeds_in = built_report.seeds;
    report.refine = built_report.refine;
    report.barriers = std::move(built_report.barriers);
    return next;
}

}  // namespace

struct LiveModel::Impl {
    std::mutex writing;  ///< one edit at a time
    std::shared_ptr<ModelSnapshot> newest;
    mutable std::mutex mutex;  ///< of the pointer
};

LiveModel LiveModel::measured(Site site) {
    Model model;
    static_cast<Site&>(model) = std::move(site);
    merge_coincident(model.samples, model.properties);
    const bool hard = std::ranges::any_of(model.properties, &Property::hard_horizons);
    for (const Surface& surface : model.surfaces) {
        if (surface.kind == SurfaceKind::fault || (hard && surface.kind == SurfaceKind::horizon)) {
            Barrier& barrier = model.barriers.emplace_back();
            barrier.name = surface.name;
            barrier.sheet = surface;
        }
    }
    return LiveModel(std::move(model));
}

LiveModel::LiveModel(Model model) : impl_(std::make_unique<Impl>()) {
    impl_->newest = std::make_shared<ModelSnapshot>(std::move(model));
}

LiveModel::LiveModel(Site site, const BuildOptions& options, BuildReport& report, const Progress& progress)
    : impl_(std::make_unique<Impl>()) {
    impl_->newest = built(std::move(site), options, report, progress);
}

LiveModel::LiveModel(Site site, const BuildOptions& options, const Progress& progress)
    : impl_(std::make_unique<Impl>()) {
    BuildReport report;
    impl_->newest = built(std::move(site), options, report, progress);
}

LiveModel::LiveModel(const std::shared_ptr<const ModelSnapshot>& state) : impl_(std::make_unique<Impl>()) {
    impl_->newest = std::const_pointer_cast<ModelSnapshot>(state);  // changed only where nobody else has it
}

LiveModel::~LiveModel() = default;
LiveModel::LiveModel(LiveModel&&) noexcept = default;
LiveModel& LiveModel::operator=(LiveModel&&) noexcept = default;

std::shared_ptr<const ModelSnapshot> LiveModel::snapshot() const {
    const std::lock_guard lock(impl_->mutex);
    return impl_->newest;
}

std::vector<double> LiveModel::value_at(const Vec3& place) const {
    const ValueQuery query{place};
    std::vector<double> values;
    for (const auto& of_property : snapshot()->estimator().values({&query, 1}).values) {
        values.push_back(of_property.front());
    }
    return values;
}

void LiveModel::add_uncertainty() {
    const std::lock_guard lock(impl_->mutex);
    if (impl_->newest.use_count() > 1) {  // somebody holds it
        impl_->newest = std::make_shared<ModelSnapshot>(Model(impl_->newest->model()));
    }
    impl_->newest->add_uncertainty();
}

ChangeReport LiveModel::edit(ModelPlan plan, const Progress& progress, const RefineOptions& refine) {
    const std::lock_guard one_at_a_time(impl_->writing);
    const auto before = snapshot();
    const bool uncertain = has_uncertainty(before->model());
    ChangeReport report;
    std::shared_ptr<ModelSnapshot> next;
    if (is_local_change(before->model(), plan)) {
        next = changed(before, std::move(plan), report, progress, refine);
    } else {
        next = built_again(before->model(), std::move(plan), report, progress, refine);
    }
    if (uncertain) {
        next->add_uncertainty();
    }
    const std::lock_guard lock(impl_->mutex);
    impl_->newest = std::move(next);
    return report;
}

void LiveModel::remove_surface(const std::string& name, const Progress& progress) {
    ModelPlan plan = plan_of(model());
    terratet::remove_surface(plan.site, name);
    edit(std::move(plan), progress);
}

}  // namespace terratet
