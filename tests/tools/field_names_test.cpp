// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/options/field_names.hpp"

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>

#include <catch2/catch.hpp>

#include "source_dir.hpp"

using namespace terratet::tools;
using terratet::testing::source_dir;

TEST_CASE("A field in a message becomes the option that sets it") {
    CHECK(with_options("`l_min` must be a positive length") == "--lmin must be a positive length");
    CHECK(with_options("lower `barriers.width`") == "lower --fault-width");
    CHECK(with_options("more than `max_vertices` 10 (`l_max`, `v_max`)") ==
          "more than --max-vertices 10 (--lmax, --vmax)");
    CHECK(with_options("give `boreholes` with `logs`, or `samples`") == "give --boreholes with --log, or --samples");
    CHECK(with_options("`columns` x=EASTING, or `format` VDB") == "--columns x=EASTING, or --of VDB");
    const std::string twice = with_options("`extent`");
    CHECK(with_options(twice) == twice);
}

TEST_CASE("What is no field of an option stays in its backticks") {
    for (const char* text :
         {"", "`", "``", "no field", "`max_seeds`", "`barriers.max_seeds`", "`vertices`",
          "layer `samples`, row 3, column `properties` holds", "the trigger `pad` on layer `boreholes`",
          "the index `extent`", "`a name` with blanks", "`L_MIN`", "open `l_min"}) {
        CHECK(with_options(text) == text);
    }
    CHECK(with_options("it`s odd: `l_min`") == "it`s odd: --lmin");
    CHECK(with_options("``l_min``") == "`--lmin`");
}

TEST_CASE("Every field that the library's messages name has its option") {
    const std::regex literal(R"re("(?:[^"\\]|\\.)*")re");
    const std::regex field(R"((layer |column )?`[a-z_.]+`)");
    std::set<std::string> without;
    std::size_t found = 0;
    for (const char* floor : {"tess", "interp", "io"}) {
        for (const auto& entry : std::filesystem::recursive_directory_iterator(source_dir() / floor)) {
            std::ifstream file(entry.path());
            for (std::string line; entry.path().extension() == ".cpp" && std::getline(file, line);) {
                for (std::sregex_iterator text(line.begin(), line.end(), literal); text != std::sregex_iterator();
                     ++text) {
                    const std::string message = text->str();
                    for (std::sregex_iterator at(message.begin(), message.end(), field); at != std::sregex_iterator();
                         ++at) {
                        ++found;
                        if (!(*at)[1].matched && with_options(at->str()) == at->str()) {
                            without.insert(entry.path().filename().string() + ": " + at->str());
                        }
                    }
                }
            }
        }
    }
    CHECK(without == std::set<std::string>());
    CHECK(found > 50);
}
