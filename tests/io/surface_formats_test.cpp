// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surfaces in the formats of modelling programs and of databases of faults. Every encoding of VTK's, and real files:
// tests/tools/test_surface_files.py.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <numbers>

#include "io/read/surfaces/read_surfaces.hpp"
#include "io/read/surfaces/trace_words.hpp"
#include "site_case.hpp"

using namespace terratet;
using namespace terratet::testing;
using Catch::Matchers::Contains;

namespace {

struct Found {
    RawSurfaces raw;
    Diagnostics diagnostics;

    [[nodiscard]] std::map<std::string, std::size_t> triangles() const {
        std::map<std::string, std::size_t> counts;
        for (const Surface& surface : raw.surfaces) {
            counts[surface.name] = surface.triangles.size();
        }
        return counts;
    }
    [[nodiscard]] Box3 box() const { return bounding_box(raw.surfaces.front().vertices); }
};

Found found_in(const std::string& path, const ColumnNames& columns = {}, const SurfaceOptions& options = {}) {
    Found found;
    found.raw = read_surfaces({path}, SurfaceKind::fault, columns, found.diagnostics, options);
    return found;
}

std::string refusal(const std::string& path) {
    try {
        found_in(path);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

using Counts = std::map<std::string, std::size_t>;

std::string trace(const std::string& properties, const std::string& line = "[[500000,6000000],[500000,6000200]]") {
    return R"({"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"EPSG:32633"}},"features":[)"
           R"({"type":"Feature","properties":{"Name":"F")" +
           properties + R"(},"geometry":{"type":"LineString","coordinates":)" + line + "}}]}";
}

void check_box(const Box3& box, const Vec3& lo, const Vec3& hi) {
    INFO(box.lo.x << " " << box.lo.y << " " << box.lo.z << " to " << box.hi.x << " " << box.hi.y << " " << box.hi.z);
    CHECK(near(box.lo, lo, 1e-6));
    CHECK(near(box.hi, hi, 1e-6));
}

}  // namespace

TEST_CASE("polygons, groups and negative indices of an OBJ are read, damage is rejected by line") {
    const TemporaryFolder folder;
    const Found found = found_in(
        written(folder / "f.obj",
                "# two walls\nv 0 0 0\nv 0 200 0\nv 0 200 -200\nv 0 0 -200\ng west\nf 1 2 3 4\nv 200 0 0\nv 200 200 0\n"
                "v 200 200 -200\ng east\nf -3 -2 \\\n -1\nf 1 2 99\nf 1 1 2\nl 1 2\nv x 0 0\n"));
    CHECK(found.triangles() == Counts{{"east", 1}, {"west", 2}});
    REQUIRE(found.diagnostics.rejected.size() == 3);
    CHECK(found.diagnostics.rejected[0].line == 14);
    CHECK_THAT(found.diagnostics.rejected[0].reason, Contains("vertex 99, which is not there"));
}

TEST_CASE("polyface and polygon meshes of a DXF are read beside 3DFACEs, by layer") {
    const TemporaryFolder folder;
    const auto vertex = [](double x, double y, double z, const std::string& more) {
        return fmt::format("0\nVERTEX\n8\nA\n10\n{}\n20\n{}\n30\n{}\n{}", x, y, z, more);
    };
    std::string text = "999\nby hand\n0\nSECTION\n2\nENTITIES\n0\nPOLYLINE\n8\nA\n66\n1\n70\n64\n";
    text += vertex(0, 0, 0, "70\n192\n") + vertex(0, 200, 0, "70\n192\n") + vertex(0, 200, -200, "70\n192\n") +
            vertex(0, 0, -200, "70\n192\n") + vertex(0, 0, 0, "70\n128\n71\n1\n72\n2\n73\n-3\n74\n4\n") + "0\nSEQEND\n";
    text += "0\nPOLYLINE\n8\nB\n70\n16\n71\n2\n72\n3\n";
    for (int k = 0; k < 6; ++k) {
        text += vertex(200, 100 * (k % 3), -200 * (k / 3), "70\n64\n");
    }
    text +=
        "0\nSEQEND\n0\n3DFACE\n8\nC\n10\n0\n20\n0\n30\n0\n11\n9\n21\n0\n31\n0\n12\n9\n22\n9\n32\n0\n13\n9\n23\n9\n33\n0"
        "\n";
    CHECK(found_in(written(folder / "f.dxf", text + "0\nENDSEC\n0\nEOF\n")).triangles() ==
          Counts{{"A", 2}, {"B", 4}, {"C", 1}});
    CHECK_THAT(refusal(written(folder / "l.dxf", "0\nSECTION\n2\nENTITIES\n0\nLINE\n8\nC\n0\nENDSEC\n0\nEOF\n")),
               Contains("no 3DFACE and no polyface mesh in its ENTITIES, but 1 LINE"));
}

TEST_CASE("depths of a mesh are turned over where the user says so, not those of a file that says itself") {
    const TemporaryFolder folder;
    const std::string off = written(folder / "f.off", "OFF\n3 1 0\n0 0 0\n0 200 0\n0 200 200\n3 0 1 2\n");
    CHECK(found_in(off).box().hi.z == 200);
    CHECK(found_in(off, {}, {ZPositive::down, ""}).box().lo.z == -200);
    const std::string ts = written(
        folder / "f.ts", "GOCAD TSurf 1\nTFACE\nVRTX 1 0 0 0\nVRTX 2 0 200 0\nVRTX 3 0 200 200\nTRGL 1 2 3\nEND\n");
    CHECK(found_in(ts, {}, {ZPositive::down, ""}).box().hi.z == 200);
}

TEST_CASE("Irap grids stand turned about their corner and have holes") {
    const TemporaryFolder folder;
    const auto grid = [&](const std::string& angle) {
        return found_in(written(folder / "top.irap", "-996 3 100.0 50.0\n500 800 600 700\n4 " + angle +
                                                         " 500 600\n0 0 0 0 0 0 0\n-100 -110 -120 -130 -100\n"
                                                         "-110 -120 9999900.000000 -100 -110 -120 -130\n"));
    };
    CHECK(grid("0.0").triangles() == Counts{{"top", 12 - 3}});
    check_box(grid("0.0").box(), {500, 600, -130}, {800, 700, -100});
    check_box(grid("90.0").box(), {400, 600, -130}, {500, 900, -100});
}

TEST_CASE("ZMap grids are read by GDAL") {
    const TemporaryFolder folder;
    std::string text = "! a comment\n@top, GRID, 3\n20, 1e30, , 4, 1\n2, 3, 500, 700, 600, 700\n0.0, 0.0, 0.0\n@\n";
    for (int c = 0; c < 3; ++c) {
        text += fmt::format("{:20.4f}{:20.4f}\n", -100.0 - 10 * c, -105.0 - 10 * c);
    }
    const Found found = found_in(written(folder / "top.zmap", text));
    CHECK(found.box().hi.z <= -90);
    CHECK(found.raw.surfaces.front().name == "top");
}

TEST_CASE("dips and directions of traces in every spelling") {
    for (const char* dip : {"60", "60°", "(60,50,70)", "50-70", "50 to 70", "(3:60,50,70)", "55–65"}) {
        INFO(dip);
        CHECK(parse_dip(dip) == 60.0);
    }
    CHECK(parse_dip("vertical") == 90.0);
    for (const char* none : {"", "steep", "95", "-5", "60 or 70"}) {
        INFO(none);
        CHECK_FALSE(parse_dip(none));
    }
    CHECK(parse_direction("SSW")->degrees == 202.5);
    CHECK(parse_direction("north-west")->degrees == 315);
    CHECK_FALSE(parse_direction("up"));

    const TemporaryFolder folder;
    const double down = 200 / std::tan(std::numbers::pi / 3);
    const auto box = [&](const std::string& properties, const ColumnNames& columns = {},
                         const SurfaceOptions& options = {}) {
        return found_in(written(folder / "f.geojson", trace(properties)), columns, options).box();
    };
    const Vec3 lo{500000, 6000000, -200};
    for (const char* properties :
         {R"(,"Dip_pref":60,"Dip_dir":"SE","D90":0.2)", R"(,"Dip_pref":60,"Dip_dir":90,"D90":0.2)",
          R"x(,"average_dip":"(60,50,70)","average_dip_direction":"NNE","lower_seis_depth":"(0.2,0.1,0.3)")x",
          R"(,"dip":60,"strike":0,"D90":0.2)"}) {
        INFO(properties);
        check_box(box(properties), lo, {500000 + down, 6000200, 0});
    }
    check_box(box(R"(,"dip":60,"dip_dir":"NW","D90":0.2)"), {500000 - down, 6000000, -200}, {500000, 6000200, 0});
    check_box(box(R"(,"dip":90,"base":250)", {{"lower-depth", "base"}}), {500000, 6000000, -250}, {500000, 6000200, 0});
    check_box(box(R"(,"dip":90,"Lower depth [m]":80)"), {500000, 6000000, -80}, {500000, 6000200, 0});
    check_box(box(R"(,"Neig":90)", {{"dip", "Neig"}}, {ZPositive::automatic, "0.3km"}), {500000, 6000000, -300},
              {500000, 6000200, 0});
}

TEST_CASE("what a trace lacks is said: its dip, direction or depth") {
    const TemporaryFolder folder;
    const auto message = [&](const std::string& properties) {
        return refusal(written(folder / "f.geojson", trace(properties)));
    };
    CHECK_THAT(message(""), Contains("no column says their dip"));
    CHECK_THAT(message(R"(,"dip":60,"D90":1)"), Contains("no dip direction"));
    CHECK_THAT(message(R"(,"dip":60,"dip_dir":"E")"), Contains("`fault_depth`"));
    CHECK_THAT(message(R"(,"dip":60,"dip_dir":5,"D90":1)"), Contains("along the trace"));
    CHECK_THAT(message(R"(,"dip":null,"dip_dir":"E","D90":1)"), Contains("no dip"));
}

TEST_CASE("sticks are joined one behind the other, from lines in space or from a table") {
    const TemporaryFolder folder;
    std::string features;
    std::string table = "X,Y,Z,FAULT,STICK_ID\n";
    for (int n = 0; n < 3; ++n) {
        std::string line;
        for (int k = 0; k < 4; ++k) {
            const int at = n % 2 == 0 ? k : 3 - k;  // drawn up and down in turn
            line += fmt::format("{}[{},{},{}]", k == 0 ? "" : ",", 40 * at, 80 * n, -60 * at);
            table += fmt::format("{},{},{},F,{}\n", 40 * k, 80 * n, -60 * k, n);
        }
        features += (n == 0 ? "" : ",") +
                    fmt::format(R"({{"type":"Feature","properties":{{"Name":"F"}},"geometry":{{"type":"LineString",)"
                                R"("coordinates":[{}]}}}})",
                                line);
    }
    const Found lines =
        found_in(written(folder / "l.geojson", R"({"type":"FeatureCollection","features":[)" + features + "]}"));
    const Found points = found_in(written(folder / "p.csv", table));
    CHECK(lines.triangles() == Counts{{"F", 12}});
    check_box(lines.box(), {0, 0, -180}, {120, 160, 0});
    CHECK(lines.raw.surfaces.front().vertices == points.raw.surfaces.front().vertices);
    CHECK(lines.raw.surfaces.front().triangles == points.raw.surfaces.front().triangles);
}

TEST_CASE("points of VSet and PLine objects are triangulated; points of no graph are refused at once") {
    const TemporaryFolder folder;
    std::string points;
    std::string depths = "X,Y,Z_TVDSS\n";
    for (int i = 0; i < 25; ++i) {
        points += fmt::format("VRTX {} {} {} {}\n", i, 10 * (i / 5), 40 * (i % 5), 40 * (i / 5));
        depths += fmt::format("{},{},{}\n", 10 * (i / 5), 40 * (i % 5), 40 * (i / 5));
    }
    for (const std::string kind : {"VSet", "PLine"}) {
        const Found found =
            found_in(written(folder / "f.vs", "GOCAD " + kind +
                                                  " 1\nHEADER {\nname:F\n}\nGOCAD_ORIGINAL_COORDINATE_SYSTEM\n"
                                                  "ZPOSITIVE Depth\nEND_ORIGINAL_COORDINATE_SYSTEM\n" +
                                                  points + "END\n"));
        CHECK(found.triangles() == Counts{{"F", 32}});
        CHECK(found.box().lo.z == -160);
    }
    CHECK(found_in(written(folder / "d.csv", depths)).box().lo.z == -160);
    std::string cloud = "X,Y,Z\n";
    std::string folded = "X,Y,Z\n";
    for (int i = 0; i < 800; ++i) {
        cloud += fmt::format("{},{},{}\n", i * 7919 % 1000, i * 104729 % 1000, -(i * 1299709 % 1000));
        const double turn = 0.02 * (i / 20);  // most of a cylinder
        folded += fmt::format("{},{},{}\n", 300 * std::cos(6 * turn), 300 * std::sin(6 * turn), 50 * (i % 20));
    }
    CHECK_THAT(refusal(written(folder / "c.csv", cloud)), Contains("no graph over their plane"));
    CHECK_THAT(refusal(written(folder / "r.csv", folded)), Contains("no graph over their plane"));
}
