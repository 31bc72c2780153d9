// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read/tables/csv_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

#include "io/base/csv_text.hpp"
#include "io/base/lower_case.hpp"
#include "io/base/parse_number.hpp"
#include "io/base/text_lines.hpp"
#include "io/read/tables/csv_splitter.hpp"
#include "io/read/tables/geo_eas.hpp"
#include "io/read/tables/header_rows.hpp"

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

/// Without no-break blanks, narrow ones, and marks of no width at either end.
std::string without_wide_blanks(std::string text) {
    static constexpr std::array<std::string_view, 6> blanks{"\xC2\xA0",     "\xE2\x80\xAF", "\xE2\x80\x89",
                                                            "\xE2\x80\x8B", "\xEF\xBB\xBF", " "};
    for (bool again = true; again;) {
        again = false;
        for (const std::string_view blank : blanks) {
            if (text.starts_with(blank)) {
                text.erase(0, blank.size());
                again = true;
            } else if (text.ends_with(blank)) {
                text.resize(text.size() - blank.size());
                again = true;
            }
        }
    }
    return text;
}

/// A header that a spreadsheet broke into lines.
std::string one_line(std::string text) {
    std::erase(text, '\r');
    std::ranges::replace(text, '\n', ' ');
    return text;
}

void append_record(Table& table, const Cells& cells) {
    for (std::size_t column = 0; column < table.cells.size(); ++column) {
        const std::string_view cell = column < cells.size() ? cells[column] : std::string_view{};
        const std::string_view text = cell.starts_with('\'') ? without_formula_mark(cell) : cell;
        if (is_ascii(text)) {
            table.cells[column].push_back(text);
        } else {
            table.cells[column].push_back(without_wide_blanks(to_utf8(text)));
        }
    }
}

/// From the first record; field_1, field_2, … where it is none.
std::vector<std::string> column_names(const Cells& cells, bool header) {
    std::vector<std::string> names;
    for (std::size_t column = 0; column < cells.size(); ++column) {
        names.push_back(header
                            ? one_line(std::string(without_formula_mark(without_wide_blanks(to_utf8(cells[column])))))
                            : "field_" + std::to_string(column + 1));
    }
    return names;
}

std::vector<std::string> texts(const Cells& cells) {
    std::vector<std::string> names;
    std::ranges::transform(cells, std::back_inserter(names), [](std::string_view cell) { return to_utf8(cell); });
    return names;
}

bool is_header(const Cells& cells, const CsvOptions& options) {
    if (options.header) {
        return *options.header;
    }
    return std::ranges::none_of(cells, [](std::string_view cell) { return parse_number(cell).has_value(); }) ||
           names_columns(texts(cells));
}

/// The separator that a spreadsheet says in a line of its own; 0: it does not.
char said_separator(std::string_view head) {
    const std::string_view line = trimmed(head.substr(0, std::min(head.find_first_of("\r\n"), head.size())));
    return line.size() == 5 && lower_case(line.substr(0, 4)) == "sep=" ? line[4] : '\0';
}

bool is_blank_record(const Cells& cells) {
    constexpr std::string_view end_of_file = "\x1A";  // of DOS
    return std::ranges::all_of(cells, [](std::string_view cell) { return cell.empty(); }) ||
           (cells.size() == 1 && cells.front() == end_of_file);
}

/// Takes records in order and makes tables of them.
class TableBuilder {
  public:
    TableBuilder(std::string path, const CsvOptions& options) : path_(std::move(path)), options_(options) {}

    void add(const Cells& cells, std::int64_t line) {
        if (is_blank_record(cells) || (columns_.empty() && !begin(cells))) {
            return;
        }
        table_.cells.resize(columns_.size());
        append_record(table_, cells);
        table_.lines.push_back(line);
        const auto beyond = cells.begin() + static_cast<std::ptrdiff_t>(std::min(cells.size(), columns_.size()));
        if (std::any_of(beyond, cells.end(), [](std::string_view cell) { return !cell.empty(); })) {
            first_longer_ = longer_++ == 0 ? line : first_longer_;
        }
    }

    /// Columns that stand in no record.
    void set_columns(std::vector<std::string> names) { columns_ = std::move(names); }

    void note(std::string text) { table_.notes.push_back(std::move(text)); }

    [[nodiscard]] std::size_t rows() const { return table_.rows(); }

    /// What was added since the last call.
    Table take() {
        table_.columns = columns_;
        table_.cells.resize(columns_.size());
        return std::exchange(table_, {});
    }

    /// At the end of the text.
    void note_longer() {
        if (longer_ > 0) {
            note(
                fmt::format("{}: {} records have more cells than the header has columns, which are ignored; the "
                            "first is on line {}",
                            path_, longer_, first_longer_));
        }
        longer_ = 0;
    }

  private:
    /// Names the columns; is the record one with values?
    bool begin(const Cells& cells) {
        if (cells.front().starts_with('#') && !options_.header) {
            comment_.assign(cells.begin(), cells.end());
            comment_.front().erase(0, 1);
            if (trimmed(comment_.front()).empty()) {
                comment_.erase(comment_.begin());
            }
            return false;
        }
        const bool header = is_header(cells, options_);
        const bool commented = !header && comment_.size() == cells.size();
        columns_ = column_names(commented ? Cells(comment_.begin(), comment_.end()) : cells, header || commented);
        return !header;
    }

    std::string path_;
    CsvOptions options_;
    Table table_;
    std::vector<std::string> columns_;
    std::vector<std::string> comment_;
    std::size_t longer_ = 0;
    std::int64_t first_longer_ = 0;
};

/// A record that is kept.
struct Record {
    std::vector<std::string> cells;
    std::int64_t line;
};

/// The first records of a text without those above its header, which are left out (noted).
std::vector<Record> first_records(CsvSplitter& splitter, bool says_separator, const CsvOptions& options,
                                  const std::string& path, TableBuilder& builder) {
    std::vector<Record> records;
    Cells cells;
    while (records.size() < most_title_rows && splitter.next(cells)) {
        if (!says_separator || splitter.line() != 1) {
            records.push_back({{cells.begin(), cells.end()}, splitter.line()});
        }
    }
    std::size_t comments = 0;
    while (comments < records.size() && records[comments].cells.front().starts_with('#')) {
        ++comments;
    }
    std::vector<std::vector<std::string>> names;
    for (std::size_t i = comments; i < records.size() && !options.header; ++i) {
        names.push_back(texts(Cells(records[i].cells.begin(), records[i].cells.end())));
    }
    if (const std::size_t titles = header_record(names); titles > 0) {
        builder.note(fmt::format("{}: the header is found on line {}; what stands above is passed over", path,
                                 records[comments + titles].line));
        records.erase(records.begin(), records.begin() + static_cast<std::ptrdiff_t>(comments + titles));
    }
    return records;
}

}  // namespace

char separator_of(std::string_view head) {
    const std::vector<std::string_view> lines = first_lines(head);
    const bool title = !lines.empty() && std::ranges::all_of(std::string_view("\t;|,"), [&](char separator) {
        return count_cells(lines.front(), separator) == 1;
    });
    const std::size_t typical = title && lines.size() > 2 ? lines.size() - 2 : 0;  // the last one may be cut
    std::tuple<std::size_t, std::size_t> best{0, 1};
    char found = 0;
    for (const char separator : {'\t', ';', '|', ','}) {
        const std::size_t count = lines.empty() ? 1 : count_cells(lines[typical], separator);
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
    CsvSplitter splitter;
    TableBuilder builder;
    std::vector<Record> first{};
    std::size_t used = 0;  ///< of the first ones

    Impl(const std::string& path, const CsvOptions& options) : splitter(path), builder(path, options) {
        if (auto geo_eas = options.header ? std::nullopt : geo_eas_header(splitter.head())) {
            begin_geo_eas(*geo_eas, path);
            return;
        }
        const char said = said_separator(splitter.head());
        splitter.set_separator(options.separator != 0 ? options.separator
                               : said != 0            ? said
                                                      : separator_of(splitter.head()));
        first = first_records(splitter, said != 0, options, path, builder);
    }

    void begin_geo_eas(GeoEasHeader& header, const std::string& path) {
        builder.note(fmt::format("{}: is a table of GSLIB (Geo-EAS): {} columns named above the numbers", path,
                                 header.columns.size()));
        builder.set_columns(std::move(header.columns));
        splitter.set_separator('\n');  // lines of the header are one cell each
        Cells cells;
        while (splitter.next(cells)) {
            if (splitter.line() == header.lines) {
                break;
            }
        }
        const std::string_view data = splitter.head().substr(0, splitter.head().find('\n'));
        splitter.set_separator(data.find(',') == std::string_view::npos ? ' ' : ',');
    }

    /// Adds up to `most` records to the table; false: the text is at its end.
    bool add(std::size_t most) {
        for (; builder.rows() < most && used < first.size(); ++used) {
            builder.add(Cells(first[used].cells.begin(), first[used].cells.end()), first[used].line);
        }
        Cells cells;
        while (builder.rows() < most) {
            if (!splitter.next(cells)) {
                return false;
            }
            builder.add(cells, splitter.line());
        }
        return true;
    }
};

CsvFile::CsvFile(const std::string& path, const CsvOptions& options) : impl_(std::make_unique<Impl>(path, options)) {}

CsvFile::~CsvFile() = default;
CsvFile::CsvFile(CsvFile&&) noexcept = default;

Table CsvFile::next(std::size_t most) {
    if (!impl_->add(most)) {
        impl_->builder.note_longer();
    }
    return impl_->builder.take();
}

Table read_csv_file(const std::string& path, const CsvOptions& options) {
    return CsvFile(path, options).next();
}

}  // namespace terratet
