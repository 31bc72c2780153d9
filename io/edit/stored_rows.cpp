// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/edit/stored_rows.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "io/model/model_schema.hpp"
#include "io/model/sqlite_rows.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

std::string hex(const unsigned char* bytes, std::size_t size) {
    std::string text;
    text.reserve(2 * size);
    for (std::size_t i = 0; i < size; ++i) {
        text += "0123456789abcdef"[bytes[i] >> 4];
        text += "0123456789abcdef"[bytes[i] & 15];
    }
    return text;
}

std::string from_hex(const std::string& text) {
    const auto digit = [](char c) { return c <= '9' ? c - '0' : c - 'a' + 10; };
    std::string bytes;
    for (std::size_t i = 0; i + 1 < text.size(); i += 2) {
        bytes += static_cast<char>(digit(text[i]) << 4 | digit(text[i + 1]));
    }
    return bytes;
}

JsonRow cell(sqlite3_stmt* statement, int column) {
    switch (sqlite3_column_type(statement, column)) {
        case SQLITE_INTEGER:
            return sqlite3_column_int64(statement, column);
        case SQLITE_FLOAT:
            return sqlite3_column_double(statement, column);
        case SQLITE_TEXT:
            return std::string(reinterpret_cast<const char*>(sqlite3_column_text(statement, column)),
                               static_cast<std::size_t>(sqlite3_column_bytes(statement, column)));
        case SQLITE_BLOB:
            return {{"hex", hex(static_cast<const unsigned char*>(sqlite3_column_blob(statement, column)),
                                static_cast<std::size_t>(sqlite3_column_bytes(statement, column)))}};
        default:
            return nullptr;
    }
}

void bind_cell(sqlite3_stmt* statement, int parameter, const JsonRow& value) {
    if (value.is_number_integer()) {
        sqlite3_bind_int64(statement, parameter, value.get<std::int64_t>());
    } else if (value.is_number()) {
        sqlite3_bind_double(statement, parameter, value.get<double>());
    } else if (value.is_string()) {
        const auto text = value.get<std::string>();
        sqlite3_bind_text(statement, parameter, text.data(), static_cast<int>(text.size()), SQLITE_TRANSIENT);
    } else if (value.is_object()) {
        const std::string bytes = from_hex(value.at("hex").get<std::string>());
        sqlite3_bind_blob(statement, parameter, bytes.data(), static_cast<int>(bytes.size()), SQLITE_TRANSIENT);
    } else {
        sqlite3_bind_null(statement, parameter);
    }
}

/// Cells of columns that a row does not name are null.
JsonRow cell_of(const JsonRow& row, const std::string& column) {
    const auto found = row.find(column);
    return found == row.end() ? JsonRow(nullptr) : *found;
}

/// Equal cell by cell; what one of them lacks is null in it.
bool same_row(const JsonRow& a, const JsonRow& b, const std::vector<std::string>& columns) {
    if (a.is_null() || b.is_null()) {
        return a.is_null() && b.is_null();
    }
    return std::ranges::all_of(columns, [&](const std::string& column) {
        return column == "fid" || cell_of(a, column) == cell_of(b, column);
    });
}

}  // namespace

StoredTable::StoredTable(SqliteDatabase& database, std::string name) : database_(database), name_(std::move(name)) {
    prepare_again();
}

void StoredTable::prepare_again() {
    columns_.clear();
    const SqliteStatement info = database_.prepare("PRAGMA table_info(" + quoted_name(name_) + ")");
    while (database_.step(info)) {
        columns_.push_back(info.text(1));
    }
    const auto fid = std::ranges::find(columns_, "fid");
    if (fid == columns_.end()) {
        throw InputError(database_.file() + ": layer " + name_ + " is missing, or has no column fid");
    }
    std::rotate(columns_.begin(), fid, fid + 1);
    select_.reset();
    insert_.reset();
    update_.reset();
    delete_.reset();
}

void StoredTable::add_column(const std::string& name, const char* type) {
    database_.run("ALTER TABLE " + quoted_name(name_) + " ADD COLUMN " + quoted_name(name) + " " + type);
    prepare_again();
}

SqliteStatement& StoredTable::statement(std::unique_ptr<SqliteStatement>& kept, const std::string& sql) {
    if (!kept) {
        kept = std::make_unique<SqliteStatement>(database_.prepare(sql));
    }
    kept->reset();
    return *kept;
}

std::int64_t StoredTable::last_row() {
    const SqliteStatement last = database_.prepare("SELECT max(fid) FROM " + quoted_name(name_));
    return database_.step(last) ? last.integer(0) : 0;
}

JsonRow StoredTable::read(std::int64_t row) {
    if (!select_) {
        std::string list;
        for (const std::string& column : columns_) {
            list += (list.empty() ? "" : ", ") + quoted_name(column);
        }
        statement(select_, "SELECT " + list + " FROM " + quoted_name(name_) + " WHERE fid = ?");
    }
    select_->reset();
    select_->bind(1, row);
    if (!database_.step(*select_)) {
        return nullptr;
    }
    JsonRow cells = JsonRow::object();
    for (std::size_t i = 1; i < columns_.size(); ++i) {
        cells[columns_[i]] = cell(select_->get(), static_cast<int>(i));
    }
    select_->reset();
    return cells;
}

void StoredTable::put(std::int64_t row, const JsonRow& cells) {
    const std::string table = quoted_name(name_);
    if (cells.is_null()) {
        SqliteStatement& gone = statement(delete_, "DELETE FROM " + table + " WHERE fid = ?");
        gone.bind(1, row);
        database_.step(gone);
        return;
    }
    if (!insert_) {
        std::string names;
        std::string marks;
        std::string sets;
        for (std::size_t i = 0; i < columns_.size(); ++i) {
            const std::string mark = "?" + std::to_string(i + 1);
            names += (i == 0 ? "" : ", ") + quoted_name(columns_[i]);
            marks += (i == 0 ? "" : ", ") + mark;
            sets += i == 0 ? "" : (i == 1 ? "" : ", ") + quoted_name(columns_[i]) + " = " + mark;
        }
        statement(insert_, "INSERT INTO " + table + " (" + names + ") VALUES (" + marks + ")");
        statement(update_, "UPDATE " + table + " SET " + sets + " WHERE fid = ?1");
    }
    SqliteStatement& write = read(row).is_null() ? *insert_ : *update_;
    write.reset();
    write.bind(1, row);
    for (std::size_t i = 1; i < columns_.size(); ++i) {
        bind_cell(write.get(), static_cast<int>(i) + 1, cell_of(cells, columns_[i]));
    }
    database_.step(write);
    write.reset();
}

ChangeLog::ChangeLog(SqliteDatabase& database, std::int64_t edit)
    : database_(database),
      edit_(edit),
      next_row_(StoredTable(database, schema::changes).last_row() + 1),
      insert_(database.prepare("INSERT INTO " + quoted_name(schema::changes) +
                               " (fid, edit, \"table\", row_id, before, after) VALUES (?, ?, ?, ?, ?, ?)")) {}

void ChangeLog::put(StoredTable& table, std::int64_t row, const JsonRow& cells) {
    const JsonRow before = table.read(row);
    if (same_row(before, cells, table.columns())) {
        return;
    }
    table.put(row, cells);
    const JsonRow after = table.read(row);
    insert_.reset();
    insert_.bind(1, next_row_++);
    insert_.bind(2, edit_);
    insert_.bind(3, table.name());
    insert_.bind(4, row);
    if (!before.is_null()) {
        insert_.bind(5, before.dump());
    }
    if (!after.is_null()) {
        insert_.bind(6, after.dump());
    }
    database_.step(insert_);
    insert_.reset();
}

JsonRowWriter::JsonRowWriter(SqliteDatabase& database, StoredTable& table, ChangeLog& log)
    : table_(table), log_(log), srs_id_(srs_of_layer(database, table.name())) {}

Column JsonRowWriter::add(const std::string& name, const char* type) {
    if (std::ranges::find(table_.columns(), name) == table_.columns().end()) {
        table_.add_column(name, type);
    }
    names_.push_back(name);
    return static_cast<Column>(names_.size() - 1);
}

void JsonRowWriter::set(Column column, double value) {
    if (!std::isnan(value)) {
        cells_[names_[at_column(column)]] = value;
    }
}

void JsonRowWriter::set(Column column, std::span<const std::byte> value) {
    cells_[names_[at_column(column)]] = {
        {"hex", hex(reinterpret_cast<const unsigned char*>(value.data()), value.size())}};
}

void JsonRowWriter::set_point(const Vec3& position) {
    set_geometry(std::make_unique<OGRPoint>(position.x, position.y, position.z));
}

void JsonRowWriter::set_geometry(std::unique_ptr<OGRGeometry> geometry) {
    const std::string bytes = geopackage_geometry(*geometry, srs_id_);
    cells_["geom"] = {{"hex", hex(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size())}};
}

void JsonRowWriter::write() {
    log_.put(table_, row_, cells_);
    cells_ = JsonRow::object();
}

}  // namespace terratet
