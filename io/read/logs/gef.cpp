// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// GEF, the Dutch exchange format for cone penetration tests (GEF-CPT) and borings (GEF-BORE); a header of #KEY= values
// and rows of numbers. https://publicwiki.deltares.nl/display/STREAM/GEF
#include <cpl_conv.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "io/base/parse_number.hpp"
#include "io/base/text_lines.hpp"
#include "io/read/logs/well_file.hpp"
#include "io/read/logs/well_words.hpp"
#include "tess/error.hpp"

namespace terratet {

namespace {

struct Column {
    std::string unit;
    std::string name;
    int quantity = 0;
    std::optional<double> none;
};

std::vector<std::string> parts_of(std::string_view text, char separator) {
    std::vector<std::string> parts;
    while (true) {
        const std::size_t end = std::min(text.find(separator), text.size());
        parts.push_back(to_utf8(trimmed(text.substr(0, end))));
        if (end == text.size()) {
            return parts;
        }
        text.remove_prefix(end + 1);
    }
}

std::string without_quotes(std::string text) {
    const bool quoted = text.size() >= 2 && text.front() == '\'' && text.back() == '\'';
    return quoted ? text.substr(1, text.size() - 2) : text;
}

class GefReader {
  public:
    explicit GefReader(const Source& source) : file_(source.describe()), path_(source.path) {}

    WellFile read() {
        LineReader reader(path_);
        std::string_view line;
        bool data = false;
        while (reader.next(line)) {
            std::string_view text = trimmed(line);
            if (data) {
                row(text, reader.number(), reader.bytes());
            } else if (text.starts_with('#')) {
                const std::size_t equals = text.find('=');
                const std::string key = bare(text.substr(1, equals == std::string_view::npos ? equals : equals - 1));
                header(key, equals == std::string_view::npos ? "" : trimmed(text.substr(equals + 1)));
                data = key == "EOH";
                if (data) {
                    begin();
                }
            }
        }
        if (!data) {
            throw InputError(file_ + ": a GEF file without #EOH=, the end of its header; is it whole?");
        }
        return finish();
    }

  private:
    void header(const std::string& key, std::string_view value) {
        const std::vector<std::string> parts = parts_of(value, ',');
        const auto part = [&](std::size_t i) { return i < parts.size() ? parts[i] : ""; };
        const auto index = [&]() -> Column* {
            const auto number = parse_number(part(0));
            return number && *number >= 1 && *number <= 1000 ? &columns_[static_cast<int>(*number)] : nullptr;
        };
        if (key == "COLUMNINFO") {
            if (Column* const column = index()) {
                column->unit = part(1);
                column->name = part(2);
                column->quantity = static_cast<int>(std::clamp(parse_number(part(3)).value_or(0), 0.0, 1e6));
            }
        } else if (key == "COLUMNVOID") {
            if (Column* const column = index()) {
                column->none = parse_number(part(1));
            }
        } else if (key == "COLUMNSEPARATOR") {
            separator_ = value.empty() ? ' ' : value.front();
        } else if (key == "RECORDSEPARATOR") {
            record_end_ = value.empty() ? '\0' : value.front();
        } else if (key == "XYID") {
            system_ = part(0);
            x_ = part(1);
            y_ = part(2);
        } else if (key == "ZID") {
            z_ = part(1);
        } else if (key == "TESTID") {
            test_ = to_utf8(value);
        } else if (key == "MEASUREMENTVAR" && part(0) == "13") {
            excavated_ = parse_number(part(1)).value_or(0);
        } else if (key == "MEASUREMENTVAR" && part(0) == "16") {
            length_ = part(1);
        } else if (key == "REPORTCODE" || key == "PROCEDURECODE") {
            report_ += bare(part(0));
        } else if (key == "DATAFORMAT" && bare(part(0)) == "BINARY") {
            throw InputError(file_ + ": a GEF file with binary data, which is not read; export it with ASCII data");
        }
    }

    void begin() {
        if (columns_.empty()) {
            throw InputError(file_ + ": a GEF file without #COLUMNINFO=: nobody knows what its numbers are");
        }
        const int last = columns_.rbegin()->first;
        for (int i = 1; i <= last; ++i) {
            const Column& column = columns_[i];
            table_.add_column(column.name.empty() ? fmt::format("column {}", i) : column.name, column.unit);
        }
        numbers_ = static_cast<std::size_t>(last);
        if (report_.find("DISS") != std::string::npos) {
            throw InputError(file_ + ": a GEF dissipation test: pressures over time at one depth, no log by depth");
        }
        bore_ = report_.find("BORE") != std::string::npos;
        if (bore_) {
            for (const char* name : {"SOIL", "TEXT_2", "TEXT_3", "TEXT_4"}) {
                table_.add_column(name, "");
            }
        }
    }

    void row(std::string_view text, std::int64_t line, std::uint64_t bytes) {
        while (!text.empty() && (text.back() == record_end_ || text.back() == ' ' || text.back() == '!')) {
            text.remove_suffix(1);
        }
        if (text.empty()) {
            return;
        }
        std::vector<std::string> cells;
        if (separator_ == ' ') {
            for (std::string_view word = next_word(text); !word.empty(); word = next_word(text)) {
                cells.emplace_back(word);
            }
        } else {
            cells = parts_of(text, separator_);
            if (cells.back().empty() && cells.size() > numbers_) {
                cells.pop_back();
            }
        }
        if (cells.size() < numbers_ && result_.rejected.size() < 1000) {
            result_.rejected.emplace_back(line, fmt::format("{} columns where {} are defined", cells.size(), numbers_));
        }
        if (cells.size() < numbers_) {
            return;
        }
        for (std::size_t i = 0; i < cells.size(); ++i) {
            cells[i] = log_cell(without_quotes(std::move(cells[i])));
            const std::optional<double> none = i < numbers_ ? columns_[static_cast<int>(i) + 1].none : std::nullopt;
            if (none && parse_number(cells[i]) == none) {
                cells[i].clear();
            }
        }
        rows_.push_back({std::move(cells), line});
        bytes_ = bytes;
    }

    int quantity(int wanted) const {
        for (const auto& [index, column] : columns_) {
            if (column.quantity == wanted) {
                return index - 1;
            }
        }
        return -1;
    }

    WellFile finish() {
        result_.format = bore_ ? "GEF-BORE" : "GEF-CPT";
        if (rows_.empty()) {
            throw InputError(fmt::format("{}: is {} and has no row of data", file_, result_.format));
        }
        const std::string hole = test_.empty() ? CPLGetBasename(path_.c_str()) : test_;
        result_.collars = collar_table(file_);
        if (parse_number(x_) && parse_number(y_)) {
            add_collar(result_.collars, hole, x_, y_, parse_number(z_) ? z_ : "0", length_, 1);
            result_.collars.crs = system();
            if (!parse_number(z_)) {
                result_.notes.emplace_back("no #ZID=: its depths hang from height 0");
            }
        }
        result_.facts.emplace_back("well", hole);
        const int top = bore_ ? quantity(1) : -1;
        const int base = bore_ ? quantity(2) : -1;
        StatedColumns& stated = table_.table().stated;
        if (top >= 0 && base >= 0) {
            stated.meanings = {{Meaning::from, top}, {Meaning::to, base}};
        } else {
            stated.meanings = {{Meaning::depth, depths()}};
        }
        stated.metres_per_depth = 1;
        stated.hole_names = {hole, CPLGetBasename(path_.c_str())};
        stated.one_of_several = true;
        for (const Row& row : rows_) {
            table_.add_row(row.cells, row.line, bytes_);
        }
        result_.logs.push_back(table_.finish());
        return std::move(result_);
    }

    /// The column of depths of a sounding: its length, corrected for inclination where that is known. Lengths that are
    /// all negative count downwards all the same; what lies in the hole dug before is no measurement.
    int depths() {
        const auto length = static_cast<std::size_t>(std::max(quantity(1), 0));
        const int corrected = quantity(11);
        const std::size_t column = corrected >= 0 ? static_cast<std::size_t>(corrected) : length;
        bool downwards = false;
        bool upwards = false;
        for (Row& row : rows_) {
            std::string& cell = row.cells[column];
            cell = cell.empty() ? row.cells[length] : cell;
            const double depth = parse_number(cell).value_or(0);
            downwards = downwards || depth < 0;
            upwards = upwards || depth > 0;
        }
        if (downwards && !upwards) {
            result_.notes.emplace_back("its lengths are negative, and are taken for depths");
            for (Row& row : rows_) {
                std::string& cell = row.cells[column];
                cell.erase(0, cell.starts_with('-') ? 1 : 0);
            }
        }
        const auto dug = std::erase_if(
            rows_, [&](const Row& row) { return parse_number(row.cells[column]).value_or(excavated_) < excavated_; });
        if (rows_.empty()) {
            throw InputError(
                fmt::format("{}: all its {} rows lie in the {:g} m dug before the test; none is a measurement", file_,
                            dug, excavated_));
        }
        if (dug > 0) {
            result_.notes.push_back(
                fmt::format("{} rows lie in the {:g} m dug before the test and are left out", dug, excavated_));
        }
        for (const auto& [index, each] : columns_) {
            if (each.quantity == 1 || each.quantity == 11 || each.quantity == 12) {
                table_.table().stated.asides.push_back(index - 1);  // lengths and times
            }
        }
        return static_cast<int>(column);
    }

    Crs system() {
        static const std::map<std::string, const char*> codes{
            {"31000", "EPSG:28992"}, {"2", "EPSG:4326"}, {"00002", "EPSG:4326"}, {"32000", "EPSG:31370"}};
        const auto known = codes.find(system_);
        if (known == codes.end()) {
            result_.notes.push_back(fmt::format("#XYID= names the coordinate system {}, which is not known", system_));
            return {};
        }
        return parse_crs(known->second);
    }

    std::string file_;
    std::string path_;
    std::map<int, Column> columns_;
    std::size_t numbers_ = 0;
    char separator_ = ' ';
    char record_end_ = '\0';
    std::string system_;
    std::string x_;
    std::string y_;
    std::string z_;
    std::string test_;
    std::string length_;
    std::string report_;
    double excavated_ = 0;
    bool bore_ = false;
    struct Row {
        std::vector<std::string> cells;
        std::int64_t line = 0;
    };
    std::vector<Row> rows_;
    std::uint64_t bytes_ = 0;
    LogTable table_{file_};
    WellFile result_;
};

}  // namespace

WellFile read_gef(const Source& source) {
    return GefReader(source).read();
}

}  // namespace terratet
