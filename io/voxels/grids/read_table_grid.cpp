// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// A table of places and values, as `X;Y;Z;value` or a block model: a row a voxel, in any order, streamed twice: for
/// the axes, and for the values.

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <unordered_set>

#include "io/base/lower_case.hpp"
#include "io/base/parse_number.hpp"
#include "io/read/tables/csv_file.hpp"
#include "io/read/tables/csv_splitter.hpp"
#include "io/voxels/grids/grid_source.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

using Cells = std::vector<std::string_view>;

constexpr std::size_t most_places = 1'000'000;  ///< along an axis
constexpr std::size_t most_classes = 65536;
constexpr float no_value = std::numeric_limits<float>::quiet_NaN();

const std::vector<std::string> axis_names[3] = {
    {"x", "east", "easting", "e", "xc", "xcentre", "xcenter", "centroid_x", "x_centre", "xmid", "lon", "longitude"},
    {"y", "north", "northing", "n", "yc", "ycentre", "ycenter", "centroid_y", "y_centre", "ymid", "lat", "latitude"},
    {"z", "elev", "elevation", "rl", "zc", "zcentre", "zcenter", "centroid_z", "z_centre", "zmid", "height"}};

struct Column {
    std::size_t cell = 0;
    std::string name;
    bool text = false;
    std::map<std::string, float, std::less<>> classes;
};

/// The places along one axis as they come.
struct Axis {
    std::size_t cell = 0;
    std::unordered_set<double> seen;
    double last = std::numeric_limits<double>::quiet_NaN();
    double origin = 0;
    double step = 1;
    std::int64_t count = 1;

    void take(double place) {
        if (place != last) {
            seen.insert(place);
            last = place;
        }
    }
};

class TableGrid {
  public:
    explicit TableGrid(const Source& source) : source_(source) {}

    GridContents read(const std::string& spill) {
        stream([&](const Cells& cells, std::int64_t line) { survey(cells, line); });
        if (rows_ == 0) {
            throw InputError(source_.describe() + ": no row has three numbers for x, y and z");
        }
        if (std::ranges::any_of(columns_, &Column::text)) {
            stream([&](const Cells& cells, std::int64_t) { find_classes(cells); });
        }
        GridContents contents;
        place(contents.grid);
        contents.blocks = make_blocks(contents.grid, spill);
        counts_ = {};
        for (std::size_t a = 0; a < 3; ++a) {
            counts_[a] = (axes_[a].count + Brick::edge - 1) / Brick::edge;
        }
        blocks_.resize(static_cast<std::size_t>(counts_[0] * counts_[1] * counts_[2]));
        stream([&](const Cells& cells, std::int64_t line) { put(cells, line); });
        std::vector<std::size_t> same(columns_.size());
        for (std::size_t c = 0; c < same.size(); ++c) {
            same[c] = c;
        }
        for (std::size_t b = 0; b < blocks_.size(); ++b) {
            const auto n = static_cast<std::int64_t>(b);
            blocks_[b].resize(columns_.size());
            contents.blocks->put({n / (counts_[1] * counts_[2]), n / counts_[2] % counts_[1], n % counts_[2]},
                                 blocks_[b], same);
            blocks_[b] = {};
        }
        return contents;
    }

  private:
    void stream(const auto& take) {
        CsvSplitter splitter(source_.path);
        splitter.set_separator(separator_of(splitter.head()));
        Cells cells;
        bool first = true;
        while (splitter.next(cells)) {
            if (std::exchange(first, false) && find_columns(cells)) {
                continue;
            }
            take(cells, splitter.line());
        }
    }

    /// Returns whether the record is a header; without one the columns are x, y, z and values.
    bool find_columns(const Cells& cells) {
        const auto first = cells.begin();
        const bool header = std::any_of(first, first + std::min<std::ptrdiff_t>(3, std::ssize(cells)),
                                        [](std::string_view cell) { return !parse_number(cell); });
        if (!columns_.empty()) {
            return header;
        }
        std::vector<bool> taken(cells.size(), false);
        for (std::size_t a = 0; a < 3; ++a) {
            std::size_t found = header ? cells.size() : a;
            for (std::size_t c = 0; header && c < cells.size(); ++c) {
                const std::string name = lower_case(cells[c]);
                if (found == cells.size() && std::ranges::find(axis_names[a], name) != axis_names[a].end()) {
                    found = c;
                }
            }
            if (found >= cells.size()) {
                throw InputError(source_.describe() + ": a grid's table has columns x, y and z, and there is no " +
                                 axis_names[a].front() + " in its first row");
            }
            axes_[a].cell = found;
            taken[found] = true;
        }
        for (std::size_t c = 0; c < cells.size(); ++c) {
            const std::string name = lower_case(cells[c]);
            const bool size = header && (name == "dx" || name == "dy" || name == "dz");
            if (!taken[c] && !size) {
                columns_.push_back({c, header ? std::string(cells[c]) : "value" + std::to_string(c - 2), false, {}});
            }
        }
        if (columns_.empty()) {
            throw InputError(source_.describe() + ": a grid's table has a column of values beside x, y and z");
        }
        return header;
    }

    [[nodiscard]] bool place_of(const Cells& cells, double (&place)[3]) const {
        for (std::size_t a = 0; a < 3; ++a) {
            const auto number = axes_[a].cell < cells.size() ? parse_number(cells[axes_[a].cell]) : std::nullopt;
            if (!number) {
                return false;
            }
            place[a] = *number;
        }
        return true;
    }

    void survey(const Cells& cells, std::int64_t line) {
        double place[3];
        if (!place_of(cells, place)) {
            throw InputError(source_.describe() + ": line " + std::to_string(line) +
                             ": x, y and z are not three numbers; every row of a grid has them");
        }
        ++rows_;
        for (std::size_t a = 0; a < 3; ++a) {
            axes_[a].take(place[a]);
            if (axes_[a].seen.size() > most_places) {
                throw InputError(source_.describe() + ": more than a million places along " + axis_names[a].front() +
                                 ": no regular grid has so many");
            }
        }
        for (Column& column : columns_) {
            const std::string_view cell = column.cell < cells.size() ? cells[column.cell] : std::string_view();
            column.text = column.text || (!is_missing(cell) && !parse_number(cell));
        }
    }

    static bool is_missing(std::string_view cell) {
        const std::string text = lower_case(cell);
        return text.empty() || text == "nan" || text == "na" || text == "null" || text == "none" || text == "-";
    }

    void place(VoxelGrid& grid) {
        for (std::size_t a = 0; a < 3; ++a) {
            Axis& axis = axes_[a];
            std::vector<double> places(axis.seen.begin(), axis.seen.end());
            axis.seen = {};
            std::ranges::sort(places);
            axis.origin = places.front();
            double step = std::numeric_limits<double>::infinity();
            const double apart = 1e-9 * std::max(std::abs(places.front()), std::abs(places.back()));
            for (std::size_t n = 1; n < places.size(); ++n) {
                const double gap = places[n] - places[n - 1];
                step = gap > apart ? std::min(step, gap) : step;
            }
            if (std::isfinite(step)) {  // what the file rounds is spread over the whole length
                axis.count = std::llround((places.back() - places.front()) / step) + 1;
                axis.step = (places.back() - places.front()) / static_cast<double>(axis.count - 1);
            } else {
                axis.step = 0;
            }
            for (const double at : places) {
                const double n = axis.step == 0 ? 0 : (at - axis.origin) / axis.step;
                if (std::abs(n - std::round(n)) > 0.02) {
                    throw InputError(source_.describe() + ": places along " + axis_names[a].front() +
                                     " are not evenly spaced: " + std::to_string(at) + " is no multiple of " +
                                     std::to_string(axis.step) + " from " + std::to_string(axis.origin) +
                                     "; a grid's are, other tables are samples of a model");
                }
            }
        }
        const double any = std::max({axes_[0].step, axes_[1].step, axes_[2].step, 0.0});
        for (std::size_t a = 0; a < 3; ++a) {
            const int axis = static_cast<int>(a);
            grid.origin[axis] = axes_[a].origin;
            grid.spacing[axis] = axes_[a].step > 0 ? axes_[a].step : any > 0 ? any : 1;
            grid.size[a] = axes_[a].count;
        }
        constexpr double most_a_row = 4096;  // a table that fills so little of its box is no grid
        if (static_cast<double>(grid.count()) > most_a_row * (static_cast<double>(rows_) + 64)) {
            throw InputError(source_.describe() + ": " + std::to_string(rows_) + " rows are no grid of " +
                             std::to_string(grid.count()) + " places; other tables are samples of a model");
        }
        for (const Column& column : columns_) {
            std::vector<std::string> classes;
            for (const auto& [name, number] : column.classes) {
                classes.push_back(name);
            }
            grid.layers.push_back(
                grid_layer(column.name, "", column.text || column.name == "region", false, std::move(classes)));
        }
        name_layers(grid.layers);
    }

    void put(const Cells& cells, std::int64_t line) {
        double at[3];
        if (!place_of(cells, at)) {
            return;
        }
        std::array<std::int64_t, 3> n{};
        for (std::size_t a = 0; a < 3; ++a) {
            n[a] = axes_[a].step == 0 ? 0 : std::llround((at[a] - axes_[a].origin) / axes_[a].step);
        }
        constexpr std::int64_t edge = Brick::edge;
        auto& block =
            blocks_[static_cast<std::size_t>((n[0] / edge * counts_[1] + n[1] / edge) * counts_[2] + n[2] / edge)];
        block.resize(columns_.size());
        const std::size_t voxel =
            Brick::index(static_cast<int>(n[0] % edge), static_cast<int>(n[1] % edge), static_cast<int>(n[2] % edge));
        for (std::size_t c = 0; c < columns_.size(); ++c) {
            const std::string_view cell = columns_[c].cell < cells.size() ? cells[columns_[c].cell] : "";
            if (is_missing(cell)) {
                continue;
            }
            if (block[c].empty()) {
                block[c].assign(static_cast<std::size_t>(edge * edge * edge), no_value);
            }
            if (!std::isnan(block[c][voxel])) {
                throw InputError(source_.describe() + ": line " + std::to_string(line) + ": " + columns_[c].name +
                                 " has a value at this place already, by a row above; a grid has one a place");
            }
            block[c][voxel] =
                columns_[c].text ? columns_[c].classes.find(cell)->second : static_cast<float>(*parse_number(cell));
        }
    }

    /// In the order of their names, whatever that of the rows.
    void find_classes(const Cells& cells) {
        for (Column& column : columns_) {
            const std::string_view cell = column.cell < cells.size() ? cells[column.cell] : std::string_view();
            if (!column.text || is_missing(cell) || column.classes.find(cell) != column.classes.end()) {
                continue;
            }
            if (column.classes.size() == most_classes) {
                throw InputError(source_.describe() + ": " + column.name + ": more than 65 536 different texts");
            }
            column.classes.emplace(std::string(cell), 0);
            float number = 0;
            for (auto& [name, of_class] : column.classes) {
                of_class = number++;
            }
        }
    }

    Source source_;
    Axis axes_[3];
    std::vector<Column> columns_;
    std::int64_t rows_ = 0;
    std::array<std::int64_t, 3> counts_{};
    std::vector<std::vector<std::vector<float>>> blocks_;  ///< [block][column]
};

}  // namespace

GridContents read_table_grid(const Source& source, const std::string& spill) {
    return TableGrid(source).read(spill);
}

}  // namespace terratet
