// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/edit/samples_where.hpp"

#include <sqlite3.h>

#include <cmath>
#include <memory>

#include "io/model/model_schema.hpp"
#include "io/model/sqlite_database.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

void bind_number(sqlite3_stmt* statement, int parameter, double value) {
    if (std::isnan(value)) {
        sqlite3_bind_null(statement, parameter);
    } else {
        sqlite3_bind_double(statement, parameter, value);
    }
}

void bind_text(sqlite3_stmt* statement, int parameter, const std::string& text) {
    sqlite3_bind_text(statement, parameter, text.data(), static_cast<int>(text.size()), SQLITE_TRANSIENT);
}

}  // namespace

std::vector<bool> samples_where(const Site& site, const std::string& condition) {
    sqlite3* handle = nullptr;
    const int opened = sqlite3_open_v2(":memory:", &handle, SQLITE_OPEN_READWRITE, nullptr);
    const std::unique_ptr<sqlite3, int (*)(sqlite3*)> database(handle, &sqlite3_close_v2);
    const auto prepare = [&](const std::string& sql) {
        sqlite3_stmt* statement = nullptr;
        if (opened != SQLITE_OK || sqlite3_prepare_v2(handle, sql.c_str(), -1, &statement, nullptr) != SQLITE_OK) {
            throw UsageError("'" + condition + "' is no condition on samples (borehole, depth, length, x, y, z, " +
                             "properties): " + sqlite3_errmsg(handle));
        }
        return SqliteStatement(statement);
    };
    std::string names = "sample INTEGER PRIMARY KEY, borehole, depth, length, x, y, z";
    std::string marks = "?, ?, ?, ?, ?, ?, ?";
    for (const std::string& column : schema::property_columns(site.properties)) {
        names += ", " + quoted_name(column);
        marks += ", ?";
    }
    sqlite3_step(prepare("CREATE TABLE samples (" + names + ")").get());
    SqliteStatement insert = prepare("INSERT INTO samples VALUES (" + marks + ")");
    const Samples& samples = site.samples;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        insert.reset();
        insert.bind(1, static_cast<std::int64_t>(i));
        if (samples.borehole[i] >= 0) {
            bind_text(insert.get(), 2, site.boreholes[static_cast<std::size_t>(samples.borehole[i])].id);
        }
        bind_number(insert.get(), 3, samples.depth[i]);
        bind_number(insert.get(), 4, samples.length[i]);
        const Vec3 p = site.frame.to_world(samples.positions[i]);
        for (int axis = 0; axis < 3; ++axis) {
            bind_number(insert.get(), 5 + axis, p[axis]);
        }
        for (std::size_t property = 0; property < site.properties.size(); ++property) {
            const double value = samples.values[property][i];
            const int parameter = 8 + static_cast<int>(property);
            if (site.properties[property].kind == Kind::categorical && !std::isnan(value)) {
                bind_text(insert.get(), parameter, site.properties[property].classes[static_cast<std::size_t>(value)]);
            } else {
                bind_number(insert.get(), parameter, value);
            }
        }
        sqlite3_step(insert.get());
    }
    std::vector<bool> marked(samples.size());
    const SqliteStatement chosen = prepare("SELECT sample FROM samples WHERE (" + condition + ")");
    while (sqlite3_step(chosen.get()) == SQLITE_ROW) {
        marked[static_cast<std::size_t>(chosen.integer(0))] = true;
    }
    return marked;
}

}  // namespace terratet
