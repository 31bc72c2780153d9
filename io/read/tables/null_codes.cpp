// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read/tables/null_codes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "io/base/lower_case.hpp"
#include "io/base/parse_number.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

constexpr double undefined_from = 1e19;

/// Of the values that are no code.
struct Rest {
    double low = HUGE_VAL;
    double high = -HUGE_VAL;
};

bool is_far(double code, const Rest& rest) {
    if (rest.low > rest.high) {
        return true;
    }
    if (std::abs(code) >= undefined_from) {
        return std::max(std::abs(rest.low), std::abs(rest.high)) < std::abs(code) / 1000;
    }
    return code < 0 ? rest.low > code / 10 : rest.high < code / (code == std::trunc(code) ? 100 : 10);
}

}  // namespace

bool is_null_code(double value) {
    static constexpr std::array<double, 20> codes{-99,     -999,    -999.25,  -999.99, -9999,    -9999.25,     -9999.99,
                                                  -99999,  -999999, -9999999, -32768,  -32767,   -99999999,    9999.25,
                                                  9999.99, 99999,   999999,   9999999, 99999999, -2147483648.0};
    if (value > -99 && value < 9999) {
        return false;
    }
    return std::abs(value) >= undefined_from || std::ranges::find(codes, value) != codes.end();
}

std::vector<NullCode> null_codes(std::span<const double> values) {
    std::map<double, std::size_t> counts;
    Rest rest;
    for (const double value : values) {
        if (is_null_code(value)) {
            ++counts[value];
        } else if (!std::isnan(value)) {
            rest.low = std::min(rest.low, value);
            rest.high = std::max(rest.high, value);
        }
    }
    std::vector<NullCode> result;
    for (const auto& [code, count] : counts) {
        result.push_back({code, count, is_far(code, rest)});
    }
    return result;
}

std::optional<OffScale> off_scale(std::span<const double> values) {
    constexpr int bins = 2200;  // by powers of two, from the least number on
    constexpr int shift = 1100;
    constexpr int apart = 5;  // empty bins: at least 32 times, and perhaps a hundred
    std::vector<std::size_t> counts(bins, 0);
    std::size_t n = 0;
    for (const double value : values) {
        if (std::isfinite(value) && value != 0) {
            ++counts[static_cast<std::size_t>(std::ilogb(value) + shift)];
            ++n;
        }
    }
    std::size_t above = 0;
    int empty = 0;
    for (int bin = bins - 1; bin >= 0 && n >= 8; --bin) {
        const std::size_t here = counts[static_cast<std::size_t>(bin)];
        if (here == 0) {
            empty += above > 0 ? 1 : 0;
            continue;
        }
        if (above > 0 && empty >= apart) {
            OffScale result{above, HUGE_VAL, 0};
            for (const double value : values) {
                const bool off = std::isfinite(value) && value != 0 && std::ilogb(value) + shift > bin;
                result.least = off ? std::min(result.least, std::abs(value)) : result.least;
                result.others = off || std::isnan(value) ? result.others : std::max(result.others, std::abs(value));
            }
            if (result.least >= 100 * result.others) {
                return result;
            }
        }
        above += here;
        empty = 0;
        if (above > std::max<std::size_t>(1, n / 20)) {
            break;
        }
    }
    return std::nullopt;
}

NullValue parse_null(const std::string& text) {
    const std::size_t equals = text.find('=');
    const bool named = equals != std::string::npos && equals > 0;
    NullValue result{named ? text.substr(0, equals) : "", named ? text.substr(equals + 1) : text, {}};
    if (result.text.empty()) {
        throw UsageError("`nulls` '" + text + "' has no value: give VALUE, or PROPERTY=VALUE");
    }
    result.number = parse_number(result.text);
    return result;
}

bool says_null(const std::vector<NullValue>& nulls, std::span<const std::string> names, std::string_view cell,
               std::optional<double> number, bool everywhere) {
    return std::ranges::any_of(nulls, [&](const NullValue& null) {
        const bool here = null.column.empty() ? everywhere : std::ranges::any_of(names, [&](const std::string& name) {
            return lower_case(name) == lower_case(null.column);
        });
        return here && (null.number ? number && *number == *null.number : lower_case(cell) == lower_case(null.text));
    });
}

}  // namespace terratet
