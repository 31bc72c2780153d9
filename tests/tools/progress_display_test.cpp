// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/run/progress_display.hpp"

#include <catch2/catch.hpp>

#include "tess/error.hpp"

using namespace terratet;
using namespace terratet::tools;

namespace {

/// Everything that a display of this style writes while `use` runs.
template <class Use>
std::string written(ProgressDisplay::Style style, Use use) {
    char* text = nullptr;
    std::size_t size = 0;
    std::FILE* stream = open_memstream(&text, &size);
    {
        ProgressDisplay display(style, stream);
        use(display.callback());
    }
    std::fclose(stream);
    std::string out(text, size);
    std::free(text);  // open_memstream's
    return out;
}

}  // namespace

TEST_CASE("Progress as JSON is one line for each hundredth of each stage") {
    const auto out = written(ProgressDisplay::Style::lines, [](const Progress& progress) {
        for (const double fraction : {0.0, 0.001, 0.5, 0.502, 1.0}) {
            CHECK(progress("refine", fraction));
        }
        CHECK(progress("write", 1.0));
    });
    CHECK(out ==
          "{\"stage\":\"refine\",\"fraction\":0.00}\n{\"stage\":\"refine\",\"fraction\":0.50}\n"
          "{\"stage\":\"refine\",\"fraction\":1.00}\n{\"stage\":\"write\",\"fraction\":1.00}\n");
}

TEST_CASE("A bar stays away from what takes less than a second, and no style writes nothing") {
    const auto brief = [](const Progress& progress) { CHECK(progress("read", 0.5)); };
    CHECK(written(ProgressDisplay::Style::bar, brief).empty());
    CHECK(written(ProgressDisplay::Style::none, brief).empty());
}

TEST_CASE("Quiet runs show no bar, and a progress that is none of the three is refused") {
    CHECK(progress_style(ProgressStyle::automatic, true) == ProgressDisplay::Style::none);
    CHECK(progress_style(ProgressStyle::json, true) == ProgressDisplay::Style::lines);
}
