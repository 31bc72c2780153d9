// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/parse_number.hpp"

#include <charconv>
#include <cmath>

namespace terratet {

std::optional<double> parse_bound(const std::string& text) {
    if (text.empty() || (text.front() != '<' && text.front() != '>')) {
        return std::nullopt;
    }
    const std::size_t begin = text.size() > 1 && text[1] == '=' ? 2 : 1;
    return parse_number(text.substr(begin));
}

std::optional<double> parse_number(const std::string& text) {
    std::size_t begin = text.find_first_not_of(" \t");
    if (begin == std::string::npos) {
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
