// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "interp/estimator_spec.hpp"
#include "interp/plan/estimator_choice.hpp"
#include "interp/plan/shared_estimates.hpp"
#include "tess/barrier/query/model_bounds.hpp"
#include "tess/error.hpp"
#include "tools/options/text.hpp"
#include "tools/run/query.hpp"

namespace terratet::tools {
namespace {

/// Rows are estimated and written so many at a time.
constexpr std::size_t batch_size = 65536;
constexpr std::size_t none = static_cast<std::size_t>(-1);

/// The model's own estimator, or the one that was asked for.
class AskedEstimator {
  public:
    AskedEstimator(const ModelSnapshot& opened, const QueryArguments& a) {
        if (a.estimator.empty()) {
            estimator_ = a.no_deviation ? &opened.estimator() : &opened.estimator_with_errors();
            return;
        }
        other_.emplace(opened.model(), opened.barriers(), with_open_chosen(parse_estimator(a.estimator)), nullptr,
                       ModelEstimatorOptions{.uncertainty = !a.no_deviation});
        estimator_ = &*other_;
    }
    [[nodiscard]] const ModelEstimator& get() const { return *estimator_; }

  private:
    std::optional<ModelEstimator> other_;
    const ModelEstimator* estimator_ = nullptr;
};

class ValueQueries {
  public:
    ValueQueries(const ModelSnapshot& opened, const QueryArguments& a, RowSink& sink, QueryRemarks& remarks)
        : opened_(opened),
          model_(opened.model()),
          arguments_(a),
          sink_(sink),
          remarks_(remarks),
          places_(opened, a),
          bounds_(model_.domain, opened.barriers()) {
        for (std::size_t p = 0; p < model_.properties.size(); ++p) {
            const auto& values = model_.samples.values[p];
            if (std::ranges::any_of(values, [](double value) { return !std::isnan(value); })) {
                asked_.push_back(p);
            }
        }
    }

    void run() {
        const AskedEstimator asked(opened_, arguments_);
        const ModelEstimator& estimator = asked.get();
        bool begun = false;
        while (const auto points = places_.next(batch_size, remarks_.diagnostics)) {
            if (!std::exchange(begun, true)) {
                sink_.begin(columns(points->table));
            }
            for (std::size_t begin = 0; begin < points->positions.size(); begin += batch_size) {
                sink_.add(rows(*points, begin, std::min(begin + batch_size, points->positions.size()), estimator));
            }
        }
        remark(estimator);
    }

  private:
    [[nodiscard]] std::vector<RowColumn> columns(const Table& table) const {
        std::vector<RowColumn> columns;
        for (const std::string& column : table.columns) {
            columns.push_back({column, RowColumn::Type::text});
        }
        for (const std::size_t p : asked_) {
            const Property& property = model_.properties[p];
            const bool category = property.kind == Kind::categorical;
            add_column(columns, property.name, category ? RowColumn::Type::text : RowColumn::Type::number);
            for (const char* suffix : {"_sd", "_ci95", "_extrapolation"}) {
                add_column(columns, property.name + suffix);
            }
            if (category) {
                add_column(columns, property.name + "_entropy");
                for (const auto& name : property.classes) {
                    if (arguments_.probabilities) {
                        add_column(columns, property.name + "_p_" + name);
                    }
                }
            }
        }
        return columns;
    }

    /// In the input's order; places that could not be read, are above the ground or outside the domain have no values.
    [[nodiscard]] std::vector<Row> rows(const PointTable& points, std::size_t begin, std::size_t end,
                                        const ModelEstimator& estimator) {
        std::vector<ValueQuery> queries;
        std::vector<std::size_t> query_of(end - begin, none);
        for (std::size_t row = begin; row < end; ++row) {
            const Vec3& p = points.positions[row];
            const bool modelled = is_finite(p) && !bounds_.excludes(p);
            remarks_.excluded += is_finite(p) && !modelled ? 1 : 0;
            if (modelled) {
                query_of[row - begin] = queries.size();
                queries.push_back({p, -1, static_cast<std::int8_t>(arguments_.side == "-" ? -1 : 1)});
            }
        }
        const auto estimates = arguments_.ranks == nullptr ? estimator.estimates(queries)
                                                           : shared_estimates(estimator, queries, *arguments_.ranks);
        std::vector<Row> rows(end - begin);
        for (std::size_t row = begin; row < end; ++row) {
            Row& out = rows[row - begin];
            for (const auto& column : points.table.cells) {
                out.cells.emplace_back(std::string(column[row]));
            }
            for (const std::size_t p : asked_) {
                append(out.cells, model_.properties[p], estimates[p], query_of[row - begin]);
            }
            if (is_finite(points.positions[row])) {
                out.outline = {model_.frame.to_world(points.positions[row])};
            }
        }
        return rows;
    }

    /// One property's cells, all empty where there is no value.
    void append(std::vector<RowCell>& cells, const Property& property, const PropertyEstimates& all,
                std::size_t i) const {
        const bool there = i != none && !std::isnan(all.value[i]);
        const auto number = [&](const std::vector<double>& column) {
            cells.push_back(there ? RowCell(column[i]) : RowCell());
        };
        cells.push_back(there ? value_cell(property, all.value[i]) : RowCell());
        number(all.deviation);
        number(all.half_width);
        number(all.extrapolation);
        if (property.kind == Kind::categorical) {
            number(all.entropy);
            for (const auto& probability : all.probability) {
                if (arguments_.probabilities) {
                    number(probability);
                }
            }
        }
    }

    void remark(const ModelEstimator& estimator) {
        const auto kinds = estimator.estimates({});
        for (const std::size_t p : asked_) {
            const Property& property = model_.properties[p];
            if (kinds[p].deviation_source != DeviationSource::none) {
                const Calibration& c = kinds[p].calibration;
                remarks_.deviations.push_back(fmt::format(
                    "{}_sd: {}{}{}", one_line(property.name), to_string(kinds[p].deviation_source),
                    property.scale == Scale::log10 ? ", in decades" : "",
                    c.samples == 0
                        ? std::string(", not calibrated: no borehole could be left out")
                        : fmt::format(", calibrated on {} left-out samples of {} boreholes{}", c.samples, c.boreholes,
                                      c.boreholes < 20 ? ", few: wide rather than tight" : "")));
            }
        }
    }

    const ModelSnapshot& opened_;
    const Model& model_;
    const QueryArguments& arguments_;
    RowSink& sink_;
    QueryRemarks& remarks_;
    QueryPoints places_;
    ModelBounds bounds_;
    std::vector<std::size_t> asked_;  ///< properties with samples
};

}  // namespace

void query_values(const ModelSnapshot& model, const QueryArguments& a, RowSink& sink, QueryRemarks& remarks) {
    if (a.ranks != nullptr && !a.ranks->is_root()) {
        serve_estimates(AskedEstimator(model, a).get(), *a.ranks);
        return;
    }
    ValueQueries(model, a, sink, remarks).run();
    if (a.ranks != nullptr) {
        end_serving(*a.ranks);
    }
}

}  // namespace terratet::tools
