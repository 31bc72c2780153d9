// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/run/query.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "io/base/time_steps.hpp"
#include "tess/base/words.hpp"
#include "tess/error.hpp"
#include "tools/options/site_options.hpp"
#include "tools/options/text.hpp"
#include "tools/options/values.hpp"

namespace terratet::tools {
namespace {

std::string full(double number) {
    return fmt::format("{}", number);
}

/// Hands on what is said at one time, under names without it.
class TimeSink final : public RowSink {
  public:
    /// `arguments` get the names that the model has.
    TimeSink(const std::vector<Property>& properties, const std::string& time, QueryArguments& arguments, RowSink& sink)
        : properties_(properties), time_(time), sink_(sink) {
        const std::size_t equals = arguments.above.find('=');
        const std::string asked = name_at(arguments.above.substr(0, equals), time);
        if (equals != std::string::npos && std::ranges::count(properties, asked, &Property::name) > 0) {
            arguments.above = asked + arguments.above.substr(equals);
        }
    }

    void begin(const std::vector<RowColumn>& columns) override {
        std::vector<RowColumn> kept;
        for (std::size_t i = 0; i < columns.size(); ++i) {
            const Property* const property = property_of(columns[i].name);
            const std::string plain = property == nullptr ? "" : name_without_time(property->name);
            if (property != nullptr && plain != property->name && name_at(plain, time_) != property->name) {
                continue;
            }
            kept_.push_back(i);
            const std::size_t own = property == nullptr ? 0 : property->name.size();
            add_column(kept, plain + columns[i].name.substr(own), columns[i].type);
        }
        sink_.begin(kept);
    }
    void add(const std::vector<Row>& rows) override {
        std::vector<Row> kept;
        for (const Row& row : rows) {
            kept.push_back(row);
            kept.back().cells.clear();
            for (const std::size_t i : kept_) {
                kept.back().cells.push_back(row.cells[i]);
            }
        }
        sink_.add(kept);
    }
    void end() override {}  // by whoever began

  private:
    /// Whose value, deviation or the like a column has: the longest name that it begins with.
    [[nodiscard]] const Property* property_of(const std::string& column) const {
        const Property* found = nullptr;
        for (const Property& property : properties_) {
            const bool fits = column == property.name || column.starts_with(property.name + "_");
            if (fits && (found == nullptr || property.name.size() > found->name.size())) {
                found = &property;
            }
        }
        return found;
    }

    const std::vector<Property>& properties_;
    std::string time_;
    RowSink& sink_;
    std::vector<std::size_t> kept_;
};

}  // namespace

QueryPoints::QueryPoints(const ModelSnapshot& opened, const QueryArguments& a) {
    const Model& model = opened.model();
    if (a.at.empty() == (a.words.size() < 2)) {
        throw UsageError("query " + a.words.front() +
                         ": give either a table of points (- for standard input) or --at x,y,z");
    }
    if (a.at.empty()) {
        reader_.emplace(parse_source(a.words[1] == "-" ? "/vsistdin/" : a.words[1]), model.frame, a.crs,
                        column_names(a.columns));
        return;
    }
    PointTable& points = given_.emplace();
    points.table.columns = {"x", "y", "z"};
    points.table.cells.resize(3);
    for (const std::string& text : a.at) {
        const auto n = option_numbers("--at", text, 3, 3);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            points.table.cells[axis].push_back(full(n[axis]));
        }
        points.positions.push_back(model.frame.to_local({n[0], n[1], n[2]}));
    }
}

std::optional<PointTable> QueryPoints::next(std::size_t most, Diagnostics& diagnostics) {
    return reader_ ? reader_->next(most, diagnostics) : std::exchange(given_, std::nullopt);
}

PointTable query_points(const ModelSnapshot& opened, const QueryArguments& a, Diagnostics& diagnostics) {
    return *QueryPoints(opened, a).next(std::numeric_limits<std::size_t>::max(), diagnostics);
}

RowCell value_cell(const Property& property, double value) {
    if (std::isnan(value)) {
        return {};
    }
    if (property.kind == Kind::categorical && value >= 0 && value < static_cast<double>(property.classes.size())) {
        return property.classes[static_cast<std::size_t>(value)];
    }
    return value;
}

void add_column(std::vector<RowColumn>& columns, std::string name, RowColumn::Type type) {
    while (std::ranges::find(columns, name, &RowColumn::name) != columns.end()) {
        name += "_estimate";  // the table's own are left as they are
    }
    columns.push_back({std::move(name), type});
}

void add_property_columns(const Model& model, std::vector<RowColumn>& columns) {
    for (const Property& property : model.properties) {
        add_column(columns, property.name,
                   property.kind == Kind::categorical ? RowColumn::Type::text : RowColumn::Type::number);
    }
}

void run_query(const ModelSnapshot& model, const QueryArguments& a, RowSink& sink, QueryRemarks& remarks) {
    using Verb = std::function<void(const ModelSnapshot&, const QueryArguments&, RowSink&, QueryRemarks&)>;
    static const std::map<std::string, Verb> verbs{
        {"value", query_values}, {"nearest", query_vertices},    {"within", query_vertices},
        {"box", query_vertices}, {"neighbours", query_vertices}, {"cell", query_cells},
        {"line", query_line},    {"section", query_section},     {"region", query_regions}};
    const auto found = verbs.find(a.words.front());
    if (found == verbs.end()) {
        std::vector<std::string> names;
        for (const auto& [name, verb] : verbs) {
            names.push_back(name);
        }
        throw UsageError(fmt::format("query: '{}' is not known; there is {}{}", a.words.front(), listed(names),
                                     did_you_mean(a.words.front(), names)));
    }
    if (a.side != "+" && a.side != "-") {
        throw UsageError("query --side: '" + a.side + "' is neither + nor -");
    }
    if (a.time.empty()) {
        found->second(model, a, sink, remarks);
    } else {
        QueryArguments at_time = a;
        TimeSink of_time(model.model().properties, require_time(model.model().properties, a.time), at_time, sink);
        found->second(model, at_time, of_time, remarks);
    }
    sink.end();
}

}  // namespace terratet::tools
