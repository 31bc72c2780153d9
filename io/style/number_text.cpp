// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/style/number_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace terratet {

std::string number_text(double value, int digits) {
    const double size = std::abs(value);
    std::string text = size != 0 && (size < 1e-3 || size >= 1e5) && !(size >= 1e5 && size < 1e9 && digits > 5)
                           ? fmt::format("{:.{}e}", value, std::max(0, digits - 1))
                           : fmt::format("{:.{}g}", value, digits);
    if (const auto e = text.find('e'); e != std::string::npos) {
        std::string mantissa = text.substr(0, e);
        if (mantissa.find('.') != std::string::npos) {
            mantissa.erase(mantissa.find_last_not_of('0') + 1);
            if (mantissa.back() == '.') {
                mantissa.pop_back();
            }
        }
        text = mantissa + "e" + std::to_string(std::stoi(text.substr(e + 1)));
    }
    return text.starts_with('-') ? "\u2212" + text.substr(1) : text;
}

}  // namespace terratet
