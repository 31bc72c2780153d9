// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "site_case.hpp"

using namespace terratet;
using namespace terratet::testing;
using Catch::Matchers::Contains;

TEST_CASE("every dirty record is listed with its line and reason, and the clean ones are used") {
    Case dirty;
    dirty
        .collars(
            "BHID,X,Y,Z,EOH\nA,0,0,0,50\nB,10,0,0,\nA,0,0,5,\nC,1e12,0,0,\nD,nan,0,0,\nE,,0,0,\n,5,5,5,\nF,x,0,0,\n"
            "G,inf,0,0,\nNOLOG,30,0,0,x\n")
        .survey(
            "BHID,AT,AZ,DIP\nA,0,0,90\nA,10,0,95\nA,-5,0,90\nA,x,0,90\nZZ,0,0,90\nA,20,abc,80\nA,30,,80\nA,0,0,80\n"
            "A,40,720,80\nA,45,0,\nB,0,,90\n")
        .log(
            "BHID,FROM,TO,CU,NI\nA,0,1,1,1\nA,3,2,1,1\nA,-1,0,1,1\nA,x,9,1,1\nZZ,0,1,1,1\nA,5,6,abc,1\nA,6,8,2,1\n"
            "A,7,9,3,1\nA,6,8,4,1\n,0,1,1,1\nB,0,,1,1\nB,1,1e9,1,1\nB,4,5,,\nB,6,7,inf,\n");
    const Read result = read(dirty.inputs);
    const auto lines = [&](const std::string& file, const std::string& text) {
        std::vector<std::int64_t> found;
        for (const Rejected& rejection : result.diagnostics.rejected) {
            if (rejection.file.find(file) != std::string::npos && rejection.reason.find(text) != std::string::npos) {
                found.push_back(rejection.line);
            }
        }
        return found;
    };
    using Lines = std::vector<std::int64_t>;
    CHECK(lines("collars", "a second collar") == Lines{4});
    CHECK(lines("collars", "beyond 1e+09") == Lines{5});
    CHECK(lines("collars", "'nan' is not a number") == Lines{6});
    CHECK(lines("collars", "X is empty") == Lines{7});
    CHECK(lines("collars", "no id") == Lines{8});
    CHECK(lines("collars", "'x' is not a number") == Lines{9});
    CHECK(lines("collars", "'inf' is not a number") == Lines{10});
    CHECK(lines("collars", "").size() == 7);
    CHECK(lines("survey", "'95' is no") == Lines{3});
    CHECK(lines("survey", "negative depth -5") == Lines{4});
    CHECK(lines("survey", "'x' is not a number") == Lines{5});
    CHECK(lines("survey", "hole ZZ has no collar") == Lines{6});
    CHECK(lines("survey", "'abc' is no azimuth") == Lines{7});
    CHECK(lines("survey", "no azimuth beside the dip 80") == Lines{8});
    CHECK(lines("survey", "different station at depth 0") == Lines{9});
    CHECK(lines("survey", "'720' is no azimuth") == Lines{10});
    CHECK(lines("survey", "'' is no number") == Lines{11});
    CHECK(lines("survey", "").size() == 9);
    CHECK(lines("log", "from 3 is below to 2") == Lines{3});
    CHECK(lines("log", "negative depth -1") == Lines{4});
    CHECK(lines("log", "column FROM: 'x' is not a number") == Lines{5});
    CHECK(lines("log", "hole ZZ has no collar") == Lines{6});
    CHECK(lines("log", "column CU: 'abc' is not a number; the record's other values are used") == Lines{7});
    CHECK(lines("log", "overlaps the one on line 8") == Lines{9, 10});
    CHECK(lines("log", "no id") == Lines{11});
    CHECK(lines("log", "column TO is empty") == Lines{12});
    CHECK(lines("log", "deeper than any hole") == Lines{13});
    CHECK(lines("log", "column CU: 'inf'") == Lines{15});
    CHECK(lines("log", "").size() == 11);
    CHECK(result.noted("2 of 14 records have no value"));

    CHECK(result.counts.boreholes == 3);
    CHECK(result.site.boreholes[0].collar == Vec3{0, 0, 0});
    CHECK(result.site.boreholes[2].path.size() == 1);
    REQUIRE(result.counts.samples == 3);
    CHECK(result.site.samples.depth == std::vector<double>{0.5, 5.5, 7});
    CHECK(same_bits(result.site.samples.values[0], {1, missing, 2}));
    CHECK(same_bits(result.site.samples.values[1], {1, 1, 1}));
}

TEST_CASE("strict: the first dirty record is fatal, an unassayed interval is not") {
    Case hole;
    hole.collars(two_collars).log("BHID,FROM,TO,CU\nA,0,1,1\nA,1,2,\nA,9,8,1\n");
    hole.inputs.strict = true;
    CHECK_THAT(error_of(hole.inputs), Contains("line 4") && Contains("from 9 is below to 8"));
    Case clean;
    clean.collars(two_collars).log("BHID,FROM,TO,CU\nA,0,1,1\nA,1,2,\n");
    clean.inputs.strict = true;
    CHECK(read(clean.inputs).counts.samples == 1);
}

TEST_CASE("bad inputs are each refused with one clear message") {
    const testing::TemporaryFolder folder;
    const auto with = [](auto&& change) {
        Case good;
        good.collars(two_collars).log("BHID,FROM,TO,CU\nA,0,1,1\n");
        change(good);
        return error_of(good.inputs);
    };
    CHECK_THAT(with([](Case& c) { c.inputs.boreholes[0].path += ".gone"; }), Contains("not found"));
    CHECK_THAT(with([&](Case& c) { c.inputs.logs[0].path = folder.path().string(); }), Contains("folder"));
    CHECK_THAT(with([](Case& c) { c.log(""); }), Contains("empty"));
    CHECK_THAT(with([](Case& c) { c.log("BHID,FROM,TO,CU\n"); }), Contains("no row"));
    CHECK_THAT(with([](Case& c) { c.log(std::string("\0\1\2\3binary", 10)); }), Contains("binary"));
    CHECK_THAT(with([](Case& c) { c.log("BHID,FROM,TO,ROCK\nA,0,1,granite\n"); }),
               Contains("no numeric column") && Contains("ROCK") && Contains(":categorical"));
    CHECK_THAT(with([](Case& c) { c.log("FROM,TO,CU\n0,1,1\n"); }), Contains("hole's id") && Contains("id=NAME"));
    CHECK_THAT(with([](Case& c) { c.log("BHID,CU\nA,1\n"); }), Contains("depths"));
    CHECK_THAT(with([](Case& c) { c.log("BHID,FROM,TO,CU\nZ,0,1,1\n"); }),
               Contains("none of its 1 rows is usable") && Contains("line 2") && Contains("hole Z has no collar"));
    CHECK_THAT(with([](Case& c) { c.survey("BHID,AT,AZ\nA,0,0\n"); }), Contains("no column for dip"));
    CHECK_THAT(with([](Case& c) { c.collars("BHID,X,Y\nC,1,2\n"); }), Contains("height"));
    CHECK_THAT(with([](Case& c) { c.collars("BHID,X,Y,Z\nC,1e12,2,3\n"); }), Contains("beyond 1e+09"));
    CHECK_THAT(with([](Case& c) { c.inputs.source_crs = ""; }), Contains("-s_srs"));
    CHECK_THAT(with([](Case& c) { c.inputs.source_crs = "EPSG:4326"; }),
               Contains("no longitude and latitude") && Contains("EPSG:4326"));
    CHECK_THAT(with([](Case& c) { c.inputs.target_crs = "EPSG:3067"; }), Contains("no transformation from local"));
    CHECK_THAT(with([](Case& c) {
                   c.inputs.boreholes.clear();
                   c.inputs.source_crs = "";
                   c.collars("BHID,LON,LAT,Z\nA,21,61,0\n");
               }),
               Contains("-s_srs") && Contains("EPSG:4326"));
    CHECK_THAT(with([](Case& c) {
                   c.inputs.boreholes.clear();
                   c.inputs.source_crs = "EPSG:3067";
                   c.collars("BHID,LON,LAT,Z\nA,21,61,0\n");
               }),
               Contains("hold degrees") && Contains("srs=EPSG:4326"));
}

TEST_CASE("requests that cannot be met are told apart from bad inputs") {
    Case good;
    good.collars(two_collars).log("BHID,FROM,TO,CU\nA,0,1,1\n");
    const auto usage = [&](auto&& change) {
        SiteInputs inputs = good.inputs;
        change(inputs);
        try {
            read(inputs);
        } catch (const UsageError& error) {
            return std::string(error.what());
        }
        return std::string("no UsageError");
    };
    CHECK_THAT(usage([](SiteInputs& i) { i.boreholes.clear(); }), Contains("`boreholes`"));
    CHECK_THAT(usage([](SiteInputs& i) { i = {}; }), Contains("no input"));
    CHECK_THAT(usage([](SiteInputs& i) { i.target_crs = "EPSG:4326"; }), Contains("degrees"));
    CHECK_THAT(usage([](SiteInputs& i) { i.target_crs = "EPSG:nope"; }), Contains("not understood"));
    CHECK_THAT(usage([](SiteInputs& i) { i.columns = {{"id", "NUMMER"}}; }), Contains("NUMMER"));
    CHECK_THAT(usage([](SiteInputs& i) { i.columns = {{"nummer", "BHID"}}; }), Contains("no such meaning"));
    CHECK_THAT(usage([](SiteInputs& i) { i.source_crs = "EPSG:2225+5703"; }), Contains("another unit"));
}

TEST_CASE("R6: the order of rows does not matter") {
    testing::Random random(42);
    std::string collars = "BHID,X,Y,Z\n";
    std::string survey = "BHID,AT,AZ,DIP\n";
    std::string log = "BHID,FROM,TO,CU,ROCK\n";
    std::string loose = "X,Y,Z,CU\n";
    for (int hole = 0; hole < 12; ++hole) {
        const std::string id = "H" + std::to_string(hole) + ",";
        collars += id + std::to_string(random(2e5, 3e5)) + "," + std::to_string(random(6.7e6, 6.8e6)) + ",10\n";
        for (int i = 0; i < 5; ++i) {
            survey += id + std::to_string(20 * i) + "," + std::to_string(random(0, 360)) + "," +
                      std::to_string(random(40, 90)) + "\n";
        }
        for (int i = 0; i < 20; ++i) {
            log += id + std::to_string(5 * i) + "," + std::to_string(5 * i + (i % 7 == 0 ? 6 : 5)) + "," +
                   (i % 5 == 0   ? ""
                    : i % 5 == 1 ? "<0.5"
                                 : std::to_string(random(0, 9))) +
                   ",R" + std::to_string(random.below(4)) + "\n";
        }
        loose += "250000,6750000," + std::to_string(hole % 3) + "," + std::to_string(random.below(3)) + "\n";
    }
    const auto site_of = [&](const std::string& c, const std::string& s, const std::string& l, const std::string& p) {
        Case result;
        result.collars(c).survey(s).log(l).samples(p);
        result.inputs.source_crs = "EPSG:3067";
        result.inputs.properties = {"CU", "ROCK:categorical"};
        return read(result.inputs).site;
    };
    const Site expected = site_of(collars, survey, log, loose);
    CHECK(expected.samples.size() > 200);
    CHECK(expected.samples.censored_count(0) > 30);
    CHECK(std::ranges::is_sorted(expected.boreholes, {}, &Borehole::id));
    for (int trial = 0; trial < 5; ++trial) {
        CHECK(same(expected, site_of(shuffled(collars, random), shuffled(survey, random), shuffled(log, random),
                                     shuffled(loose, random))));
    }
}

TEST_CASE("faults come into the frame of the samples") {
    Case site;
    site.samples("X,Y,Z,V\n582673.75,5275653.28,484,1\n")
        .faults(
            "FAULT,X,Y,Z\nF,2296000,414000,1500\nF,2296100,414000,1500\nF,2296000,414100,1600\nF,2296100,414100,"
            "1600\n");
    site.inputs.source_crs = "EPSG:26915";
    site.inputs.faults[0].srs = "EPSG:26791";
    const Read result = read(site.inputs);
    CHECK(result.counts.faults == 1);
    REQUIRE(result.site.surfaces.size() == 1);
    REQUIRE(result.site.surfaces[0].vertices.size() == 4);
    Box3 box;
    for (const Vec3& vertex : result.site.surfaces[0].vertices) {
        box.extend(result.site.frame.to_world(vertex));
        CHECK(result.site.frame.snapped(vertex) == vertex);
    }
    CHECK(box.lo.z == Approx(1500 * 1200.0 / 3937.0));
    CHECK(box.hi.z == Approx(1600 * 1200.0 / 3937.0));
    CHECK(box.size().x == Approx(100 * 1200.0 / 3937.0).epsilon(0.02));
    CHECK(box.lo.x == Approx(582667).margin(40).epsilon(0));
}

TEST_CASE("reading reports its progress and can be cancelled") {
    Case good;
    good.collars(two_collars).log("BHID,FROM,TO,CU\nA,0,1,1\n");
    Diagnostics diagnostics;
    ReadCounts counts;
    double last = 0;
    read_site(good.inputs, diagnostics, counts, [&](std::string_view, double fraction) {
        CHECK(fraction >= last);
        last = fraction;
        return true;
    });
    CHECK(last == 1);
    CHECK_THROWS_AS(read_site(good.inputs, diagnostics, counts, [](std::string_view, double) { return false; }),
                    Cancelled);
}
