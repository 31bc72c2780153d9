// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read/read_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <string_view>

#include "io/base/free_memory.hpp"
#include "io/base/lower_case.hpp"
#include "io/base/text_lines.hpp"
#include "io/read/tables/column_numbers.hpp"
#include "io/read/tables/qualifiers.hpp"
#include "tess/error.hpp"

namespace terratet {

namespace {

/// Header without its bracketed unit, and the unit: "Cu (%)" → "Cu", "%".
std::pair<std::string, std::string> split_unit(const std::string& header) {
    const std::size_t open = header.find_first_of("([");
    const std::size_t close = header.find_last_of(")]");
    if (open == std::string::npos || open == 0 || close != header.size() - 1) {
        return {header, ""};
    }
    const std::size_t end = header.find_last_not_of(" \t", open - 1);
    return {header.substr(0, end == std::string::npos ? 0 : end + 1), header.substr(open + 1, close - open - 1)};
}

/// A column that a spreadsheet or a library named for want of a name: a running number more often than a measurement.
bool is_unnamed(const std::string& header) {
    const std::string name = lower_case(header);
    if (name.empty()) {
        return true;
    }
    const bool generated = name.starts_with("unnamed: ") || name.starts_with("field");
    return generated && std::isdigit(static_cast<unsigned char>(name.back())) != 0;
}

/// Whole numbers that number or count records: by the column's name, or since they count up from a great number.
bool is_record_number(const std::string& header, std::span<const double> values) {
    static constexpr std::array<std::string_view, 24> names{
        "n",     "no",       "nr",       "num",      "number", "count",    "index", "idx",
        "seq",   "objectid", "oid",      "fid",      "ogcfid", "gid",      "lab",   "labno",
        "labnr", "labid",    "sampleno", "samplenr", "sampid", "sampleid", "batch", "batchno"};
    const bool named = std::ranges::find(names, normal_header(header)) != names.end();
    double last = missing;
    bool counts = true;
    std::size_t count = 0;
    for (const double value : values) {
        if (std::isnan(value)) {
            continue;
        }
        counts = counts && value >= 1e5 && (count == 0 || value == last + 1);
        if (value != std::trunc(value) || (!named && !counts)) {
            return false;
        }
        last = value;
        ++count;
    }
    return named || (counts && count >= 5);
}

/// Has the column a meaning (position, depth, id), by name or by the user's word? Such columns are no properties unless
/// asked for.
std::vector<bool> columns_with_meaning(const Table& table, const ColumnNames& columns) {
    std::vector<bool> result(table.columns.size(), false);
    for (const Meaning meaning : {Meaning::id, Meaning::x, Meaning::y, Meaning::z, Meaning::from, Meaning::to,
                                  Meaning::depth, Meaning::azimuth, Meaning::dip, Meaning::length}) {
        if (const int column = find_optional_column(table, meaning, columns); column >= 0) {
            result[static_cast<std::size_t>(column)] = true;
        }
        for (std::size_t column = 0; table.stated.meanings.empty() && column < table.columns.size(); ++column) {
            if (std::ranges::find(aliases(meaning), normal_header(table.columns[column])) != aliases(meaning).end()) {
                result[column] = true;
            }
        }
    }
    for (const int column : table.stated.asides) {
        result[static_cast<std::size_t>(column)] = true;
    }
    return result;
}

/// The unit that a column states, in its header or beside it.
std::string unit_of(const Table& table, std::size_t column) {
    const bool stated = !table.stated.units.empty() && !table.stated.units[column].empty();
    return stated ? table.stated.units[column] : split_unit(table.columns[column]).second;
}

/// A column taken for a property.
struct Choice {
    Property property;
    std::size_t column;
    Numbers numbers{};  ///< of a continuous one
};

/// May a column of words be classes: words that come again, not all the same?
bool may_be_classes(const auto& column) {
    std::set<std::string_view> words;
    std::size_t filled = 0;
    for (const std::string_view text : column) {
        if (!is_null_word(text)) {
            words.insert(text);
            ++filled;
        }
        if (2 * words.size() > column.size()) {
            return false;  // a long column of remarks
        }
    }
    return words.size() > 1 && 2 * words.size() <= filled;
}

/// Says once which columns of words could have been classes.
void note_classes(const Table& table, const std::vector<std::size_t>& columns, Diagnostics& diagnostics) {
    if (columns.empty()) {
        return;
    }
    constexpr std::size_t most = 5;
    std::string names;
    for (std::size_t i = 0; i < std::min(columns.size(), most); ++i) {
        names += (i == 0 ? "" : ", ") + table.columns[columns[i]];
    }
    if (columns.size() > most) {
        names += fmt::format(" and {} more", columns.size() - most);
    }
    diagnostics.note(fmt::format("{}: {} {} words and {} left out; `properties` {}:categorical takes {} as classes",
                                 table.file, names, columns.size() == 1 ? "holds" : "hold",
                                 columns.size() == 1 ? "is" : "are", table.columns[columns.front()],
                                 columns.size() == 1 ? "it" : "the first"));
}

/// The columns that hold numbers; of a table on its own without any, the one column of classes.
std::vector<Choice> default_columns(const Table& table, const ColumnNames& names, Diagnostics& diagnostics) {
    const std::vector<bool> known = columns_with_meaning(table, names);
    std::vector<Choice> result;
    std::vector<std::size_t> classes;
    for (std::size_t column = 0; column < table.columns.size(); ++column) {
        if (known[column]) {
            continue;
        }
        Numbers numbers = numbers_of(table.cells[column]);
        const std::string& name = table.columns[column];
        const bool repeated = std::ranges::any_of(
            result, [&](const Choice& choice) { return lower_case(choice.property.name) == lower_case(name); });
        if (numbers.count == 0) {
            if (may_be_classes(table.cells[column])) {
                classes.push_back(column);
            }
            continue;
        }
        if (is_record_number(name, numbers.values)) {
            diagnostics.note(
                fmt::format("{}: column {} is left out: whole numbers under a name of records, not of a "
                            "measurement; `properties` {} takes it",
                            table.file, name, name));
            continue;
        }
        if (is_unnamed(name) || repeated) {
            diagnostics.note(fmt::format("{}: column {} is left out: {}", table.file, name,
                                         repeated ? "the first of that name is used" : "it has no name of its own"));
            continue;
        }
        if (2 * numbers.count < numbers.filled()) {
            diagnostics.note(
                fmt::format("{}: column {} has numbers in only {} of {} cells and is left out; `properties` {} "
                            "takes them, {}:categorical takes all as classes",
                            table.file, name, numbers.count, numbers.filled(), name, name));
            continue;
        }
        result.push_back(
            {Property{name, unit_of(table, column), Scale::linear, Kind::continuous, {}}, column, std::move(numbers)});
    }
    if (result.empty() && classes.size() == 1 && !table.stated.one_of_several) {
        const std::string& name = table.columns[classes.front()];
        diagnostics.note(
            fmt::format("{}: no column holds numbers; the words of {} are taken as classes", table.file, name));
        result.push_back({Property{name, "", Scale::linear, Kind::categorical, {}}, classes.front()});
        return result;
    }
    note_classes(table, classes, diagnostics);
    return result;
}

/// The columns of the wanted properties that this table has; by whole header, else by header without its unit.
std::vector<Choice> wanted_columns(const Table& table, const std::vector<Property>& wanted) {
    std::vector<Choice> result;
    for (const Property& property : wanted) {
        const auto named = [&](const auto& form) {
            return std::ranges::find(table.columns, lower_case(property.name),
                                     [&](const std::string& header) { return lower_case(form(header)); });
        };
        auto found = named([](const std::string& header) { return header; });
        if (found == table.columns.end()) {
            found = named([](const std::string& header) { return split_unit(header).first; });
        }
        if (found == table.columns.end()) {
            continue;
        }
        const auto column = static_cast<std::size_t>(found - table.columns.begin());
        Numbers numbers = property.kind == Kind::continuous ? numbers_of(table.cells[column]) : Numbers{};
        if (property.kind == Kind::continuous && numbers.count == 0) {
            throw InputError(fmt::format("{}: column {} holds no number; for classes write `properties` {}:categorical",
                                         table.file, *found, property.name));
        }
        result.push_back({property, column, std::move(numbers)});
        if (property.unit.empty()) {
            result.back().property.unit = unit_of(table, column);
        }
    }
    return result;
}

/// Usual codes become missing where they are far outside the other values; what else is off is told.
void drop_codes(std::vector<double>& values, const Table& table, std::size_t column, Diagnostics& diagnostics) {
    const std::string& name = table.columns[column];
    for (const NullCode& found : null_codes(values)) {
        diagnostics.note(fmt::format(
            "column {}: {} cells of {} {} ({})", name, found.count, found.code,
            found.far ? "are taken for no value"
                      : fmt::format("are kept, for other values come near; `nulls` {}={} drops them", name, found.code),
            table.file));
        if (found.far) {
            std::ranges::replace(values, found.code, missing);
        }
    }
    if (const auto off = off_scale(values)) {
        diagnostics.note(
            fmt::format("column {}: {} values from {} on are a hundred times as large as all others (up to {}): in "
                        "another unit, or a code? `nulls` {}=VALUE drops one ({})",
                        name, off->count, off->least, off->others, name, table.file));
    }
}

void drop_without_logarithm(std::vector<double>& values, const std::string& where, Diagnostics& diagnostics) {
    const auto bad = [](double value) { return value <= 0; };
    if (const auto count = std::ranges::count_if(values, bad); count > 0) {
        diagnostics.note(
            fmt::format("{}: {} values are not positive, have no logarithm and are taken for no value", where, count));
        std::ranges::replace_if(values, bad, missing);
    }
}

/// Cells that the user says are none lose their values; they are no rejections.
void drop_nulls(Numbers& numbers, const Table& table, const Choice& choice, const std::vector<NullValue>& nulls,
                Diagnostics& diagnostics) {
    const std::array names{table.columns[choice.column], choice.property.name};
    std::map<std::string, std::size_t> told;
    std::vector<bool> none(nulls.empty() ? 0 : table.rows());
    for (std::size_t row = 0; row < none.size(); ++row) {
        const std::string_view text = table.cells[choice.column][row];
        const double value = numbers.values[row];
        none[row] =
            !text.empty() && says_null(nulls, names, text, std::isnan(value) ? std::nullopt : std::optional(value));
        if (none[row]) {
            ++told[std::string(text)];
            numbers.values[row] = missing;
        }
    }
    std::erase_if(numbers.words, [&](std::uint32_t row) { return !none.empty() && none[row]; });
    for (const auto& [text, count] : told) {
        diagnostics.note(fmt::format("column {}: {} cells of {} are no value, as `nulls` say ({})", names[0], count,
                                     text, table.file));
    }
}

/// Values that a column of signs calls bounds; how many.
std::size_t qualify(Numbers& numbers, const TextColumn& signs) {
    std::size_t qualified = 0;
    for (std::size_t row = 0; row < numbers.values.size(); ++row) {
        const Censoring said = std::isnan(numbers.values[row]) ? Censoring::none : qualifier_of(signs[row]);
        if (said != Censoring::none) {
            numbers.censored.resize(numbers.values.size(), Censoring::none);
            numbers.censored[row] = numbers.censored[row] | said;
            ++qualified;
        }
    }
    return qualified;
}

ValueColumn continuous_values(const Table& table, Choice choice, int qualifier, const std::vector<NullValue>& nulls,
                              std::size_t index, Diagnostics& diagnostics) {
    const std::string where = table.file + ": column " + table.columns[choice.column];
    Numbers numbers = std::move(choice.numbers);
    drop_nulls(numbers, table, choice, nulls, diagnostics);
    const auto signs = static_cast<std::size_t>(std::max(qualifier, 0));
    const std::size_t qualified = qualifier < 0 ? 0 : qualify(numbers, table.cells[signs]);
    for (const std::uint32_t row : numbers.words) {
        diagnostics.reject(table.file, table.lines[row],
                           fmt::format("column {}: '{}' is not a number; the record's other values are used",
                                       table.columns[choice.column], table.cells[choice.column][row]));
    }
    drop_codes(numbers.values, table, choice.column, diagnostics);
    if (choice.property.scale == Scale::log10) {
        drop_without_logarithm(numbers.values, where, diagnostics);
    }
    std::size_t bounds = 0;
    for (std::size_t row = 0; row < numbers.censored.size(); ++row) {
        Censoring& censored = numbers.censored[row];
        censored = std::isnan(numbers.values[row]) ? Censoring::none : censored;
        bounds += censored != Censoring::none ? 1 : 0;
    }
    ValueColumn result{index, std::move(numbers.values)};
    if (bounds > 0) {
        const std::string by =
            qualified == 0 ? "" : fmt::format(", {} of them by column {}", qualified, table.columns[signs]);
        diagnostics.note(fmt::format("{}: {} censored values (<, >) count as their bound{}", where, bounds, by));
        result.censored = std::move(numbers.censored);
    }
    return result;
}

/// Indices into `classes`, which grows; in order of appearance until PropertyCatalogue::finish.
std::vector<double> class_values(const Table& table, const Choice& choice, std::vector<std::string>& classes) {
    std::map<std::string, std::size_t> index;
    for (std::size_t i = 0; i < classes.size(); ++i) {
        index.emplace(classes[i], i);
    }
    std::vector<double> values;
    for (const std::string_view text : table.cells[choice.column]) {
        if (is_null_word(text)) {
            values.push_back(missing);
            continue;
        }
        const auto [entry, added] = index.emplace(std::string(text), classes.size());
        if (added) {
            classes.emplace_back(text);
        }
        values.push_back(static_cast<double>(entry->second));
    }
    return values;
}

}  // namespace

PropertyCatalogue::PropertyCatalogue(const std::vector<std::string>& wanted, const std::vector<std::string>& nulls) {
    std::ranges::transform(nulls, std::back_inserter(nulls_), parse_null);
    for (const std::string& text : wanted) {
        Property property = parse_property(to_utf8(text));
        if (std::ranges::any_of(
                wanted_, [&](const Property& other) { return lower_case(other.name) == lower_case(property.name); })) {
            throw UsageError("property '" + property.name + "' is asked for twice; name it once, with all that it is");
        }
        wanted_.push_back(std::move(property));
    }
}

std::size_t PropertyCatalogue::index_of(const Property& property) {
    const auto found = std::ranges::find(properties_, lower_case(property.name),
                                         [](const Property& known) { return lower_case(known.name); });
    if (found == properties_.end()) {
        properties_.push_back(property);
        return properties_.size() - 1;
    }
    if (found->unit.empty()) {
        found->unit = property.unit;
    }
    return static_cast<std::size_t>(found - properties_.begin());
}

std::vector<ValueColumn> PropertyCatalogue::read(Table& table, const ColumnNames& columns, Diagnostics& diagnostics) {
    seen_columns_.insert(seen_columns_.end(), table.columns.begin(), table.columns.end());
    std::vector<Choice> choices =
        wanted_.empty() ? default_columns(table, columns, diagnostics) : wanted_columns(table, wanted_);
    if (choices.empty() && wanted_.empty() && !table.stated.one_of_several) {
        throw InputError(
            fmt::format("{}: no numeric column to take for a property; columns: {}; `properties` "
                        "NAME:categorical takes a column of classes",
                        table.file, fmt::join(table.columns, ", ")));
    }
    if (choices.empty() && !table.stated.one_of_several) {
        diagnostics.note(table.file + ": has none of the properties asked for and is not used");
    }
    const std::vector<int> qualified_by = qualifiers(table, columns);
    std::vector<ValueColumn> result;
    for (Choice& choice : choices) {
        const std::size_t index = index_of(choice.property);
        std::vector<std::string>& classes = properties_[index].classes;
        const int qualifier = qualified_by[choice.column];
        result.push_back(choice.property.kind == Kind::categorical
                             ? ValueColumn{index, class_values(table, choice, classes)}
                             : continuous_values(table, std::move(choice), qualifier, nulls_, index, diagnostics));
    }
    const std::vector<bool> known = columns_with_meaning(table, columns);
    for (std::size_t column = 0; column < table.cells.size(); ++column) {
        if (!known[column]) {
            table.cells[column] = {};
        }
    }
    give_back_memory();
    return result;
}

std::vector<Property> PropertyCatalogue::finish(Samples& samples) {
    for (const Property& property : wanted_) {
        if (std::ranges::none_of(properties_, [&](const Property& known) {
                return lower_case(known.name) == lower_case(property.name);
            })) {
            throw UsageError(fmt::format("`properties` {}: no table has such a column; columns: {}", property.name,
                                         fmt::join(seen_columns_, ", ")));
        }
    }
    for (std::size_t p = 0; p < properties_.size(); ++p) {
        std::vector<std::string>& classes = properties_[p].classes;
        std::vector<std::size_t> order(classes.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::ranges::sort(order, {}, [&](std::size_t i) { return classes[i]; });
        std::vector<double> rank(classes.size());
        std::vector<std::string> sorted;
        for (const std::size_t i : order) {
            rank[i] = static_cast<double>(sorted.size());
            sorted.push_back(classes[i]);
        }
        if (properties_[p].kind == Kind::categorical) {
            for (double& value : samples.values[p]) {
                value = std::isnan(value) ? value : rank[static_cast<std::size_t>(value)];
            }
        }
        classes = std::move(sorted);
    }
    return properties_;
}

}  // namespace terratet
