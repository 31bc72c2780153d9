// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/parse_number.hpp"

#include <array>
#include <charconv>
#include <cmath>

namespace terratet {

std::size_t bound_sign(std::string_view text) {
    if (text.empty() || (text.front() != '<' && text.front() != '>' && text.front() != '=' && text.front() != '\xE2')) {
        return 0;  // the common case, at once
    }
    static constexpr std::array<std::string_view, 8> signs{"<=", "=<", ">=", "=>", "<", ">", "≤", "≥"};
    for (const std::string_view sign : signs) {
        if (text.starts_with(sign)) {
            return sign.size();
        }
    }
    return 0;
}

bool is_upper_bound(std::string_view text) {
    const std::string_view sign = text.substr(0, bound_sign(text));
    return sign.find('<') != std::string_view::npos || sign == "≤";
}

std::optional<double> parse_bound(std::string_view text) {
    const std::size_t sign = bound_sign(text);
    return sign == 0 ? std::nullopt : parse_number(text.substr(sign));
}

std::optional<double> parse_number(std::string_view text) {
    std::size_t begin = text.find_first_not_of(" \t");
    if (begin == std::string_view::npos) {
        return std::nullopt;
    }
    if (text[begin] == '+' && begin + 1 < text.size() && text[begin + 1] != '-') {
        ++begin;
    }
    const char* const last = text.data() + text.find_last_not_of(" \t") + 1;
    double value = 0;
    const auto [end, error] = std::from_chars(text.data() + begin, last, value);
    return error == std::errc() && end == last && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

}  // namespace terratet
