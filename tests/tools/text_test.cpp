// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/options/text.hpp"

#include <catch2/catch.hpp>

using namespace terratet::tools;

TEST_CASE("Wrapping breaks at blanks, indents what follows and keeps long words whole") {
    CHECK(wrapped("one two three", 0, 2, 8) == "one two\n  three");
    CHECK(wrapped("one two", 5, 5, 9) == "one\n     two");
    CHECK(wrapped("incomprehensibilities x", 0, 0, 8) == "incomprehensibilities\nx");
    CHECK(wrapped("", 0, 2, 8).empty());
}

TEST_CASE("Numbers for people are grouped, short, and sizes carry a unit") {
    CHECK(grouped(7) == "7");
    CHECK(grouped(1292) == "1 292");
    CHECK(grouped(1234567) == "1 234 567");
    CHECK(short_number(80) == "80");
    CHECK(short_number(1e-12) == "1e-12");
    CHECK(short_number(1.4142135) == "1.41421");
    CHECK(byte_size(999) == "999 B");
    CHECK(byte_size(1400) == "1.4 kB");
    CHECK(byte_size(12'345'678) == "12 MB");
    CHECK(byte_size(999'999) == "1.0 MB");
}

TEST_CASE("A message of several lines becomes one") {
    CHECK(one_line("a\n  b\r\n\tc \n") == "a b c");
    CHECK(one_line("\n").empty());
}
