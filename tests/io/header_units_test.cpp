// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read/tables/header_units.hpp"

#include <catch2/catch.hpp>

#include "site_case.hpp"

using namespace terratet;
using namespace terratet::testing;
using Catch::Matchers::Contains;

namespace {

double metres(const std::string& header, const std::string& unit_row = "") {
    Table table;
    table.columns = {header};
    if (!unit_row.empty()) {
        table.stated.units = {unit_row};
    }
    const auto unit = stated_length_unit(table, 0);
    return unit ? unit->metres : 0;
}

}  // namespace

TEST_CASE("what a header says of its unit of length is understood, and nothing is read into others") {
    for (const char* header : {"FROM_M", "Depth (m)", "to [metres]", "elevation m", "Depth (m bgl)", "RL {m}"}) {
        CHECK(metres(header) == 1);
    }
    for (const char* header : {"FROM_FT", "depth ft", "To (feet)", "Elev_ft", "TD [Ft]"}) {
        CHECK(metres(header) == 0.3048);
    }
    CHECK(metres("z_km") == 1000);
    CHECK(metres("FROM", "ft") == 0.3048);
    CHECK(metres("FROM_FT", "m") == 1);  // the row of units is the later word
    for (const char* header : {"m", "ft", "FROM", "Depth (%)", "FROM_IN", "team", "Form", "Au (g/t)"}) {
        CHECK(metres(header) == 0);
    }
}

TEST_CASE("depths, lengths and heights have the unit that their own columns state") {
    Case feet;
    feet.inputs.source_crs = "EPSG:32632";
    feet.collars("BHID,X,Y,Z_FT,TD (ft)\nA,500000,6700000,328.083989501312,500\n")
        .log("BHID,FROM_FT,TO_FT,CU\nA,0,32.808398950131,1\nA,32.808398950131,65.616797900262,2\n");
    const Read in_feet = read(feet.inputs);
    Case same;
    same.inputs.source_crs = "EPSG:32632";
    same.collars("BHID,X,Y,Z,TD\nA,500000,6700000,100,152.4\n").log("BHID,FROM,TO,CU\nA,0,10,1\nA,10,20,2\n");
    const Read in_metres = read(same.inputs);
    REQUIRE(in_feet.site.samples.size() == 2);
    for (std::size_t i = 0; i < 2; ++i) {
        const Vec3 p = in_feet.site.frame.to_world(in_feet.site.samples.positions[i]);
        const Vec3 q = in_metres.site.frame.to_world(in_metres.site.samples.positions[i]);
        CHECK(distance(p, q) < 1e-6);
    }
    CHECK(in_feet.noted("heights are taken in ft, as column Z_FT states"));
    CHECK(in_feet.noted("depths are taken in ft, as column FROM_FT states"));
    CHECK_FALSE(in_metres.noted("states"));

    Case mixed;
    mixed.collars("BHID,X,Y,Z\nA,0,0,100\n").log("BHID,FROM_FT,TO_M,CU\nA,0,10,1\n");
    CHECK_THAT(error_of(mixed.inputs), Contains("FROM_FT and TO_M state different units"));
    mixed.inputs.depth_unit = "m";
    const Read told = read(mixed.inputs);
    CHECK(told.noted("column FROM_FT states ft; its depths are taken in m all the same"));
    CHECK(told.site.frame.to_world(told.site.samples.positions[0]).z == Approx(95));
}

TEST_CASE("coordinates that all state one unit are in one unit, whatever the coordinate system is thought to have") {
    Case local;
    local.collars("BHID,X_FT,Y_FT,Z_FT\nA,0,0,100\nB,50,0,100\n").log("BHID,FROM,TO,CU\nA,0,10,1\nB,0,10,2\n");
    const Read result = read(local.inputs);
    CHECK(result.site.frame.to_world(result.site.samples.positions[0]).z == Approx(95));
    CHECK_FALSE(result.noted("heights are taken"));
}
