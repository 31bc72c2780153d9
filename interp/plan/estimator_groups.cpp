// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/plan/estimator_groups.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "interp/estimator/beside_barriers.hpp"
#include "interp/plan/estimator_choice.hpp"
#include "interp/plan/extrapolation.hpp"
#include "interp/plan/fitted_estimator.hpp"
#include "interp/plan/make_estimator.hpp"

namespace terratet {
namespace {

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

}  // namespace

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

namespace {

/// Of each site of `after` its number in `before`; −1 where the sample is new or of another value or place.
std::vector<std::int64_t> sites_before(const Group& before, const Group& after,
                                       std::span<const std::int64_t> before_of) {
    std::vector<std::int64_t> numbers(after.sites.size(), -1);
    const auto same_value = [](double a, double b) {
        return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
    };
    for (std::size_t site = 0; site < numbers.size(); ++site) {
        const std::int64_t sample = before_of[after.samples[site]];
        const auto found = std::ranges::lower_bound(before.samples, sample);
        if (sample < 0 || found == before.samples.end() || *found != sample) {
            continue;
        }
        const auto old = static_cast<std::size_t>(found - before.samples.begin());
        bool same = before.sites[old] == after.sites[site];
        for (std::size_t c = 0; same && c < after.columns.size(); ++c) {
            same = same_value(before.columns[c].measured[old], after.columns[c].measured[site]);
        }
        numbers[site] = same ? static_cast<std::int64_t>(old) : -1;
    }
    return numbers;
}

bool same_traits(const ColumnTraits& a, const ColumnTraits& b) {
    return a.lowest == b.lowest && a.highest == b.highest && a.reach == b.reach;
}

}  // namespace

std::unique_ptr<const ChangedPlaces> changes_between(const Group& before, const Group& after,
                                                     std::span<const std::int64_t> before_of) {
    const bool alike = before.spec.to_string() == after.spec.to_string() &&
                       std::ranges::equal(before.columns, after.columns, [](const Column& a, const Column& b) {
                           return a.property == b.property && same_traits(a.traits, b.traits);
                       });
    if (!alike || before.slopes == nullptr || after.slopes == nullptr) {
        return nullptr;
    }
    ExchangedSites exchanged{sites_before(before, after, before_of), {}};
    std::vector<bool> stays(before.sites.size(), false);
    for (std::size_t site = 0; site < after.sites.size(); ++site) {
        if (exchanged.before[site] < 0) {
            exchanged.places.push_back(after.sites[site]);
        } else {
            stays[static_cast<std::size_t>(exchanged.before[site])] = true;
        }
    }
    for (std::size_t old = 0; old < stays.size(); ++old) {
        if (!stays[old]) {
            exchanged.places.push_back(before.sites[old]);
        }
    }
    std::ranges::sort(exchanged.places);
    exchanged.places.erase(std::ranges::unique(exchanged.places).begin(), exchanged.places.end());
    return after.estimator->changes_since(*before.estimator, exchanged, before.slopes.get(), after.slopes.get());
}

}  // namespace terratet
