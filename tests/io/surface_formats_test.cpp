// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surfaces in the formats of modelling programs and of databases of faults. Every encoding of VTK's, and real files:
// tests/tools/test_surface_files.py.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
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

namespace {

template <typename Number>
void append(std::string& bytes, Number number, bool big) {
    char raw[sizeof number];
    std::memcpy(raw, &number, sizeof number);
    if (big) {
        std::reverse(raw, raw + sizeof number);
    }
    bytes.append(raw, sizeof number);
}

/// Records of Fortran: length, content, length.
std::string record(const std::string& content) {
    std::string bytes;
    append(bytes, static_cast<std::int32_t>(content.size()), true);
    const std::string length = bytes;
    return length + content + length;
}

}  // namespace

TEST_CASE("a binary Irap grid is the same as one in text") {
    const TemporaryFolder folder;
    for (const float angle : {0.0F, 90.0F}) {
        std::string first, second, third(28, '\0');
        append(first, std::int32_t{-996}, true);
        append(first, std::int32_t{3}, true);
        for (const float number : {500.0F, 800.0F, 600.0F, 700.0F, 100.0F, 50.0F}) {
            append(first, number, true);
        }
        append(second, std::int32_t{4}, true);
        for (const float number : {angle, 500.0F, 600.0F}) {
            append(second, number, true);
        }
        std::string rows[2];
        int node = 0;
        for (const float z :
             {-100.F, -110.F, -120.F, -130.F, -100.F, -110.F, -120.F, 1e30F, -100.F, -110.F, -120.F, -130.F}) {
            append(rows[node++ < 5 ? 0 : 1], z, true);
        }
        const std::string bytes = record(first) + record(second) + record(third) + record(rows[0]) + record(rows[1]);
        const Found found = found_in(written(folder / "top.gri", bytes));
        CHECK(found.triangles() == Counts{{"top", 12 - 3}});
        const Found text = found_in(written(
            folder / "text.irap", fmt::format("-996 3 100.0 50.0\n500 800 600 700\n4 {} 500 600\n0 0 0 0 0 0 0\n-100 "
                                              "-110 -120 -130 -100 -110 -120 9999900 -100 -110 -120 -130\n",
                                              angle)));
        CHECK(found.raw.surfaces.front().vertices == text.raw.surfaces.front().vertices);
        CHECK(found.raw.surfaces.front().triangles == text.raw.surfaces.front().triangles);
        CHECK_THAT(refusal(written(folder / "cut.gri", bytes.substr(0, bytes.size() - 20))), Contains("cut off"));
    }
}

TEST_CASE("a binary DXF is the same as one in text, with codes of one byte or two") {
    const TemporaryFolder folder;
    const std::vector<std::pair<int, std::string>> pairs{
        {0, "SECTION"},  {2, "HEADER"}, {9, "$ACADVER"}, {1, "AC1015"}, {70, "7"},     {0, "ENDSEC"}, {0, "SECTION"},
        {2, "ENTITIES"}, {0, "3DFACE"}, {8, "A"},        {62, "3"},     {10, "0.125"}, {20, "0"},     {30, "-3.7"},
        {11, "100"},     {21, "0"},     {31, "0"},       {12, "0"},     {22, "1e2"},   {32, "5"},     {13, "0"},
        {23, "1e2"},     {33, "5"},     {1070, "4"},     {1000, "x"},   {0, "ENDSEC"}, {0, "EOF"}};
    std::string text;
    for (const auto& [code, value] : pairs) {
        text += fmt::format("{}\n{}\n", code, value);
    }
    const Found expected = found_in(written(folder / "f.dxf", text));
    REQUIRE(expected.triangles() == Counts{{"A", 1}});
    for (const bool wide : {true, false}) {
        std::string bytes("AutoCAD Binary DXF\r\n\x1A\0", 22);
        for (const auto& [code, value] : pairs) {
            if (wide || code > 254) {
                bytes += wide ? "" : "\xFF";
                append(bytes, static_cast<std::int16_t>(code), false);
            } else {
                append(bytes, static_cast<std::uint8_t>(code), false);
            }
            if (code >= 10 && code < 60) {
                append(bytes, std::stod(value), false);
            } else if ((code >= 60 && code < 80) || code == 1070) {
                append(bytes, static_cast<std::int16_t>(std::stoi(value)), false);
            } else {
                bytes += value + '\0';
            }
        }
        const Found found = found_in(written(folder / "f.dxf", bytes));
        CHECK(found.triangles() == expected.triangles());
        CHECK(found.raw.surfaces.front().vertices == expected.raw.surfaces.front().vertices);
        CHECK_THAT(refusal(written(folder / "cut.dxf", bytes.substr(0, 60))), Contains("cut.dxf"));
    }
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

TEST_CASE("traces go down to a detachment, each point to where it meets it") {
    const TemporaryFolder folder;
    // A plane that falls from -1000 at x = 0 to -3000 at x = 4000.
    const std::string plane =
        written(folder / "detachment.ts",
                "GOCAD TSurf 1\nTFACE\nVRTX 1 0 -9000 -1000\nVRTX 2 4000 -9000 -3000\nVRTX 3 4000 9000 "
                "-3000\nVRTX 4 0 9000 -1000\nTRGL 1 2 3\nTRGL 1 3 4\nEND\n");
    const auto traces = [&](double x) {
        return written(folder / "t.geojson",
                       fmt::format(R"({{"type":"FeatureCollection","features":[{{"type":"Feature","properties":)"
                                   R"({{"name":"F","dip":45,"dip_dir":"E"}},"geometry":{{"type":"LineString",)"
                                   R"("coordinates":[[{0},0,0],[{0},1000,0],[{0},2000,0]]}}}}]}})",
                                   x));
    };
    Source source{traces(500)};
    source.srs = "EPSG:3067";
    const auto found = [&] {
        Diagnostics diagnostics;
        return read_surfaces(source, SurfaceKind::fault, {}, diagnostics, {ZPositive::automatic, plane});
    };
    const Surface surface = found().surfaces.at(0);
    // From (500, 0): z = -(x - 500) meets z = -1000 - x / 2 at x = 3000.
    double lowest = 0;
    for (const Vec3& p : surface.vertices) {
        CHECK(p.z >= -1000 - p.x / 2 - 1e-6);
        CHECK(std::abs(p.z + (p.x - 500)) < 1e-6);
        lowest = std::min(lowest, p.z);
    }
    CHECK(std::abs(lowest + 2500) < 1e-6);
    source.path = traces(3500);  // beyond the plane's end
    CHECK_THROWS_WITH(found(), Contains("does not meet the detachment"));
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
