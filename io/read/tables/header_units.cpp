// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read/tables/header_units.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include "io/source.hpp"

namespace terratet {
namespace {

struct Word {
    std::string_view word;
    std::string_view unit;  ///< as metres_in_unit() knows it
};

constexpr std::array<Word, 17> words{{{"m", "m"},
                                      {"metre", "m"},
                                      {"metres", "m"},
                                      {"meter", "m"},
                                      {"meters", "m"},
                                      {"mtrs", "m"},
                                      {"masl", "m"},
                                      {"amsl", "m"},
                                      {"mamsl", "m"},
                                      {"mbgl", "m"},
                                      {"mbgs", "m"},
                                      {"ft", "ft"},
                                      {"feet", "ft"},
                                      {"foot", "ft"},
                                      {"ftbgs", "ft"},
                                      {"usft", "usft"},
                                      {"km", "km"}}};

std::vector<std::string> lower_words(std::string_view text) {
    std::vector<std::string> result;
    bool inside = false;
    for (const unsigned char c : text) {
        const bool letter = std::isalnum(c) != 0 || c >= 0x80;
        if (letter && !inside) {
            result.emplace_back();
        }
        if (letter) {
            result.back() += static_cast<char>(std::tolower(c));
        }
        inside = letter;
    }
    return result;
}

std::optional<StatedUnit> length_unit(const std::string& word) {
    const auto* const known = std::ranges::find(words, word, &Word::word);
    return known == words.end() ? std::nullopt
                                : std::optional(StatedUnit{word, metres_in_unit(std::string(known->unit))});
}

}  // namespace

std::optional<StatedUnit> stated_length_unit(const Table& table, int column) {
    if (column < 0) {
        return std::nullopt;
    }
    const auto index = static_cast<std::size_t>(column);
    const auto first_word = [](std::string_view text) {
        const std::vector<std::string> all = lower_words(text);
        return all.empty() ? std::nullopt : length_unit(all.front());
    };
    if (!table.stated.units.empty() && !table.stated.units[index].empty()) {
        return first_word(table.stated.units[index]);
    }
    const std::string_view header = table.columns[index];
    if (const std::size_t open = header.find_first_of("([{"); open != std::string_view::npos) {
        return first_word(header.substr(open + 1));
    }
    const std::vector<std::string> all = lower_words(header);
    return all.size() < 2 ? std::nullopt : length_unit(all.back());
}

}  // namespace terratet
