// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <ogrsf_frmts.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <numeric>

#include "io/base/gdal_scope.hpp"
#include "io/read/surfaces/read_surfaces.hpp"
#include "support.hpp"
#include "tess/error.hpp"

using namespace terratet;
using Catch::Matchers::Contains;

namespace {

struct Result {
    RawSurfaces raw;
    Diagnostics diagnostics;
    const Surface& at(std::size_t i) const { return raw.surfaces.at(i); }
};

Result read(const std::string& source, const ColumnNames& columns = {}) {
    Result result;
    result.raw = read_surfaces(parse_source(source), SurfaceKind::horizon, columns, result.diagnostics);
    return result;
}

struct Row {
    std::string name;
    std::string wkt;
};

/// A layer "faults" with an optional text field.
std::string write_layer(const testing::TemporaryFolder& folder, const std::string& file, const char* driver,
                        const std::vector<Row>& rows, const char* field = "NAME", int epsg = 26912,
                        OGRwkbGeometryType type = wkbUnknown) {
    const GdalScope quiet;
    const std::string path = folder / file;
    GDALDataset* const dataset =
        GetGDALDriverManager()->GetDriverByName(driver)->Create(path.c_str(), 0, 0, 0, GDT_Unknown, nullptr);
    REQUIRE(dataset);
    OGRSpatialReference reference;
    reference.importFromEPSG(epsg);
    OGRLayer* const layer = dataset->CreateLayer("faults", &reference, type, nullptr);
    REQUIRE(layer);
    if (field) {
        OGRFieldDefn definition(field, OFTString);
        layer->CreateField(&definition);
    }
    for (const Row& row : rows) {
        OGRFeature feature(layer->GetLayerDefn());
        if (field && !row.name.empty()) {
            feature.SetField(field, row.name.c_str());
        }
        OGRGeometry* geometry = nullptr;
        REQUIRE(OGRGeometryFactory::createFromWkt(row.wkt.c_str(), nullptr, &geometry) == OGRERR_NONE);
        feature.SetGeometryDirectly(geometry);
        REQUIRE(layer->CreateFeature(&feature) == OGRERR_NONE);
    }
    GDALClose(dataset);
    return path;
}

const char* const tin = "TIN Z (((0 0 0,10 0 1,10 10 2,0 0 0)),((0 0 0,10 10 2,0 10 3,0 0 0)))";
const char* const polyhedral = "POLYHEDRALSURFACE Z (((0 0 0,10 0 1,10 10 2,0 0 0)),((0 0 0,10 10 2,0 10 3,0 0 0)))";
const char* const multi = "MULTIPOLYGON Z (((0 0 0,10 0 1,10 10 2,0 0 0)),((0 0 0,10 10 2,0 10 3,0 0 0)))";
const char* const collection =
    "GEOMETRYCOLLECTION Z (POLYGON Z ((0 0 0,10 0 1,10 10 2,0 0 0)),TRIANGLE Z ((0 0 0,10 10 2,0 10 3,0 0 0)))";

/// What each of the geometries above is, in canonical order.
void check_square(const Surface& s) {
    CHECK(s.vertices == std::vector<Vec3>{{0, 0, 0}, {0, 10, 3}, {10, 0, 1}, {10, 10, 2}});
    CHECK(s.triangles == std::vector<Triangle>{{0, 2, 3}, {0, 3, 1}});
    CHECK(s.kind == SurfaceKind::horizon);
}

void put(const std::string& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}

}  // namespace

TEST_CASE("Every kind of polygon geometry reads as the same surface") {
    const testing::TemporaryFolder folder;
    for (const char* wkt : {tin, polyhedral, multi, collection}) {
        INFO(wkt);
        const auto path = write_layer(folder, std::string(wkt).substr(0, 5) + ".gpkg", "GPKG", {{"F 1", wkt}});
        const Result r = read(path);
        REQUIRE(r.raw.surfaces.size() == 1);
        check_square(r.at(0));
        CHECK(r.at(0).name == "F 1");
        CHECK(r.at(0).file == path);
        CHECK(r.diagnostics.rejected.empty());
        CHECK_THAT(r.raw.crs.name, Contains("26912") || Contains("UTM zone 12N"));
    }
    const auto shape = write_layer(folder, "tin.shp", "ESRI Shapefile", {{"S", tin}}, "NAME", 26912, wkbTINZ);
    check_square(read(shape).at(0));
    CHECK(read(shape).at(0).name == "S");
}

TEST_CASE("Features of one name are one surface, whatever their order") {
    const testing::TemporaryFolder folder;
    std::vector<Row> faces{{"A", "POLYGON Z ((0 0 0,10 0 1,10 10 2,0 0 0))"},
                           {"B", "POLYGON Z ((50 0 0,60 0 1,60 10 2,50 0 0))"},
                           {"A", "POLYGON Z ((0 0 0,10 10 2,0 10 3,0 0 0))"}};
    const Result r = read(write_layer(folder, "a.gpkg", "GPKG", faces, "FAULT_NAME"));
    REQUIRE(r.raw.surfaces.size() == 2);
    check_square(r.at(0));
    CHECK(r.at(0).name == "A");
    CHECK(r.at(1).name == "B");
    std::reverse(faces.begin(), faces.end());
    const Result reversed = read(write_layer(folder, "b.gpkg", "GPKG", faces, "FAULT_NAME"));
    CHECK(reversed.at(0).vertices == r.at(0).vertices);
    CHECK(reversed.at(0).triangles == r.at(0).triangles);
    // A drawing converted face by face has its fault names in "Layer"; a column may be named.
    check_square(read(write_layer(folder, "c.gpkg", "GPKG", faces, "Layer")).at(0));
    check_square(read(write_layer(folder, "d.gpkg", "GPKG", faces, "ODD"), {{"name", "ODD"}}).at(0));
    CHECK_THROWS_AS(read(folder / "d.gpkg", {{"name", "NOT_THERE"}}), UsageError);
    CHECK(read((folder / "a.gpkg") + ",where=FAULT_NAME = 'B'").raw.surfaces.size() == 1);
}

TEST_CASE("Features without a name are one surface face by face, and one each otherwise") {
    const testing::TemporaryFolder folder;
    const Result faces = read(write_layer(
        folder, "faces.gpkg", "GPKG",
        {{"", "POLYGON Z ((0 0 0,10 0 1,10 10 2,0 0 0))"}, {"", "POLYGON Z ((0 0 0,10 10 2,0 10 3,0 0 0))"}}, nullptr));
    REQUIRE(faces.raw.surfaces.size() == 1);
    check_square(faces.at(0));
    CHECK(faces.at(0).name == "faults");
    const Result whole = read(write_layer(folder, "whole.gpkg", "GPKG", {{"", tin}, {"", multi}}, nullptr));
    REQUIRE(whole.raw.surfaces.size() == 2);
    CHECK(whole.at(0).name == "faults 1");
    check_square(whole.at(1));
}

TEST_CASE("Polygons with more corners and holes are triangulated, and curves of them refused with their record") {
    const testing::TemporaryFolder folder;
    const Result r =
        read(write_layer(folder, "p.gpkg", "GPKG",
                         {{"L", "POLYGON Z ((0 0 0,20 0 20,20 10 20,10 10 10,10 20 10,0 20 0,0 0 0))"},
                          {"H", "POLYGON Z ((0 0 5,9 0 5,9 9 5,0 9 5,0 0 5),(3 3 5,6 3 5,6 6 5,3 6 5,3 3 5))"},
                          {"X", "POLYGON Z ((0 0 0,9 9 0,9 0 0,0 8 0,0 0 0))"},
                          {"P", "LINESTRING Z (0 0 0,1 1 1)"},
                          {"D", "POLYGON ((0 0,1 0,1 1,0 0))"}}));
    REQUIRE(r.raw.surfaces.size() == 2);
    CHECK(r.at(0).name == "H");
    CHECK(r.at(0).triangles.size() == 8);
    CHECK(statistics(r.at(0)).area == Approx(72));
    CHECK(r.at(1).name == "L");
    CHECK(r.at(1).triangles.size() == 4);
    CHECK(statistics(r.at(1)).area == Approx(300 * std::sqrt(2)));
    REQUIRE(r.diagnostics.rejected.size() == 3);
    CHECK(r.diagnostics.rejected[0].line == 4);
    CHECK_THAT(r.diagnostics.rejected[0].reason, Contains("Line String is no surface"));
    CHECK(r.diagnostics.rejected[1].line == 5);
    CHECK_THAT(r.diagnostics.rejected[1].reason, Contains("without z"));
    CHECK(r.diagnostics.rejected[2].line == 3);
    CHECK_THAT(r.diagnostics.rejected[2].reason, Contains("crosses itself"));
}

TEST_CASE("Layers that hold no surface are refused, saying what is needed") {
    const testing::TemporaryFolder folder;
    CHECK_THROWS_WITH(read(write_layer(folder, "flat.gpkg", "GPKG", {{"D", "POLYGON ((0 0,1 0,1 1,0 0))"}})),
                      Contains("flat.gpkg") && Contains("no z"));
    CHECK_THROWS_WITH(read(write_layer(folder, "line.gpkg", "GPKG", {{"P", "LINESTRING Z (0 0 0,1 1 1)"}})),
                      Contains("no column says their dip"));
    CHECK_THROWS_WITH(read((folder / "flat.gpkg") + ",layer=none"), Contains("no layer none") && Contains("faults"));
    CHECK_THROWS_WITH(read(folder / "nothing.gpkg"), Contains("nothing.gpkg"));
    put(folder / "f.dxf", "anything");
    CHECK_THROWS_WITH(read(folder / "f.dxf"), Contains("no 3DFACE and no polyface mesh"));
    put(folder / "drawing", "999\nby hand\n  0\r\nSECTION\r\n  2\nENTITIES\n");
    CHECK_THROWS_WITH(read(folder / "drawing"), Contains("no 3DFACE and no polyface mesh"));
    put(folder / "junk.ts", std::string("\x01\x02\x03\x00junk", 8));
    CHECK_THROWS_AS(read(folder / "junk.ts"), InputError);
}

TEST_CASE("A GOCAD file is known by its first line, not by its name") {
    const testing::TemporaryFolder folder;
    put(folder / "f.txt", "\nGOCAD TSurf 1\nTFACE\nVRTX 1 0 0 0\nVRTX 2 1 0 0\nVRTX 3 0 1 0\nTRGL 1 2 3\nEND\n");
    CHECK(read(folder / "f.txt").at(0).triangles.size() == 1);
    CHECK(read(folder / "f.txt").at(0).kind == SurfaceKind::horizon);
}

TEST_CASE("Points of several faults in a table triangulate fault by fault, whatever the order of rows") {
    const testing::TemporaryFolder folder;
    std::vector<std::string> rows;
    for (int i = 0; i < 5; ++i) {
        for (int j = 0; j < 4; ++j) {
            rows.push_back(std::to_string(500000 + 20 * i) + "," + std::to_string(6700000 + 10 * j) + "," +
                           std::to_string(-20 * j) + ",South");
            rows.push_back(std::to_string(600000 + 20 * i) + "," + std::to_string(6700000) + "," +
                           std::to_string(-20 * j) + ",North");
        }
    }
    const auto table = [&](const std::string& header) {
        std::string text = header + "\n";
        for (const std::string& row : rows) {
            text += row + "\n";
        }
        return text;
    };
    put(folder / "points.csv", table("x,y,z,FAULT"));
    const Result r = read(folder / "points.csv");
    REQUIRE(r.raw.surfaces.size() == 2);
    CHECK(r.at(0).name == "North");
    CHECK(r.at(1).name == "South");
    CHECK(r.at(0).triangles.size() == 2 * 4 * 3);
    CHECK(statistics(r.at(0)).dip_mean_deg == Approx(90));
    CHECK(statistics(r.at(1)).dip_mean_deg == Approx(std::atan(2) * 180 / 3.14159265358979).epsilon(1e-6));
    CHECK(r.raw.crs.empty());

    std::reverse(rows.begin(), rows.end());
    rows.push_back(rows.front());
    rows.insert(rows.begin() + 3, "1,abc,3,South");
    rows.insert(rows.begin() + 5, "1,2,3,");
    rows.insert(rows.begin() + 7, "1,2,3,Stub");
    put(folder / "points.csv", table("x,y,z,FAULT"));
    const Result dirty = read(folder / "points.csv");
    CHECK(dirty.raw.surfaces == r.raw.surfaces);
    REQUIRE(dirty.diagnostics.rejected.size() == 3);
    CHECK(dirty.diagnostics.rejected[0].line == 5);
    CHECK(dirty.diagnostics.rejected[1].line == 7);
    CHECK_THAT(dirty.diagnostics.rejected[1].reason, Contains("no fault name in column FAULT"));
    CHECK_THAT(dirty.diagnostics.rejected[2].reason, Contains("Stub") && Contains("span no surface"));
    CHECK_THAT(dirty.diagnostics.notes.back(), Contains("1 of 21 points coincide"));

    put(folder / "odd.csv", table("p,q,r,s"));
    CHECK_THROWS_WITH(read(folder / "odd.csv"), Contains("no column for x, y, z") && Contains("p, q, r, s"));
    CHECK(read(folder / "odd.csv", {{"x", "p"}, {"y", "q"}, {"z", "r"}, {"name", "s"}}).raw.surfaces == [&] {
        auto renamed = r.raw.surfaces;
        for (Surface& s : renamed) {
            s.file = folder / "odd.csv";
        }
        return renamed;
    }());
}

TEST_CASE("Points without a fault name, or with row numbers for one, are one fault named after the file") {
    const testing::TemporaryFolder folder;
    put(folder / "Main fault.csv", "X,Y,Z\n0,0,0\n10,0,0\n0,10,-10\n10,10,-10\n");
    CHECK(read(folder / "Main fault.csv").at(0).name == "Main fault");
    CHECK(read(folder / "Main fault.csv").at(0).triangles.size() == 2);
    put(folder / "numbered.csv", "ID,X,Y,Z\n1,0,0,0\n2,10,0,0\n3,0,10,-10\n4,10,10,-10\n");
    const Result numbered = read(folder / "numbered.csv");
    REQUIRE(numbered.raw.surfaces.size() == 1);
    CHECK(numbered.at(0).name == "numbered");
    CHECK_THAT(numbered.diagnostics.notes.back(), Contains("column ID differs from row to row"));
}

TEST_CASE("Points with geometry bring their CRS, and degrees are weighed as metres") {
    const testing::TemporaryFolder folder;
    std::vector<Row> rows;
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) {  // 45° to the east: 0.001° of longitude at 60° N is 55.66 m
            rows.push_back({"F", "POINT Z (" + std::to_string(24 + i * 0.001) + " " + std::to_string(60 + j * 0.001) +
                                     " " + std::to_string(-55.66 * i) + ")"});
        }
    }
    const Result r = read(write_layer(folder, "g.gpkg", "GPKG", rows, "NAME", 4326, wkbPoint25D));
    REQUIRE(r.raw.surfaces.size() == 1);
    CHECK(r.raw.crs.geographic);
    CHECK(r.at(0).vertices.size() == 16);
    CHECK(r.at(0).triangles.size() == 18);
    CHECK(r.at(0).vertices[0].x == Approx(24));
    // As in a metric plane: each triangle spans one step of the grid at most.
    for (const Triangle& t : r.at(0).triangles) {
        for (int k = 0; k < 3; ++k) {
            const Vec3 edge = r.at(0).vertices[t[k]] - r.at(0).vertices[t[(k + 1) % 3]];
            REQUIRE(std::abs(edge.x) < 0.0011);
            REQUIRE(std::abs(edge.y) < 0.0011);
        }
    }
}

TEST_CASE("The paper's fault, 465 points at 20 m, reads as one rectangle") {
    const testing::TemporaryFolder folder;
    std::string text = "x,y,z\n";
    for (int i = 0; i < 15; ++i) {
        for (int j = 0; j < 31; ++j) {
            text += std::to_string(1525000 + 20 * i) + "," + std::to_string(6792000 + 16 * j) + "," +
                    std::to_string(-100 - 12 * j) + "\n";
        }
    }
    put(folder / "fault.csv", text);
    const Result r = read(folder / "fault.csv");
    CHECK(r.at(0).vertices.size() == 465);
    CHECK(r.at(0).triangles.size() == 840);
    CHECK(statistics(r.at(0)).area == Approx(280 * 600));
}
