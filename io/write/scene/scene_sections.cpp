// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// Sections and isosurfaces: cuts of the cells.

#include <algorithm>
#include <cmath>

#include "io/write/scene/scene.hpp"
#include "io/write/scene/scene_text.hpp"
#include "tess/base/words.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

constexpr Color greyed{0.80, 0.81, 0.83};  ///< beyond the reach of the samples

CutPlane local_plane(const Section& section, const Frame& frame) {
    // A normal goes the other way than a size under the frame's z-scale.
    Vec3 normal = section.normal;
    normal.z /= frame.z_scale;
    return CutPlane::through(frame.to_local(section.point), normal);
}

std::vector<double> distances(const SceneCells& cells, const CutPlane& plane) {
    std::vector<double> result;
    result.reserve(cells.mesh.points.size());
    for (const Vec3& p : cells.mesh.points) {
        result.push_back(plane.distance(p));
    }
    return result;
}

/// What of a curtain is between its ends.
CutTriangles between_ends(CutTriangles cut, const SceneCells& cells, const Section& section) {
    const auto& [a, b] = *section.ends;
    const Frame& frame = cells.model->frame;
    const Vec3 along = frame.to_local(b) - frame.to_local(a);
    cut = part_above(cut, distances(cells, CutPlane::through(frame.to_local(a), along)), 0);
    return part_above(cut, distances(cells, CutPlane::through(frame.to_local(b), -along)), 0);
}

/// Adds triangles with their values; corners are coloured by `color`, given the corner's number among them.
template <class Paint>
void add(ScenePart& part, const CutTriangles& cut, const SceneCells& cells, const SceneFrame& frame, Paint&& color) {
    const auto first = static_cast<std::uint32_t>(part.positions.size());
    const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
    append(part.positions, frame.positions(cut.positions(cells)));
    append(part.extrapolation, cut.extrapolation(cells));
    part.values.resize(cells.values.size());
    for (std::size_t p = 0; p < part.values.size(); ++p) {
        append(part.values[p], cut.values(cells, p));
    }
    for (const auto& [a, b, c] : cut.triangles) {
        part.triangles.push_back({first + a, first + b, first + c});
    }
    for (std::size_t v = 0; v < cut.places.size(); ++v) {
        part.colors.push_back(color(first + v));
    }
}

/// The triangles of each fault block, apart, so that their colours do not run into each other.
void add_by_block(ScenePart& part, const CutTriangles& cut, const SceneCells& cells, const SceneFrame& frame) {
    for (std::size_t region = 0; region < cells.region_names.size(); ++region) {
        CutTriangles own;
        own.places = cut.places;
        for (std::size_t t = 0; t < cut.triangles.size(); ++t) {
            if (cells.mesh.region[cut.cell[t]] == static_cast<std::int32_t>(region)) {
                own.triangles.push_back(cut.triangles[t]);
                own.cell.push_back(cut.cell[t]);
            }
        }
        own.drop_unused_places();
        add(part, own, cells, frame, [&](std::size_t) { return class_color(region); });
    }
}

void paint(ScenePart& part, const CutTriangles& cut, const SceneCells& cells, const Coloring& coloring,
           const SceneFrame& frame) {
    if (!coloring.has_property()) {
        add_by_block(part, cut, cells, frame);
    } else if (coloring.categorical()) {
        std::vector<std::uint32_t> owner;
        const CutTriangles pieces = by_nearest_point(cells, cut, owner);
        const std::size_t before = part.positions.size();
        add(part, pieces, cells, frame,
            [&](std::size_t v) { return coloring.at(cells.values[coloring.index()][owner[v - before]]); });
        for (std::size_t k = 0; k < owner.size(); ++k) {  // ties between pieces are settled by the piece
            part.values[coloring.index()][before + k] = cells.values[coloring.index()][owner[k]];
        }
    } else {
        add(part, cut, cells, frame, [&](std::size_t v) { return coloring.at(part.values[coloring.index()][v]); });
    }
}

double middle_of(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// To the number with few digits next to it.
double rounded(double value, double size) {
    const double step = std::pow(10, std::floor(std::log10(size / 50)));
    return std::round(value / step) * step;
}

ScenePart isosurface_part(const SceneCells& cells, const IsoLevel& level, double opacity, const ExportOptions& options,
                          const Coloring& coloring, const SceneFrame& frame) {
    const Property& p = cells.model->properties[level.property];
    const CutTriangles cut = isosurface(cells, level, options);
    ScenePart part;
    const double value = from_scale(p, level.scaled);
    part.name = "isosurface: " + p.name + "=" + number_text(value) + (p.unit.empty() ? "" : " " + p.unit);
    part.kind = ScenePart::Kind::isosurface;
    part.property = p.name;
    part.level = value;
    part.opacity = opacity;
    part.color =
        coloring.has_property() && coloring.index() == level.property ? coloring.at(value) : Color{0.4, 0.5, 0.6};
    add(part, cut, cells, frame, [&](std::size_t) { return part.color; });
    part.colors.clear();
    part.normals = vertex_normals(part.positions, part.triangles);
    return part;
}

}  // namespace

ScenePart section_part(const SceneCells& cells, const Section& section, const Coloring& coloring,
                       const SceneFrame& frame, double max_extrapolation) {
    ScenePart part;
    part.name = "section: " + section.name;
    CutTriangles cut = cut_triangles(
        cut_cells(cells.mesh.points, cells.mesh.cells, local_plane(section, cells.model->frame), cells.in_gap));
    if (section.ends) {
        cut = between_ends(std::move(cut), cells, section);
    }
    // At 1 the samples do not reach at all.
    const double reach = max_extrapolation < 1 ? max_extrapolation : 1 - 1e-9;
    std::vector<double> nearness;
    nearness.reserve(cells.extrapolation.size());
    for (const double e : cells.extrapolation) {
        nearness.push_back(-e);
    }
    paint(part, part_above(cut, nearness, -reach), cells, coloring, frame);
    std::vector<double> farness;
    farness.reserve(nearness.size());
    for (const double e : nearness) {
        farness.push_back(-e);
    }
    if (coloring.has_property()) {
        add(part, part_above(cut, farness, reach), cells, frame, [](std::size_t) { return greyed; });
    } else {
        paint(part, part_above(cut, farness, reach), cells, coloring, frame);
    }
    return part;
}

std::vector<Section> default_sections(const Model& model) {
    const Frame& frame = model.frame;
    const Box3 extent{frame.to_world(model.domain.extent.lo), frame.to_world(model.domain.extent.hi)};
    Vec3 middle = extent.center();
    if (model.samples.size() > 0) {
        std::vector<double> xs;
        std::vector<double> ys;
        for (const Vec3& p : model.samples.positions) {
            const Vec3 world = frame.to_world(p);
            xs.push_back(world.x);
            ys.push_back(world.y);
        }
        middle.x = middle_of(std::move(xs));
        middle.y = middle_of(std::move(ys));
    }
    middle.x = std::clamp(rounded(middle.x, extent.size().x), extent.lo.x, extent.hi.x);
    middle.y = std::clamp(rounded(middle.y, extent.size().y), extent.lo.y, extent.hi.y);
    return {{"E-W y=" + number_text(middle.y, 9), middle, {0, -1, 0}, {}},
            {"N-S x=" + number_text(middle.x, 9), middle, {1, 0, 0}, {}}};
}

CutTriangles isosurface(const SceneCells& cells, const IsoLevel& level, const ExportOptions& options) {
    const CutTriangles cut =
        cut_triangles(cut_cells(cells.mesh.cells, cells.scaled(level.property), level.scaled, cells.in_gap));
    std::vector<double> nearness;
    for (const double e : cells.extrapolation) {
        nearness.push_back(-e);
    }
    const double reach = std::min(options.max_extrapolation.value_or(1), 1.0);
    return part_above(cut, nearness, reach < 1 ? -reach : -1 + 1e-9);
}

std::vector<IsoLevel> iso_levels(const Model& model, const ExportOptions& options, const Coloring& coloring) {
    std::vector<IsoLevel> levels;
    for (const IsoLevels& wanted : options.iso) {
        const auto found = std::find_if(model.properties.begin(), model.properties.end(),
                                        [&](const Property& p) { return p.name == wanted.property; });
        if (found == model.properties.end()) {
            const auto names = names_of(model.properties, &Property::name);
            throw UsageError("`iso`: no property '" + wanted.property + "'; there is " + listed(names) +
                             did_you_mean(wanted.property, names));
        }
        if (found->kind == Kind::categorical) {
            throw UsageError("`iso`: '" + wanted.property + "' has classes, and no level between them");
        }
        for (const double value : wanted.values) {
            const double scaled = to_scale(*found, value);
            if (!std::isfinite(scaled)) {
                throw UsageError("`iso`: " + number_text(value) + " is no value of '" + wanted.property +
                                 "', whose scale is log10");
            }
            levels.push_back({static_cast<std::size_t>(found - model.properties.begin()), scaled});
        }
    }
    if (options.iso.empty() && coloring.has_property() && !coloring.categorical()) {
        for (const double level : sample_quartiles(model, coloring.index())) {
            levels.push_back({coloring.index(), to_scale(coloring.property(), level)});
        }
    }
    return levels;
}

std::vector<ScenePart> isosurface_parts(const SceneCells& cells, const ExportOptions& options, const Coloring& coloring,
                                        const SceneFrame& frame) {
    std::vector<ScenePart> parts;
    double opacity = options.iso.empty() ? 0.12 : 0.5;  // the inner ones are seen through the outer
    for (const IsoLevel& level : iso_levels(*cells.model, options, coloring)) {
        parts.push_back(isosurface_part(cells, level, opacity, options, coloring, frame));
        opacity += options.iso.empty() ? 0.15 : 0;
    }
    return parts;
}

}  // namespace terratet
