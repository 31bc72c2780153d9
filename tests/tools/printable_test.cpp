// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/options/printable.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace terratet::tools;

TEST_CASE("What a terminal would obey is shown, and what people write is left as it is") {
    CHECK(printable("a\x01"
                    "b\x1b[31mred\x7f") == "a\\x01b\\x1b[31mred\\x7f");
    CHECK(printable("two\nlines\tand\rmore") == "two\\x0alines\\x09and\\x0dmore");
    CHECK(printable("two\nlines\tand\rmore", true) == "two\nlines\tand\\x0dmore");
    CHECK(printable(std::string("nul\0", 4)) == "nul\\x00");
    CHECK(printable("\xC2\x9B"
                    "31m") == "\\u009b31m");  // C1's CSI
    CHECK(printable("x\xE2\x80\xAEgnp.exe") == "x\\u202egnp.exe");
    CHECK(printable("\xE2\x81\xA6\xEF\xBB\xBF\xE2\x80\xA8") == "\\u2066\\ufeff\\u2028");
    CHECK(printable("\xF3\xA0\x81\x81") == "\\ue0041");
    for (const char* text :
         {"Cu (%)", "naïve", "日本語", "10 µm ± 3 °", "می‌خواهم", "👩‍🔬", "back\\slash"}) {
        CHECK(printable(text) == text);
    }
}

TEST_CASE("Bytes that are no UTF-8 are shown one by one") {
    CHECK(printable("\x9b"
                    "31m") == "\\x9b31m");
    CHECK(printable("Bj\xF6rk") == "Bj\\xf6rk");
    CHECK(printable("\xC0\x9B") == "\\xc0\\x9b");                    // overlong
    CHECK(printable("\xE0\x80\x9B") == "\\xe0\\x80\\x9b");           // overlong
    CHECK(printable("\xED\xA0\x80") == "\\xed\\xa0\\x80");           // a surrogate
    CHECK(printable("\xF4\x90\x80\x80") == "\\xf4\\x90\\x80\\x80");  // beyond Unicode
    CHECK(printable("\xE2\x80") == "\\xe2\\x80");                    // cut off
}

TEST_CASE("JSON keeps every name, escaped as JSON does") {
    const std::string name = "a\x1b[31m\x7f\xC2\x9B\xE2\x80\xAE\xF3\xA0\x81\x81 naïve";
    const std::string text = json_text({{"name", name}, {"list", {1, 2.5}}});
    CHECK(text.find("a\\u001b[31m\\u007f\\u009b\\u202e\\udb40\\udc41 naïve") != std::string::npos);
    CHECK(nlohmann::json::parse(text)["name"] == name);
    CHECK(nlohmann::json::parse(json_text({{"cell", "Bj\xF6rk"}}))["cell"] == "Bj\xEF\xBF\xBDrk");
    CHECK(text.back() == '\n');
}
