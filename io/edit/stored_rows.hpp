// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Rows of a stored model, one by one: read as JSON, put back, written anew; each change noted in terratet_changes.

#include <map>
#include <memory>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "io/model/row_writer.hpp"
#include "io/model/sqlite_database.hpp"

namespace terratet {

/// A row as JSON: numbers with all their digits, text, null; {"hex": …} for bytes.
using JsonRow = nlohmann::ordered_json;

/// The rows of one layer.
class StoredTable {
  public:
    StoredTable(SqliteDatabase& database, std::string name);

    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] const std::vector<std::string>& columns() const { return columns_; }  ///< fid first
    void add_column(const std::string& name, const char* type);

    [[nodiscard]] std::int64_t last_row();
    /// null where there is none
    [[nodiscard]] JsonRow read(std::int64_t row);
    /// Puts a row as `read` gave it, in the place of what is there; null takes it out.
    void put(std::int64_t row, const JsonRow& cells);

  private:
    SqliteStatement& statement(std::unique_ptr<SqliteStatement>& kept, const std::string& sql);
    void prepare_again();

    SqliteDatabase& database_;
    std::string name_;
    std::vector<std::string> columns_;
    std::unique_ptr<SqliteStatement> select_, insert_, update_, delete_;
};

/// What one edit changes, written as it goes.
class ChangeLog {
  public:
    ChangeLog(SqliteDatabase& database, std::int64_t edit);

    void remove(StoredTable& table, std::int64_t row) { put(table, row, nullptr); }
    /// Nothing is noted where the row is so already.
    void put(StoredTable& table, std::int64_t row, const JsonRow& cells);

  private:
    SqliteDatabase& database_;
    std::int64_t edit_;
    std::int64_t next_row_;
    SqliteStatement insert_;
};

/// Rows for a ChangeLog through the interface that new models are written by.
class JsonRowWriter final : public RowWriter {
  public:
    /// Makes missing columns. \param srs_id  of the layer's geometries
    JsonRowWriter(SqliteDatabase& database, StoredTable& table, ChangeLog& log);

    /// The number of the row to come.
    void at(std::int64_t row) { row_ = row; }

    Column number(const std::string& name) override { return add(name, "REAL"); }
    Column integer(const std::string& name) override { return add(name, "INTEGER"); }
    Column text(const std::string& name) override { return add(name, "TEXT"); }
    Column bytes(const std::string& name) override { return add(name, "BLOB"); }
    void create() override {}
    void set(Column column, double value) override;
    void set(Column column, std::int64_t value) override { cells_[names_[at_column(column)]] = value; }
    void set(Column column, const std::string& value) override { cells_[names_[at_column(column)]] = value; }
    void set(Column column, std::span<const std::byte> value) override;
    void set_point(const Vec3& position) override;
    void set_geometry(std::unique_ptr<OGRGeometry> geometry) override;
    void write() override;

  private:
    static std::size_t at_column(Column column) { return static_cast<std::size_t>(column); }
    Column add(const std::string& name, const char* type);

    StoredTable& table_;
    ChangeLog& log_;
    std::int32_t srs_id_ = 0;
    std::vector<std::string> names_;
    JsonRow cells_ = JsonRow::object();
    std::int64_t row_ = 0;
};

}  // namespace terratet
