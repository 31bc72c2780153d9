// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// What the parsers of wells share: units, coordinates in words, cells, tables that grow with a limit.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/base/table.hpp"

namespace terratet {

/// Metres in a unit of depth by its names in logs (M, F, FT, FEET, .1IN, …; in brackets or not); 0 for none, and for
/// what is no length.
double metres_in_log_unit(std::string_view unit);

/// Upper case letters and digits only: "U.W.I." is "UWI".
std::string bare(std::string_view text);

/// Degrees, decimal or as io/read/tables/degrees.hpp reads them.
std::optional<double> degrees(std::string_view text);

/// A coordinate system by what headers call it: "WGS84", "NAD83", "OSGB36", "RD", "UTM zone 33N" with a datum, a code,
/// ….  Empty when it is not understood.
Crs crs_by_name(const std::string& name);

/// The geographic system of a datum: NAD27, NAD83, WGS84, ETRS89, …. Empty when it is not known.
Crs crs_of_datum(const std::string& datum);

/// A cell of a log as a table has it: without blanks, empty where it stands for no value (NaN, ERR, (null), --, ***),
/// with a point for a decimal comma and an E for Fortran's D.
std::string log_cell(std::string_view text);

/// A table that grows by rows. Rows may be short (padded with nothing) or long (cut); a file cannot make it grow far
/// beyond its own size, for each row costs as many cells as there are columns.
class LogTable {
  public:
    explicit LogTable(std::string file) { table_.file = std::move(file); }

    /// Throws InputError beyond 10 000 columns.
    int add_column(std::string name, std::string unit);
    /// `bytes`: of the file read so far. Throws InputError where most cells are padding.
    void add_row(const std::vector<std::string>& cells, std::int64_t line, std::uint64_t bytes);

    /// Cell by cell, for what counts by speed: all columns get one before the next row().
    void put(std::size_t column, std::string_view cell) { table_.cells[column].push_back(cell); }
    void end_row(std::int64_t line, std::uint64_t bytes);

    [[nodiscard]] std::size_t columns() const { return table_.columns.size(); }
    Table& table() { return table_; }
    /// The finished table: repeated names get _2, _3, …, nameless ones UNKNOWN.
    Table finish();

  private:
    Table table_;
};

/// A one-row collar table's beginnings: stated columns HOLE, X, Y, Z, LENGTH.
Table collar_table(const std::string& file);
void add_collar(Table& collars, const std::string& hole, const std::string& x, const std::string& y,
                const std::string& z, const std::string& length, std::int64_t line);

}  // namespace terratet
