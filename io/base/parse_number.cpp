// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/parse_number.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>

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

namespace {

/// Digits with or without a point, few enough that one division of exact numbers rounds as it should: what nearly all
/// cells are.
std::optional<double> short_decimal(std::string_view text) {
    static constexpr std::array<double, 16> powers{1,   1e1, 1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                   1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};
    const bool negative = !text.empty() && text.front() == '-';
    text.remove_prefix(negative ? 1 : 0);
    if (text.empty() || text.size() > 16) {
        return std::nullopt;
    }
    std::uint64_t digits = 0;
    std::size_t point = text.size();
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto digit = static_cast<unsigned char>(text[i] - '0');
        if (digit <= 9) {
            digits = 10 * digits + digit;
        } else if (text[i] == '.' && point == text.size() && i > 0 && i + 1 < text.size()) {
            point = i;
        } else {
            return std::nullopt;
        }
    }
    if (digits > (std::uint64_t{1} << 53U)) {
        return std::nullopt;
    }
    const std::size_t parts = point == text.size() ? 0 : text.size() - point - 1;
    const double value = static_cast<double>(digits) / powers[parts];
    return negative ? -value : value;
}

}  // namespace

std::optional<double> parse_number(std::string_view text) {
    if (const auto value = short_decimal(text)) {
        return value;
    }
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
