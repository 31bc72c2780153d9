// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/model_source.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace terratet {
namespace {

/// Weights of so many queries are held at a time.
constexpr std::size_t block_size = 16384;

/// A property's values at the sites of its group.
struct Column {
    std::size_t property;
    std::vector<double> measured;
    std::vector<double> scaled;
};

/// Properties measured at the same samples, and the estimator over those.
struct Group {
    std::vector<Column> columns;
    std::unique_ptr<Estimator> estimator;
};

Column column_of(const Model& model, std::size_t p, const std::vector<std::uint32_t>& samples) {
    Column column{p, {}, {}};
    for (const std::uint32_t s : samples) {
        column.measured.push_back(model.samples.values[p][s]);
        column.scaled.push_back(to_scale(model.properties[p], column.measured.back()));
    }
    return column;
}

/// One for each distinct set of samples; a property without any is in no group and gets no values.
std::vector<Group> groups_of(const Model& model, const FaultProximity& faults, const EstimatorSpec& spec) {
    std::map<std::vector<std::uint32_t>, std::vector<std::size_t>> properties_at;
    for (std::size_t p = 0; p < model.properties.size(); ++p) {
        std::vector<std::uint32_t> present;
        for (std::uint32_t s = 0; s < model.samples.size(); ++s) {
            if (!std::isnan(to_scale(model.properties[p], model.samples.values[p][s]))) {
                present.push_back(s);
            }
        }
        if (!present.empty()) {
            properties_at[std::move(present)].push_back(p);
        }
    }
    std::vector<Group> groups;
    for (const auto& [samples, properties] : properties_at) {
        Group& group = groups.emplace_back();
        for (const std::size_t p : properties) {
            group.columns.push_back(column_of(model, p, samples));
        }
        std::vector<Vec3> sites(samples.size());
        std::transform(samples.begin(), samples.end(), sites.begin(),
                       [&](std::uint32_t s) { return model.samples.positions[s]; });
        group.estimator = make_estimator(spec, std::move(sites), &faults);
    }
    return groups;
}

/// The class with the largest summed weight; of equal ones the smaller index.
double heaviest_class(const std::vector<SiteWeight>& terms, const Column& column) {
    std::map<double, double> weight_of;
    for (const auto& [site, weight] : terms) {
        weight_of[column.measured[site]] += weight;
    }
    return std::max_element(weight_of.begin(), weight_of.end(),
                            [](const auto& a, const auto& b) { return a.second < b.second; })
        ->first;
}

double estimate(const Property& property, const std::vector<SiteWeight>& terms, const Column& column) {
    if (terms.empty()) {
        return missing;
    }
    if (terms.size() == 1) {
        return column.measured[terms.front().site];  // as measured, not by way of its logarithm
    }
    if (property.kind == Kind::categorical) {
        return heaviest_class(terms, column);
    }
    double sum = 0;
    for (const auto& [site, weight] : terms) {
        sum += weight * column.scaled[site];
    }
    return from_scale(property, sum);
}

class Source {
  public:
    Source(const Model& model, const FaultProximity& faults, const EstimatorSpec& spec,
           std::shared_ptr<EstimatorCounters> counters)
        : model_(model), groups_(groups_of(model, faults, spec)), counters_(std::move(counters)) {}

    [[nodiscard]] ValueBatch operator()(std::span<const ValueQuery> queries) const {
        ValueBatch batch;
        batch.values.assign(model_.properties.size(), std::vector<double>(queries.size(), missing));
        batch.extrapolation.assign(queries.size(), 1.0);
        std::vector<Weights> weights(std::min(block_size, queries.size()));
        for (std::size_t begin = 0; begin < queries.size(); begin += block_size) {
            const auto block = queries.subspan(begin, std::min(block_size, queries.size() - begin));
            estimate_block(block, begin, std::span(weights).first(block.size()), batch);
        }
        return batch;
    }

  private:
    void estimate_block(std::span<const ValueQuery> queries, std::size_t begin, std::span<Weights> weights,
                        ValueBatch& batch) const {
        std::vector<double> extrapolation(queries.size(), -1);
        std::vector<bool> fallback(queries.size(), false);
        for (const auto& group : groups_) {
            group.estimator->weights(queries, weights);
            for (std::size_t i = 0; i < queries.size(); ++i) {
                if (!weights[i].terms.empty()) {
                    extrapolation[i] = std::max(extrapolation[i], weights[i].extrapolation);
                }
                fallback[i] = fallback[i] || weights[i].fallback;
                for (const auto& column : group.columns) {
                    batch.values[column.property][begin + i] =
                        estimate(model_.properties[column.property], weights[i].terms, column);
                }
            }
        }
        for (std::size_t i = 0; i < queries.size(); ++i) {
            batch.extrapolation[begin + i] = extrapolation[i] < 0 ? 1.0 : extrapolation[i];
        }
        if (counters_) {
            counters_->queries += queries.size();
            counters_->fallbacks += static_cast<std::uint64_t>(std::count(fallback.begin(), fallback.end(), true));
        }
    }

    const Model& model_;
    std::vector<Group> groups_;
    std::shared_ptr<EstimatorCounters> counters_;
};

}  // namespace

ValueSource make_model_source(const Model& model, const FaultProximity& faults, const EstimatorSpec& spec,
                              std::shared_ptr<EstimatorCounters> counters) {
    // Shared, since a std::function must be copyable and estimators are not.
    const auto source = std::make_shared<const Source>(model, faults, spec, std::move(counters));
    return [source](std::span<const ValueQuery> queries) { return (*source)(queries); };
}

}  // namespace terratet
