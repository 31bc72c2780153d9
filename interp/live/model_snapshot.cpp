// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/model_snapshot.hpp"

#include <algorithm>
#include <array>
#include <mutex>
#include <optional>
#include <sstream>

#include "interp/estimator_plan.hpp"
#include "interp/plan/model_source.hpp"
#include "interp/plan/uncertainty.hpp"
#include "tess/error.hpp"
#include "tess/site_edits.hpp"

namespace terratet {
namespace {

CollapsedModel collapse_checked(const TessellatedModel& made, Collapsing which, const Progress& progress) {
    const Model& model = made.model;
    CollapsedModel result = collapse_faults(model, made.mesh, made.cells, *made.barriers, which, progress);
    const Conformity& c = result.report.conformity;
    if (!c.proper()) {
        const Vec3 where = model.frame.to_world(c.places.empty() ? Vec3{} : c.places.front());
        std::ostringstream text;
        text << "the mesh of faults without width fails its check, first at (" << where.x << ", " << where.y << ", "
             << where.z << "): " << c.not_positive << " cells turned inside out, " << c.unmatched
             << " facets without their twin, " << c.overlapping << " overlapping; volume off by " << c.volume_error
             << "; please report this";
        throw Error(text.str());
    }
    return result;
}

}  // namespace

/// Each function makes what is missing. \pre The mutex is held.
struct ModelSnapshot::Impl {
    std::unique_ptr<TessellatedModel> made;  ///< barriers, tessellation and cells may be missing
    EstimatorPlan plan;
    std::shared_ptr<const ModelEstimator> estimator;
    bool inherited = false;  ///< the estimator: it is that of an earlier state, which it keeps alive
    bool valued = false;     ///< by the estimator, all vertices
    std::unique_ptr<const ModelEstimator> with_errors;
    std::array<std::unique_ptr<const CollapsedModel>, 2> collapsed;  ///< all, bounds
    std::optional<bool> delaunay;
    bool tessellated = false;
    bool described = false;
    std::mutex mutex;

    const BarrierQuery& barriers() {
        if (!made->barriers) {
            made->barriers = model_proximity(made->model);
        }
        return *made->barriers;
    }

    Tessellation& tessellation() {
        if (!made->tessellation) {
            made->tessellation = tessellate(made->model);
        }
        return *made->tessellation;
    }

    const TetMesh& mesh() {
        if (!tessellated) {
            made->mesh = tessellation().mesh();
            tessellated = true;
        }
        return made->mesh;
    }

    const CellTable& cells() {
        if (!described) {
            made->cells = describe_cells(made->model, mesh(), barriers());
            described = true;
        }
        return made->cells;
    }

    const std::shared_ptr<const ModelEstimator>& plain_estimator() {
        if (!estimator) {
            estimator = std::make_shared<const ModelEstimator>(made->model, barriers(), plan);
            inherited = false;
            valued = false;
        }
        return estimator;
    }

    const ModelEstimator& estimator_with_errors() {
        if (!with_errors) {
            with_errors = std::make_unique<const ModelEstimator>(made->model, barriers(), plan, nullptr,
                                                                 ModelEstimatorOptions{.uncertainty = true});
        }
        return *with_errors;
    }
};

ModelSnapshot::ModelSnapshot(Model model) : impl_(std::make_unique<Impl>()) {
    impl_->plan = parse_estimator_plan(model.estimator);
    impl_->made = std::make_unique<TessellatedModel>();
    impl_->made->model = std::move(model);
}

ModelSnapshot::ModelSnapshot(std::unique_ptr<TessellatedModel> made, std::shared_ptr<const ModelEstimator> estimator,
                             bool complete, bool inherited, bool valued)
    : impl_(std::make_unique<Impl>()) {
    impl_->plan = estimator ? estimator->plan() : parse_estimator_plan(made->model.estimator);
    impl_->made = std::move(made);
    impl_->estimator = std::move(estimator);
    impl_->inherited = inherited;
    impl_->valued = valued && impl_->estimator != nullptr;
    impl_->tessellated = complete;
    impl_->described = complete;
}

ModelSnapshot::~ModelSnapshot() = default;

Tessellation ModelSnapshot::take_tessellation() const {
    const std::lock_guard lock(impl_->mutex);
    if (!impl_->made->tessellation) {
        return tessellate(impl_->made->model);
    }
    Tessellation taken = std::move(*impl_->made->tessellation);
    impl_->made->tessellation.reset();
    return taken;
}

void ModelSnapshot::release_memory() const {
    const std::lock_guard lock(impl_->mutex);
    if (impl_->tessellated) {
        impl_->made->tessellation.reset();
    }
    impl_->estimator.reset();
    impl_->with_errors.reset();
}

void ModelSnapshot::add_uncertainty() {
    const std::lock_guard lock(impl_->mutex);
    const ModelEstimator& estimator = impl_->estimator_with_errors();
    terratet::add_uncertainty(impl_->made->model, estimator);
    impl_->plan = estimator.plan();  // with the factors found, so that they stay
    impl_->made->model.estimator = impl_->plan.to_string();
    impl_->with_errors.reset();  // both know the model as it was
    impl_->estimator.reset();
}

const Model& ModelSnapshot::model() const {
    return impl_->made->model;
}

const BarrierQuery& ModelSnapshot::barriers() const {
    const std::lock_guard lock(impl_->mutex);
    return impl_->barriers();
}

const TetMesh& ModelSnapshot::mesh() const {
    const std::lock_guard lock(impl_->mutex);
    return impl_->mesh();
}

const CellTable& ModelSnapshot::cells() const {
    const std::lock_guard lock(impl_->mutex);
    return impl_->cells();
}

bool ModelSnapshot::is_delaunay() const {
    const std::lock_guard lock(impl_->mutex);
    if (!impl_->delaunay) {
        impl_->delaunay = impl_->made->tessellation || !impl_->tessellated
                              ? impl_->tessellation().is_delaunay()
                              : tessellate(impl_->made->model).is_delaunay();  // was given up, and is not wanted again
    }
    return *impl_->delaunay;
}

std::vector<Verdict> ModelSnapshot::verify(bool edited, const Progress& progress, const VerifyOptions& options) const {
    const std::lock_guard lock(impl_->mutex);
    Impl& own = *impl_;
    const ValueSourceFactory factory = [&own](const Model& model, const BarrierQuery& barriers) {
        return make_model_source(model, barriers, own.plan);
    };
    const ValueSource source = [estimator = own.plain_estimator()](std::span<const ValueQuery> queries) {
        return estimator->values(queries);
    };
    auto verdicts =
        terratet::verify({own.made->model, own.barriers(), own.tessellation(), own.mesh(), own.cells(), source},
                         factory, progress, edited, options);
    if (std::ranges::any_of(verdicts, [](const Verdict& v) { return v.guarantee == "R7" && !v.holds; })) {
        own.made->tessellation.reset();  // it was refined
    }
    return verdicts;
}

const CollapsedModel& ModelSnapshot::collapsed(Collapsing which, const Progress& progress) const {
    const std::lock_guard lock(impl_->mutex);
    auto& result = impl_->collapsed[which == Collapsing::all ? 0 : 1];
    if (!result) {
        static_cast<void>(impl_->cells());
        static_cast<void>(impl_->barriers());
        result = std::make_unique<CollapsedModel>(collapse_checked(*impl_->made, which, progress));
    }
    return *result;
}

const ModelEstimator& ModelSnapshot::estimator() const {
    const std::lock_guard lock(impl_->mutex);
    return *impl_->plain_estimator();
}

std::shared_ptr<const ModelEstimator> ModelSnapshot::estimator_of(const std::shared_ptr<const ModelSnapshot>& self) {
    const std::lock_guard lock(self->impl_->mutex);
    const auto& own = self->impl_->plain_estimator();
    return self->impl_->inherited ? own : std::shared_ptr<const ModelEstimator>(self, own.get());
}

const ModelEstimator* ModelSnapshot::source_of_values() const {
    const std::lock_guard lock(impl_->mutex);
    return impl_->valued ? impl_->estimator.get() : nullptr;
}

const ModelEstimator& ModelSnapshot::estimator_with_errors() const {
    const std::lock_guard lock(impl_->mutex);
    return impl_->estimator_with_errors();
}

std::vector<std::uint32_t> ModelSnapshot::neighbours_of(const std::string& borehole) const {
    const Model& model = this->model();
    const auto number = static_cast<std::int32_t>(find_borehole(model, borehole));
    std::vector<char> own(model.vertices.size(), 0);
    for (std::size_t v = 0; v < own.size(); ++v) {
        const Vertex& vertex = model.vertices[v];
        own[v] =
            vertex.role == Role::sample && model.samples.borehole[static_cast<std::size_t>(vertex.owner)] == number;
    }
    std::vector<std::uint32_t> neighbours;
    for (const auto& cell : mesh().cells) {
        if (std::ranges::any_of(cell, [&](std::uint32_t v) { return own[v] != 0; })) {
            std::ranges::copy_if(cell, std::back_inserter(neighbours), [&](std::uint32_t v) { return own[v] == 0; });
        }
    }
    std::ranges::sort(neighbours);
    neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
    return neighbours;
}

}  // namespace terratet
