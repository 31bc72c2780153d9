// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>

#include "io/base/parse_number.hpp"
#include "io/base/text_lines.hpp"
#include "io/read/logs/las_header.hpp"
#include "io/read/logs/las_place.hpp"
#include "io/read/logs/las_rows.hpp"
#include "io/read/logs/well_file.hpp"
#include "io/read/logs/well_words.hpp"
#include "tess/error.hpp"
#include "tess/samples.hpp"

namespace terratet {

namespace {

bool is_depth_name(const std::string& mnemonic) {
    static constexpr std::array<std::string_view, 9> names{"DEPT", "DEPTH",  "MD",    "MDEPTH",       "DEP",
                                                           "DPTH", "DEPTMD", "DEPTM", "MEASUREDDEPTH"};
    return std::ranges::find(names, bare(mnemonic)) != names.end();
}

bool is_time(const LasItem& item) {
    const std::string unit = bare(item.unit);
    const std::string name = bare(item.mnemonic);
    return unit == "S" || unit == "SEC" || unit == "MS" || unit == "MIN" || name == "TIME" || name == "ETIM";
}

/// Which column is the top or the bottom of an interval (LAS 3: CORET, LITHB, DTOP, …).
bool is_end(const LasItem& item, bool top) {
    const std::string name = bare(item.mnemonic);
    const std::string text = bare(item.description);
    const bool number = item.description.find("{S") == std::string::npos;
    const bool named =
        top ? name.ends_with("T") || name.find("TOP") != std::string::npos
            : name.ends_with("B") || name.find("BOT") != std::string::npos || name.find("BASE") != std::string::npos;
    const bool said = text.find("DEPTH") != std::string::npos &&
                      (top ? text.find("TOP") != std::string::npos
                           : text.find("BOTTOM") != std::string::npos || text.find("BASE") != std::string::npos);
    return number && named && said;
}

int column_where(const std::vector<LasItem>& items, const auto& holds) {
    const auto found = std::ranges::find_if(items, holds);
    return found == items.end() ? -1 : static_cast<int>(found - items.begin());
}

/// The index of a log: the first column, but where another one is the depth.
int index_column(const std::vector<LasItem>& items) {
    const bool first =
        items.empty() || is_depth_name(items.front().mnemonic) || metres_in_log_unit(items.front().unit) > 0;
    const int depth = first ? 0 : column_where(items, [](const LasItem& item) { return is_depth_name(item.mnemonic); });
    return std::max(depth, 0);
}

/// One file while it is read.
class LasReader {
  public:
    explicit LasReader(const Source& source) : file_(source.describe()), path_(source.path) {}

    WellFile read() {
        LineReader reader(path_);
        std::string_view line;
        while (reader.next(line)) {
            const std::string_view text = trimmed(line);
            if (text.starts_with('~')) {
                end_section();
                section_ = las_section(text);
                begin_section();
            } else if (rows_) {
                rows_->add(line, reader.number(), reader.bytes());
            } else if (!text.empty() && text.front() != '#') {
                add_las_line(header_, section_, text, reader.number());
            }
        }
        end_section();
        return finish();
    }

  private:
    void begin_section() {
        if (section_.kind != LasSection::Kind::data) {
            return;
        }
        const auto defined = header_.definitions.find(section_.definition);
        std::vector<LasItem> items = section_.definition == "LOG"           ? header_.curves
                                     : defined == header_.definitions.end() ? std::vector<LasItem>{}
                                                                            : defined->second;
        rows_ = std::make_unique<LasRows>(header_, section_, std::move(items), file_);
    }

    void end_section() {
        if (!rows_) {
            return;
        }
        Table table = rows_->finish();
        const bool log = rows_->name() == "LOG";
        const std::string where = log ? "" : fmt::format("section {}: ", rows_->name());
        for (const std::string& note : rows_->notes) {
            result_.notes.push_back(where + note);
        }
        std::ranges::move(rows_->rejected, std::back_inserter(result_.rejected));
        if (table.rows() > 0) {
            place(std::move(table), rows_->items(), rows_->name());
        }
        rows_.reset();
    }

    /// States what the columns of a section are, and puts it where it belongs.
    void place(Table table, const std::vector<LasItem>& items, const std::string& name) {
        StatedColumns& stated = table.stated;
        if (name != "LOG") {
            const int number = ++sections_[name];
            table.file += " (" + name + (number > 1 ? fmt::format(" {})", number) : ")");
        }
        const int depth = index_column(items);
        const auto unit = [&](int column) { return metres_in_log_unit(items[static_cast<std::size_t>(column)].unit); };
        if (name.starts_with("INCLIN") || name.starts_with("DEVIATION") || name.starts_with("SURVEY")) {
            const auto named = [&](std::initializer_list<const char*> names) {
                return column_where(items, [&](const LasItem& item) {
                    return std::ranges::find(names, bare(item.mnemonic)) != names.end();
                });
            };
            const int azimuth = named({"AZIM", "AZI", "AZ", "AZIMUTH", "HAZI"});
            const int dip = named({"DEVI", "INCL", "INC", "INCLINATION", "DEV"});
            if (azimuth >= 0 && dip >= 0) {
                stated.meanings = {{Meaning::depth, depth}, {Meaning::azimuth, azimuth}, {Meaning::dip, dip}};
                stated.metres_per_depth = unit(depth);
                stated.inclination = true;
                result_.surveys.push_back(std::move(table));
                return;
            }
        }
        const int top = name == "LOG" ? -1 : column_where(items, [](const auto& item) { return is_end(item, true); });
        const int base = name == "LOG" ? -1 : column_where(items, [](const auto& item) { return is_end(item, false); });
        if (top >= 0 && base >= 0) {
            stated.meanings = {{Meaning::from, top}, {Meaning::to, base}};
        } else {
            stated.meanings = {{Meaning::depth, top >= 0 ? top : depth}};
        }
        stated.metres_per_depth = unit(stated.meanings.front().second);
        if (name == "LOG") {
            check_index(table, items, depth);
            result_.logs.insert(result_.logs.begin(), std::move(table));
        } else {
            result_.logs.push_back(std::move(table));
        }
    }

    /// Is the index a depth, and does it run as the header says?
    void check_index(Table& table, const std::vector<LasItem>& items, int depth) {
        const LasItem& index = items[static_cast<std::size_t>(depth)];
        const LasItem* const start = header_.find({"STRT"});
        if (is_time(index)) {
            throw InputError(fmt::format("{}: its index {} ({}) is a time, not a depth; export the log by depth", file_,
                                         index.mnemonic, index.unit));
        }
        if (table.stated.metres_per_depth == 0 && start) {
            table.stated.metres_per_depth = metres_in_log_unit(start->unit);
        }
        const bool depths = is_depth_name(index.mnemonic) || metres_in_log_unit(index.unit) > 0 ||
                            index.mnemonic.empty() || items.front().line == 0;
        if (depths || !count_depths(table)) {
            compare_ends(table.cells[static_cast<std::size_t>(depth)]);
        }
    }

    double header_number(const char* mnemonic) const {
        const LasItem* const item = header_.find({mnemonic});
        return item ? parse_number(item->value).value_or(missing) : missing;
    }

    /// A log without depths has as many rows as there are steps from STRT to STOP.
    bool count_depths(Table& table) {
        const double first = header_number("STRT");
        const double step = header_number("STEP");
        const double rows = (header_number("STOP") - first) / step + 1;
        if (!(std::abs(rows - static_cast<double>(table.rows())) < 1.5)) {
            return false;
        }
        table.columns.emplace_back("DEPT");
        table.stated.units.push_back(header_.find({"STRT"})->unit);
        table.cells.emplace_back();
        for (std::size_t row = 0; row < table.rows(); ++row) {
            table.cells.back().push_back(fmt::format("{:.10g}", first + static_cast<double>(row) * step));
        }
        table.stated.meanings = {{Meaning::depth, static_cast<int>(table.columns.size()) - 1}};
        result_.notes.push_back(
            fmt::format("the log has no depths: they are counted from STRT {} by STEP {}", first, step));
        return true;
    }

    void compare_ends(const TextColumn& cells) {
        const double step = header_number("STEP");
        const auto compare = [&](const char* mnemonic, const char* which, std::string_view cell) {
            const double said = header_number(mnemonic);
            const double near = step != 0 && std::isfinite(step) ? 1.5 * std::abs(step) : 1e-3 * std::abs(said) + 1;
            if (std::abs(said - parse_number(cell).value_or(missing)) > near) {
                result_.notes.push_back(
                    fmt::format("{} says {}, the {} depth is {}: the depths count", mnemonic, said, which, cell));
            }
        };
        compare("STRT", "first", cells.front());
        compare("STOP", "last", cells[cells.size() - 1]);
        if (const auto without = std::ranges::count(cells, std::string_view()); without > 0) {
            result_.notes.push_back(fmt::format("{} rows have no depth", without));
        }
    }

    WellFile finish() {
        result_.format = "LAS " + (header_.version.empty() ? "of no stated version" : header_.version);
        if (result_.logs.empty()) {
            throw InputError(fmt::format("{}: is {} without a row of data ({} curves in its header)", file_,
                                         result_.format, header_.curves.size()));
        }
        place_las(header_, path_, file_, result_);
        for (auto* tables : {&result_.logs, &result_.surveys}) {
            for (Table& table : *tables) {
                table.stated.one_of_several = true;
            }
        }
        return std::move(result_);
    }

    std::string file_;
    std::string path_;
    LasHeader header_;
    LasSection section_;
    std::map<std::string, int> sections_;
    std::unique_ptr<LasRows> rows_;
    WellFile result_;
};

}  // namespace

WellFile read_las(const Source& source) {
    return LasReader(source).read();
}

}  // namespace terratet
