// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "io/base/crs.hpp"
#include "site_case.hpp"

using namespace terratet;
using namespace terratet::testing;
using Catch::Matchers::Contains;

TEST_CASE("collars of a GeoPackage and a Shapefile give the site that their CSV gives") {
    GDALAllRegister();
    const testing::TemporaryFolder folder;
    Case csv;
    csv.collars("HOLE_ID,X,Y,Z\nKR1,208000.5,6797000.25,7\nKR2,208100,6797100,8\n")
        .log("HOLE_ID,FROM,TO,K\nKR1,0,10,1e-9\nKR2,5,10,1e-8\n");
    csv.inputs.source_crs = "EPSG:3067";
    const Read expected = read(csv.inputs);
    for (const auto& [driver, name] : {std::pair{"GPKG", "c.gpkg"}, std::pair{"ESRI Shapefile", "c.shp"}}) {
        INFO(driver);
        GDALDataset* dataset = GetGDALDriverManager()->GetDriverByName(driver)->Create((folder / name).c_str(), 0, 0, 0,
                                                                                       GDT_Unknown, nullptr);
        OGRSpatialReference reference;
        reference.importFromEPSG(3067);
        OGRLayer* layer = dataset->CreateLayer("c", &reference, wkbPoint25D, nullptr);
        OGRFieldDefn id("HOLE_ID", OFTString);
        layer->CreateField(&id);
        for (const auto& [hole, point] :
             {std::pair{"KR2", OGRPoint(208100, 6797100, 8)}, std::pair{"KR1", OGRPoint(208000.5, 6797000.25, 7)}}) {
            const OGRFeatureUniquePtr feature{OGRFeature::CreateFeature(layer->GetLayerDefn())};
            feature->SetField("HOLE_ID", hole);
            feature->SetGeometry(&point);
            REQUIRE(layer->CreateFeature(feature.get()) == OGRERR_NONE);
        }
        GDALClose(dataset);
        SiteInputs inputs = csv.inputs;
        inputs.boreholes = {{folder / name}};
        inputs.source_crs.clear();
        Read actual = read(inputs);
        CHECK_THAT(actual.site.frame.crs_name, Contains("TM35FIN"));
        actual.site.frame.crs_wkt = expected.site.frame.crs_wkt;  // a Shapefile's loses the code
        actual.site.frame.crs_name = expected.site.frame.crs_name;
        CHECK(same(actual.site, expected.site));
    }
}

TEST_CASE("coordinate columns that differ from a layer's points in a known CRS are not believed") {
    Case geojson;
    geojson.inputs.source_crs.clear();
    const testing::TemporaryFolder folder;
    geojson.inputs.boreholes = {{written(
        folder / "c.geojson",
        R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{"HOLE_ID":"KR1","EAST":208000,)"
        R"("NORTH":6797000,"ELEV":7},"geometry":{"type":"Point","coordinates":[21.55,61.2]}}]})")}};
    const Read result = read(geojson.inputs);
    CHECK(result.noted("EAST and NORTH differ from the points of the layer"));
    CHECK(result.noted("EPSG:32634"));
    const Vec3 collar = result.site.frame.to_world(result.site.boreholes[0].collar);
    CHECK(collar.x == Approx(529500).margin(500).epsilon(0));
    CHECK(collar.z == 7);
}

TEST_CASE("inputs in feet, metres and degrees meet in one projected frame") {
    // The same place in three systems: what is at one point must come out at one point.
    const Vec3 feet{2296021.09, 414095.85, 1590};
    std::vector<Vec3> metric{feet};
    CrsTransform(parse_crs("EPSG:26791"), parse_crs("EPSG:26915")).apply(metric);
    std::vector<Vec3> degrees = metric;
    CrsTransform(parse_crs("EPSG:26915"), parse_crs("EPSG:4269")).apply(degrees);
    char text[3][200];
    std::snprintf(text[0], 200, "ID,X,Y,Z\nH,%.6f,%.6f,%.6f\n", feet.x, feet.y, feet.z);
    std::snprintf(text[1], 200, "X,Y,Z,V\n%.6f,%.6f,%.6f,2\n", metric[0].x, metric[0].y, metric[0].z);
    std::snprintf(text[2], 200, "LON,LAT,Z,V\n%.10f,%.10f,%.6f,3\n", degrees[0].x, degrees[0].y, degrees[0].z);
    Case mixed;
    mixed.collars(text[0]).log("ID,DEPTH,V\nH,0,1\n").samples(text[1]).samples(text[2]);
    mixed.inputs.source_crs = "EPSG:26915";
    mixed.inputs.boreholes[0].srs = "EPSG:26791";
    mixed.inputs.samples[1].srs = "EPSG:4269";

    const Read first = read(mixed.inputs);  // the first projected one is the frame's: feet
    CHECK_THAT(first.site.frame.crs_name, Contains("EPSG:26791"));
    REQUIRE(first.counts.samples == 3);
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(near(first.world(i), feet, 0.01));
    }
    mixed.inputs.target_crs = "EPSG:26915";
    const Read chosen = read(mixed.inputs);
    CHECK(chosen.site.frame.unit == "metre");
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(near(chosen.world(i), metric[0], 0.01));
    }
    CHECK(chosen.world(0).z == Approx(1590 * 1200.0 / 3937.0));
}

TEST_CASE("longitude and latitude go to the UTM zone of their middle, and azimuths count from true north there") {
    Case geographic;
    geographic.collars("ID,LON,LAT,ELEV\nA,21.5,61.2,10\nB,21.6,61.3,12\n")
        .survey("ID,DEPTH,AZ,DIP\nA,0,0,0\nB,0,90,-45\n")
        .log("ID,DEPTH,V\nA,1000,1\nB,100,2\n");
    geographic.inputs.source_crs = "EPSG:4326";
    const Read result = read(geographic.inputs);
    CHECK_THAT(result.site.frame.crs_name, Contains("EPSG:32634"));
    CHECK(result.noted("EPSG:32634"));
    // Level and due north from A: the end keeps A's longitude.
    std::vector<Vec3> end{result.world(0)};
    CrsTransform(parse_crs("EPSG:32634"), parse_crs("EPSG:4326")).apply(end);
    CHECK(end[0].x == Approx(21.5).margin(2e-6).epsilon(0));
    CHECK(end[0].y > 61.2);
    CHECK(result.world(1).z == Approx(12 - 100 * std::sqrt(0.5)).margin(1e-6).epsilon(0));
}

TEST_CASE("azimuths count from grid, true or magnetic north as told") {
    Case hole;
    hole.collars("ID,X,Y,Z\nA,208000,6797000,0\n").survey("ID,MD,AZ,DIP\nA,0,0,0\n").log("ID,MD,V\nA,1000,1\n");
    hole.inputs.source_crs = "EPSG:3067";
    CHECK(near(read(hole.inputs).world(0), {208000, 6798000, 0}, 1e-6));
    const double true_north =
        CrsTransform(parse_crs("EPSG:3067"), parse_crs("EPSG:3067")).convergence_deg({208000, 6797000, 0});
    CHECK(true_north > 4);
    const auto bearing = [&] {
        const Vec3 way = read(hole.inputs).world(0) - Vec3{208000, 6797000, 0};
        return std::atan2(way.x, way.y) * 180 / std::acos(-1.0);
    };
    hole.inputs.azimuth = AzimuthReference::true_north;
    CHECK(bearing() == Approx(true_north).margin(1e-6).epsilon(0));
    hole.inputs.azimuth = AzimuthReference::magnetic;
    hole.inputs.declination_deg = 7.5;
    CHECK(bearing() == Approx(true_north + 7.5).margin(1e-6).epsilon(0));
}

TEST_CASE("depths are in the unit of the collars' system, or as told") {
    Case hole;
    hole.collars("ID,X,Y,Z,EOH\nA,2296021.09,414095.85,1590,300\n").log("ID,FROM,TO,V\nA,100,200,1\n");
    hole.inputs.source_crs = "EPSG:26791";
    hole.inputs.target_crs = "EPSG:26915";
    const double foot = 1200.0 / 3937.0;
    CHECK(read(hole.inputs).site.samples.depth[0] == Approx(150 * foot));
    CHECK(read(hole.inputs).site.samples.length[0] == Approx(100 * foot));
    CHECK(read(hole.inputs).site.boreholes[0].path_depth.back() == Approx(300 * foot));
    hole.inputs.depth_unit = "m";
    CHECK(read(hole.inputs).site.samples.depth[0] == 150);
    hole.inputs.target_crs = "";
    CHECK(read(hole.inputs).site.samples.depth[0] == Approx(150 / foot));
    hole.inputs.depth_unit = "ft";
    CHECK(read(hole.inputs).site.samples.depth[0] == 150);
    hole.inputs.depth_unit = "fathom";
    CHECK_THROWS_AS(read(hole.inputs), UsageError);
}

TEST_CASE("X3: every position of a site is snapped, round an origin that is a multiple of 1024") {
    Case hole;
    hole.collars("ID,X,Y,Z\nA,208000.123,6797000.456,7.89\n")
        .survey("ID,MD,AZ,DIP\nA,0,33,-61\nA,100,35,-58\n")
        .log("ID,FROM,TO,V\nA,0,3.3,1\nA,50,51.7,2\nA,99,140,3\n")
        .samples("X,Y,Z,V\n208010.1,6797020.2,-30.3,4\n");
    hole.inputs.source_crs = "EPSG:3067";
    const Read result = read(hole.inputs);
    const Frame& frame = result.site.frame;
    CHECK(frame.origin.x == 207872);
    CHECK(std::fmod(frame.origin.y, 1024) == 0);
    CHECK(frame.origin.z == 0);
    for (const Vec3& position : result.site.samples.positions) {
        CHECK(frame.snapped(position) == position);
    }
    for (const Vec3& position : result.site.boreholes[0].path) {
        CHECK(frame.snapped(position) == position);
    }
    CHECK(result.world(3) == Vec3{208010.1, 6797020.2, -30.3});
    CHECK(result.site.boreholes[0].path_depth.back() == 140);
}

TEST_CASE("dips go down by the majority of their signs, by name, or as told, and the choice is noted") {
    const auto bottom = [](const std::string& header, const std::string& dips, DipConvention convention, Read* out) {
        Case hole;
        hole.collars("ID,X,Y,Z\nA,0,0,0\nB,0,0,0\nC,0,0,0\n").log("ID,MD,V\nA,100,1\n");
        std::string survey = "ID,MD,AZ," + header + "\n";
        std::istringstream stream(dips);
        for (const char* id : {"A", "B", "C"}) {
            std::string dip;
            stream >> dip;
            survey += std::string(id) + ",0,90," + dip + "\n";
        }
        hole.survey(survey);
        hole.inputs.dip = convention;
        Read result = read(hole.inputs);
        const Vec3 position = result.world(0);
        if (out != nullptr) {
            *out = std::move(result);
        }
        return position;
    };
    const double down = -100 * std::sin(std::acos(-1.0) / 3);
    Read result;
    CHECK(bottom("DIP", "60 90 -10", DipConvention::automatic, &result).z == Approx(down));
    CHECK(result.noted("column DIP is read as positive downwards from the horizontal (2 values above zero, 1 below"));
    CHECK(bottom("DIP", "-60 -90 10", DipConvention::automatic, &result).z == Approx(down));
    CHECK(result.noted("negative downwards"));
    CHECK(bottom("DIP", "60 -90 -10", DipConvention::automatic, nullptr).z == Approx(-down));
    CHECK(bottom("INCLINATION", "30 0 5", DipConvention::automatic, &result).z == Approx(down));
    CHECK(result.noted("inclination from the downward vertical"));
    CHECK(bottom("INCLINATION", "-60 -90 -80", DipConvention::automatic, &result).z == Approx(down));
    CHECK(result.noted("negative downwards"));
    CHECK(bottom("DIP", "30 0 170", DipConvention::inclination, nullptr).z == Approx(down));
    CHECK(bottom("INCL", "60 0 5", DipConvention::down_positive, nullptr).z == Approx(down));
    CHECK(bottom("DIP", "-60 1 1", DipConvention::down_negative, nullptr).z == Approx(down));
}

TEST_CASE("a hole without survey goes in its collar's direction, or else straight down, noted") {
    Case holes;
    holes.collars("ID,X,Y,Z,AZIMUTH,DIP\nA,0,0,0,90,-45\nB,10,0,0,,\nC,20,0,0,0,-90\nD,30,0,0,0,-60\n")
        .survey("ID,MD,AZ,DIP\nC,50,0,-90\nD,20,90,0\n")
        .log("ID,MD,V\nA,100,1\nB,100,2\nC,100,3\nD,100,4\n");
    const Read result = read(holes.inputs);
    CHECK(near(result.world(0), {100 * std::sqrt(0.5), 0, -100 * std::sqrt(0.5)}, 1e-9));
    CHECK(near(result.world(1), {10, 0, -100}, 1e-9));
    CHECK(near(result.world(2), {20, 0, -100}, 1e-9));
    CHECK(near(result.world(3), {130, 0, 0}, 1e-9));  // a survey counts, from the collar on
    CHECK(result.noted("1 of 4 holes have no survey and go straight in their collar's direction"));
    CHECK(result.noted("1 of 4 holes have no survey and no direction and are taken for vertical"));
}

TEST_CASE("Holes without any log are read, and it is said that nothing is known of the ground between them") {
    Case bare;
    bare.collars("BHID,X,Y,Z,EOH\nA,0,0,0,50\nB,30,0,0,50\n");
    CHECK(read(bare.inputs).noted("no log is given"));
    bare.log("BHID,FROM,TO,CU\nA,0,1,1\n");
    CHECK_FALSE(read(bare.inputs).noted("no log is given"));
}
