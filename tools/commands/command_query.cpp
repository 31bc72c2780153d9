// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <optional>
#include <set>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "interp/estimator_spec.hpp"
#include "interp/model_snapshot.hpp"
#include "io/base/csv_text.hpp"
#include "io/read/read_points.hpp"
#include "tess/barrier/query/model_bounds.hpp"
#include "tess/error.hpp"
#include "tools/options/command.hpp"
#include "tools/options/site_options.hpp"
#include "tools/options/text.hpp"
#include "tools/run/open_model.hpp"
#include "tools/run/process.hpp"

namespace terratet::tools {
namespace {

/// Rows are estimated and written so many at a time.
constexpr std::size_t batch_size = 65536;

bool has_samples(const Model& model, std::size_t p) {
    const auto& values = model.samples.values[p];
    return std::any_of(values.begin(), values.end(), [](double value) { return !std::isnan(value); });
}

class Query final : public Command {
  public:
    Syntax syntax() override {
        return {"query",
                {{"Options",
                  {{{"estimator"}, "SPEC", "instead of the model's own", &estimator_},
                   {{"probabilities"}, "", "of a category also each class's probability", &probabilities_},
                   {{"no-sd"}, "", "leave standard deviations and half-widths out: empty, and faster", &no_deviation_},
                   {{"s_srs", "source-crs"}, "CRS", "of the points, if they carry none; the model's by default", &crs_},
                   {{"columns"}, "MEANING=COLUMN", "a column not found by its name: x, y, z", &columns_},
                   {{"side"}, "+|-", "of a fault that a place lies exactly on; + by default", &side_},
                   accept_edited_option(accept_edited_),
                   {{"threads"}, "N", "as many as there are cores by default", &threads_},
                   {{"q", "quiet"}, "", "no remarks on standard error", &quiet_}}}},
                {"MODEL.gpkg VERB POINTS", 3, 3, &words_}};
    }

    int run(const std::vector<Given>&) override {
        if (words_[1] != "value") {
            throw UsageError("query: '" + words_[1] + "' is not known; there is value");
        }
        if (side_ != "+" && side_ != "-") {
            throw UsageError("query --side: '" + side_ + "' is neither + nor -");
        }
        const ThreadLimit threads(threads_);
        const ModelSnapshot opened(open_model(words_[0], accept_edited_));
        const Model& model = opened.model();
        Diagnostics diagnostics;
        const PointTable points = read_points(parse_source(words_[2] == "-" ? "/vsistdin/" : words_[2]), model.frame,
                                              crs_, column_names(columns_), diagnostics);
        std::optional<ModelEstimator> other;
        if (!estimator_.empty()) {
            other.emplace(model, opened.barriers(), parse_estimator(estimator_), nullptr,
                          ModelEstimatorOptions{.uncertainty = !no_deviation_});
        }
        const ModelEstimator& estimator = other           ? *other
                                          : no_deviation_ ? opened.estimator()
                                                          : opened.estimator_with_errors();
        const ModelBounds bounds(model.domain, opened.barriers());
        for (std::size_t p = 0; p < model.properties.size(); ++p) {
            if (has_samples(model, p)) {
                asked_.push_back(p);
            }
        }
        print(header(model, points.table));
        for (std::size_t begin = 0; begin < points.positions.size(); begin += batch_size) {
            print(rows(model, points, begin, std::min(begin + batch_size, points.positions.size()), estimator, bounds));
        }
        remark(model, estimator, diagnostics);
        return exit_done;
    }

  private:
    [[nodiscard]] std::string header(const Model& model, const Table& table) const {
        std::string row;
        std::set<std::string> taken;
        for (const auto& column : table.columns) {
            row += taken.empty() ? "" : ",";
            append_csv_text(row, column);
            taken.insert(column);
        }
        const auto add = [&](std::string name) {
            while (!taken.insert(name).second) {
                name += "_estimate";  // the table's own are left as they are
            }
            row += ',';
            append_csv_text(row, name);
        };
        for (const std::size_t p : asked_) {
            const Property& property = model.properties[p];
            add(property.name);
            add(property.name + "_sd");
            add(property.name + "_ci95");
            add(property.name + "_extrapolation");
            if (property.kind == Kind::categorical) {
                add(property.name + "_entropy");
                for (const auto& name : property.classes) {
                    if (probabilities_) {
                        add(property.name + "_p_" + name);
                    }
                }
            }
        }
        return row + "\n";
    }

    /// In the input's order; places that could not be read, are above the ground or outside the domain have no values.
    [[nodiscard]] std::string rows(const Model& model, const PointTable& points, std::size_t begin, std::size_t end,
                                   const ModelEstimator& estimator, const ModelBounds& bounds) {
        std::vector<ValueQuery> queries;
        std::vector<std::size_t> query_of(end - begin, none);
        for (std::size_t row = begin; row < end; ++row) {
            const bool modelled = is_finite(points.positions[row]) && !bounds.excludes(points.positions[row]);
            excluded_ += is_finite(points.positions[row]) && !modelled ? 1 : 0;
            if (modelled) {
                query_of[row - begin] = queries.size();
                queries.push_back({points.positions[row], -1, static_cast<std::int8_t>(side_ == "-" ? -1 : 1)});
            }
        }
        const auto estimates = estimator.estimates(queries);
        std::string text;
        for (std::size_t row = begin; row < end; ++row) {
            for (std::size_t column = 0; column < points.table.columns.size(); ++column) {
                text += column == 0 ? "" : ",";
                append_csv_text(text, points.table.cells[column][row]);
            }
            for (const std::size_t p : asked_) {
                append(text, model.properties[p], estimates[p], query_of[row - begin]);
            }
            text += '\n';
        }
        return text;
    }

    /// One property's cells, all empty where there is no value.
    void append(std::string& text, const Property& property, const PropertyEstimates& all, std::size_t i) const {
        const auto number = [&](const std::vector<double>& column) {
            text += ',';
            if (i != none && !std::isnan(all.value[i]) && !std::isnan(column[i])) {
                append_csv_number(text, column[i]);
            }
        };
        text += ',';
        append_csv_value(text, property, i == none ? missing : all.value[i]);
        number(all.deviation);
        number(all.half_width);
        number(all.extrapolation);
        if (property.kind == Kind::categorical) {
            number(all.entropy);
            for (const auto& probability : all.probability) {
                if (probabilities_) {
                    number(probability);
                }
            }
        }
    }

    void remark(const Model& model, const ModelEstimator& estimator, const Diagnostics& diagnostics) const {
        if (quiet_) {
            return;
        }
        for (const auto& record : diagnostics.rejected) {
            spdlog::warn("{}",
                         one_line(fmt::format("{}, line {}: {}; no value", record.file, record.line, record.reason)));
        }
        for (const auto& note : diagnostics.notes) {
            spdlog::info("{}", one_line(note));
        }
        if (excluded_ > 0) {
            spdlog::info("{} places are above the ground or outside the domain: no value", excluded_);
        }
        const auto kinds = estimator.estimates({});
        for (const std::size_t p : asked_) {
            const Property& property = model.properties[p];
            if (kinds[p].deviation_source != DeviationSource::none) {
                const Calibration& c = kinds[p].calibration;
                spdlog::info("{}_sd: {}{}{}", one_line(property.name), to_string(kinds[p].deviation_source),
                             property.scale == Scale::log10 ? ", in decades" : "",
                             c.samples == 0
                                 ? std::string(", not calibrated: no borehole could be left out")
                                 : fmt::format(", calibrated on {} left-out samples of {} boreholes{}", c.samples,
                                               c.boreholes, c.boreholes < 20 ? ", few: wide rather than tight" : ""));
            }
        }
    }

    static constexpr std::size_t none = static_cast<std::size_t>(-1);

    std::vector<std::string> words_;
    std::vector<std::size_t> asked_;  ///< properties with samples
    std::vector<std::string> columns_;
    std::string estimator_;
    std::string crs_;
    std::string side_ = "+";
    std::uint64_t threads_ = 0;
    std::size_t excluded_ = 0;
    bool probabilities_ = false;
    bool no_deviation_ = false;
    bool quiet_ = false;
    bool accept_edited_ = false;
};

}  // namespace

CommandEntry query_command() {
    return {"query",
            "values at places",
            "MODEL.gpkg value POINTS",
            "Estimates each property from the model's samples at the places of a table with x, y, z, or - for standard "
            "input. CSV on standard output: a row each in the same order, the table's columns, then NAME, NAME_sd, "
            "NAME_ci95 (half-width of the 95 % interval) and NAME_extrapolation of each property, empty where there is "
            "no value: also above the ground and outside the "
            "domain. A name that the table has already gets _estimate behind it.",
            {"terratet query site.gpkg value places.csv > values.csv",
             "printf 'x,y,z\\n525500,6792000,-200\\n' | terratet query site.gpkg value -"},
            [] { return std::make_unique<Query>(); }};
}

}  // namespace terratet::tools
