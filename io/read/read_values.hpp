// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Property columns: which of a table's columns are measured quantities, and their values.

#include <string>
#include <vector>

#include "io/read/tables/null_codes.hpp"
#include "io/read/tables/read_table.hpp"
#include "tess/diagnostics.hpp"
#include "tess/property.hpp"
#include "tess/samples.hpp"

namespace terratet {

/// The values of one property in one table.
struct ValueColumn {
    std::size_t property = 0;           ///< index in PropertyCatalogue::properties()
    std::vector<double> values;         ///< a row each; missing where there is none
    std::vector<Censoring> censored{};  ///< of each value; empty: none is
};

/// The properties of all tables together, in the order of tables and columns. The same name in any case is the same
/// property.
class PropertyCatalogue {
  public:
    /// \param wanted NAME[:log10][:categorical][:unit=U]; none: every numeric column. Throws UsageError for a name, in
    ///                any case, that comes twice.
    /// \param nulls  as SiteInputs::nulls
    explicit PropertyCatalogue(const std::vector<std::string>& wanted, const std::vector<std::string>& nulls = {});

    /// Reads a table's property columns. Without `wanted` those are the columns that carry no known meaning and hold
    /// numbers in at least half of their non-empty cells (others with a number in them are noted); where none does, the
    /// one column whose words come again, as classes (noted). Empty cells, NA,
    /// N/A, NaN, null, none and - are missing, and so are what `nulls` say and usual codes far outside the other values
    /// (noted; io/read/tables/null_codes.hpp); "<0.005" counts as its bound, and is marked as censored (noted), as are
    /// values that a column of signs beside them qualifies (io/read/tables/qualifiers.hpp); any other text is rejected
    /// with line and column, the record's other values are used. A table without any wanted property gives nothing
    /// (noted). Throws InputError: no numeric column (lists those there are), or no number in a wanted one.
    /// The text of columns that carry no known meaning is given up: values take its room.
    std::vector<ValueColumn> read(Table& table, const ColumnNames& columns, Diagnostics& diagnostics);

    [[nodiscard]] const std::vector<Property>& properties() const { return properties_; }

    /// Call when all tables are read: sorts the classes of categories and renumbers `samples`. Throws UsageError when a
    /// wanted property was in no table.
    std::vector<Property> finish(Samples& samples);

  private:
    std::size_t index_of(const Property& property);

    std::vector<Property> wanted_;
    std::vector<NullValue> nulls_;
    std::vector<Property> properties_;
    std::vector<std::string> seen_columns_;  ///< for the message of what there is
};

}  // namespace terratet
