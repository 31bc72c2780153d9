// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read/surfaces/trace_words.hpp"

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "io/base/lower_case.hpp"
#include "io/base/parse_number.hpp"

namespace terratet {
namespace {

/// Letters of compass points, without blanks and hyphens; words abbreviated.
std::string compass_letters(std::string_view text) {
    std::string word;
    for (const char c : lower_case(text)) {
        if (c != ' ' && c != '-' && c != '_' && c != '.') {
            word += c;
        }
    }
    for (const auto& [whole, letter] : {std::pair{"north", "n"}, {"south", "s"}, {"east", "e"}, {"west", "w"}}) {
        for (std::size_t at = word.find(whole); at != std::string::npos; at = word.find(whole)) {
            word.replace(at, std::string_view(whole).size(), letter);
        }
    }
    return word;
}

/// The numbers in a text and what parts them; nothing where it holds anything else.
struct Numbers {
    std::vector<double> values;
    bool tuple = false;
};

std::optional<Numbers> numbers_in(std::string text) {
    Numbers result;
    for (const std::string_view sign : {"°", "–", "..", "to"}) {
        for (std::size_t at = text.find(sign); at != std::string::npos; at = text.find(sign)) {
            text.replace(at, sign.size(), sign == "°" ? " " : "~");
        }
    }
    std::string word;
    const auto finish = [&] {
        const bool good = word.empty() || parse_number(word);
        if (!word.empty() && good) {
            result.values.push_back(*parse_number(word));
        }
        word.clear();
        return good;
    };
    bool colon = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        const bool minus = c == '-' && word.empty() && result.values.empty();
        if (c == '(' || c == '[' || c == ')' || c == ']' || c == ',' || c == ';' || c == '/') {
            result.tuple = true;
        }
        if (c == ':' && !colon) {  // GDAL's lists: (3:60,50,70)
            colon = true;
            word.clear();
        } else if ((c >= '0' && c <= '9') || c == '.' || minus) {
            word += c;
        } else if (std::string_view("()[],;/~- ").find(c) != std::string_view::npos) {
            if (!finish()) {
                return std::nullopt;
            }
        } else {
            return std::nullopt;
        }
    }
    return finish() && !result.values.empty() ? std::optional(result) : std::nullopt;
}

}  // namespace

std::optional<double> parse_estimate(std::string_view text) {
    if (const auto plain = parse_number(text)) {
        return plain;
    }
    const auto numbers = numbers_in(lower_case(text));
    if (!numbers) {
        return std::nullopt;
    }
    const bool range = !numbers->tuple && numbers->values.size() == 2;
    if (!range && !numbers->tuple && numbers->values.size() > 1) {
        return std::nullopt;
    }
    return range ? (numbers->values[0] + numbers->values[1]) / 2 : numbers->values[0];
}

std::optional<double> parse_dip(std::string_view text) {
    if (lower_case(text) == "vertical") {
        return 90;
    }
    const auto dip = parse_estimate(text);
    return dip && *dip >= 0 && *dip <= 90 ? dip : std::nullopt;
}

std::optional<Direction360> parse_direction(std::string_view text) {
    static constexpr std::array<std::string_view, 16> points{"n", "nne", "ne", "ene", "e", "ese", "se", "sse",
                                                             "s", "ssw", "sw", "wsw", "w", "wnw", "nw", "nnw"};
    const std::string letters = compass_letters(text);
    for (std::size_t k = 0; k < points.size(); ++k) {
        if (letters == points[k]) {
            return Direction360{22.5 * static_cast<double>(k), true};
        }
    }
    const auto degrees = parse_estimate(text);
    return degrees && std::abs(*degrees) <= 360 ? std::optional(Direction360{*degrees, false}) : std::nullopt;
}

}  // namespace terratet
