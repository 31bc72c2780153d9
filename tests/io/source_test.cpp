// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/source.hpp"

#include <catch2/catch.hpp>

#include "tess/error.hpp"

using namespace terratet;
using Catch::Matchers::Contains;

TEST_CASE("a source splits at commas before known keys only") {
    CHECK(parse_source("collars.csv") == Source{"collars.csv", "", "", "", "", {}});
    CHECK(parse_source("a,b.gpkg,layer=holes,srs=EPSG:3067") == Source{"a,b.gpkg", "holes", "EPSG:3067", "", "", {}});
    CHECK(parse_source("a.csv,where=ID IN ('A','B'),oo=SEPARATOR=TAB,oo=HEADERS=YES") ==
          Source{"a.csv", "", "", "ID IN ('A','B')", "", {"SEPARATOR=TAB", "HEADERS=YES"}});
    CHECK(parse_source("a.gpkg,sql=SELECT a,b FROM t WHERE a=1,srs=+proj=utm +zone=35") ==
          Source{"a.gpkg", "", "+proj=utm +zone=35", "", "SELECT a,b FROM t WHERE a=1", {}});
    CHECK(parse_source("PG:host=h,dbname=d,layer=holes").path == "PG:host=h,dbname=d");
    CHECK(parse_source("/vsizip/a.zip/b.csv").path == "/vsizip/a.zip/b.csv");
}

TEST_CASE("a mistyped key of a source is told, with those there are") {
    CHECK_THROWS_WITH(parse_source("a.csv,lyer=x"), Contains("lyer") && Contains("layer="));
    CHECK_THROWS_AS(parse_source("a.csv,lyer=x"), UsageError);
    CHECK_THROWS_AS(parse_source(""), UsageError);
    CHECK_THROWS_AS(parse_source(",layer=x"), UsageError);
    CHECK_THROWS_AS(parse_source("a.csv,layer="), UsageError);
    CHECK_THROWS_AS(parse_source("a.csv,layer=x,layer=y"), UsageError);
    CHECK_THROWS_AS(parse_source("a.csv,oo=novalue"), UsageError);
    CHECK_THROWS_AS(parse_source("a.csv,layer=x,sql=SELECT 1"), UsageError);
}

TEST_CASE("messages name a source's layer and hide its password") {
    CHECK(parse_source("a.gpkg,layer=holes").describe() == "a.gpkg (layer holes)");
    CHECK(parse_source("PG:dbname=d password=secret user=u").describe() == "PG:dbname=d password=*** user=u");
    CHECK(parse_source("PG:dbname=d password='se cret'").describe() == "PG:dbname=d password=***");
}

TEST_CASE("lengths carry their unit or take the target's") {
    CHECK(parse_length("20").in(0.3048) == 20);
    CHECK(parse_length("20m").in(1) == 20);
    CHECK(parse_length("65ft").in(1) == Approx(19.812));
    CHECK(parse_length("1.5km").in(1) == 1500);
    CHECK(parse_length("3.048m").in(0.3048) == Approx(10));
    for (const char* bad : {"", "m", "20 m", "20parsec", "nan", "inf", "1e999", "0x10"}) {
        INFO(bad);
        CHECK_THROWS_AS(parse_length(bad), UsageError);
    }
}
