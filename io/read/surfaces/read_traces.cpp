// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Faults of national databases: a line on the map, a dip and its direction, and how deep it goes.
#include <fmt/format.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "io/base/file_bytes.hpp"
#include "io/base/gdal_dataset.hpp"
#include "io/base/rejections.hpp"
#include "io/base/text_lines.hpp"
#include "io/read/surfaces/detachment.hpp"
#include "io/read/surfaces/read_surfaces.hpp"
#include "io/read/surfaces/sticks.hpp"
#include "io/read/surfaces/trace_words.hpp"
#include "tess/error.hpp"
#include "tess/samples.hpp"

namespace terratet {
namespace {

constexpr double metres_per_degree = 111319.49;
constexpr double flattest_deg = 3;        ///< a flatter sheet is no fault drawn as a trace
constexpr double least_from_strike = 15;  ///< degrees between a dip direction and its trace
constexpr double radians = std::numbers::pi / 180;

using Line = std::vector<Vec3>;

struct TraceColumns {
    int name = -1, dip = -1, direction = -1, strike = -1, depth = -1;
    double metres_per_depth = 0;  ///< 0: kilometres up to 100, metres above
};

/// One feature: its lines, and what its record says.
struct Trace {
    std::string name;
    std::int64_t record = 0;
    std::vector<Line> lines;
    std::string dip, direction, strike, depth;
};

int column_called(const Table& header, std::initializer_list<const char*> names) {
    for (const char* name : names) {
        const auto found = std::ranges::find(header.columns, name, normal_header);
        if (found != header.columns.end()) {
            return static_cast<int>(found - header.columns.begin());
        }
    }
    return -1;
}

int first_of(int a, int b) {
    return a >= 0 ? a : b;
}

/// Kilometres of databases, unless the header says another unit.
double depth_unit(const std::string& header) {
    std::string words;
    for (const char c : header) {
        words += std::isalnum(static_cast<unsigned char>(c)) != 0 ? static_cast<char>(std::tolower(c)) : ' ';
    }
    words += ' ';
    const std::string name = normal_header(header);
    return words.find(" km ") != std::string::npos                   ? 1000.0
           : words.find(" m ") != std::string::npos                  ? 1.0
           : name == "d90" || name.find("seis") != std::string::npos ? 1000.0
                                                                     : 0.0;
}

TraceColumns trace_columns(const Table& header, const ColumnNames& names) {
    TraceColumns columns;
    columns.name = first_of(find_optional_column(header, Meaning::name, names), column_called(header, {"layer"}));
    columns.dip = find_optional_column(header, Meaning::dip, names);
    columns.direction = first_of(find_optional_column(header, Meaning::dip_direction, names),
                                 find_optional_column(header, Meaning::azimuth, names));
    columns.strike = column_called(header, {"strike", "averagestrike", "strikedeg", "meanstrike"});
    columns.depth = find_optional_column(header, Meaning::lower_depth, names);
    columns.metres_per_depth =
        columns.depth < 0 ? 0 : depth_unit(header.columns[static_cast<std::size_t>(columns.depth)]);
    return columns;
}

Table header_of(OGRFeatureDefn& definition, const Source& source) {
    Table header;
    header.file = source.describe();
    for (int i = 0; i < definition.GetFieldCount(); ++i) {
        header.columns.push_back(to_utf8(definition.GetFieldDefn(i)->GetNameRef()));
    }
    return header;
}

/// The lines of a geometry, at height 0 where it has none. GDAL bounds the nesting.
void append_lines(const OGRGeometry& geometry, std::vector<Line>& lines) {
    const OGRwkbGeometryType type = wkbFlatten(geometry.getGeometryType());
    if (type == wkbLineString) {
        Line line;
        for (const OGRPoint& point : *geometry.toLineString()) {
            const Vec3 p{point.getX(), point.getY(), point.Is3D() != 0 ? point.getZ() : 0};
            if (line.empty() || line.back() != p) {
                line.push_back(p);
            }
        }
        lines.push_back(std::move(line));
    } else if (OGR_GT_IsSubClassOf(type, wkbGeometryCollection)) {
        for (const OGRGeometry* part : *geometry.toGeometryCollection()) {
            append_lines(*part, lines);
        }
    }
}

std::vector<Trace> read_features(OGRLayer& layer, const TraceColumns& columns, Rejections& rejections) {
    std::vector<Trace> traces;
    layer.ResetReading();
    while (const OGRFeatureUniquePtr record{layer.GetNextFeature()}) {
        const auto text = [&](int column) {
            return column >= 0 && record->IsFieldSetAndNotNull(column)
                       ? std::string(trimmed(to_utf8(record->GetFieldAsString(column))))
                       : std::string();
        };
        Trace trace{text(columns.name),   record->GetFID(),   {}, text(columns.dip), text(columns.direction),
                    text(columns.strike), text(columns.depth)};
        if (const OGRGeometry* const geometry = record->GetGeometryRef()) {
            append_lines(*geometry, trace.lines);
        }
        const bool good =
            std::ranges::all_of(trace.lines, [](const Line& line) { return std::ranges::all_of(line, is_acceptable); });
        std::erase_if(trace.lines, [](const Line& line) { return line.size() < 2; });
        if (trace.lines.empty() || !good) {
            rejections.add(trace.record, [&] {
                return std::string(good ? "no line of two points" : "coordinates must be numbers within 1e9");
            });
            continue;
        }
        if (trace.name.empty()) {
            trace.name = to_utf8(layer.GetName()) + " " + std::to_string(trace.record);
        }
        traces.push_back(std::move(trace));
    }
    return traces;
}

// --- Sticks --------------------------------------------------------------------------------------------------------

/// Lines in space that go down, several a name: drawn on sections.
bool are_sticks(const std::vector<Trace>& traces) {
    std::map<std::string, std::size_t> counts;
    for (const Trace& trace : traces) {
        for (const Line& line : trace.lines) {
            const auto [low, high] = std::ranges::minmax(line, {}, &Vec3::z);
            if (low.z == high.z) {
                return false;
            }
            ++counts[trace.name];
        }
    }
    return std::ranges::any_of(counts, [](const auto& entry) { return entry.second > 1; });
}

std::vector<Surface> surfaces_of_sticks(const std::vector<Trace>& traces) {
    std::map<std::string, std::vector<Line>> sticks;
    for (const Trace& trace : traces) {
        std::ranges::copy(trace.lines, std::back_inserter(sticks[trace.name]));
    }
    std::vector<Surface> surfaces;
    surfaces.reserve(sticks.size());
    for (auto& [name, lines] : sticks) {
        surfaces.push_back(surface_of_sticks(name, std::move(lines)));
    }
    return surfaces;
}

// --- Extrusion -----------------------------------------------------------------------------------------------------

/// Metres of a unit of x, y and z at a place.
struct Scales {
    double x = 1, y = 1, z = 1;
};

Scales scales_at(const Vec3& place, const Crs& crs) {
    if (crs.geographic) {
        return {metres_per_degree * std::max(std::cos(place.y * radians), 1e-3), metres_per_degree, 1};
    }
    return {crs.metres_per_unit, crs.metres_per_unit, crs.metres_per_height};
}

double angle_between(double a, double b) {
    return std::abs(std::remainder(a - b, 360.0));
}

/// Of a trace's ends, clockwise from north.
double strike_of(const Line& line, const Scales& scales) {
    const Vec3 run = line.back() - line.front();
    return std::atan2(run.x * scales.x, run.y * scales.y) / radians;
}

struct Attitude {
    double dip = 90;
    double direction = 0;
};

/// The dip of a record and the direction it goes to, or why there is none.
Attitude attitude_of(const Trace& trace, double strike, std::string& problem) {
    Attitude result;
    const auto dip = parse_dip(trace.dip);
    if (!dip || *dip < flattest_deg) {
        problem =
            trace.dip.empty() ? "no dip" : fmt::format("'{}' is no dip from {} to 90 degrees", trace.dip, flattest_deg);
        return result;
    }
    result.dip = *dip;
    const auto direction = parse_direction(trace.direction);
    const auto given_strike = parse_direction(trace.strike);
    if (direction && direction->letters) {
        const bool right =
            angle_between(strike + 90, direction->degrees) <= angle_between(strike - 90, direction->degrees);
        result.direction = strike + (right ? 90 : -90);
    } else if (direction) {
        result.direction = direction->degrees;
        const double along =
            std::min(angle_between(result.direction, strike), angle_between(result.direction, strike + 180));
        if (along < least_from_strike && *dip < 89.5) {
            problem = fmt::format("its dip direction {:.6g} runs along the trace, which strikes {:.3g}",
                                  result.direction, strike);
        }
    } else if (given_strike && !given_strike->letters) {
        result.direction = given_strike->degrees + 90;  // the rule of the right hand
    } else if (*dip < 89.5) {
        problem = trace.direction.empty() ? "a dip, but no dip direction"
                                          : fmt::format("'{}' is no dip direction", trace.direction);
    } else {
        result.dip = 90;
    }
    return result;
}

/// Where the way down the dip goes from a place, a metre down.
Vec3 down_dip(const Attitude& attitude, const Scales& scales) {
    const double out = attitude.dip >= 90 ? 0 : 1 / std::tan(attitude.dip * radians);
    return {out * std::sin(attitude.direction * radians) / scales.x,
            out * std::cos(attitude.direction * radians) / scales.y, -1 / scales.z};
}

/// Appends the sheet from a line down to a height for each of its points, in rows about as far apart as those.
void extrude(const Line& line, const Attitude& attitude, const std::vector<double>& bottoms, const Scales& scales,
             Surface& surface) {
    double length = 0;
    for (std::size_t i = 1; i < line.size(); ++i) {
        length += std::hypot((line[i].x - line[i - 1].x) * scales.x, (line[i].y - line[i - 1].y) * scales.y);
    }
    const double drop = (line.front().z - bottoms.front()) * scales.z;
    const double down = drop / std::sin(attitude.dip * radians);
    const double spacing = length / static_cast<double>(line.size() - 1);
    const int rows = static_cast<int>(std::clamp(std::round(down / std::max(spacing, 1e-9)), 1.0, 50.0));
    const Vec3 way = down_dip(attitude, scales);
    const auto first = static_cast<std::uint32_t>(surface.vertices.size());
    const auto wide = static_cast<std::uint32_t>(line.size());
    for (int row = 0; row <= rows; ++row) {
        for (std::size_t i = 0; i < line.size(); ++i) {
            const Vec3& p = line[i];
            const double here = (p.z - bottoms[i]) * row / rows;
            const double metres = here * scales.z;
            surface.vertices.push_back({p.x + metres * way.x, p.y + metres * way.y, p.z - here});
        }
    }
    for (std::uint32_t row = 0; row < static_cast<std::uint32_t>(rows); ++row) {
        for (std::uint32_t i = 0; i + 1 < wide; ++i) {
            const std::uint32_t a = first + row * wide + i;
            surface.triangles.push_back({a, a + wide, a + wide + 1});
            surface.triangles.push_back({a, a + wide + 1, a + 1});
        }
    }
}

/// How far below zero a record's sheet reaches, in metres; NaN: nobody says.
double lower_depth_m(const Trace& trace, const TraceColumns& columns, double general_m) {
    const auto depth = parse_estimate(trace.depth);
    if (!depth || !(*depth > 0)) {
        return general_m;
    }
    return *depth * (columns.metres_per_depth > 0 ? columns.metres_per_depth : *depth <= 100 ? 1000 : 1);
}

/// Where sheets end below, where their records do not say it.
struct Lower {
    double general_m = missing;  ///< below zero
    Detachment detachment{};
    std::string file{};  ///< of the detachment
};

/// The heights to which the points of a line go down; empty, with the reason in `problem`, when one does not.
std::vector<double> bottoms_of(const Line& line, const Attitude& attitude, double depth, const Lower& lower,
                               const Scales& scales, std::string& problem) {
    std::vector<double> bottoms(line.size(), -depth / scales.z);
    const Vec3 way = down_dip(attitude, scales);
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (!lower.detachment.empty()) {
            bottoms[i] = lower.detachment.met_from(line[i], way);
        }
        if (!(bottoms[i] < line[i].z)) {
            problem = lower.detachment.empty()
                          ? fmt::format("the trace lies at or below its lower depth, {:.6g} m", depth)
                          : fmt::format("down its dip the trace does not meet the detachment {}", lower.file);
            return {};
        }
    }
    return bottoms;
}

void add_trace(const Trace& trace, const TraceColumns& columns, const Crs& crs, const Lower& lower,
               std::map<std::string, Surface>& surfaces, Rejections& rejections) {
    const Line& longest = *std::ranges::max_element(
        trace.lines, {}, [](const Line& line) { return distance(line.front(), line.back()); });
    const Scales scales = scales_at(longest.front(), crs);
    std::string problem;
    const Attitude attitude = attitude_of(trace, strike_of(longest, scales), problem);
    const double depth = lower_depth_m(trace, columns, lower.general_m);
    if (problem.empty() && std::isnan(depth) && lower.detachment.empty()) {
        problem = "no lower depth; `fault_depth` gives one to all";
    }
    std::vector<std::vector<double>> bottoms;
    for (std::size_t i = 0; i < trace.lines.size() && problem.empty(); ++i) {
        bottoms.push_back(bottoms_of(trace.lines[i], attitude, depth, lower, scales, problem));
    }
    if (!problem.empty()) {
        return rejections.add(trace.record, [&] { return fmt::format("\"{}\": {}", trace.name, problem); });
    }
    for (std::size_t i = 0; i < trace.lines.size(); ++i) {
        extrude(trace.lines[i], attitude, bottoms[i], scales, surfaces[trace.name]);
    }
}

/// A depth, or the file of a surface at which the faults end.
Lower lower_of(const Crs& crs, const SurfaceOptions& options, const ColumnNames& names, Diagnostics& diagnostics) {
    Lower lower;
    const Source source{.path = options.fault_depth};
    if (options.fault_depth.empty()) {
        return lower;
    }
    if (file_bytes(source.path, 0, 1).empty()) {
        lower.general_m = parse_length(options.fault_depth).in(crs.metres_per_height) * crs.metres_per_height;
        return lower;
    }
    RawSurfaces found = read_surfaces(source, SurfaceKind::horizon, names, diagnostics, {options.z_positive, ""});
    for (Surface& surface : found.surfaces) {
        if (!found.crs.empty() && !crs.empty()) {
            CrsTransform(found.crs, crs).apply(surface.vertices);
        }
        std::erase_if(surface.triangles, [&](const auto& triangle) {
            return std::ranges::any_of(triangle, [&](auto corner) { return !is_finite(surface.vertices[corner]); });
        });
    }
    lower.detachment = Detachment(found.surfaces);
    lower.file = source.path;
    if (lower.detachment.empty()) {
        throw InputError(source.path + ": has no triangle at which faults could end");
    }
    return lower;
}

}  // namespace

RawSurfaces read_traces(const Source& source, SurfaceKind kind, const ColumnNames& names, const SurfaceOptions& options,
                        Diagnostics& diagnostics) {
    const GdalScope scope(source.path);
    const Dataset dataset = open_vector(source);
    ResultSet result_set;
    OGRLayer& layer = open_layer(*dataset, source, scope, result_set);
    const Table header = header_of(*layer.GetLayerDefn(), source);
    const TraceColumns columns = trace_columns(header, names);
    Rejections rejections(diagnostics, source.describe());
    const bool flat = OGR_GT_HasZ(layer.GetGeomType()) == 0;
    const std::vector<Trace> traces = read_features(layer, columns, rejections);
    RawSurfaces result;
    result.crs = crs_of(layer);
    if (columns.dip < 0 && are_sticks(traces)) {
        diagnostics.note(source.describe() +
                         ": its lines are read as sticks, one behind the other in the file's order");
        result.surfaces = surfaces_of_sticks(traces);
    } else if (columns.dip < 0) {
        throw InputError(
            fmt::format("{}: its lines are traces, but no column says their dip (Dip, Dip_pref, average_dip, …); it "
                        "has {}; name one "
                        "with `columns` dip=NAME, and dip-direction=NAME, lower-depth=NAME",
                        source.describe(), fmt::join(header.columns, ", ")));
    } else {
        const Crs crs = source.srs.empty() ? result.crs : parse_crs(source.srs);
        const Lower lower = lower_of(crs, options, names, diagnostics);
        std::map<std::string, Surface> surfaces;
        for (const Trace& trace : traces) {
            add_trace(trace, columns, crs, lower, surfaces, rejections);
        }
        for (auto& [name, surface] : surfaces) {
            surface.name = name;
            result.surfaces.push_back(std::move(surface));
        }
        if (flat && !result.surfaces.empty()) {
            diagnostics.note(source.describe() + ": its traces have no heights and begin at 0");
        }
    }
    std::erase_if(result.surfaces, [](const Surface& surface) { return surface.triangles.empty(); });
    for (Surface& surface : result.surfaces) {
        surface.kind = kind;
        surface.file = to_utf8(source.path);
    }
    if (result.surfaces.empty()) {
        throw InputError(source.describe() + ": no trace makes a surface" + rejections.first() +
                         "; a trace needs a dip, its direction, and a lower depth");
    }
    result.z_stated = true;
    return result;
}

}  // namespace terratet
