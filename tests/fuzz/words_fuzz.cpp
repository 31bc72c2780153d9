// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Any text as a cell: a number in whatever style is that number in the plain one, and angles, dips and directions are
// finite.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "io/base/parse_number.hpp"
#include "io/read/surfaces/trace_words.hpp"
#include "io/read/tables/degrees.hpp"
#include "io/read/tables/number_style.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace terratet;
    const std::string_view cell(reinterpret_cast<const char*>(data), size);
    const auto styles = styles_of(cell);
    for (int k = 0; k < number_styles; ++k) {
        if ((styles >> k & 1) == 0) {
            continue;
        }
        const std::string plain = plain_number(cell, static_cast<NumberStyle>(k));
        for (const char c : std::string_view(plain).substr(bound_sign(plain))) {
            if (std::string_view("0123456789+-.eE \t").find(c) == std::string_view::npos) {
                std::abort();
            }
        }
    }
    if (const auto degrees = parse_degrees(cell); degrees && !std::isfinite(degrees->value)) {
        std::abort();
    }
    if (const auto dip = parse_dip(cell); dip && !(*dip >= 0 && *dip <= 90)) {
        std::abort();
    }
    if (const auto direction = parse_direction(cell); direction && !(std::abs(direction->degrees) <= 360)) {
        std::abort();
    }
    return 0;
}
