// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/estimated_accuracy.hpp"
#include "interp/estimator_plan.hpp"
#include "tess/barrier_query.hpp"
#include "tess/value_source.hpp"

namespace terratet::testing {

EstimatedSite::EstimatedSite(const AnalyticSite& site, const std::string& estimator) {
    const EstimatorPlan plan = parse_estimator_plan(estimator);
    BuildReport report;
    const auto factory = [&](const Model& model, const BarrierQuery& faults) {
        return make_model_source(model, faults, plan);
    };
    model_ = std::make_unique<Model>(std::move(build(site.site, site.options, factory, report)->model));
    faults_ = std::make_unique<BarrierQuery>(model_->barriers);
    source_ = make_model_source(*model_, *faults_, plan);
}

std::vector<double> EstimatedSite::estimates(std::span<const Vec3> places) const {
    std::vector<ValueQuery> queries;
    queries.reserve(places.size());
    for (const Vec3& p : places) {
        queries.push_back({p});
    }
    return source_(queries).values[0];
}

GridField EstimatedSite::estimated(GridField grid) const {
    grid.values = estimates(nodes(grid));
    return grid;
}

MeshField EstimatedSite::estimated(MeshField mesh) const {
    mesh.values = estimates(mesh.mesh.points);
    return mesh;
}

}  // namespace terratet::testing
