// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/change_model.hpp"

#include <algorithm>
#include <bit>
#include <iterator>
#include <set>
#include <utility>

#include "tess/barrier/prepare/prepare.hpp"
#include "tess/edit/boundary.hpp"
#include "tess/edit/exchange.hpp"
#include "tess/edit/given_values.hpp"
#include "tess/edit/next_vertices.hpp"
#include "tess/edit/touched_complex.hpp"
#include "tess/error.hpp"
#include "tess/mesh/delaunay.hpp"
#include "tess/refine/refine.hpp"
#include "tess/site/canonical_site.hpp"

namespace terratet {
namespace {

Box3 united(Box3 a, const Box3& b) {
    a.extend(b.lo);
    a.extend(b.hi);
    return a;
}

/// NaN equals NaN.
bool same_values(const Samples& a, const Samples& b) {
    const auto same = [](double x, double y) {
        return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
    };
    return a.positions == b.positions && a.borehole == b.borehole && a.censored == b.censored &&
           std::ranges::equal(a.values, b.values,
                              [&](const auto& x, const auto& y) { return std::ranges::equal(x, y, same); });
}

bool have_distinct_names(const std::vector<Surface>& surfaces) {
    std::set<std::string> names;
    return std::ranges::all_of(surfaces, [&](const Surface& surface) { return names.insert(surface.name).second; });
}

/// Can some surfaces be prepared alone? The ground and a domain's walls meet all that reaches them.
bool separable(const std::vector<Surface>& surfaces) {
    return have_distinct_names(surfaces) &&
           std::ranges::none_of(surfaces, [](const Surface& surface) { return is_bound(surface.kind); });
}

void prepare(const Model& before, Model& model, std::vector<Surface> surfaces, ChangeReport& report,
             const Progress& progress) {
    BuildReport built;
    BuildOptions options = options_of(before);
    options.barriers = model.barrier_options;
    std::swap(model.surfaces, surfaces);
    prepare_boundary(options, model, built, progress);
    std::swap(model.surfaces, surfaces);
    model.domain.hull = united(before.domain.hull, model.domain.hull);  // a fault that goes leaves it as it is
    report.barriers = std::move(built.barriers);
}

/// As they were where no surface has changed. What has, and what meets it, is prepared, the others stay; or all are,
/// where they cannot be told apart, and those that come out as before are the same.
void set_barriers(const Model& before, Model& model, ChangeReport& report, const Progress& progress) {
    model.barriers = before.barriers;
    if (model.surfaces == before.surfaces) {
        return;
    }
    if (!separable(before.surfaces) || !separable(model.surfaces)) {
        prepare(before, model, model.surfaces, report, progress);
        return;
    }
    const double reach = 2 * hull_margin(model.barrier_options, model.criteria.l_min);
    std::vector<Surface> again;
    std::set<std::string> others;
    for (const Surface& surface : model.surfaces) {
        others.insert(surface.name);
    }
    for (const std::size_t i : touched_complex(before.surfaces, model.surfaces, reach)) {
        again.push_back(model.surfaces[i]);
        others.erase(model.surfaces[i].name);
    }
    std::vector<Barrier> barriers;
    std::ranges::copy_if(before.barriers, std::back_inserter(barriers),
                         [&](const Barrier& barrier) { return others.contains(barrier.name); });
    if (!again.empty()) {
        prepare(before, model, std::move(again), report, progress);
        std::ranges::move(model.barriers, std::back_inserter(barriers));
    }
    std::ranges::stable_sort(barriers, {}, &Barrier::name);
    model.barriers = std::move(barriers);
}

/// New ones, and those whose estimates may be others.
std::vector<std::uint32_t> to_value(std::span<const Vertex> vertices, const VertexValues& values,
                                    std::uint64_t first_new, bool same, const NextValues& next) {
    std::vector<std::uint8_t> differs(vertices.size(), same ? 0 : 1);
    if (!same && next.differs) {
        std::vector<ValueQuery> queries;
        queries.reserve(vertices.size());
        for (const Vertex& vertex : vertices) {
            queries.push_back(query_of(vertex));
        }
        differs = next.differs(queries, values.extrapolation);
    }
    std::vector<std::uint32_t> which;
    for (std::uint32_t i = 0; i < vertices.size(); ++i) {
        if (differs[i] != 0 || vertices[i].id >= first_new) {
            which.push_back(i);
        }
    }
    return which;
}

}  // namespace

ModelPlan plan_of(const Model& model) {
    return {model, model.criteria, model.density, model.barrier_options, model.region_names, model.estimator};
}

bool is_local_change(const Model& before, const ModelPlan& plan) {
    Criteria criteria = plan.criteria;
    criteria.overrides = before.criteria.overrides;
    const BarrierOptions& a = before.barrier_options;
    const BarrierOptions& b = plan.barriers;
    return criteria == before.criteria && plan.density == before.density && a.spacing == b.spacing &&
           a.width == b.width && a.snap == b.snap && a.mode == b.mode && a.refine == b.refine &&
           plan.region_names == before.region_names && plan.estimator == before.estimator;
}

std::unique_ptr<TessellatedModel> change_model(
    const Model& before, Tessellation tessellation, ModelPlan plan,
    const std::function<NextValues(const Model&, const BarrierQuery&, bool same_values, bool same_barriers)>& factory,
    ChangeReport& report, const Progress& progress, const RefineOptions& refine_options) {
    auto changed = std::make_unique<TessellatedModel>();
    Model& model = changed->model;
    report.coincident = canonicalise(plan.site);
    static_cast<Site&>(model) = std::move(plan.site);
    if (model.samples.size() == 0) {
        throw UsageError("the model would be left without a sample");
    }
    validate(plan.criteria);
    model.domain = before.domain;
    model.criteria = std::move(plan.criteria);
    model.density = plan.density;
    model.barrier_options = plan.barriers;
    model.region_names = std::move(plan.region_names);
    model.estimator = before.estimator;
    set_barriers(before, model, report, progress);
    changed->barriers = model_proximity(model);
    const BarrierQuery& barriers = *changed->barriers;

    const NextVertices next = next_vertices(before, model, barriers, [&] { report_progress(progress, "density", 0); });
    report.samples_out = next.counts.samples_out;
    report.samples_in = next.counts.samples_in;
    report.seeds_out = next.counts.seeds_out;
    report.seeds_in = next.counts.seeds_in;
    report.inserted_out = next.counts.inserted_out;
    report.outside_extent = next.counts.outside_extent;
    const bool same_barriers = model.barriers == before.barriers;
    const bool same =
        same_barriers && model.properties == before.properties && same_values(model.samples, before.samples);
    const NextValues next_values = factory(model, barriers, same, same_barriers);
    const ValueSource& source = next_values.source;

    delaunay::Core& core = delaunay::core(tessellation);
    for (const auto& [index, vertex] : next.next) {
        core.vertices[index] = vertex;
    }
    VertexValues values = before.vertex_values;
    ValuedVertices in{next.in, {}};
    in.values.values.assign(values.values.size(), std::vector<double>(next.in.size(), missing));
    in.values.extrapolation.assign(next.in.size(), 1);
    Touched touched{{}, next.boxes};
    exchange(core, values, next.out, in, &touched.vertices);
    const std::uint64_t first_new = before.vertices.empty() ? 0 : before.vertices.back().id + 1;
    core.next_id = first_new + next.in.size();
    report_progress(progress, "estimate", 0);
    values.values.resize(model.properties.size(), std::vector<double>(core.vertices.size(), missing));
    const auto valued = to_value(tessellation.vertices(), values, first_new, same, next_values);
    set_values(model, tessellation.vertices(), valued, source, values);

    RefineOptions options = refine_options;
    options.progress = progress;
    if (model.criteria.has_residual() && !same) {  // any cell may be off otherwise than before
        touched.boxes.assign(1, model.domain.hull);
    } else if (model.criteria.has_variation()) {
        touched.vertices.insert(touched.vertices.end(), valued.begin(), valued.end());
        std::ranges::sort(touched.vertices);
        touched.vertices.erase(std::ranges::unique(touched.vertices).begin(), touched.vertices.end());
    }
    report.refine = refine_around(touched, tessellation, values, model.domain, model.frame, barriers, model.criteria,
                                  model.properties, source, options);
    model.vertices.assign(tessellation.vertices().begin(), tessellation.vertices().end());
    model.vertex_values = std::move(values);
    changed->tessellation = std::move(tessellation);
    return changed;
}

VertexChanges vertex_changes(const Model& before, const Model& after) {
    VertexChanges changes;
    const auto value = [](const Model& model, std::size_t p, std::size_t i) {
        return std::bit_cast<std::uint64_t>(model.vertex_values.values[p][i]);
    };
    const auto same = [&](std::size_t i, std::size_t j) {
        const Vertex& a = before.vertices[i];
        const Vertex& b = after.vertices[j];
        bool equal = a.position == b.position && a.role == b.role && a.side == b.side &&
                     before.vertex_values.extrapolation[i] == after.vertex_values.extrapolation[j] &&
                     before.vertex_values.values.size() == after.vertex_values.values.size();
        for (std::size_t p = 0; equal && p < before.vertex_values.values.size(); ++p) {
            equal = value(before, p, i) == value(after, p, j);
        }
        return equal;
    };
    std::size_t i = 0;
    std::size_t j = 0;
    while (i < before.vertices.size() || j < after.vertices.size()) {
        if (j == after.vertices.size() ||
            (i < before.vertices.size() && before.vertices[i].id < after.vertices[j].id)) {
            changes.removed.push_back(before.vertices[i++].id);
        } else if (i == before.vertices.size() || after.vertices[j].id < before.vertices[i].id) {
            changes.added.push_back(after.vertices[j++].id);
        } else if (!same(i++, j++)) {
            changes.changed.push_back(after.vertices[j - 1].id);
        }
    }
    return changes;
}

}  // namespace terratet
