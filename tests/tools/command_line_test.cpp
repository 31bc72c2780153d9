// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/options/command_line.hpp"

#include <fstream>

#include <catch2/catch.hpp>

#include "support.hpp"
#include "tess/error.hpp"

using namespace terratet;
using namespace terratet::tools;
using Catch::Matchers::Contains;
using Catch::Matchers::Equals;

namespace {

struct Targets {
    std::string l_min;
    std::string extent;
    std::string crs;
    std::string config;
    std::vector<std::string> logs;
    std::vector<std::string> outputs;
    double aspect = 8;
    std::uint64_t threads = 0;
    bool overwrite = false;

    Syntax syntax() {
        return {"convert",
                {{"First",
                  {{{"lmin"}, "LENGTH", "", &l_min},
                   {{"te", "extent"}, "BOX", "", &extent, 6},
                   {{"t_srs", "target-crs"}, "CRS", "", &crs},
                   {{"log"}, "FILE", "", &logs}}},
                 {"Second",
                  {{{"aspect"}, "B", "", &aspect},
                   {{"threads"}, "N", "", &threads},
                   {{"overwrite"}, "", "", &overwrite},
                   {{"config"}, "FILE", "", &config}}}},
                {"OUTPUT", 1, 3, &outputs}};
    }
    std::vector<Given> parse(const std::vector<std::string>& arguments) { return parse_arguments(syntax(), arguments); }
};

}  // namespace

TEST_CASE("GDAL's one-dash options, two dashes and long names are the same") {
    for (const char* spelling : {"-t_srs", "--t_srs", "--target-crs", "-target-crs"}) {
        Targets targets;
        targets.parse({spelling, "EPSG:3067", "out.vtu"});
        CHECK(targets.crs == "EPSG:3067");
        CHECK(targets.outputs == std::vector<std::string>{"out.vtu"});
    }
    Targets targets;
    targets.parse({"-t_srs=EPSG:3067", "-lmin=20m", "out.vtu"});
    CHECK(targets.crs == "EPSG:3067");
    CHECK(targets.l_min == "20m");
}

TEST_CASE("The numbers of -te may stand apart or be joined, negative ones included") {
    for (const auto& spelling : std::vector<std::vector<std::string>>{{"-te", "-1", "2", "-3", "4", "5", "6.5"},
                                                                      {"-te", "-1,2,-3,4,5,6.5"},
                                                                      {"--extent", "-1,2,-3,4,5,6.5"},
                                                                      {"--extent=-1,2,-3,4,5,6.5"}}) {
        Targets targets;
        auto arguments = spelling;
        arguments.push_back("out.vtu");
        targets.parse(arguments);
        CHECK(targets.extent == "-1,2,-3,4,5,6.5");
        CHECK(targets.outputs.size() == 1);
    }
}

TEST_CASE("A repeatable option takes one value at a time and swallows no output") {
    Targets targets;
    targets.parse({"--log", "a.csv", "one.vtu", "--log", "b.csv", "two.glb", "--overwrite"});
    CHECK(targets.logs == std::vector<std::string>{"a.csv", "b.csv"});
    CHECK(targets.outputs == std::vector<std::string>{"one.vtu", "two.glb"});
    CHECK(targets.overwrite);
}

TEST_CASE("What was given comes back with its group, in order of declaration") {
    Targets targets;
    const auto given = targets.parse({"--threads", "2", "--log", "a.csv", "x.vtu"});
    REQUIRE(given.size() == 2);
    CHECK(given[0].name == "log");
    CHECK(given[0].group == "First");
    CHECK(given[1].name == "threads");
    CHECK(given[1].values == std::vector<std::string>{"2"});
    CHECK(targets.threads == 2);
}

TEST_CASE("An unknown option is refused with the nearest known one") {
    Targets targets;
    CHECK_THROWS_WITH(targets.parse({"--lmim", "20", "out.vtu"}),
                      Equals("unknown option --lmim; did you mean --lmin?"));
    CHECK_THROWS_WITH(targets.parse({"-t_sr", "EPSG:3067", "out.vtu"}), Contains("did you mean --t_srs?"));
    CHECK_THROWS_WITH(targets.parse({"--overwite", "out.vtu"}), Contains("did you mean --overwrite?"));
    CHECK_THROWS_WITH(targets.parse({"--zzz=3", "out.vtu"}), Contains("'terratet help convert'"));
}

TEST_CASE("Misuse of options is a usage error that names the option") {
    Targets targets;
    CHECK_THROWS_AS(targets.parse({"out.vtu", "--lmin"}), UsageError);
    CHECK_THROWS_WITH(targets.parse({"out.vtu", "--lmin"}), Contains("--lmin needs a value"));
    CHECK_THROWS_WITH(targets.parse({"--lmin", "1", "--lmin", "2", "out.vtu"}), Contains("--lmin is given 2 times"));
    CHECK_THROWS_WITH(targets.parse({"--aspect", "nan", "out.vtu"}), Contains("--aspect: 'nan' is not a number"));
    CHECK_THROWS_WITH(targets.parse({"--aspect", "8x", "out.vtu"}), Contains("--aspect: '8x' is not a number"));
    CHECK_THROWS_WITH(targets.parse({"--threads", "1.5", "out.vtu"}),
                      Contains("--threads: '1.5' is not a whole number"));
    CHECK_THROWS_WITH(targets.parse({"--threads", "-1", "out.vtu"}), Contains("--threads"));
    CHECK_THROWS_WITH(targets.parse({}), Contains("OUTPUT is missing"));
    CHECK_THROWS_WITH(targets.parse({"a", "b", "c", "d"}), Contains("'d' is one argument too many"));
}

TEST_CASE("A recipe holds any option and the command line wins over it") {
    const testing::TemporaryFolder folder;
    std::ofstream(folder / "recipe.toml") << "# a comment\nlmin = \"20m\"\naspect = 6.5\nlog = [\"a.csv\", \"b.csv\"]\n"
                                          << "overwrite = true\nt_srs = \"EPSG:3067\"\n";
    Targets targets;
    targets.parse({"--config", folder / "recipe.toml", "--aspect", "9", "out.vtu"});
    CHECK(targets.l_min == "20m");
    CHECK(targets.aspect == 9);
    CHECK(targets.logs == std::vector<std::string>{"a.csv", "b.csv"});
    CHECK(targets.overwrite);
    CHECK(targets.crs == "EPSG:3067");
}

TEST_CASE("A recipe that is missing, has sections or names an unknown option is refused with its name") {
    const testing::TemporaryFolder folder;
    const auto parse = [&](const std::string& text) {
        std::ofstream(folder / "recipe.toml") << text;
        Targets targets;
        targets.parse({"--config", folder / "recipe.toml", "out.vtu"});
    };
    Targets targets;
    CHECK_THROWS_WITH(targets.parse({"--config", folder / "none.toml", "out.vtu"}), Contains("none.toml"));
    CHECK_THROWS_WITH(parse("lmim = 3\n"), Contains("recipe.toml: unknown option 'lmim'; did you mean lmin?"));
    CHECK_THROWS_WITH(parse("[model]\nlmin = 3\n"), Contains("no sections"));
    CHECK_THROWS_WITH(parse("aspect = \"wide\"\n"), Contains("--aspect: 'wide' is not a number"));
    CHECK_THROWS_WITH(parse("overwrite = \"perhaps\"\n"), Contains("neither true nor false"));
}
