// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read/tables/column_numbers.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "io/base/lower_case.hpp"
#include "io/base/parse_number.hpp"

namespace terratet {

bool is_null_word(std::string_view text) {
    static constexpr std::array<std::string_view, 9> words{"",     "na",     "n/a",  "#n/a", "nan",
                                                           "null", "(null)", "none", "-"};
    const bool digit = !text.empty() && text.front() >= '0' && text.front() <= '9';
    return !digit && text.size() <= 6 && std::ranges::find(words, lower_case(text)) != words.end();
}

Numbers numbers_of(const TextColumn& column) {
    Numbers result;
    result.values.reserve(column.size());
    for (const std::string_view text : column) {
        const auto row = static_cast<std::uint32_t>(result.values.size());
        std::optional<double> value = parse_number(text);
        if (!value && (value = parse_bound(text))) {
            result.censored.resize(column.size(), Censoring::none);
            result.censored[row] = is_upper_bound(text) ? Censoring::below : Censoring::above;
        }
        result.count += value ? 1 : 0;
        if (!value && !is_null_word(text)) {
            result.words.push_back(row);
        }
        result.values.push_back(value.value_or(missing));
    }
    return result;
}

}  // namespace terratet
