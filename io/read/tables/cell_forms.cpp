// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read/tables/cell_forms.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <string_view>

#include "io/base/parse_number.hpp"
#include "io/base/text_lines.hpp"

namespace terratet {
namespace {

constexpr std::string_view minus = "\xE2\x88\x92";

using IsNumber = bool (*)(std::string_view);

/// Could a number begin here? Words mostly cannot, and cost nothing.
bool may_begin_number(std::string_view text) {
    text.remove_prefix(std::min(bound_sign(text), text.size()));
    text = trimmed(text);
    const bool sign = text.starts_with('-') || text.starts_with('+') || text.starts_with('.') || text.starts_with(',');
    return !text.empty() && (sign || text.starts_with(minus) || (text.front() >= '0' && text.front() <= '9'));
}

std::string replaced(std::string text, std::string_view from, std::string_view to) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
        text.replace(at, from.size(), to);
    }
    return text;
}

/// "2.0×10^-8", "1.0 x 10-8", "1·10⁻⁸" as "2.0E-8".
std::string with_exponent(std::string text) {
    static constexpr std::array<std::pair<std::string_view, std::string_view>, 12> raised{{{"⁻", "-"},
                                                                                           {"⁺", "+"},
                                                                                           {"⁰", "0"},
                                                                                           {"¹", "1"},
                                                                                           {"²", "2"},
                                                                                           {"³", "3"},
                                                                                           {"⁴", "4"},
                                                                                           {"⁵", "5"},
                                                                                           {"⁶", "6"},
                                                                                           {"⁷", "7"},
                                                                                           {"⁸", "8"},
                                                                                           {"⁹", "9"}}};
    for (const std::string_view sign : {"×", "·", "⋅", "x", "X", "*"}) {
        const std::size_t at = text.find(sign);
        if (at == std::string::npos) {
            continue;
        }
        const std::string_view rest = trimmed(std::string_view(text).substr(at + sign.size()));
        if (!rest.starts_with("10") || rest.size() < 3) {
            continue;
        }
        std::string power(rest.substr(rest[2] == '^' ? 3 : 2));
        for (const auto& [letter, plain] : raised) {
            power = replaced(std::move(power), letter, plain);
        }
        return std::string(trimmed(std::string_view(text).substr(0, at))) + "E" + power;
    }
    return text;
}

/// "1.0D-08", as Fortran writes it; a code such as 5D03 has no point.
std::string without_fortran(std::string text) {
    const std::size_t at = text.find_first_of("dD");
    if (at != std::string::npos && text.find('.') < at && at + 1 < text.size() &&
        (text[at + 1] == '-' || text[at + 1] == '+' || (text[at + 1] >= '0' && text[at + 1] <= '9'))) {
        text[at] = 'E';
    }
    return text;
}

std::string_view without_uncertainty(std::string_view text) {
    const std::size_t at = std::min(text.find("±"), text.find("+/-"));
    return trimmed(text.substr(0, at));
}

/// The unit at the end of a number, and its length; empty: none that is known.
std::string_view unit_at_end(std::string_view text, IsNumber is_number) {
    static constexpr std::array<std::string_view, 38> units{
        "%",     "g/t",  "gpt", "oz/t",   "ppm",  "ppb", "mg/kg", "mg/l", "mg/L", "ug/l", "µg/l",  "kg/m3", "t/m3",
        "g/cm3", "g/cc", "kPa", "MPa",    "GPa",  "bar", "°C",    "m/s",  "cm/s", "m/d",  "ohm.m", "gAPI",  "API",
        "mD",    "mS/m", "deg", "metres", "feet", "ft",  "km",    "cm",   "mm",   "m",    "pct",   "°"};
    for (const std::string_view unit : units) {
        if (text.size() > unit.size() && text.ends_with(unit)) {
            const std::string_view number = trimmed(text.substr(0, text.size() - unit.size()));
            if (is_number(number)) {
                return unit;
            }
        }
    }
    return {};
}

/// A cell as plain_column makes it.
struct Form {
    std::string text;
    std::string unit{};
    const char* what = nullptr;
};

Form form_of(std::string_view cell, IsNumber is_number) {
    Form form{std::string(cell)};
    const auto take = [&](std::string text, const char* what) {
        if (text != form.text && (is_number(text) || !unit_at_end(text, is_number).empty())) {
            form.text = std::move(text);
            form.what = what;
        }
    };
    take(replaced(form.text, minus, "-"), "minus signs of typesetting read as such");
    take(std::string(without_uncertainty(form.text)), "uncertainties (±) left out");
    take(with_exponent(replaced(form.text, minus, "-")), "powers of ten read as exponents");
    take(without_fortran(form.text), "Fortran's exponents (D) read as such");
    if (const std::string_view unit = unit_at_end(form.text, is_number); !unit.empty()) {
        form.unit = unit;
    }
    return form;
}

}  // namespace

PlainColumn plain_column(const TextColumn& column, IsNumber is_number) {
    std::map<std::string, std::size_t> units;
    std::map<std::string, std::size_t> forms;
    std::map<std::size_t, Form> dressed;
    std::size_t numbers = 0;
    for (std::size_t row = 0; row < column.size(); ++row) {
        const std::string_view cell = column[row];
        if (is_number(cell)) {
            ++numbers;
        } else if (may_begin_number(cell)) {
            Form form = form_of(cell, is_number);
            units[form.unit] += form.unit.empty() ? 0 : 1;
            forms[form.what ? form.what : ""] += form.what ? 1 : 0;
            if (form.what || !form.unit.empty()) {
                dressed.emplace(row, std::move(form));
            }
        }
    }
    units.erase("");
    PlainColumn result;
    const bool one_unit = units.size() == 1 && units.begin()->second >= numbers;
    if (dressed.empty() || (!units.empty() && !one_unit && dressed.size() == units.begin()->second)) {
        return result;
    }
    result.unit = one_unit ? units.begin()->first : "";
    bool changed = false;
    for (std::size_t row = 0; row < column.size(); ++row) {
        const auto found = dressed.find(row);
        if (found == dressed.end() || (!found->second.unit.empty() && !one_unit)) {
            result.cells.push_back(column[row]);
            continue;
        }
        std::string_view text = found->second.text;
        text.remove_suffix(found->second.unit.size());
        result.cells.push_back(trimmed(text));
        changed = true;
    }
    for (const auto& [what, count] : forms) {
        if (count > 0) {
            result.forms.push_back(what);
        }
    }
    if (one_unit) {
        result.forms.push_back(
            fmt::format("the unit {} taken off {} cells", result.unit, units.begin()->second) +
            (numbers > 0 ? fmt::format(" ({} others, without a unit, count in it too)", numbers) : ""));
    }
    return changed ? std::move(result) : PlainColumn{};
}

}  // namespace terratet
