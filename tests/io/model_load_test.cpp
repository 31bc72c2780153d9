// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <functional>

#include "stored_models.hpp"
#include "tess/error.hpp"

using namespace terratet;
using namespace terratet::testing;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

TEST_CASE("What is no model is refused with its reason") {
    const testing::TemporaryFolder folder;
    const auto path = folder / "m.gpkg";
    CHECK_FALSE(is_model(path));
    CHECK_THROWS_WITH(load_model(path), Contains("m.gpkg: not found"));
    put(path, "text");
    CHECK_FALSE(is_model(path));
    CHECK_THROWS_WITH(load_model(path), Contains("is no GeoPackage"));
    fs::remove(path);
    {
        const GdalScope quiet;
        GDALDataset* const other =
            GetGDALDriverManager()->GetDriverByName("GPKG")->Create(path.c_str(), 0, 0, 0, GDT_Unknown, nullptr);
        other->CreateLayer("roads");
        GDALClose(other);
    }
    CHECK_FALSE(is_model(path));
    CHECK_THROWS_WITH(load_model(path), Contains("no Terratet model") && Contains("terratet_meta"));
    CHECK_THROWS_WITH(save_model(path, plain_model(), entry), Contains("m.gpkg exists") && Contains("`overwrite`"));
    CHECK_THROWS_WITH(save_model(folder / "none/m.gpkg", plain_model(), entry), Contains("no folder"));
    Model latin = plain_model();
    latin.boreholes[1].id = "Bj\xF6rk";
    CHECK_THROWS_WITH(save_model(folder / "n.gpkg", latin, entry), Contains("a borehole's id is not valid UTF-8"));
    CHECK(entries(folder.path()) == 1);
}

TEST_CASE("Damage by other programs is found and named by layer and row") {
    const testing::TemporaryFolder folder;
    const Model model = plain_model();
    save_model(folder / "m.gpkg", model, entry);
    const auto message = [&](const std::string& sql) {
        INFO(sql);
        const auto path = folder / "damaged.gpkg";
        fs::copy_file(folder / "m.gpkg", path, fs::copy_options::overwrite_existing);
        execute(path, sql);
        std::string text;
        try {
            check_same(load_model(path), model);
            text = "loaded";
        } catch (const InputError& error) {
            text = error.what();
        }
        CHECK_THAT(text, Contains("damaged.gpkg") && !Contains("\n"));
        return text;
    };
    CHECK_THAT(message("DROP TABLE vertices"), Contains("layer vertices is missing"));
    CHECK_THAT(message("ALTER TABLE samples DROP COLUMN Cu"), Contains("layer samples has no column Cu of type Real"));
    CHECK_THAT(message("UPDATE terratet_meta SET value='2' WHERE key='format_version'"),
               Contains("has model format 2, this program reads format 1"));
    CHECK_THAT(message("DELETE FROM terratet_meta WHERE key='frame'"), Contains("no key frame"));
    CHECK_THAT(message("UPDATE terratet_meta SET value='{\"lo\":' WHERE key='domain'"),
               Contains("key domain is damaged"));
    CHECK_THAT(message("UPDATE terratet_meta SET value='[1]' WHERE key='criteria'"),
               Contains("key criteria is damaged"));
    CHECK_THAT(message("UPDATE terratet_meta SET value='odd' WHERE key='density'"), Contains("key density is damaged"));
    CHECK_THAT(message("DELETE FROM samples WHERE fid=3"), Contains("samples") || Contains("more or fewer rows"));
    CHECK_THAT(message("DELETE FROM vertices WHERE fid=(SELECT max(fid) FROM vertices)"),
               Contains("more or fewer rows"));
    CHECK_THAT(message("UPDATE samples SET rock='basalt' WHERE fid=4"),
               Contains("layer samples, row 4: \"basalt\" is no class of rock"));
    CHECK_THAT(message("UPDATE samples SET hole=99 WHERE fid=1"), Contains("layer samples, row 1: its borehole"));
    CHECK_THAT(message("UPDATE samples SET geom=NULL WHERE fid=2"), Contains("layer samples, row 2: its geometry"));
    CHECK_THAT(message("UPDATE samples SET Cu=0.5 WHERE fid=2"), Contains("digest differs"));
    CHECK_THAT(message("UPDATE samples SET Cu_censored='?' WHERE fid=5"), Contains("layer samples, row 5: \"?\""));
    CHECK_THAT(message("UPDATE samples SET Cu_censored='>' WHERE fid=5"), Contains("digest differs"));
    CHECK_THAT(message("UPDATE vertices SET side=5 WHERE fid=7"), Contains("layer vertices, row 7: "));
    CHECK_THAT(message("UPDATE vertices SET role='king' WHERE fid=7"),
               Contains("layer vertices, row 7: column role holds king"));
    CHECK_THAT(message("UPDATE vertices SET owner=4711 WHERE fid=1"), Contains("layer vertices, row 1: its sample"));
    CHECK_THAT(message("UPDATE vertices SET id=0 WHERE fid=9"), Contains("layer vertices, row 9: ids do not ascend"));
    CHECK_THAT(message("UPDATE vertices SET id=NULL WHERE fid=9"), Contains("row 9: no value in column id"));
    CHECK_THAT(message("UPDATE vertices SET geom=(SELECT geom FROM surfaces LIMIT 1) WHERE fid=9"),
               Contains("layer vertices, row 9: its geometry is no point"));
    CHECK_THAT(message("UPDATE surfaces SET kind='lake' WHERE fid=1"), Contains("layer surfaces, row 1: \"lake\""));
    CHECK_THAT(message("UPDATE surfaces SET mesh_triangles=x'00' WHERE fid=1"), Contains("row 1: mesh_triangles"));
    CHECK_THAT(message("UPDATE surfaces SET mesh_triangles=x'ffffffff0000000000000000' WHERE fid=1"),
               Contains("row 1: a triangle names a vertex that is not there"));
    CHECK_THAT(message("UPDATE surfaces SET mesh_vertices=zeroblob(length(mesh_vertices)) WHERE fid=1"),
               Contains("row 1: its geometry and its mesh columns differ"));
    CHECK_THAT(message("DELETE FROM surfaces WHERE kind='fault_margin'"), Contains("margin"));
    CHECK_THAT(message("UPDATE surfaces SET seed_count=seed_count+1 WHERE kind='fault_sheet'"),
               Contains("digest") || Contains("seed"));
    CHECK_THAT(message("UPDATE boreholes SET collar_x=9e99 WHERE fid=2"), Contains("layer boreholes, row 2"));
    CHECK_THAT(message("UPDATE boreholes SET id=NULL WHERE fid=2"),
               Contains("layer boreholes, row 2: no value in column id"));
}

TEST_CASE("A truncated or overwritten model file is refused or loads the same model, and never crashes") {
    const testing::TemporaryFolder folder;
    const Model model = plain_model();
    save_model(folder / "m.gpkg", model, entry);
    const std::string whole = content(folder / "m.gpkg");
    const std::string path = folder / "damaged.gpkg";
    std::size_t refused = 0;
    const auto try_load = [&](const std::string& bytes) {
        put(path, bytes);
        try {
            const Model loaded = load_model(path);
            REQUIRE(model_digest(loaded) == model_digest(model));
        } catch (const InputError& error) {
            REQUIRE_THAT(error.what(), Contains("damaged.gpkg"));
            ++refused;
        }
    };
    for (std::size_t i = 0; i < 200; ++i) {
        try_load(whole.substr(0, whole.size() * i / 200));
    }
    CHECK(refused > 190);
    refused = 0;
    testing::Random random(8);
    for (int i = 0; i < 300; ++i) {
        std::string bytes = whole;
        for (std::uint64_t n = 1 + random.below(30); n > 0; --n) {
            bytes[random.below(bytes.size())] = static_cast<char>(random.below(256));
        }
        try_load(bytes);
    }
    CHECK(refused > 50);
}
