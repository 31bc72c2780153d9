// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/report/validation.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "interp/estimator/beside_barriers.hpp"
#include "interp/estimator_spec.hpp"
#include "interp/kriging/fitted_variogram.hpp"
#include "tools/options/text.hpp"
#include "tools/report/calibration_json.hpp"

namespace terratet::tools {
namespace {

using Json = nlohmann::ordered_json;

const char* scale_unit(const Property& property) {
    return property.scale == Scale::log10 ? "decades" : property.unit.c_str();
}

/// "CU (%)", "K (decades)".
std::string titled(const Property& property) {
    const std::string unit = property.kind == Kind::categorical ? "classes" : scale_unit(property);
    return unit.empty() ? property.name : fmt::format("{} ({})", property.name, unit);
}

std::string cell(double value, int digits = 4) {
    return std::isnan(value) ? "-" : fmt::format("{:.{}g}", value, digits);
}

std::string percent(double share) {
    return std::isnan(share) ? "-" : fmt::format("{:.1f}", 100 * share);
}

Json number(double value) {
    return std::isnan(value) ? Json() : Json(value);
}

std::string variogram_line(const Variogram& v, bool apart) {
    std::string line = fmt::format("{}: nugget {}, sill {}, range {}", to_string(v.family), short_number(v.nugget),
                                   short_number(v.sill), short_number(v.range));
    if (apart || v.anisotropy.ratio3 != 1) {
        line += fmt::format(" across and {} along the holes", short_number(v.range * v.anisotropy.ratio3));
    }
    if (v.family != VariogramFamily::spherical) {
        line += fmt::format(" (95 % of the sill at {})", short_number(v.practical_range()));
    }
    return line;
}

/// Distances, semivariances and pairs, side by side along and across the holes, or in all directions.
std::string lag_table(const VariogramFit& fit) {
    struct Column {
        const char* title;
        const std::vector<Lag>* lags;
    };
    std::vector<Column> columns;
    if (!fit.along.empty()) {
        columns.push_back({"along holes", &fit.along});
    }
    if (!fit.across.empty()) {
        columns.push_back({"across", &fit.across});
    }
    columns.push_back({"all", &fit.all});
    std::string titles = "  ";
    std::string heads = "  ";
    std::size_t rows = 0;
    for (const auto& column : columns) {
        titles += fmt::format("{:<32}", column.title);
        heads += fmt::format("{:>8} {:>10} {:>9}   ", "distance", "gamma", "pairs");
        rows = std::max(rows, column.lags->size());
    }
    std::string out = titles + "\n" + heads + "\n";
    for (std::size_t row = 0; row < rows; ++row) {
        out += "  ";
        for (const auto& column : columns) {
            if (row < column.lags->size()) {
                const Lag& lag = (*column.lags)[row];
                out += fmt::format("{:>8.4g} {:>10.4g} {:>9}   ", lag.distance, lag.semivariance, lag.pairs);
            } else {
                out += std::string(32, ' ');
            }
        }
        out += "\n";
    }
    return out;
}

Json lags_json(const std::vector<Lag>& lags) {
    Json list = Json::array();
    for (const Lag& lag : lags) {
        list.push_back({{"distance", lag.distance}, {"semivariance", lag.semivariance}, {"pairs", lag.pairs}});
    }
    return list;
}

Json variogram_json(const VariogramFit& fit) {
    const Variogram& v = fit.variogram;
    return {{"model", to_string(v.family)},
            {"nu", v.family == VariogramFamily::matern ? Json(v.nu) : Json()},
            {"nugget", v.nugget},
            {"sill", v.sill},
            {"range", v.range},
            {"ratio3", v.anisotropy.ratio3},
            {"practical_range", v.practical_range()},
            {"fitted_apart", fit.apart},
            {"along", lags_json(fit.along)},
            {"across", lags_json(fit.across)},
            {"all", lags_json(fit.all)}};
}

ChartSeries lag_series(const std::string& label, const std::vector<Lag>& lags) {
    ChartSeries series{label, ChartSeries::Style::circles, {}};
    for (const Lag& lag : lags) {
        series.points.emplace_back(lag.distance, lag.semivariance);
    }
    return series;
}

ChartSeries model_series(const std::string& label, Variogram v, double range, double reach) {
    v.range = range;
    ChartSeries series{label, ChartSeries::Style::line, {}};
    for (int i = 1; i <= 200; ++i) {
        const double h = reach * i / 200;
        series.points.emplace_back(h, v(h));
    }
    return series;
}

/// One set of lags and the model that was laid through it.
Chart variogram_chart(const Property& property, const std::string& where, const std::vector<Lag>& lags,
                      const Variogram& v, double range) {
    Chart chart{fmt::format("{}: variogram {}", property.name, where), "distance", "semivariance", {}, false, true};
    chart.series.push_back(lag_series("samples", lags));
    chart.series.push_back(model_series(fmt::format("{}, range {}", to_string(v.family), short_number(range)), v, range,
                                        lags.empty() ? 1 : lags.back().distance));
    return chart;
}

/// What an anisotropy or method left open became; empty where it was given.
std::string chosen_text(const CrossValidation& v) {
    EstimatorSpec chosen = v.estimator;
    for (const char* fitted : {"nugget", "sill", "range", "drift"}) {
        if (!v.asked.options.contains(fitted)) {
            chosen.options.erase(fitted);
        }
    }
    if (chosen.name == "kriging" && !chosen.options.contains("azimuth") && !chosen.options.contains("dip")) {
        return "";  // its vertical ratio was fitted
    }
    return chosen.as_given() == v.asked.as_given() ? "" : chosen.as_given();
}

std::string suggestion_text(const ChosenEstimator& suggestion, const Property& property) {
    if (suggestion.trials.empty()) {
        return "";
    }
    const bool classes = property.kind == Kind::categorical;
    std::string out = fmt::format("  {:<60}{:>9}{:>8}{:>9}\n", "tried in the same few folds",
                                  classes ? "wrong %" : "RMSE", "folds", "by idw");
    for (const auto& trial : suggestion.trials) {
        const auto shown = [&](double rms) { return classes ? percent(rms * rms) : cell(rms); };
        out += fmt::format("  {:<60}{:>9}{:>8}{:>9}\n", trial.spec.as_given(), trial.rms ? shown(*trial.rms) : "-",
                           &trial == &suggestion.trials.front()
                               ? "-"
                               : fmt::format("{} of {}", trial.better_folds, suggestion.choice.folds),
                           shown(trial.quick));
    }
    return out +
           "  folds: in how many of them the errors are smaller than the first one's; by idw: of inverse distance "
           "with that\n  anisotropy. Suggested (--estimator): " +
           suggestion.spec.as_given() + "\n";
}

Json suggestion_json(const ChosenEstimator& suggestion) {
    if (suggestion.trials.empty()) {
        return {};
    }
    Json trials = Json::array();
    for (const auto& trial : suggestion.trials) {
        trials.push_back({{"estimator", trial.spec.as_given()},
                          {"rms", trial.rms ? Json(*trial.rms) : Json()},
                          {"better_folds", trial.better_folds},
                          {"rms_by_idw", trial.quick}});
    }
    return {{"estimator", suggestion.spec.as_given()}, {"folds", suggestion.choice.folds}, {"tried", trials}};
}

}  // namespace

std::vector<PropertyValidation> validate_all(const Model& model, const BarrierQuery& faults,
                                             const std::vector<EstimatorSpec>& specs,
                                             const CrossValidationOptions& options, bool suggest,
                                             const Progress& progress) {
    std::vector<PropertyValidation> all;
    for (std::size_t p = 0; p < model.properties.size(); ++p) {
        const Property& property = model.properties[p];
        std::vector<Vec3> places;
        std::vector<double> values;
        std::vector<std::int32_t> boreholes;
        for (std::size_t s = 0; s < model.samples.size(); ++s) {
            const double value = to_scale(property, model.samples.values[p][s]);
            if (!std::isnan(value)) {
                places.push_back(model.samples.positions[s]);
                values.push_back(value);
                boreholes.push_back(model.samples.borehole[s]);
            }
        }
        if (places.empty()) {
            continue;
        }
        PropertyValidation one;
        one.property = p;
        const BarrierQuery& seen = faults.seen_by(p);
        EstimatorChooser chooser({beside_barriers(places, faults), values, boreholes, property.kind}, &seen);
        if (suggest) {
            one.suggestion = chooser.choose(parse_estimator("auto"));
        }
        std::vector<EstimatorSpec> resolved;
        for (std::size_t e = 0; e < specs.size(); ++e) {
            const double done = static_cast<double>(p * specs.size() + e);
            report_progress(progress, "validate", done / static_cast<double>(model.properties.size() * specs.size()));
            resolved.push_back(is_to_be_chosen(specs[e]) ? chooser.choose(specs[e]).spec : specs[e]);
            one.estimators.push_back(cross_validate(model, faults, p, resolved.back(), options));
            one.estimators.back().asked = without_choice(specs[e]);
            one.estimators.back().asked.name = specs[e].name;
        }
        EstimatorSpec shown;
        if (const auto kriging = std::ranges::find(resolved, "kriging", &EstimatorSpec::name);
            kriging != resolved.end()) {
            const auto& fitted = one.estimators[static_cast<std::size_t>(kriging - resolved.begin())].estimator.options;
            shown = *kriging;
            if (const auto drift = fitted.find("drift"); drift != fitted.end()) {
                shown.options["drift"] = one.drift = drift->second;
            }
        }
        one.variogram = fit_variogram(shown, places, values, boreholes, property.kind);
        all.push_back(std::move(one));
    }
    return all;
}

std::string validation_text(const Model& model, const std::vector<PropertyValidation>& all) {
    std::string out;
    for (const auto& one : all) {
        const Property& property = model.properties[one.property];
        const bool classes = property.kind == Kind::categorical;
        out += fmt::format("{}, {} samples left out in {} groups\n", titled(property),
                           grouped(one.estimators.front().sample.size()), one.estimators.front().folds);
        out += classes ? fmt::format("  {:<44}{:>9}{:>10}\n", "estimator", "right %", "no value")
                       : fmt::format("  {:<34}{:>9}{:>9}{:>10}{:>7}{:>9}{:>9}{:>9}\n", "estimator", "RMSE", "MAE",
                                     "bias", "rank", "in sd %", "in 95 %", "no value");
        for (const auto& v : one.estimators) {
            const auto s = score(v, property);
            const std::string name = v.asked.as_given();
            out += classes ? fmt::format("  {:<44}{:>9}{:>10}\n", name, percent(s.accuracy), s.without_value)
                           : fmt::format("  {:<34}{:>9}{:>9}{:>10}{:>7}{:>9}{:>9}{:>9}\n", name, cell(s.rmse),
                                         cell(s.mae), cell(s.bias, 3), cell(s.rank_correlation, 3),
                                         percent(s.within_one), percent(s.within_half_width), s.without_value);
            if (const std::string as = chosen_text(v); !as.empty()) {
                out += "    as " + as + "\n";
            }
        }
        if (!classes) {
            out +=
                "  in sd %: left-out truths within the stated standard deviation (68 or a little more is right); in "
                "95 %: within\n  the stated half-width, NAME_ci95 (95 is right). Both are stated without having seen "
                "the borehole.\n";
        }
        out += suggestion_text(one.suggestion, property);
        if (!one.variogram.all.empty()) {
            out += std::string("  Variogram") + (one.drift == "linear" ? " about a plane, " : ", ") +
                   variogram_line(one.variogram.variogram, one.variogram.apart) + "\n" + lag_table(one.variogram);
        }
        out += "\n";
    }
    return out;
}

Json validation_json(const Model& model, const std::vector<PropertyValidation>& all) {
    Json properties = Json::array();
    for (const auto& one : all) {
        const Property& property = model.properties[one.property];
        Json estimators = Json::array();
        for (const auto& v : one.estimators) {
            const auto s = score(v, property);
            estimators.push_back({{"estimator", v.asked.as_given()},
                                  {"specification", v.estimator.to_string()},
                                  {"count", s.count},
                                  {"without_value", s.without_value},
                                  {"rmse", number(s.rmse)},
                                  {"mae", number(s.mae)},
                                  {"bias", number(s.bias)},
                                  {"rank_correlation", number(s.rank_correlation)},
                                  {"within_1sd", number(s.within_one)},
                                  {"within_1.96sd", number(s.within_two)},
                                  {"within_half_width", number(s.within_half_width)},
                                  {"calibration", calibration_json(v.calibration)},
                                  {"deviation", to_string(v.deviation_source)},
                                  {"accuracy", number(s.accuracy)},
                                  {"folds", v.folds},
                                  {"fallbacks", v.fallbacks}});
        }
        properties.push_back({{"name", property.name},
                              {"unit", scale_unit(property)},
                              {"samples", one.estimators.front().sample.size()},
                              {"estimators", estimators},
                              {"suggestion", suggestion_json(one.suggestion)},
                              {"variogram", variogram_json(one.variogram)}});
    }
    return properties;
}

std::vector<Chart> validation_charts(const Model& model, const std::vector<PropertyValidation>& all) {
    std::vector<Chart> charts;
    for (const auto& one : all) {
        const Property& property = model.properties[one.property];
        const VariogramFit& fit = one.variogram;
        const Variogram& v = fit.variogram;
        if (fit.apart) {
            charts.push_back(variogram_chart(property, "along holes", fit.along, v, v.range * v.anisotropy.ratio3));
            charts.push_back(variogram_chart(property, "across holes", fit.across, v, v.range));
        } else if (!fit.all.empty()) {
            charts.push_back(variogram_chart(property, "in all directions", fit.all, v, v.range));
        }
        if (property.kind == Kind::categorical) {
            continue;
        }
        for (const auto& validation : one.estimators) {
            Chart chart{fmt::format("{}: {}", property.name, validation.asked.as_given()),
                        "measured " + titled(property),
                        "estimated",
                        {},
                        true,
                        false};
            ChartSeries series;
            for (std::size_t i = 0; i < validation.measured.size(); ++i) {
                series.points.emplace_back(validation.measured[i], validation.estimated[i]);
            }
            chart.series.push_back(std::move(series));
            charts.push_back(std::move(chart));
        }
    }
    return charts;
}

}  // namespace terratet::tools
