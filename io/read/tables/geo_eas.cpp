// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read/tables/geo_eas.hpp"

#include <algorithm>

#include "io/base/parse_number.hpp"
#include "io/base/text_lines.hpp"

namespace terratet {
namespace {

std::string_view take_line(std::string_view& text) {
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    const std::string_view line = trimmed(text.substr(0, end));
    const std::size_t length = end + 1 < text.size() && text[end] == '\r' && text[end + 1] == '\n' ? 2 : 1;
    text.remove_prefix(std::min(end + length, text.size()));
    return line;
}

/// How many numbers a line has, parted by blanks or commas; 0 where a word is none.
std::size_t count_numbers(std::string_view line) {
    std::size_t count = 0;
    std::string text(line);
    std::ranges::replace(text, ',', ' ');
    std::string_view rest = text;
    for (std::string_view word = next_word(rest); !word.empty(); word = next_word(rest)) {
        if (!parse_number(word)) {
            return 0;
        }
        ++count;
    }
    return count;
}

}  // namespace

std::optional<GeoEasHeader> geo_eas_header(std::string_view head) {
    take_line(head);  // the title
    std::string_view said = take_line(head);
    const auto columns = parse_number(next_word(said));
    const bool numbers_follow = trimmed(said).empty() || count_numbers(said) > 0;  // of a grid
    if (!columns || *columns < 1 || *columns > 1000 || *columns != static_cast<int>(*columns) || !numbers_follow) {
        return std::nullopt;
    }
    GeoEasHeader header;
    for (int i = 0; i < static_cast<int>(*columns); ++i) {
        const std::string_view name = take_line(head);
        if (name.empty() || count_numbers(name) > 0) {
            return std::nullopt;
        }
        header.columns.push_back(to_utf8(name));
    }
    header.lines = static_cast<std::int64_t>(header.columns.size()) + 2;
    return count_numbers(take_line(head)) == header.columns.size() ? std::optional(std::move(header)) : std::nullopt;
}

}  // namespace terratet
