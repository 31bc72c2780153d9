// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/model/sqlite_rows.hpp"

#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "tess/error.hpp"

namespace terratet {
namespace {

constexpr int row_parameter = 1;
constexpr int geometry_parameter = 2;
constexpr int first_column = 3;

}  // namespace

std::string geopackage_geometry(const OGRGeometry& geometry, std::int32_t srs_id) {
    const bool point = wkbFlatten(geometry.getGeometryType()) == wkbPoint;
    const bool empty = geometry.IsEmpty() != 0;
    std::string bytes("GP\0\0", 4);
    bytes[3] = static_cast<char>(1 | (point || empty ? 0 : 2 << 1) | (empty ? 1 << 4 : 0));
    const auto append = [&](const auto& value) {
        bytes.append(reinterpret_cast<const char*>(&value), sizeof value);  // little-endian, as this machine
    };
    append(srs_id);
    if (!point && !empty) {
        OGREnvelope3D e;
        geometry.getEnvelope(&e);
        for (const double bound : {e.MinX, e.MaxX, e.MinY, e.MaxY, e.MinZ, e.MaxZ}) {
            append(bound);
        }
    }
    const std::size_t head = bytes.size();
    bytes.resize(head + geometry.WkbSize());
    geometry.exportToWkb(wkbNDR, reinterpret_cast<unsigned char*>(bytes.data() + head), wkbVariantIso);
    return bytes;
}

std::int32_t srs_of_layer(SqliteDatabase& database, const std::string& layer) {
    SqliteStatement id = database.prepare("SELECT srs_id FROM gpkg_geometry_columns WHERE lower(table_name) = ?");
    id.bind(1, layer);
    return database.step(id) ? static_cast<std::int32_t>(id.integer(0)) : 0;
}

SqliteRowWriter::SqliteRowWriter(SqliteDatabase& database, std::string layer)
    : database_(database), layer_(std::move(layer)), srs_id_(srs_of_layer(database, layer_)) {}

Column SqliteRowWriter::add(const std::string& name) {
    columns_.push_back(name);
    return static_cast<Column>(columns_.size() - 1);
}

void SqliteRowWriter::create() {
    SqliteStatement geometry =
        database_.prepare("SELECT count(*) FROM gpkg_geometry_columns WHERE lower(table_name) = ?");
    geometry.bind(1, layer_);
    database_.step(geometry);
    const bool has_geometry = geometry.integer(0) > 0;
    std::string names = has_geometry ? "fid, geom" : "fid";
    std::string marks = has_geometry ? "?1, ?2" : "?1";
    for (std::size_t i = 0; i < columns_.size(); ++i) {
        names += ", " + quoted_name(columns_[i]);
        marks += ", ?" + std::to_string(first_column + static_cast<int>(i));
    }
    std::vector<std::string> dropped;
    {
        SqliteStatement triggers =
            database_.prepare("SELECT name, sql FROM sqlite_master WHERE type = 'trigger' AND lower(tbl_name) = ?");
        triggers.bind(1, layer_);
        while (database_.step(triggers)) {
            dropped.push_back(triggers.text(0));
            triggers_.push_back(triggers.text(1));
        }
    }
    for (const std::string& name : dropped) {
        database_.run("DROP TRIGGER " + quoted_name(name));
    }
    insert_ = std::make_unique<SqliteStatement>(
        database_.prepare("INSERT INTO " + quoted_name(layer_) + " (" + names + ") VALUES (" + marks + ")"));
}

void SqliteRowWriter::set(Column column, double value) {
    if (!std::isnan(value)) {
        sqlite3_bind_double(insert_->get(), first_column + column, value);
    }
}

void SqliteRowWriter::set(Column column, std::int64_t value) {
    insert_->bind(first_column + column, value);
}

void SqliteRowWriter::set(Column column, const std::string& value) {
    insert_->bind(first_column + column, value);
}

void SqliteRowWriter::set(Column column, std::span<const std::byte> value) {
    if (value.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
        throw Error("cannot write " + database_.file() + ": a surface of more than 2 GiB; split it");
    }
    sqlite3_bind_blob(insert_->get(), first_column + column, value.data(), static_cast<int>(value.size()),
                      SQLITE_TRANSIENT);
}

void SqliteRowWriter::set_point(const Vec3& position) {
    struct [[gnu::packed]] Point {
        std::array<char, 4> head{'G', 'P', 0, 1};
        std::int32_t srs_id = 0;
        char order = 1;
        std::uint32_t type = 1001;
        double x = 0, y = 0, z = 0;
    };
    const Point point{.srs_id = srs_id_, .x = position.x, .y = position.y, .z = position.z};
    sqlite3_bind_blob(insert_->get(), geometry_parameter, &point, sizeof point, SQLITE_TRANSIENT);
    box_.extend(position);
}

void SqliteRowWriter::set_geometry(std::unique_ptr<OGRGeometry> geometry) {
    const std::string bytes = geopackage_geometry(*geometry, srs_id_);
    sqlite3_bind_blob(insert_->get(), geometry_parameter, bytes.data(), static_cast<int>(bytes.size()),
                      SQLITE_TRANSIENT);
    if (!geometry->IsEmpty()) {
        OGREnvelope e;
        geometry->getEnvelope(&e);
        box_.extend({e.MinX, e.MinY, 0});
        box_.extend({e.MaxX, e.MaxY, 0});
    }
}

void SqliteRowWriter::write() {
    insert_->bind(row_parameter, ++row_number_);
    database_.step(*insert_);
    insert_->reset();
}

void SqliteRowWriter::finish() {
    insert_.reset();
    for (const std::string& trigger : triggers_) {
        database_.run(trigger);
    }
    SqliteStatement count =
        database_.prepare("UPDATE gpkg_ogr_contents SET feature_count = ?1 WHERE lower(table_name) = ?2");
    count.bind(1, row_number_);
    count.bind(2, layer_);
    database_.step(count);
    if (!box_.empty()) {
        SqliteStatement extent = database_.prepare(
            "UPDATE gpkg_contents SET min_x = ?1, min_y = ?2, max_x = ?3, max_y = ?4 WHERE lower(table_name) = ?5");
        const double bounds[] = {box_.lo.x, box_.lo.y, box_.hi.x, box_.hi.y};
        for (int i = 0; i < 4; ++i) {
            sqlite3_bind_double(extent.get(), i + 1, bounds[i]);
        }
        extent.bind(5, layer_);
        database_.step(extent);
    }
}

}  // namespace terratet
