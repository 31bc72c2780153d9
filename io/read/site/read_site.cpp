// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read_site.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "io/read/join_ids.hpp"
#include "io/read/log_checks.hpp"
#include "io/read/log_intervals.hpp"
#include "io/read/read_boreholes.hpp"
#include "io/read/read_positions.hpp"
#include "io/read/read_samples.hpp"
#include "io/read/read_values.hpp"
#include "io/read/site/hole_inputs.hpp"
#include "io/read/site/over_time.hpp"
#include "io/read/surfaces/read_surfaces.hpp"
#include "tess/error.hpp"
#include "tess/site/site_box.hpp"

namespace terratet {

namespace {

/// All inputs as read: tables untyped, places in their own CRS.
struct Inputs : HoleInputs {
    std::vector<PlacedTable> samples;
    std::vector<RawSurfaces> surfaces;
};

/// Hands on what a step noted; throws on the first rejection when strict.
class Checkpoint {
  public:
    Checkpoint(const SiteInputs& inputs, Diagnostics& diagnostics, const Progress& progress)
        : strict_(inputs.strict), seen_(diagnostics.rejected.size()), diagnostics_(diagnostics), progress_(progress) {}

    void pass(double fraction) const {
        if (strict_ && diagnostics_.rejected.size() > seen_) {
            const Rejected& first = diagnostics_.rejected[seen_];
            throw InputError(fmt::format("{}, line {}: {} (`strict`)", first.file, first.line, first.reason));
        }
        report_progress(progress_, "read", fraction);
    }

  private:
    bool strict_;
    std::size_t seen_;
    Diagnostics& diagnostics_;
    const Progress& progress_;
};

// --- Reading -------------------------------------------------------------------------------------------------------

Table read_noted(const Source& source, Diagnostics& diagnostics) {
    Table table = read_table(source);
    for (const std::string& note : table.notes) {
        diagnostics.note(note);
    }
    return table;
}

/// A surface file, its CRS resolved. Readers want to know the CRS (units, degrees); the general one is only right for a
/// file that states none, which shows when it has been read.
RawSurfaces read_surface_file(Source source, SurfaceKind kind, const SiteInputs& inputs, Diagnostics& diagnostics) {
    if (source.srs.empty() && is_gocad(source.path)) {
        source.srs = inputs.source_crs;
    }
    Diagnostics said;
    const SurfaceOptions options{inputs.z_positive, inputs.fault_depth};
    RawSurfaces raw = read_surfaces(source, kind, inputs.columns, said, options);
    if (raw.crs.empty() && source.srs.empty() && !inputs.source_crs.empty()) {
        source.srs = inputs.source_crs;
        said = {};
        raw = read_surfaces(source, kind, inputs.columns, said, options);
    }
    raw.crs = resolved_crs(source, raw.crs, inputs.source_crs);
    std::ranges::move(said.rejected, std::back_inserter(diagnostics.rejected));
    std::ranges::move(said.notes, std::back_inserter(diagnostics.notes));
    return raw;
}

Inputs read_inputs(const SiteInputs& inputs, Diagnostics& diagnostics, const Checkpoint& checkpoint) {
    Inputs read{read_hole_inputs(inputs, diagnostics), {}, {}};
    const auto placed = [&](const Source& source) {
        return place(read_noted(source, diagnostics), source, inputs.source_crs, inputs.columns, diagnostics,
                     place_options(inputs));
    };
    for (const Source& source : inputs.samples) {
        read.samples.push_back(placed(source));
    }
    checkpoint.pass(0.4);
    for (const Source& source : inputs.faults) {
        read.surfaces.push_back(read_surface_file(source, SurfaceKind::fault, inputs, diagnostics));
    }
    for (const Source& source : inputs.surfaces) {
        read.surfaces.push_back(read_surface_file(source, SurfaceKind::horizon, inputs, diagnostics));
    }
    for (const Source& source : inputs.topography) {
        read.surfaces.push_back(read_surface_file(source, SurfaceKind::topography, inputs, diagnostics));
    }
    for (const Source& source : inputs.domain) {
        RawSurfaces raw = read_domain(source, diagnostics);
        raw.crs = resolved_crs(source, raw.crs, inputs.source_crs);
        read.surfaces.push_back(std::move(raw));
    }
    checkpoint.pass(0.6);
    return read;
}

/// A column named by the user must be in some table; fault files may be tables as well, so with them nobody knows.
void require_named_columns(const SiteInputs& inputs, const Inputs& read) {
    if (!read.surfaces.empty()) {
        return;
    }
    for (const auto& named : inputs.columns) {
        const auto in_table = [&](const Table& table) { return column_named(table, named.second) >= 0; };
        const auto in_placed = [&](const PlacedTable& placed) { return in_table(placed.table); };
        if (std::ranges::none_of(read.collars, in_placed) && std::ranges::none_of(read.surveys, in_table) &&
            std::ranges::none_of(read.logs, in_table) && std::ranges::none_of(read.samples, in_placed)) {
            throw UsageError(fmt::format("`columns` {}={}: no table has such a column", named.first, named.second));
        }
    }
}

// --- One CRS -------------------------------------------------------------------------------------------------------

std::vector<Vec3> surface_points(const RawSurfaces& raw) {
    std::vector<Vec3> points;
    for (const Surface& surface : raw.surfaces) {
        points.insert(points.end(), surface.vertices.begin(), surface.vertices.end());
    }
    return points;
}

/// The middle of the shortest arc that holds all longitudes: places on both sides of the antimeridian are near each
/// other.
double middle_longitude(std::vector<double> longitudes) {
    std::ranges::sort(longitudes);
    double widest = longitudes.front() + 360 - longitudes.back();
    double first = longitudes.front();
    for (std::size_t i = 1; i < longitudes.size(); ++i) {
        if (longitudes[i] - longitudes[i - 1] > widest) {
            widest = longitudes[i] - longitudes[i - 1];
            first = longitudes[i];
        }
    }
    const double middle = first + (360 - widest) / 2;
    return middle >= 180 ? middle - 360 : middle;
}

/// The UTM zone of the middle of everything, all of which is in longitude and latitude.
Crs utm_of_middle(const Inputs& read, Diagnostics& diagnostics) {
    const Crs wgs84 = parse_crs("EPSG:4326");
    Box3 extent;
    std::vector<double> longitudes;
    const auto extend = [&](const Crs& crs, std::vector<Vec3> points) {
        CrsTransform(crs, wgs84).apply(points);
        for (const Vec3& point : points) {
            if (is_finite(point)) {
                extent.extend(point);
                longitudes.push_back(point.x);
            }
        }
    };
    for (const auto* tables : {&read.collars, &read.samples}) {
        for (const PlacedTable& placed : *tables) {
            extend(placed.crs, placed.points);
        }
    }
    for (const RawSurfaces& raw : read.surfaces) {
        extend(raw.crs, surface_points(raw));
    }
    if (extent.empty()) {
        throw InputError(
            "no place of the inputs can be given a longitude and latitude; name a projected system with -t_srs");
    }
    const double longitude = middle_longitude(longitudes);
    const double latitude = extent.center().y;
    Crs zone = utm_zone(longitude, latitude);
    diagnostics.note(fmt::format(
        "all inputs are in longitude and latitude; the model is in {} (-t_srs chooses another); its middle "
        "is at {:.4f}° {}, {:.4f}° {}",
        zone.name, std::abs(longitude), longitude < 0 ? "W" : "E", std::abs(latitude), latitude < 0 ? "S" : "N"));
    return zone;
}

Crs choose_target(const SiteInputs& inputs, const Inputs& read, Diagnostics& diagnostics) {
    if (!inputs.target_crs.empty()) {
        Crs target = parse_crs(inputs.target_crs);
        if (target.geographic) {
            throw UsageError("-t_srs " + target.name + " is in degrees; a model needs a projected system or local");
        }
        return target;
    }
    std::vector<const Crs*> in_order;
    for (const auto* tables : {&read.collars, &read.samples}) {
        for (const PlacedTable& placed : *tables) {
            in_order.push_back(&placed.crs);
        }
    }
    for (const RawSurfaces& raw : read.surfaces) {
        in_order.push_back(&raw.crs);
    }
    const auto projected = std::ranges::find_if(in_order, [](const Crs* crs) { return !crs->geographic; });
    return projected != in_order.end() ? **projected : utm_of_middle(read, diagnostics);
}

/// All three axes of a model have one unit.
void require_one_unit(const Crs& target) {
    if (std::abs(target.metres_per_height / target.metres_per_unit - 1) > 1e-5) {
        throw UsageError(target.name + " has heights in another unit than its plane (" + target.unit +
                         "); choose a system with one unit with -t_srs");
    }
}

void to_crs(RawSurfaces& raw, const Crs& target, Diagnostics& diagnostics) {
    const CrsTransform transform(raw.crs, target);
    for (Surface& surface : raw.surfaces) {
        transform.apply(surface.vertices);
        if (!std::ranges::all_of(surface.vertices, is_acceptable)) {
            throw InputError(
                fmt::format("{}: surface {} cannot be transformed from {} to {}; is its coordinate system "
                            "right?",
                            surface.file, surface.name, raw.crs.name, target.name));
        }
    }
    if (const std::string remark = transform.remark(); !remark.empty() && !raw.surfaces.empty()) {
        diagnostics.note(raw.surfaces.front().file + ": " + remark);
    }
    raw.crs = target;
    for (Surface& surface : raw.surfaces) {
        for (Vec3& p : surface.vertices) {
            p.z = surface.kind == SurfaceKind::domain ? 0 : p.z;  // of a polygon in plan z says nothing
        }
    }
}

/// A path's depths come to the target's unit as its points do.
void to_crs_depths(HolePath& path, const Crs& own, const Crs& target) {
    if (!std::ranges::all_of(path.points, is_acceptable)) {
        throw InputError(
            fmt::format("hole {}: its path cannot be transformed from {} to {}; is its coordinate system right?",
                        path.hole, own.name, target.name));
    }
    const double factor = own.metres_per_unit / target.metres_per_unit;
    for (double& depth : path.depths) {
        depth *= std::abs(factor - 1) < 1e-5 ? 1 : factor;
    }
}

/// Brings everything to the target; returns the CRSs that the collar tables were in, whose units their depths have.
std::vector<Crs> unify(Inputs& read, const Crs& target, Diagnostics& diagnostics) {
    std::vector<Crs> collar_crs;
    for (PlacedTable& placed : read.collars) {
        collar_crs.push_back(placed.crs);
        to_crs(placed, target, diagnostics);
    }
    for (std::size_t i = 0; i < read.paths.size(); ++i) {
        CrsTransform(read.path_crs[i], target).apply(read.paths[i].points);
        to_crs_depths(read.paths[i], read.path_crs[i], target);
    }
    for (PlacedTable& placed : read.samples) {
        to_crs(placed, target, diagnostics);
    }
    for (RawSurfaces& raw : read.surfaces) {
        to_crs(raw, target, diagnostics);
    }
    return collar_crs;
}

/// Of several tables each may do without; all together may not.
[[noreturn]] void throw_no_property(const std::vector<Table>& logs) {
    std::vector<std::string> columns;
    for (const Table& log : logs) {
        columns.insert(columns.end(), log.columns.begin(), log.columns.end());
    }
    throw InputError(
        fmt::format("{}: no numeric column to take for a property; columns: {}; `properties` "
                    "NAME:categorical takes a column of classes",
                    logs.front().file, fmt::join(columns, ", ")));
}

// --- One frame -----------------------------------------------------------------------------------------------------

/// Boreholes by id, their paths in true coordinates.
std::vector<Borehole> boreholes_of(const Holes& holes) {
    std::vector<Borehole> boreholes;
    for (const auto& [id, hole] : holes) {
        Borehole borehole{id, hole.path.position(0), {}, hole.path.polyline_depths(hole.end())};
        for (const double depth : borehole.path_depth) {
            borehole.path.push_back(hole.path.position(depth));
        }
        boreholes.push_back(std::move(borehole));
    }
    return boreholes;
}

/// Calls `visit` with every position of the site.
template <typename Visit>
void for_each_position(Site& site, const Visit& visit) {
    for (Borehole& borehole : site.boreholes) {
        visit(borehole.collar);
        std::ranges::for_each(borehole.path, visit);
    }
    std::ranges::for_each(site.samples.positions, visit);
    for (Surface& surface : site.surfaces) {
        std::ranges::for_each(surface.vertices, visit);
    }
}

Frame frame_of(const Crs& crs, const Box3& extent, double z_scale) {
    return {crs.local ? "" : crs.wkt, crs.name, crs.unit, crs.metres_per_unit, choose_origin(extent), z_scale};
}

/// Flat data are tessellated in stretched z.
double chosen_z_scale(const Site& site, const Crs& target, Diagnostics& diagnostics) {
    const Box3 box = site_box(site, target.metres_per_unit).box;
    const double scale = suitable_z_scale(box);
    if (scale > 1) {
        diagnostics.note(
            fmt::format("the data are {:.3g} times as wide as high: they are tessellated as if {:g} times as high, "
                        "where lengths and "
                        "shapes are judged (`z_scale`; 1 leaves them as they are)",
                        flatness(box), scale));
    }
    return scale;
}

/// From true coordinates to frame-local ones.
void localize(Site& site, const Crs& target, double z_scale) {
    Box3 extent;
    for_each_position(site, [&](const Vec3& point) { extent.extend(point); });
    site.frame = frame_of(target, extent, z_scale);
    for_each_position(site, [&](Vec3& point) {
        point = site.frame.snapped(site.frame.to_local(point));
        if (!is_acceptable(point)) {
            throw UsageError("`z_scale` " + std::to_string(z_scale) + " takes heights beyond " +
                             std::to_string(max_coordinate) + "; use a smaller one");
        }
    });
}

void require_consistent(const SiteInputs& inputs) {
    if (inputs.boreholes.empty() && (!inputs.surveys.empty() || !inputs.logs.empty())) {
        throw UsageError("surveys and logs need the positions of their holes: name the collar table with `boreholes`");
    }
    if (inputs.boreholes.empty() && inputs.samples.empty() && inputs.faults.empty() && inputs.surfaces.empty() &&
        inputs.topography.empty()) {
        throw UsageError("no input: give `boreholes` with `logs`, or `samples`");
    }
}

}  // namespace

Site read_site(const SiteInputs& given, Diagnostics& diagnostics, ReadCounts& counts, const Progress& progress) {
    SiteInputs inputs = given;
    const std::string time_column = take_time_column(inputs);
    require_consistent(inputs);
    const Checkpoint checkpoint(inputs, diagnostics, progress);

    Inputs read = read_inputs(inputs, diagnostics, checkpoint);
    require_named_columns(inputs, read);
    if (!time_column.empty()) {
        spread_over_time(time_column, read.logs, read.samples, inputs, diagnostics);
    }
    const Crs target = choose_target(inputs, read, diagnostics);
    require_one_unit(target);
    const std::vector<Crs> collar_crs = unify(read, target, diagnostics);
    checkpoint.pass(0.7);

    for (std::vector<Table>* const tables : {&read.surveys, &read.logs}) {
        for (Table& table : *tables) {
            if (table.stated.hole_names.empty()) {
                join_ids(table, read.collars, inputs.columns, diagnostics);
            }
        }
    }
    for (Table& log : read.logs) {
        split_ranges(log, inputs.columns, diagnostics);
    }
    for (std::vector<Table>* const tables : {&read.surveys, &read.logs}) {
        for (Table& table : *tables) {
            take_stated_depth_unit(table, target, inputs, diagnostics);
        }
    }
    Holes holes = read_boreholes(read.collars, collar_crs, read.surveys, read.paths, target, inputs, diagnostics);
    checkpoint.pass(0.8);

    PropertyCatalogue catalogue(inputs.properties, inputs.nulls);
    Samples samples;
    for (Table& log : read.logs) {
        if (log.stated.meanings.empty()) {
            accept_elevations(log, holes, inputs, diagnostics);
        }
        complete_bases(log, holes, target, inputs, diagnostics);
        note_beyond_length(log, holes, target, inputs, diagnostics);
        read_log(log, holes, target, inputs, catalogue, samples, diagnostics);
    }
    if (!read.logs.empty() && catalogue.properties().empty() && inputs.properties.empty()) {
        throw_no_property(read.logs);
    }
    for (PlacedTable& placed : read.samples) {
        read_loose_samples(placed, inputs, catalogue, samples, diagnostics);
    }
    if (!read.collars.empty() && read.logs.empty() && read.samples.empty()) {
        diagnostics.note("no log is given: the holes are there, but the tessellation has no property to follow");
    }
    checkpoint.pass(0.9);

    Site site;
    site.boreholes = boreholes_of(holes);
    site.samples = std::move(samples);
    site.samples.values.resize(catalogue.properties().size(), std::vector<double>(site.samples.size(), missing));
    site.properties = catalogue.finish(site.samples);
    for (RawSurfaces& raw : read.surfaces) {
        std::ranges::move(raw.surfaces, std::back_inserter(site.surfaces));
    }
    localize(site, target, inputs.z_scale > 0 ? inputs.z_scale : chosen_z_scale(site, target, diagnostics));
    site.samples = selected(site.samples, canonical_order(site.samples));
    std::ranges::stable_sort(site.surfaces, canonical_before);

    counts.boreholes = site.boreholes.size();
    counts.samples = site.samples.size();
    counts.faults = static_cast<std::size_t>(std::ranges::count(site.surfaces, SurfaceKind::fault, &Surface::kind));
    report_progress(progress, "read", 1);
    return site;
}

Site read_site(const SiteInputs& inputs, Diagnostics& diagnostics) {
    ReadCounts counts;
    return read_site(inputs, diagnostics, counts);
}

}  // namespace terratet
