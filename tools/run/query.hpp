// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Questions to a model, each answered by rows (docs/queries.md).

#include <optional>

#include "interp/model_snapshot.hpp"
#include "io/read/read_points.hpp"
#include "io/write/write_rows.hpp"
#include "tess/diagnostics.hpp"
#include "tools/options/query_options.hpp"

namespace terratet::tools {

/// What was said besides the rows.
struct QueryRemarks {
    Diagnostics diagnostics;
    std::size_t excluded = 0;             ///< places above the ground or outside the domain
    std::vector<std::string> deviations;  ///< where standard deviations come from, a line a property
};

/// Answers. Throws UsageError for a verb there is none of, and what does not fit it; InputError for points that cannot
/// be read. Safe from many threads.
void run_query(const ModelSnapshot& model, const QueryArguments& arguments, RowSink& sink, QueryRemarks& remarks);

/// The places asked about, by --at or a table.
PointTable query_points(const ModelSnapshot& model, const QueryArguments& arguments, Diagnostics& diagnostics);

/// The same places, some at a time; nothing: at the end.
class QueryPoints {
  public:
    QueryPoints(const ModelSnapshot& model, const QueryArguments& arguments);
    std::optional<PointTable> next(std::size_t most, Diagnostics& diagnostics);

  private:
    std::optional<PointReader> reader_;  ///< none: those given by --at
    std::optional<PointTable> given_;
};

/// The verbs, each in a file of its kind.
void query_values(const ModelSnapshot& model, const QueryArguments& arguments, RowSink& sink, QueryRemarks& remarks);
void query_vertices(const ModelSnapshot& model, const QueryArguments& arguments, RowSink& sink, QueryRemarks& remarks);
void query_cells(const ModelSnapshot& model, const QueryArguments& arguments, RowSink& sink, QueryRemarks& remarks);
void query_line(const ModelSnapshot& model, const QueryArguments& arguments, RowSink& sink, QueryRemarks& remarks);
void query_section(const ModelSnapshot& model, const QueryArguments& arguments, RowSink& sink, QueryRemarks& remarks);
void query_regions(const ModelSnapshot& model, const QueryArguments& arguments, RowSink& sink, QueryRemarks& remarks);

/// A value as a cell: a category by its class.
RowCell value_cell(const Property& property, double value);

/// A column of that name; `_estimate` behind it where the columns have it already.
void add_column(std::vector<RowColumn>& columns, std::string name, RowColumn::Type type = RowColumn::Type::number);

/// One column for each property of the model.
void add_property_columns(const Model& model, std::vector<RowColumn>& columns);

}  // namespace terratet::tools
