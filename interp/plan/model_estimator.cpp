// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/model_estimator.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "interp/estimator/beside_barriers.hpp"
#include "interp/estimator/query_order.hpp"
#include "interp/estimator_plan.hpp"
#include "interp/natural/linear_precision.hpp"
#include "interp/plan/estimator_choice.hpp"
#include "interp/plan/extrapolation.hpp"
#include "interp/plan/fitted_estimator.hpp"
#include "interp/plan/learned_errors.hpp"
#include "interp/plan/make_estimator.hpp"

namespace terratet {
namespace {

/// Weights of so many queries are held at a time.
constexpr std::size_t block_size = 4096;

/// A property's values at the sites of its group.
struct Column {
    std::size_t property;
    std::vector<double> measured;
    std::vector<double> scaled;
    ColumnTraits traits;
    std::optional<LearnedErrors> errors;
    EstimatorSpec open{};  ///< as asked or chosen, before it was fitted
};

/// Properties measured at the same samples, barred by the same and estimated alike, and the estimator over those.
struct Group {
    EstimatorSpec spec;
    const BarrierQuery* barriers = nullptr;
    std::vector<std::uint32_t> samples;
    std::vector<Vec3> sites;
    std::vector<Column> columns;
    std::unique_ptr<Estimator> estimator;
    std::shared_ptr<const Slopes> slopes;  ///< by column
};

Column column_of(const Model& model, std::size_t p, const std::vector<std::uint32_t>& samples) {
    Column column{p, {}, {}, {}, {}, {}};
    for (const std::uint32_t s : samples) {
        column.measured.push_back(model.samples.values[p][s]);
        column.scaled.push_back(to_scale(model.properties[p], column.measured.back()));
    }
    return column;
}

template <typename T>
std::vector<T> picked(const std::vector<T>& from, std::span<const std::uint32_t> which) {
    std::vector<T> out;
    out.reserve(which.size());
    for (const std::uint32_t i : which) {
        out.push_back(from[i]);
    }
    return out;
}

std::vector<std::uint32_t> samples_with(const Model& model, std::size_t p) {
    std::vector<std::uint32_t> present;
    for (std::uint32_t s = 0; s < model.samples.size(); ++s) {
        if (!std::isnan(to_scale(model.properties[p], model.samples.values[p][s]))) {
            present.push_back(s);
        }
    }
    return present;
}

/// Chooses and fits what the plan leaves open, and notes it there.
EstimatorSpec fitted_for(const Model& model, Column& column, std::span<const std::uint32_t> samples,
                         const BarrierQuery& barriers, EstimatorPlan& plan) {
    const Property& property = model.properties[column.property];
    EstimatorSpec spec = plan.of(property.name);
    column.open = spec;
    const bool to_choose = is_to_be_chosen(spec);
    if (!to_choose && !needs_values(spec)) {
        return spec;
    }
    const SampledValues data{beside_barriers(picked(model.samples.positions, samples), barriers), column.scaled,
                             picked(model.samples.borehole, samples), property.kind};
    if (to_choose) {
        auto chosen = EstimatorChooser(data, &barriers).choose(spec);
        spec = std::move(chosen.spec);
        plan.choices[property.name] = chosen.choice;
        column.open = spec;
    }
    spec = fitted_estimator(spec, data.sites, data.values, data.boreholes, property.kind, &barriers);
    plan.of_property[property.name] = spec;
    return spec;
}

/// A plan in which all is chosen: what a property to come is estimated by, too.
void close(EstimatorPlan& plan) {
    plan.general = without_choice(std::move(plan.general));
    std::erase_if(plan.of_property,
                  [&](const auto& entry) { return entry.second.to_string() == plan.general.to_string(); });
}

std::shared_ptr<const Slopes> slopes_of(const Group& group) {
    std::vector<std::span<const double>> columns;
    for (const auto& column : group.columns) {
        columns.emplace_back(column.scaled);
    }
    return group.estimator->slopes(std::move(columns));
}

/// As the plan knows them, else found and noted there.
void set_traits(Group& group, const Model& model, std::span<const std::int32_t> boreholes, EstimatorPlan& plan) {
    std::optional<double> reach;
    for (auto& column : group.columns) {
        const auto [known, fresh] = plan.traits.try_emplace(model.properties[column.property].name);
        if (fresh) {
            reach = reach ? reach : reach_of(group.spec, group.sites, boreholes);
            known->second = traits_of(column.scaled, *reach);
        }
        column.traits = known->second;
    }
}

/// One for each distinct set of samples and way of estimating; a property without samples is in no group and gets no
/// values.
std::vector<Group> groups_of(const Model& model, const BarrierQuery& barriers, EstimatorPlan& plan) {
    std::map<std::tuple<std::vector<std::uint32_t>, std::string, bool>, Group> groups;
    for (std::size_t p = 0; p < model.properties.size(); ++p) {
        auto samples = samples_with(model, p);
        if (samples.empty()) {
            continue;
        }
        Column column = column_of(model, p, samples);
        const BarrierQuery& seen = barriers.seen_by(p);
        EstimatorSpec spec = fitted_for(model, column, samples, seen, plan);
        Group& group = groups[{samples, spec.to_string(), &seen == &barriers}];
        group.barriers = &seen;
        group.columns.push_back(std::move(column));
        group.spec = std::move(spec);
        group.samples = std::move(samples);
    }
    std::vector<Group> out;
    for (auto& [key, group] : groups) {
        group.sites = beside_barriers(picked(model.samples.positions, group.samples), barriers);
        const auto boreholes = picked(model.samples.borehole, group.samples);
        group.estimator = make_estimator(group.spec, group.sites, group.barriers, boreholes);
        set_traits(group, model, boreholes, plan);
        out.push_back(std::move(group));
        out.back().slopes = slopes_of(out.back());
    }
    return out;
}

/// Leaves boreholes out to learn how far estimates are off; what is found comes back in the plan.
void learn_group(Group& group, const Model& model, const EstimatorPlan& asked, std::size_t max_folds,
                 EstimatorPlan& plan) {
    const auto boreholes = picked(model.samples.borehole, group.samples);
    ErrorTask task{group.spec,      group.spec, model.samples, group.samples, group.sites, boreholes,
                   *group.barriers, {},         max_folds};
    for (const auto& column : group.columns) {
        const Property& property = model.properties[column.property];
        const auto known = asked.calibrations.find(property.name);
        task.columns.push_back({column.scaled, property.kind == Kind::continuous,
                                known == asked.calibrations.end() ? nullptr : &known->second, column.traits});
    }
    if (group.columns.size() == 1 && task.columns.front().continuous && task.columns.front().known == nullptr) {
        const Column& column = group.columns.front();
        task.open = open_again(group.spec, column.open, group.sites, column.scaled, boreholes, Kind::continuous);
    }
    auto learned = learn_errors(task);
    for (std::size_t c = 0; c < learned.size(); ++c) {
        if (learned[c]) {
            plan.calibrations[model.properties[group.columns[c].property].name] = learned[c]->calibration;
        }
        group.columns[c].errors = std::move(learned[c]);
    }
}

/// Summed by class, in ascending order of the class.
std::map<double, double> weight_by_class(const std::vector<SiteWeight>& terms, const Column& column) {
    std::map<double, double> weight_of;
    for (const auto& [site, weight] : terms) {
        weight_of[column.measured[site]] += weight;
    }
    return weight_of;
}

/// The class with the largest summed weight; of equal ones the smaller index.
double heaviest_class(const std::vector<SiteWeight>& terms, const Column& column) {
    const auto weight_of = weight_by_class(terms, column);
    return std::max_element(weight_of.begin(), weight_of.end(),
                            [](const auto& a, const auto& b) { return a.second < b.second; })
        ->first;
}

struct Estimate {
    double value = missing;
    double slope_variance = 0;
};

/// Of the group's c-th column.
Estimate estimate(const Property& property, const Weights& weights, const Group& group, std::size_t c) {
    const auto& terms = weights.terms;
    const Column& column = group.columns[c];
    if (terms.empty()) {
        return {};
    }
    if (property.kind == Kind::categorical) {
        return {heaviest_class(terms, column), 0};
    }
    const double plain = weighted_mean(terms, column.scaled);
    const auto added = made_up(plain, weights, extrapolation_at(weights.distance, column.traits.reach),
                               group.slopes.get(), c, column.traits);
    if (terms.size() == 1 && added.value == 0) {
        return {column.measured[terms.front().site], added.variance};  // as measured, not by way of its logarithm
    }
    return {from_scale(property, plain + added.value), added.variance};
}

/// Sets query i's probabilities and entropy.
void set_probabilities(const std::vector<SiteWeight>& terms, const Column& column, std::size_t i,
                       PropertyEstimates& out) {
    const auto weight_of = weight_by_class(terms, column);
    double total = 0;
    for (const auto& [index, weight] : weight_of) {
        total += std::max(weight, 0.0);
    }
    for (auto& probability : out.probability) {
        probability[i] = 0;
    }
    double entropy = 0;
    for (const auto& [index, weight] : weight_of) {
        const double p = std::max(weight, 0.0) / total;
        out.probability[static_cast<std::size_t>(index)][i] = p;
        entropy -= p > 0 ? p * std::log2(p) : 0;
    }
    out.entropy[i] = std::max(entropy, 0.0);
}

PropertyEstimates no_estimates(const Property& property, std::size_t count) {
    PropertyEstimates out;
    out.value.assign(count, missing);
    out.deviation.assign(count, missing);
    out.half_width.assign(count, missing);
    out.extrapolation.assign(count, 1.0);
    out.samples.assign(count, 0);
    if (property.kind == Kind::categorical) {
        out.probability.assign(property.classes.size(), std::vector<double>(count, missing));
        out.entropy.assign(count, missing);
    }
    return out;
}

}  // namespace

const char* to_string(DeviationSource source) {
    constexpr const char* names[] = {"none", "kriging", "cross-validated"};
    return names[static_cast<std::size_t>(source)];
}

struct ModelEstimator::Impl {
    const Model& model;
    const BarrierQuery& barriers;
    EstimatorPlan plan;
    std::vector<Group> groups;
    std::shared_ptr<EstimatorCounters> counters;

    /// Calls work(group, place, weights, queries): weights of a block of queries at a time, near each other, or each
    /// would walk over all of the memory; place[k] is the block's k-th query's index in `queries`.
    template <typename Work>
    void for_each_block(std::span<const ValueQuery> asked, const Work& work) const {
        const std::vector<ValueQuery> queries = beside_barriers(asked, barriers);
        const bool single = queries.size() <= block_size;
        const auto order = single ? std::vector<std::uint32_t>() : spatial_order(queries);
        std::vector<ValueQuery> sorted;
        for (std::size_t begin = 0; begin < queries.size(); begin += block_size) {
            const std::size_t count = std::min(block_size, queries.size() - begin);
            auto block = std::span<const ValueQuery>(queries);
            if (!single) {
                sorted.clear();
                for (const std::uint32_t i : std::span(order).subspan(begin, count)) {
                    sorted.push_back(queries[i]);
                }
                block = sorted;
            }
            work(block, [&](std::size_t k) { return single ? k : order[begin + k]; });
        }
        if (counters) {
            counters->queries += queries.size();
        }
    }

    void count_fallbacks(const std::vector<std::uint8_t>& fallback) const {
        if (counters) {
            counters->fallbacks +=
                static_cast<std::uint64_t>(std::count(fallback.begin(), fallback.end(), std::uint8_t(1)));
        }
    }

    template <typename Place>
    void value_block(std::span<const ValueQuery> queries, const Place& place, ValueBatch& batch) const {
        std::vector<Weights> weights(queries.size());
        std::vector<double> extrapolation(queries.size(), -1);  // below any: no value yet
        std::vector<std::uint8_t> fallback(queries.size(), 0);
        for (const auto& group : groups) {
            group.estimator->weights(queries, weights);
            for (std::size_t k = 0; k < queries.size(); ++k) {
                fallback[k] |= static_cast<std::uint8_t>(weights[k].fallback);
                if (weights[k].terms.empty()) {
                    continue;
                }
                for (std::size_t c = 0; c < group.columns.size(); ++c) {
                    const Column& column = group.columns[c];
                    extrapolation[k] =
                        std::max(extrapolation[k], extrapolation_at(weights[k].distance, column.traits.reach));
                    batch.values[column.property][place(k)] =
                        estimate(model.properties[column.property], weights[k], group, c).value;
                }
            }
        }
        for (std::size_t k = 0; k < queries.size(); ++k) {
            if (extrapolation[k] >= 0) {
                batch.extrapolation[place(k)] = extrapolation[k];
            }
        }
        count_fallbacks(fallback);
    }

    template <typename Place>
    void estimate_block(std::span<const ValueQuery> queries, const Place& place,
                        std::vector<PropertyEstimates>& out) const {
        std::vector<Weights> weights(queries.size());
        std::vector<std::uint8_t> fallback(queries.size(), 0);
        for (const auto& group : groups) {
            group.estimator->weights(queries, weights);
            for (std::size_t k = 0; k < queries.size(); ++k) {
                fallback[k] |= static_cast<std::uint8_t>(weights[k].fallback);
                if (weights[k].terms.empty()) {
                    continue;
                }
                for (std::size_t c = 0; c < group.columns.size(); ++c) {
                    set_estimate(group, c, queries[k].position, weights[k], place(k), out[group.columns[c].property]);
                }
            }
        }
        count_fallbacks(fallback);
    }

    void set_estimate(const Group& group, std::size_t c, const Vec3& position, const Weights& weights, std::size_t i,
                      PropertyEstimates& out) const {
        const Column& column = group.columns[c];
        const Property& property = model.properties[column.property];
        const auto [value, slope_variance] = estimate(property, weights, group, c);
        out.value[i] = value;
        out.extrapolation[i] = extrapolation_at(weights.distance, column.traits.reach);
        out.samples[i] = static_cast<std::uint32_t>(weights.terms.size());
        if (property.kind == Kind::categorical) {
            set_probabilities(weights.terms, column, i, out);
        } else if (column.errors) {
            const auto [deviation, half_width] =
                widened(column.errors->of(position, weights, to_scale(property, value)), slope_variance);
            out.deviation[i] = deviation;
            out.half_width[i] = half_width;
        }
    }
};

ModelEstimator::ModelEstimator(const Model& model, const BarrierQuery& barriers, const EstimatorPlan& plan,
                               std::shared_ptr<EstimatorCounters> counters, const ModelEstimatorOptions& options)
    : impl_(new Impl{model, barriers, plan, {}, std::move(counters)}) {
    impl_->groups = groups_of(model, barriers, impl_->plan);
    close(impl_->plan);
    if (impl_->groups.size() == 1) {
        impl_->plan.general = impl_->groups.front().spec;  // one for all, fitted to some of its own or not
        impl_->plan.of_property.clear();
    }
    if (options.uncertainty) {
        for (auto& group : impl_->groups) {
            learn_group(group, model, plan, options.error_folds, impl_->plan);
        }
    }
}

ModelEstimator::~ModelEstimator() = default;

const EstimatorPlan& ModelEstimator::plan() const {
    return impl_->plan;
}

ValueBatch ModelEstimator::values(std::span<const ValueQuery> queries) const {
    ValueBatch batch;
    batch.values.assign(impl_->model.properties.size(), std::vector<double>(queries.size(), missing));
    batch.extrapolation.assign(queries.size(), 1.0);
    impl_->for_each_block(queries, [&](std::span<const ValueQuery> block, const auto& place) {
        impl_->value_block(block, place, batch);
    });
    return batch;
}

std::vector<PropertyEstimates> ModelEstimator::estimates(std::span<const ValueQuery> queries) const {
    std::vector<PropertyEstimates> out;
    for (const auto& property : impl_->model.properties) {
        out.push_back(no_estimates(property, queries.size()));
    }
    for (const auto& group : impl_->groups) {
        for (const auto& column : group.columns) {
            if (column.errors) {
                out[column.property].deviation_source =
                    column.errors->local ? DeviationSource::cross_validated : DeviationSource::kriging;
                out[column.property].calibration = column.errors->calibration;
            }
        }
    }
    impl_->for_each_block(queries, [&](std::span<const ValueQuery> block, const auto& place) {
        impl_->estimate_block(block, place, out);
    });
    return out;
}

}  // namespace terratet
