// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read/logs/las_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "io/base/parse_number.hpp"
#include "io/base/text_lines.hpp"
#include "tess/error.hpp"

namespace terratet {

namespace {

constexpr std::size_t longest_row = 1 << 20;
constexpr std::uint64_t most_rejections = 1000;

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

/// At a blank or more; what stands in quotation marks is one.
void split_at_blanks(std::string_view line, std::vector<std::string_view>& tokens) {
    const char* at = line.data();
    const char* const end = at + line.size();
    while (at != end) {
        while (at != end && is_blank(*at)) {
            ++at;
        }
        if (at == end) {
            return;
        }
        const char* const begin = at;
        if (*at == '"') {
            const char* const close = std::find(at + 1, end, '"');
            at = close == end ? end : close + 1;
        }
        while (at != end && !is_blank(*at)) {
            ++at;
        }
        tokens.emplace_back(begin, static_cast<std::size_t>(at - begin));
    }
}

void split_at(char delimiter, std::string_view line, std::vector<std::string_view>& tokens) {
    std::size_t begin = 0;
    bool quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        quoted = quoted != (line[i] == '"');
        if (line[i] == delimiter && !quoted) {
            tokens.push_back(line.substr(begin, i - begin));
            begin = i + 1;
        }
    }
    tokens.push_back(line.substr(begin));
}

bool quotation_is_open(std::string_view text) {
    return std::ranges::count(text, '"') % 2 == 1;
}

}  // namespace

LasRows::LasRows(const LasHeader& header, const LasSection& section, std::vector<LasItem> items,
                 const std::string& file)
    : name_(section.name),
      items_(std::move(items)),
      titles_(section.titles),
      table_(file),
      delimiter_(header.delimiter),
      delimiter_said_(header.delimiter_said),
      wrapped_(header.wrapped && section.name == "LOG") {
    if (const auto null = header.well.find("NULL"); null != header.well.end()) {
        null_text_ = null->second.value;
        null_ = parse_number(null_text_);
    }
}

/// From the first row: the delimiter where none is said, wrapping that is not said, columns where none are defined.
void LasRows::begin(std::string_view line) {
    begun_ = true;
    split(line);
    if (!delimiter_said_ && delimiter_ == ' ' && line.find(',') != std::string_view::npos) {
        std::vector<std::string_view> by_comma;
        split_at(',', line, by_comma);
        const bool fits = items_.empty() ? tokens_.size() == 1 : by_comma.size() == items_.size();
        if (fits && tokens_.size() != items_.size()) {
            delimiter_ = ',';
            split(line);
        }
    }
    const bool titled = titles_.size() == tokens_.size();
    if (items_.empty()) {
        for (std::size_t i = 0; i < tokens_.size(); ++i) {
            items_.push_back({titled ? titles_[i] : i == 0 ? "DEPT" : fmt::format("C{}", i), "", "", "", 0});
        }
        notes.push_back(fmt::format("the file defines no curves: {} columns, named {}", items_.size(),
                                    titled ? "as the data section's title says" : "by number"));
    }
    if (!wrapped_ && tokens_.size() == 1 && items_.size() > 2) {
        wrapped_ = true;
        notes.emplace_back("its rows are wrapped, though the header does not say so");
    }
    for (const LasItem& item : items_) {
        table_.add_column(item.mnemonic, item.unit);
    }
    for (std::size_t extra = items_.size(); !wrapped_ && extra < tokens_.size(); ++extra) {
        table_.add_column("", "");  // a curve that nobody defined
    }
    if (!wrapped_ && tokens_.size() > items_.size()) {
        notes.push_back(fmt::format("rows have {} columns, {} are defined: the others are called UNKNOWN",
                                    tokens_.size(), items_.size()));
    }
}

void LasRows::split(std::string_view line) {
    tokens_.clear();
    if (delimiter_ == ' ') {
        split_at_blanks(line, tokens_);
    } else {
        split_at(delimiter_, line, tokens_);
    }
}

/// Numbers without a blank between them, for want of room: "7.330-19508.961" are two; "7.020101130.188" are two of
/// which nobody knows where the first one ends.
void LasRows::split_run_on() {
    std::vector<std::string_view> apart;
    for (std::string_view token : tokens_) {
        for (std::size_t i = 1; i < token.size(); ++i) {
            if (token[i] == '-' && is_digit(token[i - 1])) {
                apart.push_back(token.substr(0, i));
                token.remove_prefix(i);
                i = 0;
            }
        }
        if (std::ranges::count(token, '.') >= 2) {
            apart.insert(apart.end(), static_cast<std::size_t>(std::ranges::count(token, '.')), std::string_view());
        } else {
            apart.push_back(token);
        }
    }
    if (apart.size() == table_.columns()) {
        tokens_ = std::move(apart);
        ++run_on_;
    }
}

std::string LasRows::cell(std::string_view token) const {
    if (!token.empty() && !null_text_.empty() && token.front() == null_text_.front()) {
        double value = 0;
        const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), value);
        const bool whole = error == std::errc() && end == token.data() + token.size();
        if ((null_ && whole && std::abs(value - *null_) <= 1e-9 * std::abs(*null_)) || token == null_text_) {
            return {};
        }
    }
    return log_cell(token);
}

void LasRows::reject(std::int64_t number, std::string reason) {
    if (++rejections_ <= most_rejections) {
        rejected.emplace_back(number, std::move(reason));
    }
}

void LasRows::take_row(std::int64_t number, std::uint64_t bytes) {
    const std::size_t columns = table_.columns();
    if (tokens_.size() < columns && delimiter_ == ' ') {
        split_run_on();
    }
    short_rows_ += tokens_.size() < columns ? 1 : 0;
    if (tokens_.size() > columns) {
        ++long_rows_;
        if (delimiter_ == ' ') {
            reject(number, fmt::format("{} columns where {} are defined", tokens_.size(), columns));
            return;
        }
    }
    for (std::size_t column = 0; column < columns; ++column) {
        table_.put(column, column < tokens_.size() ? cell(tokens_[column]) : std::string());
    }
    table_.end_row(number, bytes);
}

/// Rows that go over lines: a row is whole when it has all its columns.
void LasRows::add_wrapped(std::int64_t number, std::uint64_t bytes) {
    const std::size_t columns = table_.columns();
    if (table_.table().rows() == 0 && wrapped_cells_.size() == 1) {
        depth_alone_ = tokens_.size() > 1;
    }
    const bool new_row =
        depth_alone_ && tokens_.size() == 1 && wrapped_cells_.size() > 1 && wrapped_cells_.size() + 1 != columns;
    if (new_row || wrapped_cells_.size() + tokens_.size() > columns) {
        if (!wrapped_cells_.empty()) {
            reject(number, fmt::format("the wrapped row before this line has {} columns where {} are defined",
                                       wrapped_cells_.size(), columns));
            wrapped_cells_.clear();
        }
        if (tokens_.size() > columns) {
            reject(number, fmt::format("{} columns where {} are defined", tokens_.size(), columns));
            return;
        }
    }
    for (const std::string_view token : tokens_) {
        wrapped_cells_.push_back(cell(token));
    }
    if (wrapped_cells_.size() == columns) {
        table_.add_row(wrapped_cells_, number, bytes);
        wrapped_cells_.clear();
    }
}

void LasRows::add(std::string_view line, std::int64_t number, std::uint64_t bytes) {
    const std::string_view text = trimmed(line);
    constexpr std::string_view end_of_file = "\x1A";  // of DOS
    if (open_.empty() && (text.empty() || text.front() == '#' || text == end_of_file)) {
        return;
    }
    if (delimiter_ != ' ' && (!open_.empty() || line.find('"') != std::string_view::npos)) {
        open_line_ = open_.empty() ? number : open_line_;
        open_ += open_.empty() ? "" : " ";
        open_ += line;
        if (quotation_is_open(open_) && open_.size() < longest_row) {
            return;
        }
        const std::string whole = std::move(open_);
        open_.clear();
        if (!begun_) {
            begin(whole);
        }
        split(whole);
        take_row(open_line_, bytes);
        return;
    }
    if (!begun_) {
        begin(line);
    }
    split(delimiter_ == '\t' ? line : text);
    if (wrapped_) {
        add_wrapped(number, bytes);
    } else {
        take_row(number, bytes);
    }
}

Table LasRows::finish() {
    if (!begun_) {
        for (const LasItem& item : items_) {
            table_.add_column(item.mnemonic, item.unit);
        }
    }
    if (!open_.empty()) {
        reject(open_line_, "a quotation that is not closed");
    }
    if (!wrapped_cells_.empty()) {
        reject(0, fmt::format("the last wrapped row has {} columns where {} are defined", wrapped_cells_.size(),
                              table_.columns()));
    }
    if (rejections_ > most_rejections) {
        rejected.emplace_back(0, fmt::format("{} further rows were rejected likewise", rejections_ - most_rejections));
    }
    const auto tell = [&](std::size_t count, const char* what) {
        if (count > 0) {
            notes.push_back(fmt::format("{} rows {}", count, what));
        }
    };
    tell(short_rows_, "end early: their last columns have no value");
    tell(delimiter_ == ' ' ? 0 : long_rows_, "have more columns than are defined: those are left out");
    tell(run_on_, "have numbers that run together: parted at the minus sign, without value where that does not tell");
    return table_.finish();
}

}  // namespace terratet
