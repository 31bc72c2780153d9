// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>

#include "site_case.hpp"

using namespace terratet;
using namespace terratet::testing;
using Catch::Matchers::Contains;

TEST_CASE("Babbitt: 399 holes in feet read whole, at the places an independent program finds") {
    const auto folder = testing::public_data("pygslib/doc/source/Tutorial_1/Babbitt");
    if (!folder) {
        WARN("SKIPPED: public data absent");
        return;
    }
    SiteInputs inputs;
    inputs.boreholes = {{(*folder / "collar_BABBITT.csv").string()}};
    inputs.surveys = {{(*folder / "survey_BABBITT.csv").string()}};
    inputs.logs = {{(*folder / "assay_BABBITT.csv").string()}};
    inputs.source_crs = "EPSG:26791";
    const Read babbitt = read(inputs);
    CHECK(babbitt.counts.boreholes == 399);
    CHECK(babbitt.diagnostics.rejected.empty());
    // 35,616 rows, 11,926 of which have no assay at all.
    CHECK(babbitt.counts.samples == 23690);
    CHECK(babbitt.noted("11926 of 35616 records have no value"));
    CHECK(babbitt.noted("column DIP is read as positive downwards"));
    REQUIRE(babbitt.site.properties.size() == 4);
    CHECK(babbitt.site.properties[0].name == "CU");
    CHECK(std::ranges::count_if(babbitt.site.samples.values[0], [](double v) { return !std::isnan(v); }) == 23685);
    CHECK(std::ranges::count_if(babbitt.site.samples.values[3], [](double v) { return !std::isnan(v); }) == 24);
    CHECK(babbitt.site.frame.unit == "US survey foot");

    // By numpy: textbook formula at stations, Gauss–Legendre integration of the turning tangent between them.
    struct Place {
        std::size_t sample;
        const char* hole;
        double depth;
        Vec3 position;
    };
    const std::vector<Place> places{{0, "34873", 2516.2, {2296021.09, 414095.85, -926.2}},
                                    {5000, "B1-102", 1240, {2295497.69, 418358.994129, 376.451287}},
                                    {12345, "B1-244", 1690, {2302261.204956, 421815.948594, -89.214460}},
                                    {20000, "B1-367", 1640, {2294018.244702, 418592.807220, -38.306012}},
                                    {23689, "RMC-66225", 1115, {2290684.77, 417975.58, 485.1}}};
    for (const Place& place : places) {
        INFO(place.hole);
        const auto owner = static_cast<std::size_t>(babbitt.site.samples.borehole[place.sample]);
        CHECK(babbitt.site.boreholes[owner].id == place.hole);
        CHECK(babbitt.site.samples.depth[place.sample] == Approx(place.depth));
        CHECK(near(babbitt.world(place.sample), place.position, 2e-6));
    }

    // The same in metres: every length shrinks by the foot, straight holes keep their shape.
    inputs.target_crs = "EPSG:26915";
    const Read metric = read(inputs);
    CHECK(metric.counts.samples == 23690);
    CHECK(metric.noted("depths along its holes are taken in US survey foot"));
    constexpr double foot = 1200.0 / 3937.0;
    CHECK(metric.site.samples.depth[0] == Approx(2516.2 * foot));
    CHECK(metric.world(0).z == Approx(-926.2 * foot).margin(1e-6).epsilon(0));
    for (const std::size_t i : {5000U, 12345U, 20000U}) {
        const double drop = metric.world(i).z - metric.world(0).z;
        CHECK(drop == Approx((babbitt.world(i).z - babbitt.world(0).z) * foot).margin(1e-6).epsilon(0));
        const double across = distance(metric.world(i), metric.world(0));
        CHECK(across == Approx(distance(babbitt.world(i), babbitt.world(0)) * foot).epsilon(5e-4));
    }
}

TEST_CASE("ddh_qaqc: our mid-points are those another program wrote beside the assays") {
    const auto folder = testing::public_data("ddh_qaqc/data");
    if (!folder) {
        WARN("SKIPPED: public data absent");
        return;
    }
    SiteInputs inputs;
    inputs.boreholes = {{(*folder / "collar.csv").string()}};
    inputs.surveys = {{(*folder / "survey.csv").string()}};
    inputs.logs = {{(*folder / "assay.csv").string()}};
    inputs.properties = {"Au", "xm", "ym", "zm"};
    inputs.source_crs = "local";
    const Read ddh = read(inputs);
    REQUIRE(ddh.counts.samples == 1882);
    CHECK(ddh.counts.boreholes == 29);
    double worst = 0;
    for (std::size_t i = 0; i < ddh.site.samples.size(); ++i) {
        const auto& values = ddh.site.samples.values;
        worst = std::max(worst, distance(ddh.world(i), {values[1][i], values[2][i], values[3][i]}));
    }
    INFO("largest distance " << worst << " after 98 m of hole");
    CHECK(worst < 0.032);  // the other program interpolates angles; at stations the methods agree
    CHECK(worst > 0.001);
}

TEST_CASE("Demo1 under other column names gives the site that ddh_qaqc gives") {
    const auto ours = testing::public_data("pygslib/pygslib/data/Demo1/data");
    const auto theirs = testing::public_data("ddh_qaqc/data");
    if (!ours || !theirs) {
        WARN("SKIPPED: public data absent");
        return;
    }
    const auto inputs = [](const std::filesystem::path& folder) {
        SiteInputs result;
        result.boreholes = {{(folder / "collar.csv").string()}};
        result.surveys = {{(folder / "survey.csv").string()}};
        result.logs = {{(folder / "assay.csv").string()}};
        result.properties = {"Au"};
        result.source_crs = "local";
        return result;
    };
    const Read demo = read(inputs(*ours));
    CHECK(demo.counts.boreholes == 29);
    CHECK(demo.counts.samples == 1882);
    CHECK(demo.diagnostics.rejected.empty());
    CHECK(demo.site.samples.positions == read(inputs(*theirs)).site.samples.positions);
}

TEST_CASE("workbooks: sheets of one file, classes, units from headers, tables without header") {
    const auto folder = testing::public_data("subsurface/tests/data/borehole");
    if (!folder) {
        WARN("SKIPPED: public data absent");
        return;
    }
    const std::string wells = (*folder / "wells-database-small.xlsx").string();
    SiteInputs inputs;
    inputs.boreholes = {{wells, "collar"}};
    inputs.surveys = {{wells, "survey"}};
    inputs.logs = {{wells, "geology"}};
    inputs.properties = {"GEOL:categorical"};
    inputs.source_crs = "EPSG:32632";
    const Read book = read(inputs);
    CHECK(book.counts.boreholes > 5);
    CHECK(book.counts.samples > 5);
    CHECK(book.site.boreholes.front().id == "NC-01");
    CHECK(std::ranges::is_sorted(book.site.properties[0].classes));
    CHECK(book.noted("INCL is read as inclination from the downward vertical"));

    SiteInputs bare;
    bare.boreholes = {{(*folder / "borehole_collar.xlsx").string()}};
    bare.logs = {{(*folder / "borehole_assays.xlsx").string()}, {(*folder / "borehole_lith.xlsx").string()}};
    bare.columns = {{"id", "Field1"}, {"x", "Field2"}, {"y", "Field3"}, {"z", "Field4"}, {"length", "Field5"}};
    bare.properties = {"Cu", "LITHOLOGY:categorical"};
    bare.source_crs = "EPSG:32629";
    const Read assays = read(bare);
    CHECK(assays.counts.boreholes == 2);
    CHECK(assays.site.properties[0].unit == "%");
    CHECK(assays.site.properties[1].classes.size() == 11);
    CHECK(assays.noted("2 of 2 holes have no survey and no direction"));
    CHECK(assays.site.boreholes[1].path_depth.back() == 508.4);
}

TEST_CASE("swissgeol: semicolons, trailing separators, missing heights and coordinates") {
    const auto folder = testing::public_data("swissgeol/tests/api/TestData");
    if (!folder) {
        WARN("SKIPPED: public data absent");
        return;
    }
    const auto collars = [&](const std::string& name) {
        SiteInputs inputs;
        inputs.boreholes = {{(*folder / name).string()}};
        inputs.source_crs = "EPSG:2056";
        return inputs;
    };
    const Read holes = read(collars("testdata.csv"));
    CHECK(holes.counts.boreholes == 6);
    CHECK(holes.site.boreholes[0].id == "Unit_Test_1");
    CHECK(holes.site.frame.to_world(holes.site.boreholes[0].collar) == Vec3{2618962, 1144995, 640.7726659});
    CHECK_THAT(error_of(collars("minimal_testdata.csv")), Contains("height") && Contains("`columns` z="));
    CHECK_THAT(error_of(collars("no_data_but_required_headers.csv")), Contains("no row"));
    CHECK_THAT(error_of(collars("not_a_json_file.csv")), Contains("no column for x"));
    SiteInputs empty = collars("maxValidationErrorsExceeded.csv");
    empty.columns = {{"z", "total_depth"}};
    CHECK_THAT(error_of(empty), Contains("none of its 1244 rows") && Contains("LocationY is empty"));
    SiteInputs words = collars("geometry_xyz_invalid_data.csv");
    words.samples = std::exchange(words.boreholes, {});
    words.properties = {"MD_m"};
    const Read points = read(words);
    CHECK(points.rejected("'NOT A DOUBLE' is not a number") == std::vector<std::int64_t>{4});
    CHECK(points.counts.samples == 3);
}

TEST_CASE("R6: Babbitt with its rows shuffled is the same site") {
    const auto folder = testing::public_data("pygslib/doc/source/Tutorial_1/Babbitt");
    if (!folder) {
        WARN("SKIPPED: public data absent");
        return;
    }
    testing::Random random(1);
    const auto site_of = [&](bool shuffle) {
        Case babbitt;
        const auto text = [&](const char* name) {
            const std::string whole = text_of((*folder / name).string());
            return shuffle ? shuffled(whole, random) : whole;
        };
        babbitt.collars(text("collar_BABBITT.csv")).survey(text("survey_BABBITT.csv")).log(text("assay_BABBITT.csv"));
        babbitt.inputs.source_crs = "EPSG:26791";
        return read(babbitt.inputs).site;
    };
    CHECK(same(site_of(false), site_of(true)));
}
