// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/base/words.hpp"

#include <catch2/catch.hpp>

using namespace terratet;

TEST_CASE("The nearest word is the one with the fewest edits, and far words are none") {
    const std::vector<std::string> names{"lmin", "lmax", "overwrite", "estimator"};
    CHECK(nearest_word("lmim", names) == "lmin");
    CHECK(nearest_word("overwite", names) == "overwrite");
    CHECK(nearest_word("estimater", names) == "estimator");
    CHECK(nearest_word("banana", names).empty());
    CHECK(nearest_word("lm", names).empty());
    CHECK(nearest_word("LMIN", names) == "lmin");
    CHECK(did_you_mean("lmim", names) == "; did you mean lmin?");
    CHECK(did_you_mean("banana", names).empty());
}

TEST_CASE("Names are listed with commas, the first few of many, and none is said") {
    CHECK(listed({"a", "b", "c"}) == "a, b, c");
    CHECK(listed({"a", "b", "c"}, 2) == "a, b, …");
    CHECK(listed({}) == "none");
}
