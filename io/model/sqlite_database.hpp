// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// A model file opened by SQLite itself, to be edited: one transaction, as durable as SQLite can be.

#include <sqlite3.h>

#include <cstdint>
#include <memory>
#include <string>

namespace terratet {

/// A statement, its cells and parameters counted from 0 and 1 as SQLite does.
class SqliteStatement {
  public:
    explicit SqliteStatement(sqlite3_stmt* handle) : handle_(handle) {}

    [[nodiscard]] sqlite3_stmt* get() const { return handle_.get(); }
    [[nodiscard]] std::int64_t integer(int column) const { return sqlite3_column_int64(get(), column); }
    [[nodiscard]] std::string text(int column) const;
    void bind(int parameter, std::int64_t value) { sqlite3_bind_int64(get(), parameter, value); }
    void bind(int parameter, const std::string& value) {
        sqlite3_bind_text(get(), parameter, value.data(), static_cast<int>(value.size()), SQLITE_TRANSIENT);
    }
    void reset() {
        sqlite3_reset(get());
        sqlite3_clear_bindings(get());
    }

  private:
    struct Finalize {
        void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
    };
    std::unique_ptr<sqlite3_stmt, Finalize> handle_;
};

class SqliteDatabase {
  public:
    /// With journal_mode=DELETE and synchronous=FULL, asked back; waits up to 10 s for others. GeoPackage's functions
    /// that the triggers of an R-tree call are there. Throws Error. \pre require_plain_model (model_guard.hpp): its
    /// triggers run.
    /// \param shown  what messages call it; empty: its path
    explicit SqliteDatabase(const std::string& path, std::string shown = {});

    [[nodiscard]] SqliteStatement prepare(const std::string& sql);
    /// False behind the last row. Throws Error with SQLite's reason and what to do about a full disk.
    bool step(const SqliteStatement& statement);
    void run(const std::string& sql);

    [[noreturn]] void fail() const;
    [[nodiscard]] const std::string& file() const { return file_; }

  private:
    struct Close {
        void operator()(sqlite3* handle) const { sqlite3_close_v2(handle); }
    };
    std::string file_;
    std::unique_ptr<sqlite3, Close> handle_;
};

/// BEGIN IMMEDIATE; rolled back unless committed.
class SqliteTransaction {
  public:
    explicit SqliteTransaction(SqliteDatabase& database) : database_(database) { database_.run("BEGIN IMMEDIATE"); }
    ~SqliteTransaction();
    SqliteTransaction(const SqliteTransaction&) = delete;
    SqliteTransaction& operator=(const SqliteTransaction&) = delete;
    void commit();

  private:
    SqliteDatabase& database_;
    bool open_ = true;
};

/// A name within a statement.
std::string quoted_name(const std::string& name);

/// Takes back what a program that was killed had begun to write, if there is something: a file opened for reading alone
/// cannot. Nothing of the schema is run.
void roll_back_interrupted(const std::string& path);

}  // namespace terratet
