// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// AGS 3.1 (1999) and 4 (2011 on): groups of quoted, comma-separated rows. https://www.ags.org.uk/data-format
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "io/base/parse_number.hpp"
#include "io/base/text_lines.hpp"
#include "io/read/logs/well_file.hpp"
#include "io/read/logs/well_words.hpp"
#include "tess/error.hpp"

namespace terratet {

namespace {

struct Group {
    std::string name;
    std::vector<std::string> headings;
    std::vector<std::string> units;
    std::vector<std::string> types;
    std::vector<std::vector<std::string>> rows;
    std::vector<std::int64_t> lines;

    [[nodiscard]] int column(const std::string& heading) const {
        const auto found = std::ranges::find(headings, heading);
        return found == headings.end() ? -1 : static_cast<int>(found - headings.begin());
    }
    [[nodiscard]] std::string cell(std::size_t row, int column) const {
        return column >= 0 && static_cast<std::size_t>(column) < rows[row].size()
                   ? rows[row][static_cast<std::size_t>(column)]
                   : "";
    }
    [[nodiscard]] std::string cell(std::size_t row, const std::string& heading) const {
        return cell(row, column(heading));
    }
};

/// Fields of a row: quoted, a quotation mark within doubled.
std::vector<std::string> fields(std::string_view line) {
    std::vector<std::string> result(1);
    bool quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const char c = line[i];
        if (c == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"') {
            result.back() += '"';
            ++i;
        } else if (c == '"') {
            quoted = !quoted;
        } else if (c == ',' && !quoted) {
            result.emplace_back();
        } else {
            result.back() += c;
        }
    }
    for (std::string& field : result) {
        field = to_utf8(trimmed(field));
    }
    return result;
}

/// Groups of either edition, in the order of the file.
class Groups {
  public:
    explicit Groups(const std::string& path) {
        LineReader reader(path);
        std::string_view line;
        while (reader.next(line)) {
            const std::string_view text = trimmed(line);
            if (!text.empty()) {
                add(fields(text), reader.number());
            }
        }
        bytes = reader.bytes();
    }

    [[nodiscard]] const Group* find(const std::string& name) const {
        const auto found = std::ranges::find(groups, name, &Group::name);
        return found == groups.end() ? nullptr : &*found;
    }

    std::vector<Group> groups;
    bool third = false;  ///< edition 3
    std::uint64_t bytes = 0;
    std::vector<std::pair<std::int64_t, std::string>> rejected;

  private:
    void add(std::vector<std::string> row, std::int64_t line) {
        const std::string word = row.front();
        if (word.starts_with("**") || word == "GROUP") {
            third = third || word.starts_with("**");
            const std::string name = word.starts_with("**") ? word.substr(2) : row.size() > 1 ? row[1] : "";
            const auto known = std::ranges::find(groups, name, &Group::name);
            at_ = static_cast<std::size_t>(known - groups.begin());
            if (known == groups.end()) {
                groups.push_back({name, {}, {}, {}, {}, {}});
            }
            begun_ = false;
            return;
        }
        if (groups.empty()) {
            return;
        }
        Group& group = groups[at_];
        if (word.starts_with('*')) {
            while (row.back().empty()) {
                row.pop_back();  // what goes on in the next line ends in a comma
            }
            for (std::string& heading : row) {  // edition 3 goes on with headings in a second line
                heading.erase(0, heading.find_first_not_of("*?"));
            }
            group.headings = begun_ ? std::move(group.headings) : std::vector<std::string>{};
            group.headings.insert(group.headings.end(), row.begin(), row.end());
            begun_ = true;
        } else if (word == "<UNITS>") {
            group.units = std::move(row);
        } else if (word == "<CONT>") {
            for (std::size_t i = 1; i < row.size() && !group.rows.empty() && i < group.rows.back().size(); ++i) {
                group.rows.back()[i] += row[i];
            }
        } else if (third) {
            take(group, std::move(row), line);
        } else {
            row.erase(row.begin());
            if (word == "HEADING") {
                group.headings = std::move(row);
            } else if (word == "UNIT") {
                group.units = std::move(row);
            } else if (word == "TYPE") {
                group.types = std::move(row);
            } else if (word == "DATA") {
                take(group, std::move(row), line);
            }
        }
    }

    void take(Group& group, std::vector<std::string> row, std::int64_t line) {
        if (row.size() != group.headings.size() && rejected.size() < 1000) {
            rejected.emplace_back(line, fmt::format("group {}: {} fields where {} are headed", group.name, row.size(),
                                                    group.headings.size()));
        }
        if (row.size() <= group.headings.size()) {
            group.rows.push_back(std::move(row));
            group.lines.push_back(line);
        }
    }

    std::size_t at_ = 0;
    bool begun_ = false;
};

/// Is a heading's type one of numbers? Edition 3 has no types: what holds only numbers is one.
bool is_numeric(const Group& group, std::size_t column) {
    if (column < group.types.size() && !group.types[column].empty()) {
        const std::string& type = group.types[column];
        return type.ends_with("DP") || type.ends_with("SF") || type.ends_with("SCI") || type == "MC";
    }
    bool any = false;
    for (std::size_t row = 0; row < group.rows.size(); ++row) {
        const std::string cell = group.cell(row, static_cast<int>(column));
        if (!cell.empty() && !parse_number(cell) && !parse_bound(cell)) {
            return false;
        }
        any = any || !cell.empty();
    }
    return any;
}

class AgsReader {
  public:
    explicit AgsReader(const Source& source) : file_(source.describe()), groups_(source.path) {}

    WellFile read() {
        result_.format = groups_.third ? "AGS 3" : "AGS " + edition();
        result_.rejected = groups_.rejected;
        const Group* const holes = groups_.find(groups_.third ? "HOLE" : "LOCA");
        id_ = groups_.third ? "HOLE_ID" : "LOCA_ID";
        result_.collars = collar_table(file_);
        if (holes) {
            collars(*holes);
        }
        directions();
        if (const Group* const project = groups_.find("PROJ"); project && !project->rows.empty()) {
            result_.facts.emplace_back("project", project->cell(0, "PROJ_NAME"));
        }
        for (const Group& group : groups_.groups) {
            if (&group != holes && group.name != "HORN") {
                log(group);
            }
        }
        if (!holes && result_.logs.empty()) {
            throw InputError(fmt::format("{}: is {} without a group {} and without one that has depths; groups: {}",
                                         file_, result_.format, groups_.third ? "HOLE" : "LOCA", names()));
        }
        return std::move(result_);
    }

  private:
    std::string edition() const {
        const Group* const how = groups_.find("TRAN");
        const std::string said = how && !how->rows.empty() ? how->cell(0, "TRAN_AGS") : "";
        return said.empty() ? "4" : said;
    }

    std::string names() const {
        std::string text;
        for (const Group& group : groups_.groups) {
            text += (text.empty() ? "" : ", ") + group.name;
        }
        return text;
    }

    void collars(const Group& holes) {
        const std::string stem = groups_.third ? "HOLE_" : "LOCA_";
        std::string grid;
        std::size_t without = 0;
        const bool plane = has_numbers(holes, stem + "NATE");
        const bool local = !plane && has_numbers(holes, stem + "LOCX");
        const bool globe = !plane && !local && has_numbers(holes, stem + "LON");
        const auto place = [&](std::size_t row, const char* east, const char* x, const char* lon) {
            return holes.cell(row, stem + (plane ? east : local ? x : lon));
        };
        for (std::size_t row = 0; row < holes.rows.size(); ++row) {
            const std::string x = place(row, "NATE", "LOCX", "LON");
            const std::string y = place(row, "NATN", "LOCY", "LAT");
            const std::string z = holes.cell(row, stem + (local ? "LOCZ" : "GL"));
            if (x.empty() && y.empty()) {
                ++without;
                continue;
            }
            add_collar(result_.collars, holes.cell(row, id_), x, y, z, holes.cell(row, stem + "FDEP"),
                       holes.lines[row]);
            const std::string said = holes.cell(row, stem + (globe ? "LLZ" : "GREF"));
            grid = grid.empty() ? said : grid;
        }
        result_.facts.emplace_back("holes", std::to_string(holes.rows.size()));
        result_.collars.crs = local ? Crs{} : crs_by_name(grid);
        if (globe && !result_.collars.crs.geographic) {
            result_.collars.crs = crs_of_datum("WGS84");
            result_.notes.emplace_back("its latitudes and longitudes are taken for WGS 84");
        } else if (!globe && result_.collars.crs.geographic) {
            result_.collars.crs = {};
        }
        if (!result_.collars.crs.empty() && !grid.empty()) {
            result_.notes.push_back(fmt::format("{}GREF '{}' is taken for {}", stem, grid, result_.collars.crs.name));
        }
        if (without > 0) {
            result_.notes.push_back(fmt::format("{} of {} holes have no coordinates", without, holes.rows.size()));
        }
    }

    static bool has_numbers(const Group& group, const std::string& heading) {
        const int column = group.column(heading);
        for (std::size_t row = 0; column >= 0 && row < group.rows.size(); ++row) {
            if (parse_number(group.cell(row, column))) {
                return true;
            }
        }
        return false;
    }

    /// HORN: azimuth and plunge of a length of hole; in edition 3 HOLE_ORNT and HOLE_INCL of the whole.
    void directions() {
        const Group* const group = groups_.find(groups_.third ? "HOLE" : "HORN");
        const std::string stem = groups_.third ? "HOLE_" : "HORN_";
        if (!group || !has_numbers(*group, stem + "INCL")) {
            return;
        }
        LogTable table(file_ + " (" + group->name + ")");
        for (const char* name : {"HOLE", "DEPTH", "AZIMUTH", "DIP"}) {
            table.add_column(name, "");
        }
        for (std::size_t row = 0; row < group->rows.size(); ++row) {
            const std::string incl = group->cell(row, stem + "INCL");
            if (parse_number(incl)) {
                const std::string top = groups_.third ? "0" : group->cell(row, "HORN_TOP");
                table.add_row({group->cell(row, id_), top.empty() ? "0" : top, group->cell(row, stem + "ORNT"), incl},
                              group->lines[row], groups_.bytes);
            }
        }
        Table finished = table.finish();
        finished.stated.meanings = {{Meaning::id, 0}, {Meaning::depth, 1}, {Meaning::azimuth, 2}, {Meaning::dip, 3}};
        finished.stated.metres_per_depth = 1;
        if (finished.rows() > 0) {
            result_.surveys.push_back(std::move(finished));
        }
    }

    /// A group that has holes and depths is a log; a result of a laboratory stands where its specimen or sample was
    /// taken.
    void log(const Group& group) {
        const int id = group.column(id_);
        if (id < 0 || group.rows.empty()) {
            return;
        }
        const auto own = [&](std::initializer_list<const char*> tails) {
            for (const char* tail : tails) {
                if (const int column = group.column(group.name + tail); column >= 0) {
                    return column;
                }
            }
            return -1;
        };
        int top = own({"_TOP", "_FROM", "_DPTH", "_DEPTH", "_DEP", "_TDEP", "_STRT"});
        const int base = own({"_BASE", "_TO", "_BDEP"});
        const int specimen = group.column("SPEC_DPTH") >= 0 ? group.column("SPEC_DPTH") : group.column("SPEC_DEP");
        const int sample = group.column("SAMP_TOP");
        const int sample_id = group.column("SAMP_ID");
        if (top < 0 && specimen < 0 && sample < 0 && sample_id < 0) {
            return;
        }
        LogTable table(file_ + " (" + group.name + ")");
        for (std::size_t column = 0; column < group.headings.size(); ++column) {
            table.add_column(group.headings[column], column < group.units.size() ? group.units[column] : "");
        }
        const int from = table.add_column("depth", "m");
        const int to = table.add_column("base", "m");
        bool intervals = false;
        std::size_t lost = 0;
        for (std::size_t row = 0; row < group.rows.size(); ++row) {
            std::vector<std::string> cells = group.rows[row];
            std::string depth = group.cell(row, top);
            for (const int other : {specimen, sample}) {
                depth = depth.empty() ? group.cell(row, other) : depth;
            }
            if (depth.empty() && sample_id >= 0) {
                depth = sample_top(group.cell(row, id), group.cell(row, sample_id));
            }
            if (depth.empty()) {
                ++lost;
                continue;
            }
            const std::string end = top >= 0 ? group.cell(row, base) : "";
            intervals = intervals || (!end.empty() && end != depth);
            cells.resize(group.headings.size());
            cells.push_back(depth);
            cells.push_back(end);
            table.add_row(cells, group.lines[row], groups_.bytes);
        }
        if (lost > 0) {
            result_.notes.push_back(fmt::format("group {}: {} rows have no depth", group.name, lost));
        }
        if (lost == group.rows.size()) {
            return;
        }
        place(table.finish(), group, id, from, intervals ? to : -1);
    }

    void place(Table table, const Group& group, int id, int from, int to) {
        StatedColumns& stated = table.stated;
        stated.meanings = {{Meaning::id, id}};
        if (to >= 0) {
            stated.meanings.insert(stated.meanings.end(), {{Meaning::from, from}, {Meaning::to, to}});
        } else {
            stated.meanings.emplace_back(Meaning::depth, from);
        }
        stated.metres_per_depth = 1;
        stated.one_of_several = true;
        for (std::size_t column = 0; column < group.headings.size(); ++column) {
            const std::string& heading = group.headings[column];
            const bool key = !heading.starts_with(group.name + "_") || heading.ends_with("_TOP") ||
                             heading.ends_with("_BASE") || heading.ends_with("_DPTH") || heading.ends_with("_FROM") ||
                             heading.ends_with("_TO");
            if (key || !is_numeric(group, column)) {
                stated.asides.push_back(static_cast<int>(column));
            }
        }
        stated.asides.insert(stated.asides.end(), {from, static_cast<int>(group.headings.size()) + 1});
        result_.logs.push_back(std::move(table));
    }

    std::string sample_top(const std::string& hole, const std::string& sample) {
        const Group* const samples = groups_.find("SAMP");
        if (samples && sample_tops_.empty()) {
            for (std::size_t row = 0; row < samples->rows.size(); ++row) {
                sample_tops_.emplace(std::pair(samples->cell(row, id_), samples->cell(row, "SAMP_ID")),
                                     samples->cell(row, "SAMP_TOP"));
            }
        }
        const auto found = sample_tops_.find({hole, sample});
        return found == sample_tops_.end() ? "" : found->second;
    }

    std::string file_;
    Groups groups_;
    std::string id_;
    WellFile result_;
    std::map<std::pair<std::string, std::string>, std::string> sample_tops_;
};

}  // namespace

WellFile read_ags(const Source& source) {
    return AgsReader(source).read();
}

}  // namespace terratet
