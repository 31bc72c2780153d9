// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/plan/model_source.hpp"
#include "interp/estimator_plan.hpp"

#include <utility>

namespace terratet {

ValueSource make_model_source(const Model& model, const BarrierQuery& barriers, const EstimatorPlan& plan,
                              std::shared_ptr<EstimatorCounters> counters) {
    // Shared, since a std::function must be copyable and estimators are not.
    const auto estimator = std::make_shared<const ModelEstimator>(model, barriers, plan, std::move(counters));
    return [estimator](std::span<const ValueQuery> queries) { return estimator->values(queries); };
}

}  // namespace terratet
