// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/options/help.hpp"

#include <algorithm>
#include <set>
#include <sstream>

#include <catch2/catch.hpp>

#include "tess/error.hpp"

using namespace terratet;
using namespace terratet::tools;
using Catch::Matchers::Contains;

namespace {

/// Columns on a terminal: UTF-8 continuation bytes take none.
std::size_t columns(const std::string& line) {
    return static_cast<std::size_t>(
        std::count_if(line.begin(), line.end(), [](unsigned char c) { return (c & 0xC0U) != 0x80U; }));
}

void check_fits_terminal(const std::string& text) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        INFO(line);
        CHECK(columns(line) <= 80);
    }
}

}  // namespace

TEST_CASE("All help fits a terminal of 80 columns") {
    check_fits_terminal(general_help());
    for (const auto& entry : commands()) {
        check_fits_terminal(help_on(entry.name));
    }
    for (const char* topic : {"estimators", "formats", "exit-codes", "report"}) {
        check_fits_terminal(help_on(topic));
    }
}

TEST_CASE("The help of a command names each of its options, each once, and gives an example") {
    for (const auto& entry : commands()) {
        const std::string help = command_help(entry);
        std::set<std::string> names;
        const auto command = entry.make();
        for (const auto& group : command->syntax().groups) {
            for (const auto& option : group.options) {
                INFO(entry.name << " " << option.names.front());
                CHECK_THAT(help, Contains(dashed(option.names.front())));
                CHECK_FALSE(option.help.empty());
                for (const auto& name : option.names) {
                    CHECK(names.insert(name).second);
                }
            }
        }
        CHECK_THAT(help, Contains("Examples:\n  terratet " + entry.name));
        CHECK_THAT(general_help(), Contains("\n  " + entry.name));
    }
}

TEST_CASE("Unknown commands and topics are answered with what there is") {
    CHECK_THROWS_WITH(find_command("biuld"), Contains("did you mean build?"));
    CHECK_THROWS_WITH(find_command("frobnicate"), Contains("'terratet help' lists them"));
    CHECK_THROWS_WITH(help_on("kriging"), Contains("estimators"));
}
