// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read/tables/degrees.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string>
#include <vector>

namespace terratet {
namespace {

/// Signs between the parts, all alike; the order of parts says what they are.
bool take_sign(std::string_view& text) {
    static constexpr std::array<std::string_view, 21> signs{"°", "º",  "˚",   "′",   "″",   "’", "‘",
                                                            "”", "“",  "''",  "'",   "\"",  ":", "\xC2\xA0",
                                                            " ", "\t", "deg", "min", "sec", "d", "m"};
    for (const std::string_view sign : signs) {
        if (text.starts_with(sign)) {
            text.remove_prefix(sign.size());
            return true;
        }
    }
    if (text.starts_with("s")) {  // of seconds; a capital S is South
        text.remove_prefix(1);
        return true;
    }
    return false;
}

bool take_hemisphere(std::string_view& text, char& hemisphere) {
    const char c = text.empty() ? ' ' : text.front();
    const char upper = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    if (hemisphere != 0 || (upper != 'N' && upper != 'S' && upper != 'E' && upper != 'W')) {
        return false;
    }
    hemisphere = upper;
    text.remove_prefix(1);
    return true;
}

/// Digits with at most one point or comma.
std::optional<double> take_number(std::string_view& text, bool& whole) {
    std::string digits;
    std::size_t n = 0;
    for (; n < text.size() && ((text[n] >= '0' && text[n] <= '9') || text[n] == '.' || text[n] == ','); ++n) {
        digits += text[n] == ',' ? '.' : text[n];
    }
    double value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (digits.empty() || error != std::errc() || end != digits.data() + digits.size()) {
        return std::nullopt;
    }
    text.remove_prefix(n);
    whole = digits.find('.') == std::string::npos;
    return value;
}

}  // namespace

std::optional<Degrees> parse_degrees(std::string_view text) {
    const bool marked = std::ranges::any_of(std::array<std::string_view, 4>{"°", "º", "˚", "deg"},
                                            [&](std::string_view sign) { return text.find(sign) != text.npos; });
    std::vector<double> parts;
    Degrees result;
    bool negative = false;
    bool signs = false;
    bool whole = true;
    const auto take_signs = [&] {
        while (take_sign(text)) {
            signs = true;
        }
    };
    take_signs();
    const bool ahead = take_hemisphere(text, result.hemisphere);
    take_signs();
    if (!ahead && !text.empty() && (text.front() == '-' || text.front() == '+')) {
        negative = text.front() == '-';
        text.remove_prefix(1);
    }
    signs = false;
    while (!text.empty()) {
        // What follows a number is a hemisphere only at the very end: "24 S", but "24 s".
        std::string_view rest = text;
        char hemisphere = result.hemisphere;
        if (!parts.empty() && take_hemisphere(rest, hemisphere)) {
            while (take_sign(rest)) {
            }
            if (rest.empty()) {
                result.hemisphere = hemisphere;
                break;
            }
        }
        const auto part = whole && parts.size() < 3 ? take_number(text, whole) : std::nullopt;
        if (!part || (!parts.empty() && (*part >= 60 || !signs))) {
            return std::nullopt;
        }
        parts.push_back(*part);
        const std::size_t before = text.size();
        signs = false;
        while (!text.empty() && !(text == "s" && (parts.size() < 3 || signs)) && take_sign(text)) {
            signs = true;  // a lone s behind a blank is South
        }
        if (text.size() == before && !text.empty()) {
            signs = false;
        }
    }
    if (parts.empty() || (parts.size() == 1 && result.hemisphere == 0 && !marked)) {
        return std::nullopt;
    }
    for (std::size_t k = 0; k < parts.size(); ++k) {
        result.value += parts[k] / std::pow(60.0, static_cast<double>(k));
    }
    const bool minus = negative || result.hemisphere == 'S' || result.hemisphere == 'W';
    result.value = minus ? -result.value : result.value;
    return result;
}

}  // namespace terratet
