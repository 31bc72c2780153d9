// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "io/model_store.hpp"
#include "site_case.hpp"

using namespace terratet;
using namespace terratet::testing;
using Catch::Matchers::Contains;

TEST_CASE("properties: every numeric column, or those asked for with scale, unit and classes") {
    Case hole;
    hole.collars(two_collars)
        .log(
            "BHID,FROM,TO,CU,Au (ppm),ROCK,NOTE,YEAR\nA,0,1,1,0.5,granite,,\nA,1,2,2,,gneiss,x,\nB,0,1,,0,granite,y,7\n"
            "B,1,2,4,2,NA,z,\nB,2,3,,,,w,\n");
    const Read all = read(hole.inputs);
    REQUIRE(all.site.properties.size() == 3);
    CHECK(all.site.properties[0].name == "CU");
    CHECK(all.site.properties[1].name == "Au (ppm)");
    CHECK(all.site.properties[1].unit == "ppm");
    CHECK(all.site.properties[2].name == "YEAR");
    CHECK(all.counts.samples == 4);
    CHECK(all.noted("1 of 5 records have no value"));

    hole.inputs.properties = {"rock:categorical", "Au:log10", "CU:unit=%"};
    const Read chosen = read(hole.inputs);
    REQUIRE(chosen.site.properties.size() == 3);
    CHECK(chosen.site.properties[0].classes == std::vector<std::string>{"gneiss", "granite"});
    CHECK(same_bits(chosen.site.samples.values[0], {1, 0, 1, missing}));
    CHECK(chosen.site.properties[1].scale == Scale::log10);
    CHECK(chosen.site.properties[1].unit == "ppm");
    CHECK(same_bits(chosen.site.samples.values[1], {0.5, missing, missing, 2}));
    CHECK(chosen.noted("1 values are not positive"));
    CHECK(chosen.site.properties[2].unit == "%");

    hole.inputs.properties = {"CU", "cu:categorical"};
    CHECK_THROWS_WITH(read(hole.inputs), Contains("property 'cu' is asked for twice"));
    hole.inputs.properties = {"ZN"};
    CHECK_THROWS_WITH(read(hole.inputs), Contains("ZN") && Contains("CU, Au (ppm)"));
    hole.inputs.properties = {"ROCK"};
    CHECK_THAT(error_of(hole.inputs), Contains("ROCK holds no number") && Contains("ROCK:categorical"));
}

TEST_CASE("properties of several logs share names in any case, and lack what their log lacks") {
    Case hole;
    hole.collars(two_collars).log("BHID,FROM,TO,CU\nA,0,2,1\n").log("BHID,DEPTH,cu,K\nA,5,2,3\nB,5,,4\n");
    const Read result = read(hole.inputs);
    REQUIRE(result.site.properties.size() == 2);
    CHECK(same_bits(result.site.samples.values[0], {1, 2, missing}));
    CHECK(same_bits(result.site.samples.values[1], {missing, 3, 4}));
    CHECK(result.site.samples.depth == std::vector<double>{1, 5, 5});
    CHECK(result.site.samples.length == std::vector<double>{2, 0, 0});
}

TEST_CASE("placeholders are missing unless the column goes as low; bounds of censored values count; both noted") {
    Case hole;
    hole.collars(two_collars)
        .log("BHID,DEPTH,K,SP\nA,1,-999,-999\nA,2,<1e-12,-150\nA,3,-999.25,-20\nA,4,5,n/a\nA,5,>= 7,-\nA,6,-5,NULL\n");
    const Read result = read(hole.inputs);
    CHECK(same_bits(result.site.samples.values[0], {missing, 1e-12, missing, 5, 7, -5}));
    CHECK(same_bits(result.site.samples.values[1], {-999, -150, -20, missing, missing, missing}));
    CHECK(result.noted("column K: 1 cells of -999 are taken for no value"));
    CHECK(result.noted("column K: 1 cells of -999.25 are taken for no value"));
    CHECK(result.noted("column SP: 1 cells of -999 are kept"));
    CHECK(result.noted("column K: 2 censored values"));
    CHECK(result.site.samples.censored[0] == std::vector{Censoring::none, Censoring::below, Censoring::none,
                                                         Censoring::none, Censoring::above, Censoring::none});
    CHECK(result.site.samples.censored_count(1) == 0);
    CHECK(result.diagnostics.rejected.empty());
}

TEST_CASE("a column of words with a few numbers is no property unless asked for, and that is said") {
    Case hole;
    hole.collars(two_collars).log("BHID,DEPTH,K,LITH\nA,1,1,F\nA,2,2,3\nA,3,3,Qz\n");
    const Read result = read(hole.inputs);
    REQUIRE(result.site.properties.size() == 1);
    CHECK(result.noted("column LITH has numbers in only 1 of 3 cells and is left out"));
    hole.inputs.properties = {"LITH"};
    const Read asked = read(hole.inputs);
    CHECK(asked.rejected("column LITH") == std::vector<std::int64_t>{2, 4});
    CHECK(asked.counts.samples == 1);
}

TEST_CASE("words that come again are told as possible classes, in one note; remarks are not") {
    Case hole;
    hole.collars(two_collars)
        .log(
            "BHID,DEPTH,K,LITH,UNIT,REMARK\nA,1,1,clay,U,wet\nA,2,2,clay,U,dry\nA,3,3,sand,V,broken\n"
            "A,4,3,sand,V,core lost\n");
    const Read result = read(hole.inputs);
    REQUIRE(result.site.properties.size() == 1);
    CHECK(result.noted("LITH, UNIT hold words and are left out; `properties` LITH:categorical takes the first"));
    CHECK_FALSE(result.noted("REMARK"));
}

TEST_CASE("words of a log without numbers are classes where one column holds such; of several the user chooses") {
    Case hole;
    hole.collars(two_collars).log("BHID,DEPTH,LITH\nA,1,clay\nA,2,sand\nA,3,clay\nA,4,sand\n");
    const Read result = read(hole.inputs);
    REQUIRE(result.site.properties.size() == 1);
    CHECK(result.site.properties[0].kind == Kind::categorical);
    CHECK(result.site.properties[0].classes == std::vector<std::string>{"clay", "sand"});
    CHECK(result.noted("no column holds numbers; the words of LITH are taken as classes"));
    Case two;
    two.collars(two_collars).log("BHID,DEPTH,LITH,UNIT\nA,1,clay,U\nA,2,sand,U\nA,3,clay,V\nA,4,sand,V\n");
    CHECK_THAT(error_of(two.inputs), Contains("no numeric column") && Contains("LITH, UNIT"));
}

TEST_CASE("text that is not UTF-8 is taken for Windows-1252, and the model can be stored") {
    Case old;
    old.collars("BHID,X,Y,Z\nK\xE4rn,0,0,0\n")
        .log("BHID,DEPTH,R\xE4knat,ROCK\nK\xE4rn,1,2,gr\xE5\nK\xE4rn,3,4,gr\xE5\n")
        .faults(
            "FAULT,X,Y,Z\nS\xF6"
            "der,0,0,0\nS\xF6"
            "der,9,0,0\nS\xF6"
            "der,0,9,5\n");
    old.inputs.properties = {"R\xE4knat:unit=\xB5m", "ROCK:categorical"};
    const TemporaryFolder folder;
    old.inputs.faults.push_back({written(folder / "f\xF6rkastning.csv", "X,Y,Z\n50,0,0\n59,0,0\n50,9,5\n")});
    Model model;
    static_cast<Site&>(model) = read(old.inputs).site;
    model.vertex_values.values.resize(model.properties.size());
    CHECK(model.boreholes[0].id == "Kärn");
    REQUIRE(model.properties.size() == 2);
    CHECK(model.properties[0].name == "Räknat");
    CHECK(model.properties[0].unit == "µm");
    CHECK(model.properties[1].classes == std::vector<std::string>{"grå"});
    REQUIRE(model.surfaces.size() == 2);
    CHECK(model.surfaces[0].name == "Söder");
    CHECK(model.surfaces[1].name == "förkastning");
    model.criteria.l_min = 1;
    model.criteria.l_max = 4;
    model.domain.extent = {{-1, -1, -1}, {1, 1, 1}};
    model.domain.hull = model.domain.extent;
    model.estimator = "nearest";
    save_model(folder / "m.gpkg", model, {1, "", "build", "{}"});
    CHECK(load_model(folder / "m.gpkg").properties == model.properties);
}
