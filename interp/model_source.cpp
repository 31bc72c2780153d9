// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/model_source.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "interp/query_order.hpp"

namespace terratet {
namespace {

/// Weights of so many queries are held at a time.
constexpr std::size_t block_size = 4096;

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
        if (queries.size() <= block_size) {
            estimate_block(queries, {}, batch);
        } else {
            estimate_in_blocks(queries, batch);
        }
        if (counters_) {
            counters_->queries += queries.size();
        }
        return batch;
    }

  private:
    /// Blocks of places near each other, or each would walk over all of the memory.
    void estimate_in_blocks(std::span<const ValueQuery> queries, ValueBatch& batch) const {
        const auto order = spatial_order(queries);
        std::vector<ValueQuery> block;
        for (std::size_t begin = 0; begin < order.size(); begin += block_size) {
            const auto part = std::span(order).subspan(begin, std::min(block_size, order.size() - begin));
            block.clear();
            for (const std::uint32_t i : part) {
                block.push_back(queries[i]);
            }
            estimate_block(block, part, batch);
        }
    }

    /// \param place  where each query's results go in the batch; empty: where the query is
    void estimate_block(std::span<const ValueQuery> queries, std::span<const std::uint32_t> place,
                        ValueBatch& batch) const {
        std::vector<Weights> weights(queries.size());
        std::vector<double> extrapolation(queries.size(), no_value);
        std::vector<std::uint8_t> fallback(queries.size(), 0);
        for (const auto& group : groups_) {
            group.estimator->weights(queries, weights);
            for (std::size_t i = 0; i < queries.size(); ++i) {
                if (!weights[i].terms.empty()) {
                    extrapolation[i] = std::max(extrapolation[i], weights[i].extrapolation);
                }
                fallback[i] |= static_cast<std::uint8_t>(weights[i].fallback);
                for (const auto& column : group.columns) {
                    batch.values[column.property][place.empty() ? i : place[i]] =
                        estimate(model_.properties[column.property], weights[i].terms, column);
                }
            }
        }
        for (std::size_t i = 0; i < queries.size(); ++i) {
            if (extrapolation[i] != no_value) {
                batch.extrapolation[place.empty() ? i : place[i]] = extrapolation[i];
            }
        }
        if (counters_) {
            counters_->fallbacks +=
                static_cast<std::uint64_t>(std::count(fallback.begin(), fallback.end(), std::uint8_t(1)));
        }
    }

    static constexpr double no_value = -1;

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
