// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/options/values.hpp"

#include <cmath>

#include <fmt/format.h>

#include "io/base/parse_number.hpp"
#include "tess/geometry.hpp"
#include "tools/options/text.hpp"

namespace terratet::tools {

std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(separator, begin), text.size());
        parts.push_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return parts;
}

std::vector<double> parse_numbers(const std::string& text, std::size_t least, std::size_t most) {
    std::vector<double> numbers;
    for (const std::string& part : split(text, ',')) {
        const auto number = parse_number(part);
        if (!number) {
            throw UsageError(fmt::format("'{}' is not a number", part));
        }
        if (!(std::abs(*number) <= max_coordinate)) {
            throw UsageError(fmt::format("{} is beyond {}", part, short_number(max_coordinate)));
        }
        numbers.push_back(*number);
    }
    if (numbers.size() < least || numbers.size() > most) {
        throw UsageError(fmt::format("'{}' has {} numbers, not {}", text, numbers.size(), least));
    }
    return numbers;
}

std::vector<double> option_numbers(const std::string& option, const std::string& text, std::size_t least,
                                   std::size_t most) {
    return named(option, [&] { return parse_numbers(text, least, most); });
}

Length parse_positive_length(const std::string& text, bool or_zero) {
    Length length = parse_length(text);
    if (!(length.value > 0 || (or_zero && length.value == 0))) {
        throw UsageError(fmt::format("'{}' is {} 0", text, or_zero ? "below" : "not above"));
    }
    return length;
}

double in_unit(const std::optional<Length>& length, double metres_per_unit) {
    return length ? length->in(metres_per_unit) : 0;
}

Parsed length_value(std::optional<Length>& target, bool or_zero) {
    return {.take = [&target, or_zero](const std::string& text) { target = parse_positive_length(text, or_zero); },
            .type = "length"};
}

}  // namespace terratet::tools
