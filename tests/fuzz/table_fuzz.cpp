// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Any bytes as a table in text: refused with an error of ours, or columns of equal length whose numbers are numbers.
// The first byte says whether GDAL splits the text or this program does, which is a hundred times faster.
#include <cpl_vsi.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "io/base/csv_text.hpp"
#include "io/base/text_lines.hpp"
#include "io/read/read_values.hpp"
#include "tess/error.hpp"

using namespace terratet;

namespace {

void require(bool holds) {
    if (!holds) {
        std::abort();
    }
}

Table split(std::string_view text) {
    Table table;
    table.file = "fuzz.csv";
    for (std::size_t row = 0; !text.empty(); ++row) {
        std::string_view line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(line.size() + 1, text.size()));
        for (std::size_t column = 0; row == 0 ? !line.empty() : column < table.columns.size(); ++column) {
            const std::string_view cell = line.substr(0, line.find(','));
            line.remove_prefix(std::min(cell.size() + 1, line.size()));
            if (row == 0) {
                table.columns.emplace_back(cell);
                table.cells.emplace_back();
            } else {
                table.cells[column].push_back(cell);
            }
        }
        if (row > 0) {
            table.lines.push_back(static_cast<std::int64_t>(row));
        }
    }
    return table;
}

/// What append_csv_text wrote, unquoted as RFC 4180 says.
std::string unquoted(const std::string& field) {
    if (!field.starts_with('"')) {
        return field;
    }
    std::string text;
    for (std::size_t i = 1; i + 1 < field.size(); ++i) {
        text += field[i];
        i += field[i] == '"' ? 1 : 0;
    }
    return text;
}

void check_cell(const std::string& cell) {
    for (const auto& number : {parse_number(cell), parse_bound(cell)}) {
        require(!number || std::isfinite(*number));
    }
    std::string field;
    append_csv_text(field, cell);
    require(without_formula_mark(unquoted(field)) == cell);
    normal_header(cell);
}

void check_table(const Table& table) {
    for (std::size_t column = 0; column < table.columns.size(); ++column) {
        require(table.cells[column].size() == table.rows());
        check_cell(table.columns[column]);
        for (const std::string_view cell : table.cells[column]) {
            check_cell(std::string(cell));
        }
    }
    for (const Meaning meaning : {Meaning::id, Meaning::x, Meaning::from, Meaning::name}) {
        const int found = find_column(table, meaning, {});
        require(found >= -1 && found < static_cast<int>(table.columns.size()));
    }
    Diagnostics diagnostics;
    std::vector<std::vector<std::string>> asked{{}};
    if (!table.columns.empty()) {
        asked.push_back({table.columns.front() + ":log10", table.columns.back() + ":categorical"});
    }
    for (const auto& wanted : asked) {
        try {
            PropertyCatalogue catalogue(wanted);
            Table given = table;
            for (const ValueColumn& column : catalogue.read(given, {}, diagnostics)) {
                require(column.property < catalogue.properties().size() && column.values.size() == table.rows());
                require(column.censored.empty() || column.censored.size() == table.rows());
                const std::size_t classes = catalogue.properties()[column.property].classes.size();
                for (const double value : column.values) {
                    require(!std::isinf(value));
                    require(classes == 0 || std::isnan(value) || (value >= 0 && value < static_cast<double>(classes)));
                }
            }
        } catch (const InputError&) {
        } catch (const UsageError&) {
        }
    }
}

void check_lines(const std::string& path, std::size_t size) {
    LineReader reader(path);
    std::string_view line;
    std::size_t bytes = 0;
    while (reader.next(line)) {
        bytes += line.size();
        require(line.find('\n') == std::string_view::npos);
    }
    require(bytes <= size + size / 2);  // UTF-16 as UTF-8
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size < 2) {
        return 0;
    }
    const std::string text(reinterpret_cast<const char*>(data) + 1, size - 1);
    if (data[0] % 64 != 0) {
        check_table(split(text));
        return 0;
    }
    Source source;
    source.path = "/vsimem/fuzz.csv";
    VSIFCloseL(VSIFileFromMemBuffer(source.path.c_str(), const_cast<GByte*>(data) + 1, size - 1, FALSE));
    try {
        check_lines(source.path, size);
        check_table(read_table(source));
    } catch (const InputError&) {
    }
    VSIUnlink(source.path.c_str());
    return 0;
}
