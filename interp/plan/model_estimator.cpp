// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/model_estimator.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <utility>

#include "interp/estimator/beside_barriers.hpp"
#include "interp/estimator/query_order.hpp"
#include "interp/estimator_plan.hpp"
#include "interp/plan/estimator_choice.hpp"
#include "interp/plan/estimator_groups.hpp"
#include "interp/plan/extrapolation.hpp"

namespace terratet {
namespace {

/// Weights of so many queries are held at a time.
constexpr std::size_t block_size = 4096;

/// A plan in which all is chosen: what a property to come is estimated by, too.
void close(EstimatorPlan& plan) {
    plan.general = without_choice(std::move(plan.general));
    std::erase_if(plan.of_property,
                  [&](const auto& entry) { return entry.second.to_string() == plan.general.to_string(); });
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
    mutable std::mutex wide_mutex{};
    mutable std::vector<Vec3> wide{};  ///< places that were asked for whose weights were, some more than once

    void note_wide(std::span<const ValueQuery> queries, const std::vector<Weights>& weights) const {
        if (std::ranges::any_of(weights, &Weights::wide)) {
            const std::lock_guard lock(wide_mutex);
            for (std::size_t k = 0; k < queries.size(); ++k) {
                if (weights[k].wide) {
                    wide.push_back(queries[k].position);
                }
            }
            if (wide.size() == wide.capacity()) {
                std::ranges::sort(wide);
                wide.erase(std::ranges::unique(wide).begin(), wide.end());
                wide.reserve(2 * wide.size() + 1024);
            }
        }
    }

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
            note_wide(queries, weights);
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

std::shared_ptr<const ModelEstimator::Changes> ModelEstimator::changes_since(
    const ModelEstimator& before, std::span<const std::int64_t> before_of) const {
    auto changes = std::make_shared<Changes>();
    changes->barriers_ = &impl_->barriers;
    const auto& old = before.impl_->groups;
    changes->everywhere_ = old.size() != impl_->groups.size();
    for (std::size_t g = 0; !changes->everywhere_ && g < old.size(); ++g) {
        const Group& group = impl_->groups[g];
        const bool no_column = group.columns.empty() || old[g].columns.empty();
        const auto partner = std::ranges::find_if(old, [&](const Group& other) {
            return !no_column && other.columns.front().property == group.columns.front().property;
        });
        Changes::OfGroup of_group{nullptr, 0};
        if (partner != old.end()) {
            of_group.places = changes_between(*partner, group, before_of);
        }
        for (const Column& column : group.columns) {
            of_group.reach = std::max(of_group.reach, column.traits.reach);
        }
        changes->everywhere_ = of_group.places == nullptr;
        changes->groups_.push_back(std::move(of_group));
    }
    const std::lock_guard lock(before.impl_->wide_mutex);
    changes->wide_.insert(before.impl_->wide.begin(), before.impl_->wide.end());
    return changes;
}

std::vector<std::uint8_t> ModelEstimator::Changes::at(std::span<const ValueQuery> places,
                                                      std::span<const double> extrapolation) const {
    std::vector<std::uint8_t> changed(places.size(), 1);
    if (everywhere_) {
        return changed;
    }
    const auto asked = beside_barriers(places, *barriers_);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, asked.size(), 1024), [&](const auto& part) {
        for (std::size_t i = part.begin(); i != part.end(); ++i) {
            const Vec3& p = asked[i].position;
            changed[i] = wide_.contains(p) || std::ranges::any_of(groups_, [&](const OfGroup& group) {
                             return group.places->at(p, 2 * group.reach * extrapolation[i]);
                         });
        }
    });
    return changed;
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
