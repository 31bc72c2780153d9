// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cpl_conv.h>
#include <cmath>
#include <map>
#include <numbers>

#include "io/base/rejections.hpp"
#include "io/base/text_lines.hpp"
#include "io/read/surfaces/graph_check.hpp"
#include "io/read/surfaces/read_surfaces.hpp"
#include "io/read/surfaces/sticks.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

using PointsByName = std::map<std::string, std::vector<Vec3>>;

/// Where a table's coordinates are: in its geometry, in columns, or x and y in the one and z in the other.
struct Coordinates {
    bool geometry = false;
    int x = -1, y = -1, z = -1;
    bool down = false;  ///< z counts so
};

bool is_overridden(const ColumnNames& columns, const char* meaning) {
    return std::any_of(columns.begin(), columns.end(), [&](const auto& named) { return named.first == meaning; });
}

Coordinates find_coordinates(const Table& table, const ColumnNames& columns) {
    Coordinates result;
    result.geometry = !table.points.empty() && !is_overridden(columns, "x") && !is_overridden(columns, "y");
    if (result.geometry) {
        result.z = find_optional_column(table, Meaning::z, columns);
        return result;
    }
    std::string absent;
    for (const auto& [meaning, column] :
         {std::pair{Meaning::x, &result.x}, std::pair{Meaning::y, &result.y}, std::pair{Meaning::z, &result.z}}) {
        *column = find_column(table, meaning, columns);
        if (*column < 0) {
            absent += (absent.empty() ? "" : ", ") + std::string(to_string(meaning));
        }
    }
    if (!absent.empty()) {
        std::string present;
        for (const std::string& name : table.columns) {
            present += (present.empty() ? "" : ", ") + name;
        }
        throw InputError(table.file + ": no column for " + absent + "; it has " + present +
                         "; name them with `columns`, as in `columns` x=EASTING");
    }
    return result;
}

std::optional<Vec3> position(const Table& table, const Coordinates& where, std::size_t row) {
    const auto number = [&](int column) {
        const auto value = column < 0 ? std::nullopt : parse_number(table.cells[static_cast<std::size_t>(column)][row]);
        return value.value_or(std::nan(""));
    };
    const double height = where.down ? -number(where.z) : number(where.z);
    if (!where.geometry) {
        return Vec3{number(where.x), number(where.y), height};
    }
    std::optional<Vec3> point = table.points[row];
    if (point && std::isnan(point->z)) {
        point->z = height;
    }
    return point;
}

PointsByName group(const Table& table, const Coordinates& where, int name_column, const std::string& default_name,
                   Rejections& rejections) {
    PointsByName groups;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        const std::optional<Vec3> point = position(table, where, row);
        if (!point || !is_acceptable(*point)) {
            rejections.add(table.lines[row], [] { return std::string("x, y and z must be numbers within 1e9"); });
            continue;
        }
        const std::string name(name_column < 0 ? default_name
                                               : table.cells[static_cast<std::size_t>(name_column)][row]);
        if (name.empty()) {
            rejections.add(table.lines[row], [&] {
                return "no fault name in column " + table.columns[static_cast<std::size_t>(name_column)];
            });
            continue;
        }
        groups[name].push_back(*point);
    }
    return groups;
}

int stick_column_of(const Table& table) {
    for (const char* name : {"stick", "stickid", "stickno", "sticknr", "sticknumber", "faultstick", "segid"}) {
        const auto found = std::ranges::find(table.columns, name, normal_header);
        if (found != table.columns.end()) {
            return static_cast<int>(found - table.columns.begin());
        }
    }
    return -1;
}

/// Sticks by fault, in the order in which they first come; points in that of the rows.
std::map<std::string, std::vector<std::vector<Vec3>>> sticks_of(const Table& table, const Coordinates& where,
                                                                int name_column, const std::string& default_name,
                                                                int stick_column) {
    std::map<std::string, std::vector<std::vector<Vec3>>> result;
    std::map<std::pair<std::string, std::string>, std::size_t> places;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        const std::optional<Vec3> point = position(table, where, row);
        if (!point || !is_acceptable(*point)) {
            continue;  // rejected when points were grouped
        }
        const std::string name(name_column < 0 ? default_name
                                               : table.cells[static_cast<std::size_t>(name_column)][row]);
        const std::string stick(table.cells[static_cast<std::size_t>(stick_column)][row]);
        auto& sticks = result[name];
        const auto [entry, added] = places.emplace(std::pair(name, stick), sticks.size());
        if (added) {
            sticks.emplace_back();
        }
        sticks[entry->second].push_back(*point);
    }
    return result;
}

/// A column of row numbers under a heading like "id" passes for names; but then no name has three points.
bool names_nothing(const PointsByName& groups) {
    std::size_t points = 0, largest = 0;
    for (const auto& [name, members] : groups) {
        points += members.size();
        largest = std::max(largest, members.size());
    }
    return largest < 3 && points >= 3;
}

/// Longitude and latitude cannot be weighed against metres of height: a plane is fitted in metres round the middle.
Surface triangulate_geographic(const std::string& name, const std::vector<Vec3>& points, bool& graph) {
    constexpr double metres_per_degree = 111319.49;
    const Vec3 middle = bounding_box(points).center();
    const double shrink = std::max(std::cos(middle.y * std::numbers::pi / 180), 1e-3);
    std::map<Vec3, Vec3> original;
    std::vector<Vec3> metric;
    for (const Vec3& p : points) {
        const Vec3 m{(p.x - middle.x) * metres_per_degree * shrink, (p.y - middle.y) * metres_per_degree, p.z};
        const auto [entry, fresh] = original.emplace(m, p);
        if (!fresh) {
            entry->second = std::min(entry->second, p);
        }
        metric.push_back(m);
    }
    Surface surface = triangulate_in_best_fit_plane(name, std::move(metric));
    graph = is_graph(surface);
    for (Vec3& p : surface.vertices) {
        p = original.at(p);
    }
    return surface;
}

}  // namespace

RawSurfaces read_fault_points(const Source& source, SurfaceKind kind, const ColumnNames& columns,
                              const SurfaceOptions& options, Diagnostics& diagnostics) {
    const Table table = read_table(source);
    for (const std::string& note : table.notes) {
        diagnostics.note(note);
    }
    Coordinates where = find_coordinates(table, columns);
    const std::string z_name = where.z < 0 ? "" : table.columns[static_cast<std::size_t>(where.z)];
    if (options.z_positive == ZPositive::automatic && names_depth(z_name)) {
        where.down = true;
        diagnostics.note(table.file + ": column " + z_name +
                         " is read as positive downwards, by its name (`z_positive` up says otherwise)");
    }
    const std::string default_name = to_utf8(source.layer.empty() ? CPLGetBasename(source.path.c_str()) : source.layer);
    const int name_column = find_column(table, Meaning::name, columns);
    Rejections rejections(diagnostics, table.file);
    PointsByName groups = group(table, where, name_column, default_name, rejections);
    if (name_column >= 0 && !is_overridden(columns, "name") && names_nothing(groups)) {
        diagnostics.note(table.file + ": column " + table.columns[static_cast<std::size_t>(name_column)] +
                         " differs from row to row, so it names no faults; all points are taken as one");
        std::vector<Vec3> all;
        for (const auto& [name, points] : groups) {
            all.insert(all.end(), points.begin(), points.end());
        }
        groups = {{default_name, std::move(all)}};
    }

    RawSurfaces result;
    result.z_stated = where.down;
    result.crs = where.geometry ? table.crs : Crs{};
    const bool geographic = source.srs.empty() ? result.crs.geographic : parse_crs(source.srs).geographic;
    const int stick_column = stick_column_of(table);
    std::map<std::string, std::vector<std::vector<Vec3>>> sticks;
    if (stick_column >= 0) {
        sticks = sticks_of(table, where, name_column, default_name, stick_column);
        diagnostics.note(table.file + ": its points are read as sticks, by column " +
                         table.columns[static_cast<std::size_t>(stick_column)]);
    }
    for (const auto& [name, points] : groups) {
        bool graph = true;
        Surface surface = stick_column >= 0 ? surface_of_sticks(name, std::move(sticks[name]))
                          : geographic      ? triangulate_geographic(name, points, graph)
                                            : triangulate_in_best_fit_plane(name, points);
        graph = graph && (stick_column >= 0 || geographic || is_graph(surface));
        if (!graph) {
            rejections.add(0, [&] {
                return "\"" + name + "\": its " + std::to_string(points.size()) +
                       " points are no graph over their plane: they fill a volume, or the sheet lies over itself; give "
                       "triangles instead";
            });
            continue;
        }
        if (surface.triangles.empty()) {
            rejections.add(0, [&] {
                return "\"" + name + "\": " + std::to_string(points.size()) +
                       " points that span no surface (three off a line are needed)";
            });
            continue;
        }
        if (stick_column < 0 && surface.vertices.size() < points.size()) {
            diagnostics.note(table.file + ": \"" + name +
                             "\": " + std::to_string(points.size() - surface.vertices.size()) + " of " +
                             std::to_string(points.size()) + " points coincide with others and were left out");
        }
        surface.kind = kind;
        surface.file = to_utf8(source.path);
        result.surfaces.push_back(std::move(surface));
    }
    if (result.surfaces.empty()) {
        throw InputError(table.file + ": no usable surface" + rejections.first() +
                         "; points need x, y, z and three of them a name");
    }
    return result;
}

}  // namespace terratet
