// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read/tables/number_style.hpp"

#include <fmt/format.h>

#include <array>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "io/base/parse_number.hpp"
#include "io/read/tables/cell_forms.hpp"

namespace terratet {
namespace {

constexpr std::uint8_t bit(NumberStyle style) {
    return static_cast<std::uint8_t>(1U << static_cast<unsigned>(style));
}

constexpr std::uint8_t all_styles = 0xFF;
constexpr std::uint8_t with_decimal_comma = bit(NumberStyle::comma) | bit(NumberStyle::apostrophe_comma) |
                                            bit(NumberStyle::blank_comma) | bit(NumberStyle::thousands_point_comma);
constexpr std::uint8_t with_decimal_point = static_cast<std::uint8_t>(~with_decimal_comma);

enum class Sign : std::uint8_t { none, apostrophe, blank, comma, point };

/// A sign between digits at the front of the text, and its length; none with a length of 0.
std::pair<Sign, std::size_t> sign_at(std::string_view text) {
    static constexpr std::array<std::pair<std::string_view, Sign>, 9> signs{{{",", Sign::comma},
                                                                             {".", Sign::point},
                                                                             {"'", Sign::apostrophe},
                                                                             {"\xE2\x80\x99", Sign::apostrophe},
                                                                             {" ", Sign::blank},
                                                                             {"\xC2\xA0", Sign::blank},      // no-break
                                                                             {"\xE2\x80\xAF", Sign::blank},  // narrow
                                                                             {"\xE2\x80\x89", Sign::blank},  // thin
                                                                             {"\xC2\xB4", Sign::apostrophe}}};
    for (const auto& [letters, sign] : signs) {
        if (text.starts_with(letters)) {
            return {sign, letters.size()};
        }
    }
    return {Sign::none, 0};
}

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

std::size_t digits_at(std::string_view text) {
    std::size_t n = 0;
    while (n < text.size() && is_digit(text[n])) {
        ++n;
    }
    return n;
}

std::size_t blanks_at(std::string_view text) {
    std::size_t n = 0;
    for (auto [sign, length] = sign_at(text.substr(n)); sign == Sign::blank;
         std::tie(sign, length) = sign_at(text.substr(n))) {
        n += length;
    }
    return n;
}

/// Behind the mantissa: nothing, or an exponent.
bool is_exponent(std::string_view text) {
    if (text.empty()) {
        return true;
    }
    if (text.front() != 'e' && text.front() != 'E') {
        return false;
    }
    text.remove_prefix(1);
    text.remove_prefix(!text.empty() && (text.front() == '+' || text.front() == '-') ? 1 : 0);
    return !text.empty() && digits_at(text) == text.size();
}

/// Bound and sign are taken off; blanks round the rest too.
std::string_view unsigned_part(std::string_view cell) {
    cell.remove_prefix(bound_sign(cell));
    cell.remove_prefix(blanks_at(cell));
    cell.remove_prefix(!cell.empty() && (cell.front() == '-' || cell.front() == '+') ? 1 : 0);
    for (std::size_t k = 0; k < cell.size(); ++k) {
        if (blanks_at(cell.substr(k)) == cell.size() - k) {
            return cell.substr(0, k);
        }
    }
    return cell;
}

/// Digits only, or with one point: what nearly all cells are, at little cost.
std::optional<std::uint8_t> plain_styles(std::string_view cell) {
    std::size_t i = !cell.empty() && cell.front() == '-' ? 1 : 0;
    const std::size_t whole = digits_at(cell.substr(i));
    i += whole;
    if (i == cell.size()) {
        return whole == 0 ? std::uint8_t{0} : all_styles;
    }
    if (cell[i] != '.') {
        return std::nullopt;
    }
    const std::size_t part = digits_at(cell.substr(i + 1));
    if (i + 1 + part != cell.size() || whole == 0 || part == 0) {
        return std::nullopt;
    }
    const bool group = part == 3 && whole <= 3 && cell[i - whole] != '0';
    return group ? static_cast<std::uint8_t>(with_decimal_point | bit(NumberStyle::thousands_point_comma))
                 : with_decimal_point;
}

/// The styles whose signs between the thousands are this one.
std::uint8_t grouped_by(Sign sign) {
    switch (sign) {
        case Sign::apostrophe:
            return bit(NumberStyle::apostrophe) | bit(NumberStyle::apostrophe_comma);
        case Sign::blank:
            return bit(NumberStyle::blank) | bit(NumberStyle::blank_comma);
        case Sign::comma:
            return bit(NumberStyle::thousands_comma);
        case Sign::point:
            return bit(NumberStyle::thousands_point_comma);
        case Sign::none:
            return all_styles;
    }
    return 0;
}

}  // namespace

std::uint8_t styles_of(std::string_view cell) {
    if (const auto styles = plain_styles(cell)) {
        return *styles;
    }
    const std::string_view text = unsigned_part(cell);
    std::size_t i = digits_at(text);
    if (i == 0) {  // ".5", ",5"
        const auto [sign, length] = sign_at(text);
        const std::size_t part = length == 1 ? digits_at(text.substr(1)) : 0;
        const bool number = part > 0 && is_exponent(text.substr(1 + part));
        return !number ? 0 : sign == Sign::comma ? with_decimal_comma : sign == Sign::point ? with_decimal_point : 0;
    }
    const bool can_group = i <= 3 && (text[0] != '0');
    // Groups of three by one sign; the last one may be the decimal part instead.
    Sign group = Sign::none;
    std::size_t groups = 0;
    for (;;) {
        const auto [sign, length] = sign_at(text.substr(i));
        const std::size_t digits = digits_at(text.substr(i + length));
        if (sign == Sign::none || digits != 3 || (group != Sign::none && sign != group) || !can_group) {
            break;
        }
        group = sign;
        ++groups;
        i += length + digits;
    }
    std::uint8_t styles = 0;
    const std::string_view rest = text.substr(i);
    const auto [sign, length] = sign_at(rest);
    if (is_exponent(rest)) {
        styles = grouped_by(group);
        if (groups == 1 && group == Sign::comma) {  // 1,500: one and a half?
            styles |= with_decimal_comma;
        } else if (groups == 1 && group == Sign::point) {
            styles |= with_decimal_point;
        }
    } else if (sign == Sign::comma || sign == Sign::point) {
        const std::size_t part = digits_at(rest.substr(1));
        const bool number = is_exponent(rest.substr(1 + part)) && (part > 0 || sign == Sign::point);
        styles = number ? grouped_by(group) & (sign == Sign::comma ? with_decimal_comma : with_decimal_point) : 0;
    }
    return styles;
}

std::string plain_number(std::string_view cell, NumberStyle style) {
    const bool comma = (bit(style) & with_decimal_comma) != 0;
    std::string plain;
    while (!cell.empty()) {
        const auto [sign, length] = sign_at(cell);
        const bool decimal = sign == (comma ? Sign::comma : Sign::point);
        if (length == 0 || decimal) {
            plain += decimal ? '.' : cell.front();
        }
        cell.remove_prefix(length == 0 ? 1 : length);
    }
    return plain;
}

namespace {

/// A column's numbers: how many, and the styles that suit all of them.
struct Evidence {
    std::size_t filled = 0;
    std::size_t numbers = 0;
    std::uint8_t styles = all_styles;
    [[nodiscard]] bool is_numeric() const { return numbers > 0 && 2 * numbers >= filled; }
    [[nodiscard]] bool within(std::uint8_t set) const { return styles != 0 && (styles & ~set) == 0; }
    [[nodiscard]] bool suits(NumberStyle style) const { return (styles & bit(style)) != 0; }
};

Evidence evidence_of(const TextColumn& column) {
    Evidence result;
    for (const std::string_view cell : column) {
        const std::uint8_t styles = styles_of(cell);
        result.filled += cell.empty() ? 0 : 1;
        result.numbers += styles != 0 ? 1 : 0;
        result.styles &= styles != 0 ? styles : all_styles;
    }
    return result;
}

/// What the columns that leave no choice say of the others.
struct Proofs {
    bool decimal_comma = false;
    bool decimal_point = false;
    bool point_groups = false;

    explicit Proofs(const std::vector<Evidence>& columns) {
        for (const Evidence& column : columns) {
            if (column.is_numeric()) {
                decimal_comma = decimal_comma || column.within(with_decimal_comma);
                decimal_point = decimal_point || column.within(with_decimal_point);
                point_groups = point_groups || column.within(bit(NumberStyle::thousands_point_comma));
            }
        }
    }
};

/// The style to read a column in; nothing: as it is.
std::optional<NumberStyle> chosen_style(const Evidence& column, const Proofs& proofs) {
    if (!column.is_numeric() || column.styles == 0) {
        return std::nullopt;
    }
    if (column.suits(NumberStyle::plain)) {
        const bool groups = column.suits(NumberStyle::thousands_point_comma) && proofs.point_groups;
        return groups && !proofs.decimal_point ? std::optional(NumberStyle::thousands_point_comma) : std::nullopt;
    }
    const bool thousands_comma = column.suits(NumberStyle::thousands_comma);
    const bool decimal_comma = (column.styles & with_decimal_comma) != 0;
    if (thousands_comma && decimal_comma) {  // 1,500 all down
        if (proofs.decimal_comma == proofs.decimal_point) {
            return std::nullopt;
        }
        return proofs.decimal_comma ? NumberStyle::comma : NumberStyle::thousands_comma;
    }
    for (int k = 0; k < number_styles; ++k) {
        if (column.suits(static_cast<NumberStyle>(k))) {
            return static_cast<NumberStyle>(k);
        }
    }
    return std::nullopt;
}

const char* describe(NumberStyle style) {
    static constexpr std::array<const char*, number_styles> texts{
        "",
        "decimal commas read as points",
        "apostrophes taken for signs between thousands",
        "apostrophes taken for signs between thousands, decimal commas read as points",
        "blanks taken for signs between thousands",
        "blanks taken for signs between thousands, decimal commas read as points",
        "commas taken for signs between thousands",
        "points taken for signs between thousands, decimal commas read as points"};
    return texts[static_cast<std::size_t>(style)];
}

TextColumn restyled(const TextColumn& column, NumberStyle style) {
    TextColumn result;
    for (const std::string_view cell : column) {
        if ((styles_of(cell) & bit(style)) != 0) {
            result.push_back(plain_number(cell, style));
        } else {
            result.push_back(cell);
        }
    }
    return result;
}

/// Brings numbers in other forms to plain ones; false: there are none.
bool undress(Table& table, std::size_t column) {
    PlainColumn plain = plain_column(table.cells[column], [](std::string_view cell) { return styles_of(cell) != 0; });
    if (plain.forms.empty()) {
        return false;
    }
    for (const std::string& form : plain.forms) {
        table.notes.push_back(fmt::format("{}: column {}: {}", table.file, table.columns[column], form));
    }
    if (!plain.unit.empty()) {
        table.stated.units.resize(table.columns.size());
        std::string& unit = table.stated.units[column];
        unit = unit.empty() ? plain.unit : unit;
    }
    table.cells[column] = std::move(plain.cells);
    return true;
}

}  // namespace

void accept_number_styles(Table& table, int id_column) {
    std::vector<Evidence> evidence;
    for (std::size_t column = 0; column < table.columns.size(); ++column) {
        evidence.push_back(static_cast<int>(column) == id_column ? Evidence{} : evidence_of(table.cells[column]));
        if (evidence.back().numbers < evidence.back().filled && undress(table, column)) {
            evidence.back() = evidence_of(table.cells[column]);
        }
    }
    const Proofs proofs(evidence);
    std::map<NumberStyle, std::string> names;
    for (std::size_t column = 0; column < table.columns.size(); ++column) {
        if (const auto style = chosen_style(evidence[column], proofs)) {
            table.cells[column] = restyled(table.cells[column], *style);
            std::string& list = names[*style];
            list += (list.empty() ? "" : ", ") + table.columns[column];
        }
    }
    for (const auto& [style, list] : names) {
        table.notes.push_back(fmt::format("{}: {} in {}", table.file, describe(style), list));
    }
}

}  // namespace terratet
