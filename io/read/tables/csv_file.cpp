// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read/tables/csv_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <tuple>

#include "io/base/csv_text.hpp"
#include "io/base/parse_number.hpp"
#include "io/base/text_lines.hpp"
#include "io/read/tables/csv_splitter.hpp"

namespace terratet {
namespace {

using Cells = std::vector<std::string_view>;

bool is_ascii(std::string_view text) {
    return std::ranges::none_of(text, [](char c) { return static_cast<unsigned char>(c) >= 0x80 || c == '\0'; });
}

/// How many cells a separator makes of a line, marks of quotation minded.
std::size_t count_cells(std::string_view line, char separator) {
    std::size_t count = 1;
    bool quoted = false;
    for (const char c : line) {
        quoted = quoted != (c == '"');
        count += c == separator && !quoted ? 1 : 0;
    }
    return count;
}

std::size_t count_words(std::string_view line) {
    std::size_t count = 0;
    while (!next_word(line).empty()) {
        ++count;
    }
    return count;
}

/// The first lines that are neither blank nor comments.
std::vector<std::string_view> first_lines(std::string_view head) {
    std::vector<std::string_view> lines;
    while (!head.empty() && lines.size() < 20) {
        const std::size_t end = std::min(head.find_first_of("\r\n"), head.size());
        const std::string_view line = trimmed(head.substr(0, end));
        head.remove_prefix(std::min(end + 1, head.size()));
        if (!line.empty() && !(line.front() == '#' && lines.empty())) {
            lines.push_back(line);
        }
    }
    return lines;
}

void append_record(Table& table, const Cells& cells) {
    for (std::size_t column = 0; column < table.cells.size(); ++column) {
        const std::string_view cell = column < cells.size() ? cells[column] : std::string_view{};
        const std::string_view text = cell.starts_with('\'') ? without_formula_mark(cell) : cell;
        if (is_ascii(text)) {
            table.cells[column].push_back(text);
        } else {
            table.cells[column].push_back(to_utf8(text));
        }
    }
}

/// From the first record; field_1, field_2, … where it is none.
std::vector<std::string> column_names(const Cells& cells, bool header) {
    std::vector<std::string> names;
    for (std::size_t column = 0; column < cells.size(); ++column) {
        names.push_back(header ? std::string(without_formula_mark(to_utf8(cells[column])))
                               : "field_" + std::to_string(column + 1));
    }
    return names;
}

bool is_header(const Cells& cells, const CsvOptions& options) {
    if (options.header) {
        return *options.header;
    }
    if (std::ranges::none_of(cells, [](std::string_view cell) { return parse_number(cell).has_value(); })) {
        return true;
    }
    std::vector<std::string> names;
    std::ranges::transform(cells, std::back_inserter(names), [](std::string_view cell) { return to_utf8(cell); });
    return options.names_columns && options.names_columns(names);
}

}  // namespace

char separator_of(std::string_view head) {
    const std::vector<std::string_view> lines = first_lines(head);
    std::tuple<std::size_t, std::size_t> best{0, 1};
    char found = 0;
    for (const char separator : {'\t', ';', '|', ','}) {
        const std::size_t count = lines.empty() ? 1 : count_cells(lines.front(), separator);
        const auto even = static_cast<std::size_t>(
            std::ranges::count_if(lines, [&](std::string_view line) { return count_cells(line, separator) == count; }));
        if (count > 1 && std::tuple(even, count) > best) {
            best = {even, count};
            found = separator;
        }
    }
    const std::size_t words = lines.empty() ? 0 : count_words(lines.front());
    const bool spaced = words > 1 && std::ranges::all_of(lines.begin(), lines.end() - (lines.size() > 1 ? 1 : 0),
                                                         [&](auto line) { return count_words(line) == words; });
    return found != 0 ? found : spaced ? ' ' : ',';
}

struct CsvFile::Impl {
    std::string path;
    CsvOptions options;
    CsvSplitter splitter;
    std::vector<std::string> columns{};
    std::vector<std::string> comment{};
    Cells cells{};
    std::size_t longer = 0;
    std::int64_t first_longer = 0;

    /// False for what is no record of data: a comment, the header.
    bool is_record() {
        if (!columns.empty()) {
            return true;
        }
        if (cells.front().starts_with('#') && !options.header) {
            comment.assign(cells.begin(), cells.end());
            comment.front().erase(0, 1);
            if (trimmed(comment.front()).empty()) {
                comment.erase(comment.begin());
            }
            return false;
        }
        const bool header = is_header(cells, options);
        const bool commented = !header && comment.size() == cells.size();
        columns = column_names(commented ? Cells(comment.begin(), comment.end()) : cells, header || commented);
        return !header;
    }

    void count_longer() {
        const auto beyond = cells.begin() + static_cast<std::ptrdiff_t>(std::min(cells.size(), columns.size()));
        if (std::any_of(beyond, cells.end(), [](std::string_view cell) { return !cell.empty(); })) {
            first_longer = longer++ == 0 ? splitter.line() : first_longer;
        }
    }
};

CsvFile::CsvFile(const std::string& path, const CsvOptions& options)
    : impl_(std::make_unique<Impl>(Impl{path, options, CsvSplitter(path)})) {
    impl_->splitter.set_separator(options.separator != 0 ? options.separator : separator_of(impl_->splitter.head()));
}

CsvFile::~CsvFile() = default;
CsvFile::CsvFile(CsvFile&&) noexcept = default;

Table CsvFile::next(std::size_t most) {
    Table table;
    bool more = true;
    while (table.rows() < most && (more = impl_->splitter.next(impl_->cells))) {
        if (!impl_->is_record()) {
            continue;
        }
        table.cells.resize(impl_->columns.size());
        append_record(table, impl_->cells);
        table.lines.push_back(impl_->splitter.line());
        impl_->count_longer();
    }
    table.columns = impl_->columns;
    table.cells.resize(table.columns.size());
    if (!more && impl_->longer > 0) {
        table.notes.push_back(
            fmt::format("{}: {} records have more cells than the header has columns, which are ignored; the "
                        "first is on line {}",
                        impl_->path, impl_->longer, impl_->first_longer));
        impl_->longer = 0;
    }
    return table;
}

Table read_csv_file(const std::string& path, const CsvOptions& options) {
    return CsvFile(path, options).next();
}

}  // namespace terratet
