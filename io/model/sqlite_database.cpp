// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/model/sqlite_database.hpp"

#include <ogr_geometry.h>
#include <sys/stat.h>

#include <cmath>
#include <cstring>
#include <utility>

#include "tess/error.hpp"

namespace terratet {
namespace {

/// Of a GeoPackage geometry, by its envelope or, without one, by its points. False for an empty one or none.
bool envelope_of(sqlite3_value* value, OGREnvelope& envelope) {
    if (sqlite3_value_type(value) != SQLITE_BLOB) {
        return false;
    }
    const auto* const bytes = static_cast<const unsigned char*>(sqlite3_value_blob(value));
    const auto size = static_cast<std::size_t>(sqlite3_value_bytes(value));
    constexpr std::size_t sizes[] = {0, 32, 48, 48, 64};
    if (size < 8 || bytes[0] != 'G' || bytes[1] != 'P' || (bytes[3] >> 1 & 7) > 4) {
        return false;
    }
    const std::size_t head = 8 + sizes[bytes[3] >> 1 & 7];
    OGRGeometry* geometry = nullptr;
    if (size <= head ||
        OGRGeometryFactory::createFromWkb(bytes + head, nullptr, &geometry, size - head) != OGRERR_NONE) {
        return false;
    }
    const bool there = !geometry->IsEmpty();
    geometry->getEnvelope(&envelope);
    OGRGeometryFactory::destroyGeometry(geometry);
    return there;
}

void is_empty(sqlite3_context* context, int, sqlite3_value** values) {
    OGREnvelope envelope;
    sqlite3_result_int(context, envelope_of(values[0], envelope) ? 0 : 1);
}

template <double OGREnvelope::*Bound>
void bound(sqlite3_context* context, int, sqlite3_value** values) {
    OGREnvelope envelope;
    if (envelope_of(values[0], envelope)) {
        sqlite3_result_double(context, envelope.*Bound);
    } else {
        sqlite3_result_null(context);
    }
}

void add_functions(sqlite3* handle) {
    constexpr int flags = SQLITE_UTF8 | SQLITE_DETERMINISTIC | SQLITE_INNOCUOUS;
    const auto add = [&](const char* name, void (*function)(sqlite3_context*, int, sqlite3_value**)) {
        sqlite3_create_function(handle, name, 1, flags, nullptr, function, nullptr, nullptr);
    };
    add("ST_IsEmpty", is_empty);
    add("ST_MinX", bound<&OGREnvelope::MinX>);
    add("ST_MaxX", bound<&OGREnvelope::MaxX>);
    add("ST_MinY", bound<&OGREnvelope::MinY>);
    add("ST_MaxY", bound<&OGREnvelope::MaxY>);
}

}  // namespace

std::string SqliteStatement::text(int column) const {
    const auto* const bytes = sqlite3_column_text(get(), column);
    return bytes ? std::string(reinterpret_cast<const char*>(bytes),
                               static_cast<std::size_t>(sqlite3_column_bytes(get(), column)))
                 : std::string();
}

SqliteDatabase::SqliteDatabase(const std::string& path, std::string shown)
    : file_(shown.empty() ? path : std::move(shown)) {
    sqlite3* handle = nullptr;
    const int opened = sqlite3_open_v2(path.c_str(), &handle, SQLITE_OPEN_READWRITE, nullptr);
    handle_.reset(handle);
    if (opened != SQLITE_OK) {
        fail();
    }
    sqlite3_extended_result_codes(handle, 1);
    sqlite3_busy_timeout(handle, 10'000);
    sqlite3_db_config(handle, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 1, nullptr);  // the triggers of R-trees need it
    add_functions(handle);
    run("PRAGMA synchronous=FULL");
    SqliteStatement journal = prepare("PRAGMA journal_mode=DELETE");
    if (!step(journal) || journal.text(0) != "delete") {
        throw Error("cannot write " + file_ +
                    ": SQLite does not take journal_mode=DELETE; is another program using it?");
    }
}

SqliteStatement SqliteDatabase::prepare(const std::string& sql) {
    sqlite3_stmt* statement = nullptr;
    if (sqlite3_prepare_v2(handle_.get(), sql.c_str(), -1, &statement, nullptr) != SQLITE_OK) {
        fail();
    }
    return SqliteStatement(statement);
}

bool SqliteDatabase::step(const SqliteStatement& statement) {
    const int result = sqlite3_step(statement.get());
    if (result != SQLITE_ROW && result != SQLITE_DONE) {
        fail();
    }
    return result == SQLITE_ROW;
}

void SqliteDatabase::run(const std::string& sql) {
    const SqliteStatement statement = prepare(sql);
    while (step(statement)) {
    }
}

void SqliteDatabase::fail() const {
    const int code = sqlite3_errcode(handle_.get()) & 0xFF;
    const char* const advice =
        code == SQLITE_FULL       ? "; free some space"
        : code == SQLITE_IOERR    ? "; is the disk full, or does a limit of the shell (ulimit -f) allow no larger file?"
        : code == SQLITE_BUSY     ? "; another program is writing it"
        : code == SQLITE_READONLY ? "; it, or its folder, may not be written to"
                                  : "";
    throw Error("cannot write " + file_ + ": " + sqlite3_errmsg(handle_.get()) + advice);
}

SqliteTransaction::~SqliteTransaction() {
    if (open_) {
        try {
            database_.run("ROLLBACK");
        } catch (const Error&) {  // SQLite has done so itself
        }
    }
}

void SqliteTransaction::commit() {
    database_.run("COMMIT");
    open_ = false;
}

std::string quoted_name(const std::string& name) {
    std::string result = "\"";
    for (const char c : name) {
        result += c == '"' ? "\"\"" : std::string(1, c);
    }
    return result + '"';
}

void roll_back_interrupted(const std::string& path) {
    struct stat status {};
    if (path.starts_with("/vsi") || stat((path + "-journal").c_str(), &status) != 0 || status.st_size == 0) {
        return;
    }
    sqlite3* handle = nullptr;
    if (sqlite3_open_v2(path.c_str(), &handle, SQLITE_OPEN_READWRITE, nullptr) == SQLITE_OK) {
        sqlite3_busy_timeout(handle, 10'000);
        sqlite3_stmt* statement = nullptr;  // any read does it
        if (sqlite3_prepare_v2(handle, "SELECT rootpage FROM sqlite_master LIMIT 1", -1, &statement, nullptr) ==
            SQLITE_OK) {
            sqlite3_step(statement);
        }
        sqlite3_finalize(statement);
    }
    sqlite3_close_v2(handle);
}

}  // namespace terratet
