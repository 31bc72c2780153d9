// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A model file that someone has made to do harm. Its digest is put right where a case does not speak of it: it is no
// signature, anybody can compute it.
#include <gdal_priv.h>
#include <sqlite3.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "io/model_store.hpp"
#include "random_model.hpp"
#include "support.hpp"
#include "tess/error.hpp"

using namespace terratet;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

/// A model with plain names: continuous Cu, categorical rock.
Model plain_model() {
    for (std::uint64_t seed = 1;; ++seed) {
        Model model = testing::random_model(seed);
        if (model.boreholes.size() > 2 && model.samples.size() > 10 && model.barriers.size() > 1 &&
            model.vertices.size() > 20 && model.vertices.front().role == Role::sample && !model.surfaces.empty() &&
            model.surfaces[0].triangles.size() > 2 && model.boreholes[1].path.size() > 2 &&
            !model.frame.crs_wkt.empty()) {
            model.properties = {{"Cu", "%", Scale::linear, Kind::continuous, {}},
                                {"rock", "", Scale::linear, Kind::categorical, {"gneiss", "granite"}}};
            model.criteria.variation = {{0.1, 0.2}, {0, 0}};
            model.criteria.overrides.clear();
            model.region_names = {{{1, 2, 3}, "west"}};
            for (auto* values : {&model.samples.values, &model.vertex_values.values}) {
                const std::size_t rows = values == &model.samples.values ? model.samples.size() : model.vertices.size();
                *values = {std::vector<double>(rows, 0.25), std::vector<double>(rows, 1)};
            }
            model.samples.censored.clear();
            model.vertex_values.extrapolation.assign(model.vertices.size(), 0.5);
            return model;
        }
    }
}

void execute(const std::string& path, const std::string& sql) {
    sqlite3* database = nullptr;
    REQUIRE(sqlite3_open(path.c_str(), &database) == SQLITE_OK);
    char* message = nullptr;
    INFO(sql);
    const int result = sqlite3_exec(database, sql.c_str(), nullptr, nullptr, &message);
    INFO((message ? message : ""));
    CHECK(result == SQLITE_OK);
    sqlite3_free(message);
    sqlite3_close(database);
}

const std::string drop_triggers =
    "DROP TRIGGER trigger_insert_feature_count_vertices; DROP TRIGGER trigger_delete_feature_count_vertices;";

/// A key of terratet_meta with one part replaced.
std::string in_meta(const std::string& key, const std::string& path, const std::string& json) {
    return "UPDATE terratet_meta SET value = json_set(value, '$" + std::string(path.starts_with('[') ? "" : ".") +
           path + "', json('" + json + "')) WHERE key = '" + key + "'";
}

class Attack {
  public:
    Attack() { save_model(folder_ / "m.gpkg", plain_model(), {1, "2026-01-02T03:04:05Z", "build", "{}"}); }

    /// What is said of the model after `sql`, its digest neglected.
    std::string message(const std::string& sql, bool accept_edited = true) {
        const std::string path = folder_ / "hostile.gpkg";
        fs::copy_file(folder_ / "m.gpkg", path, fs::copy_options::overwrite_existing);
        execute(path, sql);
        CHECK(is_model(path));
        std::string text = "loaded";
        try {
            load_model(path, {.accept_edited = accept_edited});
        } catch (const InputError& error) {
            text = error.what();
            CHECK_THAT(text, Contains("hostile.gpkg"));
        }
        INFO(sql);
        CHECK_THAT(text, !Contains("\n"));
        return text;
    }

  private:
    testing::TemporaryFolder folder_;
};

}  // namespace

TEST_CASE("In the place of a model's layer a view or a virtual table is refused, and never read") {
    Attack attack;
    const std::string endless = "WITH RECURSIVE c(fid) AS (SELECT 1 UNION ALL SELECT fid + 1 FROM c) SELECT ";
    for (const std::string layer : {"samples", "boreholes", "surfaces", "vertices", "terratet_meta", "terratet_journal",
                                    "gpkg_contents", "gpkg_geometry_columns", "gpkg_extensions"}) {
        const bool triggers = !layer.starts_with("gpkg_");
        std::string sql = layer == "gpkg_extensions" ? "CREATE TABLE IF NOT EXISTS gpkg_extensions (a);" : "";
        if (triggers) {
            sql += "DROP TRIGGER trigger_insert_feature_count_" + layer +
                   "; DROP TRIGGER trigger_delete_feature_count_" + layer + ";";
        }
        sql += "PRAGMA legacy_alter_table = ON; ALTER TABLE " + layer + " RENAME TO v0;";
        CHECK_THAT(attack.message(sql + "CREATE VIEW " + layer + " AS " + endless + "c.fid, v0.* FROM c, v0"),
                   Contains("`" + layer + "` must be a table; it is a view"));
        if (layer == "vertices") {
            CHECK_THAT(attack.message(sql + "CREATE VIEW VERTICES AS SELECT * FROM v0"),
                       Contains("`VERTICES` must be a table"));
            CHECK_THAT(attack.message(sql + "CREATE VIRTUAL TABLE vertices USING rtree(fid, a, b)"),
                       Contains("`vertices` must be a table; it is a virtual table"));
        }
    }
}

TEST_CASE("Triggers, generated columns and indexes of another's making are refused") {
    Attack attack;
    CHECK_THAT(attack.message("CREATE TRIGGER t AFTER INSERT ON vertices BEGIN DELETE FROM samples; END"),
               Contains("the trigger `t` on layer `vertices` is not GeoPackage's own"));
    CHECK_THAT(attack.message("CREATE TRIGGER t BEFORE UPDATE ON terratet_meta BEGIN SELECT 1; END"),
               Contains("trigger `t` on layer `terratet_meta`"));
    CHECK_THAT(attack.message("CREATE TRIGGER t AFTER UPDATE ON gpkg_contents BEGIN DELETE FROM samples; END"),
               Contains("trigger `t` on layer `gpkg_contents`"));
    // Under a name that is GeoPackage's.
    const std::string named = drop_triggers +
                              "CREATE TRIGGER trigger_insert_feature_count_vertices AFTER INSERT ON "
                              "vertices BEGIN ";
    CHECK_THAT(attack.message(named + "DELETE FROM samples; END"), Contains("not GeoPackage's own"));
    CHECK_THAT(attack.message(named + "UPDATE gpkg_ogr_contents SET feature_count = (SELECT 1) WHERE 1; END"),
               Contains("not GeoPackage's own"));
    CHECK(attack.message(named + "UPDATE gpkg_ogr_contents SET feature_count = feature_count + 1 WHERE "
                                 "lower(table_name) = lower('vertices'); END") == "loaded");
    CHECK_THAT(attack.message("ALTER TABLE samples ADD COLUMN g AS (1 + 1)"),
               Contains("column `g` of layer `samples` is generated"));
    CHECK_THAT(attack.message("CREATE INDEX i ON samples (abs(Cu))"),
               Contains("the index `i` on layer `samples` is over an expression"));
    CHECK_THAT(attack.message("CREATE INDEX i ON samples (Cu) WHERE Cu > 0"), Contains("the index `i`"));
    CHECK(attack.message("CREATE INDEX i ON samples (Cu)") == "loaded");
    CHECK(attack.message("CREATE TABLE mine (a); CREATE TRIGGER t AFTER INSERT ON mine BEGIN SELECT 1; END; "
                         "CREATE VIEW seen AS SELECT * FROM mine; ALTER TABLE samples ADD COLUMN note VARCHAR(20)") ==
          "loaded");
}

TEST_CASE("R-trees, styles and statistics that other programs add are taken as they are") {
    const testing::TemporaryFolder folder;
    const std::string path = folder / "m.gpkg";
    save_model(path, plain_model(), {1, "2026-01-02T03:04:05Z", "build", "{}"});
    GDALAllRegister();
    GDALDataset* const dataset =
        GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_UPDATE, nullptr, nullptr, nullptr);
    REQUIRE(dataset);
    for (const char* layer : {"samples", "boreholes", "surfaces", "vertices"}) {
        const std::string sql = std::string("SELECT CreateSpatialIndex('") + layer + "', 'geom')";
        dataset->ReleaseResultSet(dataset->ExecuteSQL(sql.c_str(), nullptr, nullptr));
    }
    dataset->SetMetadataItem("TITLE", "a site");
    GDALClose(dataset);
    execute(path,
            "DROP TABLE layer_styles; CREATE TABLE layer_styles (id INTEGER PRIMARY KEY, styleQML TEXT); ANALYZE");
    CHECK(model_digest(load_model(path)) == model_digest(plain_model()));
    sqlite3* database = nullptr;
    REQUIRE(sqlite3_open(path.c_str(), &database) == SQLITE_OK);
    sqlite3_stmt* count = nullptr;
    sqlite3_prepare_v2(database, "SELECT count(*) FROM sqlite_master WHERE type = 'trigger' AND name LIKE 'rtree%'", -1,
                       &count, nullptr);
    CHECK(sqlite3_step(count) == SQLITE_ROW);
    CHECK(sqlite3_column_int(count, 0) >= 24);
    sqlite3_finalize(count);
    sqlite3_close(database);
}

TEST_CASE("Without a digest, or with another, a model is refused unless it is taken as edited") {
    Attack attack;
    const std::string remove = "DELETE FROM terratet_meta WHERE key = 'digest'";
    CHECK_THAT(attack.message(remove, false), Contains("digest") && Contains("missing") && Contains("`accept_edited`"));
    CHECK(attack.message(remove, true) == "loaded");
    CHECK_THAT(attack.message("UPDATE samples SET Cu = 0.5 WHERE fid = 1", false),
               Contains("digest differs") && Contains("`accept_edited`"));
    CHECK(attack.message("UPDATE samples SET Cu = 0.5 WHERE fid = 1", true) == "loaded");
}

TEST_CASE("Every number of terratet_meta is held to its range, naming the key and what was found") {
    Attack attack;
    const auto meta = [&](const std::string& key, const std::string& path, const std::string& json) {
        INFO(key << " " << path << " " << json);
        const std::string text = attack.message(in_meta(key, path, json));
        CHECK_THAT(text, Contains("layer terratet_meta, key " + key));
        return text;
    };
    CHECK_THAT(meta("criteria", "l_min", "0.0"), Contains("l_min is 0, not a length above 0"));
    for (const char* length : {"-1", "1e300", "\"nan\"", "\"inf\"", "\"-inf\"", "null", "[]", "\"a\""}) {
        meta("criteria", "l_min", length);
        meta("criteria", "l_max", length);
        meta("frame", "z_scale", length);
        meta("frame", "metres_per_unit", length);
        meta("fault_options", "width", length);
    }
    CHECK_THAT(meta("frame", "origin[0]", "1e300"),
               Contains("origin is 1e+300") || Contains("origin is 1.0000000000000001e+300"));
    CHECK_THAT(meta("frame", "origin[2]", "\"nan\""), Contains("origin is nan"));
    CHECK_THAT(meta("frame", "z_scale", "1e300"), Contains("z_scale is 1"));
    CHECK_THAT(meta("frame", "crs_wkt", "\"PROJCRS[\""), Contains("not understood"));
    meta("frame", "unit", "\"me\\u0000tre\"");
    for (const char* count : {"-1", "1e300", "1.5", "\"3\""}) {
        meta("counts", "vertices", count);
        meta("fault_options", "max_seeds", count);
    }
    CHECK_THAT(attack.message(in_meta("counts", "vertices", "9999999999")), Contains("more or fewer rows"));
    CHECK_THAT(meta("domain", "extent.lo[0]", "\"inf\""), Contains("extent is inf"));
    CHECK_THAT(meta("domain", "hull.hi[1]", "-1e9"), Contains("hull"));
    meta("domain", "outline", "[[[0,0,0],[1,0,0]]]");
    meta("domain", "outline", "[[[0,0,0],[1e300,0,0],[0,1,0]]]");
    const std::string limits = "{\"df_min\":0,\"df_max\":1}";
    meta("criteria", "variation", "[" + limits + "," + limits + "," + limits + "]");
    meta("criteria", "overrides", "[{\"where\":{\"block_at\":[1e300,0,0]},\"l_min\":1,\"l_max\":2}]");
    meta("criteria", "overrides", "[{\"where\":{\"block_at\":[1,0,0]},\"l_min\":0,\"l_max\":2}]");
    meta("regions", "[0].at[1]", "1e10");
    meta("properties", "[1].name", "\"Cu\"");
    meta("properties", "[1].name", "\"\"");
    meta("properties", "[1].column", "\"CU\"");
    meta("properties", "[1].column", "\"role\"");
    meta("properties", "[1].classes", "[\"a\",\"a\"]");
    meta("properties", "[0].classes", "[\"a\"]");
    meta("properties", "[1].scale", "\"log10\"");
    CHECK_THAT(attack.message("UPDATE terratet_meta SET value = 'magic' WHERE key = 'estimator'"),
               Contains("key estimator") && Contains("'magic' is not known"));
    CHECK_THAT(attack.message("UPDATE terratet_meta SET value = 'idw' || char(10) || "
                              "'samples:lowest=0:highest=1:reach=-1 of Cu' WHERE key = 'estimator'"),
               Contains("key estimator") && Contains("reach=-1' is nothing that samples can have"));
}

TEST_CASE("Every number of the layers is held to its range, naming layer, row, column and what was found") {
    Attack attack;
    const auto row = [&](const std::string& layer, const std::string& column, const std::string& value) {
        INFO(layer << " " << column << " " << value);
        const std::string text = attack.message("UPDATE " + layer + " SET " + column + " = " + value +
                                                " WHERE fid = (SELECT max(fid) FROM " + layer +
                                                (layer == "surfaces" ? " WHERE kind = 'fault_sheet'" : "") + ")");
        CHECK_THAT(text, Contains("layer " + layer + ", row ") || Contains("layer `" + layer + "`, row "));
        return text;
    };
    CHECK_THAT(row("samples", "depth", "1e300"), Contains("column depth holds 1e+300"));
    CHECK_THAT(row("samples", "length", "-3"), Contains("column length holds -3"));
    row("samples", "Cu", "9e999");
    for (const char* hole : {"99", "0", "-1", "-9223372036854775807 - 1", "9223372036854775807"}) {
        CHECK_THAT(row("samples", "hole", hole), Contains("its borehole is not in layer boreholes"));
    }
    CHECK_THAT(row("samples", "Cu", "'abc'"), Contains("column `Cu` holds something of another type"));
    CHECK_THAT(row("samples", "borehole", "x'00ff'"), Contains("column `borehole`"));
    CHECK_THAT(row("vertices", "id", "1.5"), Contains("column `id`"));
    CHECK_THAT(row("vertices", "geom", "'text'"), Contains("column `geom`"));
    row("vertices", "id", "(SELECT id FROM vertices WHERE fid = 1)");
    CHECK_THAT(row("vertices", "side", "1"), Contains("column side holds 1"));
    row("vertices", "side", "7");
    row("vertices", "role", "'king'");
    row("vertices", "owner", "1");
    CHECK_THAT(row("vertices", "extrapolation", "1.5"), Contains("column extrapolation holds 1.5"));
    row("vertices", "extrapolation", "-9e999");
    row("vertices", "rock", "'basalt'");
    row("vertices", "geom", "(SELECT geom FROM surfaces LIMIT 1)");
    CHECK_THAT(attack.message("UPDATE vertices SET geom = (SELECT geom FROM vertices WHERE fid = 2) WHERE fid = 5"),
               Contains("layer vertices: the vertices of id ") && Contains("at the same place"));
    CHECK_THAT(attack.message("UPDATE vertices SET owner = 4711 WHERE fid = 1"), Contains("its sample is not in"));
    CHECK_THAT(row("surfaces", "spacing", "0"), Contains("column spacing holds 0"));
    row("surfaces", "spacing", "1e300");
    row("surfaces", "width", "-1");
    row("surfaces", "protection_radius", "NULL");
    row("surfaces", "seed_count", "-1");
    row("surfaces", "mesh_triangles", "x'ffffffff0000000000000000'");
    row("boreholes", "id", "(SELECT id FROM boreholes WHERE fid = 1)");
    row("boreholes", "collar_x", "1e300");
    row("boreholes", "id", "CAST(x'ff41' AS TEXT)");
}

TEST_CASE("A table whose pages name one another in a ring is damaged, not endless") {
    const testing::TemporaryFolder folder;
    Model model = plain_model();
    while (model.vertices.size() < 3000) {
        const auto i = static_cast<double>(model.vertices.size());
        model.vertices.push_back({model.vertices.back().id + 1, {i, 0.5, i / 7}, Role::inserted, -1, 0});
        model.vertex_values.values[0].push_back(0);
        model.vertex_values.values[1].push_back(0);
        model.vertex_values.extrapolation.push_back(0);
    }
    std::erase_if(model.vertices, [](const Vertex& v) { return v.id > 1'000'000'000; });
    model.vertex_values.values = {std::vector<double>(model.vertices.size(), 0),
                                  std::vector<double>(model.vertices.size(), 0)};
    model.vertex_values.extrapolation.assign(model.vertices.size(), 0);
    const std::string path = folder / "m.gpkg";
    save_model(path, model, {1, "2026-01-02T03:04:05Z", "build", "{}"});
    std::ifstream in(path, std::ios::binary);
    std::string bytes{std::istreambuf_iterator<char>(in), {}};
    const auto number = [&](std::size_t at, int size) {
        std::size_t value = 0;
        for (int i = 0; i < size; ++i) {
            value = value << 8 | static_cast<unsigned char>(bytes[at + static_cast<std::size_t>(i)]);
        }
        return value;
    };
    const std::size_t page = number(16, 2);
    std::size_t changed = 0;
    for (std::size_t begin = page; begin < bytes.size(); begin += page) {
        if (bytes[begin] == 5 && number(begin + 3, 2) > 3) {  // an interior page of a table: every child its first one
            const std::size_t first = begin + number(begin + 12, 2);
            for (std::size_t cell = 1; cell < number(begin + 3, 2); ++cell) {
                bytes.replace(begin + number(begin + 12 + 2 * cell, 2), 4, bytes, first, 4);
            }
            ++changed;
        }
    }
    REQUIRE(changed > 0);
    std::ofstream(path, std::ios::binary) << bytes;
    CHECK_THROWS_WITH(load_model(path, {.accept_edited = true}), Contains("comes behind row") || Contains("damaged"));
}

TEST_CASE("A model within an archive is looked over as one on disk is") {
    const testing::TemporaryFolder folder;
    save_model(folder / "m.gpkg", plain_model(), {1, "2026-01-02T03:04:05Z", "build", "{}"});
    const std::string zip = "cd '" + folder.path().string() + "' && python3 -m zipfile -c m.zip m.gpkg";
    REQUIRE(std::system(zip.c_str()) == 0);
    const std::string path = "/vsizip/" + (folder / "m.zip") + "/m.gpkg";
    CHECK(is_model(path));
    CHECK(model_digest(load_model(path)) == model_digest(plain_model()));
    execute(folder / "m.gpkg", "CREATE TRIGGER t AFTER INSERT ON vertices BEGIN DELETE FROM samples; END");
    fs::remove(folder / "m.zip");
    REQUIRE(std::system(zip.c_str()) == 0);
    CHECK_THROWS_WITH(load_model(path), Contains("the trigger `t`"));
}
