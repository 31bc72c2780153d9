// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/crs.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "support.hpp"
#include "tess/error.hpp"

using namespace terratet;
using Catch::Matchers::Contains;

namespace {

Vec3 through(const std::string& source, const std::string& target, const Vec3& point) {
    std::vector<Vec3> points{point};
    CrsTransform(parse_crs(source), parse_crs(target)).apply(points);
    return points.front();
}

}  // namespace

TEST_CASE("a CRS comes from codes, names, PROJ strings and WKT, with its unit") {
    const Crs finnish = parse_crs("EPSG:3067");
    CHECK(finnish.name == "EPSG:3067 ETRS89 / TM35FIN(E,N)");
    CHECK_THAT(finnish.wkt, Contains("PROJCRS[") && Contains("ID[\"EPSG\",3067]"));
    CHECK_FALSE(finnish.geographic);
    CHECK(parse_crs("ETRS89 / TM35FIN(E,N)") == finnish);
    CHECK(crs_from_wkt(finnish.wkt) == finnish);
    CHECK(parse_crs("epsg:3067") == finnish);

    const Crs minnesota = parse_crs("EPSG:26791");
    CHECK(minnesota.unit == "US survey foot");
    CHECK(minnesota.metres_per_unit == Approx(1200.0 / 3937.0).epsilon(1e-12));
    CHECK(minnesota.metres_per_height == minnesota.metres_per_unit);

    const Crs degrees = parse_crs("EPSG:4326");
    CHECK(degrees.geographic);
    CHECK(degrees.unit == "degree");
    CHECK(degrees.metres_per_height == 1);

    CHECK(parse_crs("+proj=utm +zone=35 +datum=WGS84").metres_per_unit == 1);
    CHECK(parse_crs("EPSG:6318+8228").metres_per_height == Approx(0.3048));
    CHECK(parse_crs("EPSG:2056+5728").metres_per_height == 1);
}

TEST_CASE("local frames relate to nothing but themselves") {
    const Crs local = parse_crs("Local");
    CHECK(local.local);
    CHECK(local.unit == "metre");
    CHECK(parse_crs("local:ft").metres_per_unit == Approx(0.3048));
    CHECK(crs_from_wkt(local.wkt) == local);
    CHECK(CrsTransform(local, local).identity());
    CHECK(CrsTransform(local, local).convergence_deg({1, 2, 3}) == 0);
    CHECK_THROWS_AS(CrsTransform(local, parse_crs("EPSG:3067")), InputError);
}

TEST_CASE("what is no CRS is told") {
    for (const char* bad : {"", "nonsense", "EPSG:999999", "EPSG:5703", "EPSG:4978", "PROJCS[\"broken\""}) {
        INFO(bad);
        CHECK_THROWS_AS(parse_crs(bad), UsageError);
    }
    CHECK_THROWS_WITH(parse_crs("EPSG:999999"), Contains("EPSG:999999") && Contains("such as EPSG:3067"));
    CHECK(crs_from_wkt("").empty());
    CHECK(crs_from_wkt("garbage").empty());
    CHECK(
        crs_from_wkt(R"(ENGCRS["Undefined Cartesian SRS",EDATUM["Unknown"],CS[Cartesian,2],)"
                     R"(AXIS["x",east,ORDER[1],LENGTHUNIT["metre",1]],AXIS["y",north,ORDER[2],LENGTHUNIT["metre",1]]])")
            .empty());
}

TEST_CASE("UTM zones follow the exceptions of Norway and Svalbard") {
    const auto code = [](double longitude, double latitude) {
        return utm_zone(longitude, latitude).name.substr(0, 10);
    };
    CHECK(code(21.5, 61.2) == "EPSG:32634");   // Olkiluoto
    CHECK(code(-91.9, 47.6) == "EPSG:32615");  // Babbitt
    CHECK(code(5.3, 60.4) == "EPSG:32632");    // Bergen: 32 rather than 31
    CHECK(code(2.9, 60.4) == "EPSG:32631");
    CHECK(code(15.6, 78.2) == "EPSG:32633");  // Longyearbyen
    CHECK(code(8.9, 78.2) == "EPSG:32631");
    CHECK(code(21.0, 78.2) == "EPSG:32635");
    CHECK(code(33.0, 78.2) == "EPSG:32637");
    CHECK(code(151.2, -33.9) == "EPSG:32756");
    CHECK(code(180, 0) == "EPSG:32601");
    CHECK(code(-180, -1) == "EPSG:32701");
    CHECK_THROWS_AS(utm_zone(0, 85), InputError);
    CHECK_THROWS_AS(utm_zone(0, std::nan("")), InputError);
}

TEST_CASE("transforming a place is right in every axis order") {
    // Swiss reference point (old observatory of Bern) in LV95, and its WGS 84 place by the Federal Office's formulas.
    const Vec3 bern = through("EPSG:2056", "EPSG:4326", {2600000, 1200000, 550});
    CHECK(bern.x == Approx(7.438632).margin(2e-6).epsilon(0));
    CHECK(bern.y == Approx(46.951083).margin(2e-6).epsilon(0));
    CHECK(bern.z == 550);
    // Poland's CS92 has northing first by decree: x is still easting here.
    const Vec3 poland = through("EPSG:2180", "EPSG:4326", {500000, 500000, 0});
    CHECK(poland.x == Approx(19).margin(1e-9).epsilon(0));
    CHECK(poland.y == Approx(52.37).margin(0.01).epsilon(0));
}

TEST_CASE("heights in feet become metres between state plane and UTM, and back") {
    const Vec3 collar{2296021.09, 414095.85, 1590};
    const Vec3 metric = through("EPSG:26791", "EPSG:26915", collar);
    CHECK(metric.z == Approx(1590 * 1200.0 / 3937.0).epsilon(1e-12));
    CHECK(metric.x ==
          Approx(582673.75).margin(30).epsilon(0));  // NAD27 → NAD83 moves by metres, with or without a grid
    CHECK(metric.y == Approx(5275653.28).margin(30).epsilon(0));
    const Vec3 back = through("EPSG:26915", "EPSG:26791", metric);
    CHECK(distance(back, collar) < 0.01);
    // Longitude and latitude come with metres.
    CHECK(through("EPSG:4269", "EPSG:26791", {-91.9, 47.6, 100}).z == Approx(100 * 3937.0 / 1200.0));
    // A compound system says so itself.
    CHECK(through("EPSG:6344+6360", "EPSG:6344", {500000, 5e6, 100}).z == Approx(100 * 1200.0 / 3937.0));
    CHECK(through("EPSG:3857", "EPSG:3067", {2400000, 8600000, 12}).z == 12);
}

TEST_CASE("equal systems leave every bit alone, failed points become NaN, unknown heights stay unknown") {
    std::vector<Vec3> points{{208000.1, 6797000.2, -0.3}};
    const CrsTransform same(parse_crs("EPSG:3067"), parse_crs("ETRS89 / TM35FIN(E,N)"));
    CHECK(same.identity());
    same.apply(points);
    CHECK(points.front() == Vec3{208000.1, 6797000.2, -0.3});

    std::vector<Vec3> bad{{1e30, 2, 3}, {std::nan(""), 60, 0}, {21.5, 61.2, std::nan("")}};
    CrsTransform(parse_crs("EPSG:4326"), parse_crs("EPSG:3067")).apply(bad);
    CHECK(std::isnan(bad[0].x));
    CHECK(std::isnan(bad[0].z));
    CHECK(std::isnan(bad[1].x));
    CHECK(bad[2].x == Approx(204643.63).margin(0.1).epsilon(0));
    CHECK(std::isnan(bad[2].z));
}

TEST_CASE("north of one system is found in another, and true north in the grid") {
    // 5.5° west of TM35FIN's central meridian true north lies east of grid north by 5.5° × sin(61.2°).
    const Crs grid = parse_crs("EPSG:3067");
    const CrsTransform transform(parse_crs("EPSG:4326"), grid);
    const double expected = 5.5 * std::sin(61.2 * std::acos(-1.0) / 180);
    std::vector<Vec3> place{{21.5, 61.2, 0}};
    CHECK(transform.north_deg(place.front()) == Approx(expected).margin(0.01).epsilon(0));
    transform.apply(place);
    CHECK(transform.convergence_deg(place.front()) == Approx(expected).margin(0.01).epsilon(0));
    CHECK(CrsTransform(grid, grid).convergence_deg(place.front()) == Approx(expected).margin(0.01).epsilon(0));
    CHECK(CrsTransform(grid, grid).north_deg(place.front()) == 0);
}

TEST_CASE("a transformation for want of a grid is told") {
    std::vector<Vec3> place{{500000, 500000, 100}};
    const CrsTransform ballpark(parse_crs("+proj=utm +zone=15 +ellps=bessel"), parse_crs("EPSG:26915"));
    CHECK(ballpark.remark().empty());
    ballpark.apply(place);
    CHECK_THAT(ballpark.remark(), Contains("ballpark"));
    const CrsTransform good(parse_crs("EPSG:4326"), parse_crs("EPSG:32634"));
    place = {{21, 61, 0}};
    good.apply(place);
    CHECK(good.remark().empty());
}
