// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tables whose numbers cannot be what they seem, and what is said of them.
#include <catch2/catch.hpp>

#include "io/read/join_ids.hpp"
#include "io/read/tables/degrees.hpp"
#include "io/read/tables/null_codes.hpp"
#include "site_case.hpp"

using namespace terratet;
using namespace terratet::testing;
using Catch::Matchers::Contains;

TEST_CASE("codes far outside the other values are no values, with property, code and number on one line") {
    Case samples;
    samples.samples(
        "X,Y,Z,Au,SP,Por\n0,0,0,0.5,-999,0.2\n1,0,0,-99,-150,1e+33\n2,0,0,1e30,-20,0.25\n3,0,0,-1.0E+21,-30,1e30\n"
        "4,0,0,-999,-10,0.19\n5,0,0,-999,-40,0.21\n");
    const Read result = read(samples.inputs);
    CHECK(same_bits(result.site.samples.values[0], {0.5, missing, missing, missing, missing, missing}));
    CHECK(same_bits(result.site.samples.values[1], {-999, -150, -20, -30, -10, -40}));
    CHECK(same_bits(result.site.samples.values[2], {0.2, missing, 0.25, missing, 0.19, 0.21}));
    CHECK(result.noted("column Au: 2 cells of -999 are taken for no value"));
    CHECK(result.noted("column Au: 1 cells of -99 are taken for no value"));
    CHECK(result.noted("column Au: 1 cells of -1e+21 are taken for no value"));
    CHECK(result.noted("column SP: 1 cells of -999 are kept"));
    CHECK(result.noted("column Por: 1 cells of 1e+33 are taken for no value"));
}

TEST_CASE("what --null says is no value, in all columns or in one; a number in any spelling, or a word") {
    Case samples;
    samples.samples("X,Y,Z,Au,Cu\n0,0,0,0,1\n1,0,0,5.0,5\n2,0,0,nil,0\n3,0,0,2,3\n");
    samples.inputs.nulls = {"Au=5", "NIL", "Cu=0"};
    const Read result = read(samples.inputs);
    CHECK(same_bits(result.site.samples.values[0], {0, missing, 2}));
    CHECK(same_bits(result.site.samples.values[1], {1, 5, 3}));
    CHECK(result.noted("column Au: 1 cells of 5.0 are no value"));
    CHECK(result.diagnostics.rejected.empty());
    samples.inputs.nulls = {"Au="};
    CHECK_THROWS_AS(read(samples.inputs), UsageError);
}

TEST_CASE("heights and coordinates that stand for no value are rejected by line, by themselves or as told") {
    Case holes;
    holes.collars("BHID,X,Y,Z\nA,500000,6000000,100\nB,500100,6000100,-9999\nC,500000,6000100,99\nD,0,6000000,98\n")
        .log("BHID,FROM,TO,Cu\nA,0,10,1\nC,0,10,2\n");
    const Read result = read(holes.inputs);
    CHECK(result.rejected("column Z: -9999 stands for no value") == std::vector<std::int64_t>{3});
    CHECK(result.site.boreholes.size() == 3);
    holes.inputs.nulls = {"0"};  // of values: coordinates are often 0
    CHECK(read(holes.inputs).site.boreholes.size() == 3);
    holes.inputs.nulls = {"x=0", "99"};
    CHECK(read(holes.inputs).rejected("stands for no value") == std::vector<std::int64_t>{3, 4, 5});
    Case deep;  // among heights as low it is one
    deep.samples("X,Y,Z,K\n0,0,-999,1\n0,0,-2000,2\n0,0,-500,3\n");
    CHECK(read(deep.inputs).counts.samples == 3);
}

TEST_CASE("values off by magnitudes are noted, and stay") {
    std::vector<double> values{0.1, 0.5, 2, 3, 0.7, 0.2, 5, 8, 1, 1500};
    const auto off = off_scale(values);
    REQUIRE(off);
    CHECK(off->count == 1);
    CHECK(off->least == 1500);
    CHECK(off->others == 8);
    values.back() = 300;  // a grade may be forty times the next
    CHECK_FALSE(off_scale(values));
    values = {1e-12, 3e-11, 2e-10, 1e-9, 1e-8, 4e-8, 1e-7, 2e-7, 1e-6};
    CHECK_FALSE(off_scale(values));
}

TEST_CASE("numbers of records are no property unless asked for") {
    Case samples;
    samples.samples(
        "X,Y,Z,Au,Lab,N,serial\n0,0,0,1,20210300,0,700001\n1,0,0,2,20210301,1,700002\n"
        "2,0,0,3,20210302,2,700003\n3,0,0,4,20210303,3,700004\n4,0,0,5,20210304,0,700005\n");
    const Read result = read(samples.inputs);
    REQUIRE(result.site.properties.size() == 1);
    CHECK(result.noted("column Lab is left out"));
    CHECK(result.noted("column serial is left out"));
    samples.inputs.properties = {"N"};
    CHECK(read(samples.inputs).site.properties.front().name == "N");
}

TEST_CASE("a column of signs censors the values beside it, by name or by place, or as named") {
    Case samples;
    samples.samples("X,Y,Z,AS_QUAL,CU,AS_MGKG\n0,0,0,<,1,5\n1,0,0,,2,9\n2,0,0,>,3,20\n3,0,0,=,4,7\n");
    const Read result = read(samples.inputs);
    const auto censored = result.site.samples.censored;
    using C = Censoring;
    CHECK(censored[1] == std::vector{C::below, C::none, C::above, C::none});
    CHECK(censored[0] == std::vector{C::none, C::none, C::none, C::none});
    CHECK(result.noted("column AS_MGKG: 2 censored values (<, >) count as their bound, 2 of them by column AS_QUAL"));
    Case named;
    named.samples("X,Y,Z,AS,Remark\n0,0,0,5,U\n1,0,0,9,\n2,0,0,4,ND\n");
    CHECK_FALSE(read(named.inputs).site.samples.any_censored());
    named.inputs.columns = {{"qualifier", "remark"}};
    CHECK(read(named.inputs).site.samples.censored_count(0) == 2);
}

TEST_CASE("degrees, minutes and seconds in all their spellings are degrees") {
    for (const char* text :
         {"41°17'24\"S", "41° 17' 24\" S", "S41°17'24\"", "-41 17 24", "41:17:24 s", "41d17m24sS", "41°17′24″S",
          "41º17.4'S", "41°17’24,0”S", "41.29 S", "41,29°S", "-41°17'24''", "S 41 17.4", "41 deg 17 min 24 sec S"}) {
        INFO(text);
        const auto degrees = parse_degrees(text);
        REQUIRE(degrees);
        CHECK(degrees->value == Approx(-41.29).margin(1e-12));
    }
    CHECK(parse_degrees("174°46'48\"E")->hemisphere == 'E');
    for (const char* text :
         {"", "41.29", "12 m", "41°61'S", "41°17'60\"S", "41.5°17'S", "N", "abc", "41 17 24 12 S", "1e5"}) {
        INFO(text);
        CHECK_FALSE(parse_degrees(text));
    }
}

TEST_CASE("angles are coordinates in systems of degrees, and a hemisphere must suit its column") {
    Case holes;
    holes.inputs.source_crs = "EPSG:4326";
    holes.collars("BHID,LAT,LON,ELEV\nA,41°17'24\"S,174°46'48\"E,50\n").log("BHID,FROM,TO,K\nA,0,10,1\n");
    const Read result = read(holes.inputs);
    Case same;
    same.inputs.source_crs = "EPSG:4326";
    same.collars("BHID,LAT,LON,ELEV\nA,-41.29,174.78,50\n").log("BHID,FROM,TO,K\nA,0,10,1\n");
    CHECK(near(result.world(0), read(same.inputs).world(0), 1e-6));
    Case swapped;
    swapped.inputs.source_crs = "EPSG:4326";
    swapped.collars("BHID,X,Y,Z\nA,41°17'24\"S,174°46'48\"E,50\n");
    CHECK_THAT(error_of(swapped.inputs), Contains("are x and y exchanged?"));
    swapped.inputs.source_crs = "EPSG:2193";
    CHECK_THAT(error_of(swapped.inputs), Contains("is an angle"));
}

TEST_CASE("ids that are one collar's but for zeros, case, .0, blanks or dashes are taken; unclear ones are told") {
    CHECK(near_id("DH-005 ") == near_id("dh_5"));
    CHECK(near_id("4.0") == near_id("04"));
    CHECK(near_id("0.5") != near_id("5"));
    CHECK(near_id("100") != near_id("1"));
    Case holes;
    holes.collars("HoleID,X,Y,Z\n001,0,0,0\n002,9,0,0\n3,0,9,0\n4.0,9,9,0\nDH-5,5,5,0\n7,1,1,0\n07,2,2,0\n8,3,3,0\n")
        .log("HoleID,From,To,Cu\n1,0,1,1\n002,0,1,2\n003,0,1,3\n4,0,1,4\ndh5,0,1,5\n007,0,1,6\n8,0,1,7\n08,2,3,8\n");
    const Read result = read(holes.inputs);
    CHECK(result.counts.samples == 6);
    CHECK(result.noted("'1' for '001'"));
    CHECK(result.noted("'dh5' for 'DH-5'"));
    CHECK(result.noted("'007' ('07' or '7'?)"));
    CHECK(result.noted("'08' ('8'?)"));
    CHECK(result.rejected("has no collar") == std::vector<std::int64_t>{7, 9});
}

TEST_CASE("the id column that tables share joins them, whatever else is called an id") {
    Case holes;
    holes.collars("CollarID,HoleId,X,Y,RL\n1,SSDD001,0,0,100\n2,SSDD002,100,100,101\n")
        .log("CollarID,From,To,Cu\n1,0,10,1\n2,0,10,3\n")
        .survey("HoleId,Depth,Dip,Azimuth\nSSDD001,0,-60,90\n");
    const Read result = read(holes.inputs);
    CHECK(result.counts.samples == 2);
    CHECK(result.site.boreholes[0].id == "SSDD001");
    CHECK(result.noted("its column CollarID is joined with the collars' column CollarID"));
    CHECK(result.site.boreholes[0].path.back().x > result.site.boreholes[0].path.front().x + 4);
    Case numbered;  // running numbers match by chance
    numbered.collars("ID,HOLEID,X,Y,Z\n1,A,0,0,0\n2,B,9,0,0\n3,C,0,9,0\n")
        .log("ID,HOLEID,FROM,TO,K\n1,A,0,1,1\n2,B,0,1,2\n3,D,0,1,3\n");
    CHECK(read(numbered.inputs).rejected("hole D has no collar").size() == 1);
}

TEST_CASE("tops and bottoms that fall from the collars' heights are heights, also along a deviated hole") {
    const char* collars = "BHID,X,Y,Z,DIP,AZIMUTH\nA,0,0,12.5,-90,0\nB,100,0,11,-30,90\n";
    Case depths;
    depths.collars(collars).log("BHID,Top,Bottom,qc\nA,0,2,1\nA,2,4,2\nB,0,4,3\nB,4,8,4\n");
    Case heights;
    heights.collars(collars).log("BHID,Top,Bottom,qc\nA,12.5,10.5,1\nA,10.5,8.5,2\nB,11,9,3\nB,9,7,4\n");
    const Read a = read(depths.inputs);
    const Read b = read(heights.inputs);
    REQUIRE(b.counts.samples == 4);
    for (std::size_t i = 0; i < 4; ++i) {
        CHECK(near(a.world(i), b.world(i), 1e-9));
        CHECK(b.site.samples.length[i] == Approx(a.site.samples.length[i]));
    }
    CHECK(b.noted("columns Top and Bottom are read as heights"));
    heights.inputs.intervals = Intervals::depth;
    CHECK_THAT(error_of(heights.inputs), Contains("from 12.5 is below to 10.5"));
    Case sea;
    sea.collars("BHID,X,Y,Z\nA,0,0,-30\n").log("BHID,Top,Bottom,qc\nA,-30,-32,1\nA,-32,-34,2\n");
    CHECK(read(sea.inputs).site.samples.depth == std::vector<double>{1, 3});
    Case below;
    below.collars("BHID,X,Y,Z\nA,0,0,250\n").log("BHID,Top,Bottom,qc\nA,0,-2,1\nA,-2,-4,2\n");
    CHECK(read(below.inputs).site.samples.depth == std::vector<double>{1, 3});
    Case unclear;
    unclear.collars("BHID,X,Y,Z\nA,0,0,250\n").log("BHID,Top,Bottom,qc\nA,200,190,1\nA,190,180,2\n");
    Diagnostics said;
    ReadCounts counts;
    CHECK_THROWS_AS(read_site(unclear.inputs, said, counts), InputError);
    CHECK(std::ranges::any_of(said.notes,
                              [](const auto& note) { return note.find("`intervals` elevation") != note.npos; }));
    unclear.inputs.intervals = Intervals::elevation;
    CHECK(read(unclear.inputs).site.samples.depth == std::vector<double>{55, 65});
    Case points;
    points.collars("BHID,X,Y,Z\nA,0,0,250\n").log("BHID,ELEV,qc\nA,240,1\nA,200,2\n");
    points.inputs.intervals = Intervals::elevation;
    CHECK(read(points.inputs).site.samples.depth == std::vector<double>{10, 50});
    Case predrilled;
    predrilled.collars(collars).log("BHID,Top,Bottom,qc\nA,2,4,1\nA,4,6,2\n");
    CHECK(read(predrilled.inputs).site.samples.depth == std::vector<double>{3, 5});
}

TEST_CASE("logs beyond their holes' lengths are noted with the first line and the unit that would fit") {
    Case holes;
    holes.collars("BHID,X,Y,Z,LENGTH\nA,0,0,0,30\nB,9,0,0,30\n")
        .log("BHID,FROM,TO,K\nA,0,10,1\nA,440,450,2\nB,0,10,3\n");
    CHECK(read(holes.inputs)
              .noted("1 of 3 records lie below the length that their collar states, the first on line 3: "
                     "450 in hole A of 30"));
    Case other;
    other.collars("BHID,X,Y,Z,LENGTH\nA,0,0,0,30\nB,9,0,0,30\n").log("BHID,FROM,TO,K\nA,0,3000,1\nB,0,2900,3\n");
    CHECK(read(other.inputs).noted("by a factor of 100: are the depths in another unit (`depth_unit` cm)?"));
    other.inputs.depth_unit = "cm";
    Case fits;
    fits.collars("BHID,X,Y,Z,LENGTH\nA,0,0,0,30\n").log("BHID,FROM,TO,K\nA,0,30.5,1\n");
    CHECK_FALSE(read(fits.inputs).noted("lie below the length"));
}

TEST_CASE("z counts downwards in columns called depth, and where the user says so") {
    Case samples;
    samples.samples("X_UTME,Y_UTMN,Z_TVDSS,K\n500000,6000000,2100,1\n500100,6000000,2200,2\n");
    const Read result = read(samples.inputs);
    CHECK(result.world(0).z == -2100);
    CHECK(result.noted("column Z_TVDSS is read as positive downwards"));
    samples.inputs.z_positive = ZPositive::up;
    CHECK(read(samples.inputs).world(0).z == 2100);
    Case plain;
    plain.samples("X,Y,Z,K\n0,0,2100,1\n");
    CHECK(read(plain.inputs).world(0).z == 2100);
    plain.inputs.z_positive = ZPositive::down;
    CHECK(read(plain.inputs).world(0).z == -2100);
    Case both;
    both.collars("BHID,X,Y,ELEV\nA,0,0,100\n").log("BHID,FROM,TO,K\nA,0,10,1\n").samples("X,Y,Z,K\n0,0,2100,1\n");
    both.inputs.z_positive = ZPositive::down;
    const Read mixed = read(both.inputs);
    CHECK(mixed.world(0).z == 95);
    CHECK(mixed.world(1).z == -2100);
}

TEST_CASE("places outside the area of use of their system are noted, with what an exchange would give") {
    Case swapped;
    swapped.inputs.source_crs = "EPSG:2193";
    swapped.collars("BHID,X,Y,Z\nA,5428000,1748000,10\nB,5428100,1748000,10\n").log("BHID,FROM,TO,K\nA,0,10,1\n");
    CHECK(read(swapped.inputs).noted("2 of 2 places lie outside the area of use of EPSG:2193"));
    CHECK(read(swapped.inputs).noted("with x and y exchanged they would lie inside"));
    Case right;
    right.inputs.source_crs = "EPSG:2193";
    right.collars("BHID,X,Y,Z\nA,1748000,5428000,10\n").log("BHID,FROM,TO,K\nA,0,10,1\n");
    CHECK_FALSE(read(right.inputs).noted("area of use"));
    Case across;  // Chatham Islands: a system across the antimeridian
    across.inputs.source_crs = "EPSG:3793";
    across.collars("BHID,X,Y,Z\nA,3500000,5100000,10\n").log("BHID,FROM,TO,K\nA,0,10,1\n");
    CHECK_FALSE(read(across.inputs).noted("area of use"));
}

TEST_CASE("holes on both sides of the antimeridian are modelled in a zone that is near them") {
    Case holes;
    holes.inputs.source_crs = "EPSG:4326";
    holes.collars("BHID,LON,LAT,ELEV\nA,179.9995,-16.85,10\nB,-179.9995,-16.85,12\nC,179.999,-16.851,11\n")
        .log("BHID,FROM,TO,K\nA,0,10,1\nB,0,10,2\n");
    const Read result = read(holes.inputs);
    CHECK_THAT(result.site.frame.crs_name, Contains("zone 60S") || Contains("zone 1S"));
    CHECK(distance(result.site.boreholes[0].collar, result.site.boreholes[1].collar) < 120);
    CHECK(result.noted("16.85"));
}
