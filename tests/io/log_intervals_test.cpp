// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read/log_intervals.hpp"

#include <catch2/catch.hpp>

#include "site_case.hpp"

using namespace terratet;
using namespace terratet::testing;
using Catch::Matchers::Contains;

namespace {

const char* const collars_with_length = "BHID,X,Y,Z,TD\nA,0,0,100,40\nB,50,0,100,30\n";

std::vector<double> heights(const Read& read) {
    std::vector<double> result;
    for (const Vec3& p : read.site.samples.positions) {
        result.push_back(std::round(1e6 * read.site.frame.to_world(p).z) / 1e6);
    }
    return result;
}

}  // namespace

TEST_CASE("ranges in one column are intervals, however they are written; a word among them is rejected") {
    for (const char* header : {"interval", "Depth range (m)", "DEPTH", "from"}) {
        Case ranges;
        ranges.collars(collars_with_length)
            .log(std::string("BHID,") + header +
                 ",CU\nA,0-10,1\nA,10 - 20 m,2\nA,20\xE2\x80\x93"
                 "30,3\nA,30 to 40,4\nB,0..5,1\nB,5-6,1\nB,6-7,1\nB,7-8,1\nB,8-9,1\nB,9-9.5,1\nB,?,1\n");
        const Read result = read(ranges.inputs);
        CHECK(heights(result) == std::vector<double>{95, 85, 75, 65, 97.5, 94.5, 93.5, 92.5, 91.5, 90.75});
        CHECK(result.noted("holds ranges: from and to"));
        CHECK(result.rejected("'?' is not a number") == std::vector<std::int64_t>{12});
    }
    Case feet;
    feet.collars("BHID,X,Y,Z\nA,0,0,100\n").log("BHID,interval (ft),CU\nA,0-100,1\nA,100-200,2\n");
    CHECK(heights(read(feet.inputs)) == std::vector<double>{84.76, 54.28});
}

TEST_CASE("dates and falling pairs are no ranges, nor is a column beside from and to") {
    Case dates;
    dates.collars(collars_with_length).log("BHID,depth,CU\nA,2020-10,1\nA,2021-11,2\n");
    CHECK_THAT(error_of(dates.inputs), Contains("not a number"));
    Case both;
    both.collars(collars_with_length).log("BHID,from,to,range,CU\nA,0,10,1-2,1\nA,10,20,3-4,2\n");
    CHECK(heights(read(both.inputs)) == std::vector<double>{95, 85});
}

TEST_CASE("tops without bases reach to the next top, the last to the hole's end; without one its record is rejected") {
    Case tops;
    tops.collars(collars_with_length).log("BHID,TOP,LITH\nA,20,c\nA,0,a\nA,10,b\nB,0,a\nB,12,b\nB,20,c\n");
    const Read result = read(tops.inputs);
    CHECK(heights(result) == std::vector<double>{95, 85, 70, 94, 84, 75});
    CHECK(result.noted("column TOP has no base beside it"));

    Case endless;
    endless.collars("BHID,X,Y,Z\nA,0,0,100\n").log("BHID,TOP,LITH\nA,0,a\nA,10,b\nA,20,a\nA,30,b\n");
    const Read partly = read(endless.inputs);
    CHECK(heights(partly) == std::vector<double>{95, 85, 75});
    CHECK(partly.rejected("column to is empty") == std::vector<std::int64_t>{5});
    CHECK(partly.noted("a length in the collar table would"));
}
