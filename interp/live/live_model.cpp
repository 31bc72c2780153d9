// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/live_model.hpp"
#include "interp/estimator_plan.hpp"

#include <algorithm>
#include <mutex>
#include <utility>

#include "tess/error.hpp"

namespace terratet {
namespace {

std::shared_ptr<ModelSnapshot> built(Site site, const BuildOptions& options, BuildReport& report,
                                     const Progress& progress) {
    const EstimatorPlan plan = parse_estimator_plan(options.estimator);
    const auto counters = std::make_shared<EstimatorCounters>();
    std::shared_ptr<const ModelEstimator> estimator;
    const auto factory = [&](const Model& model, const BarrierQuery& barriers) -> ValueSource {
        estimator = std::make_shared<const ModelEstimator>(model, barriers, plan, counters);
        return [estimator](std::span<const ValueQuery> queries) { return estimator->values(queries); };
    };
    std::unique_ptr<TessellatedModel> made = build(std::move(site), options, factory, report, progress);
    made->model.estimator = estimator->plan().to_string();
    report.fallbacks = counters->fallbacks;
    return std::make_shared<ModelSnapshot>(std::move(made), std::move(estimator));
}

}  // namespace

struct LiveModel::Impl {
    std::shared_ptr<ModelSnapshot> newest;
    mutable std::mutex mutex;  ///< of the pointer
};

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

void LiveModel::remove_surface(const std::string& name, const Progress& progress) {
    const auto before = snapshot();
    Site site = before->model();
    if (std::erase_if(site.surfaces, [&](const Surface& surface) { return surface.name == name; }) == 0) {
        throw UsageError("there is no surface '" + name + "'");
    }
    BuildReport report;
    auto next = built(std::move(site), options_of(before->model()), report, progress);
    const std::lock_guard lock(impl_->mutex);
    impl_->newest = std::move(next);
}

}  // namespace terratet
