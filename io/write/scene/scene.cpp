// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/write/scene/scene.hpp"

#include <algorithm>

#include "tess/error.hpp"

namespace terratet {
namespace {

void append(std::vector<ScenePart>& parts, std::vector<ScenePart> more) {
    for (ScenePart& part : more) {
        if (!part.triangles.empty() || !part.lines.empty()) {
            parts.push_back(std::move(part));
        }
    }
}

std::vector<double> block_volumes(const SceneCells& cells) {
    std::vector<double> volumes(cells.region_names.size(), 0);
    for (std::size_t c = 0; c < cells.mesh.cells.size(); ++c) {
        if (const std::int32_t region = cells.mesh.region[c]; region >= 0 && cells.in_gap[c] == 0) {
            volumes[static_cast<std::size_t>(region)] += cells.volume(c);
        }
    }
    return volumes;
}

}  // namespace

Scene make_scene(const ModelView& view, const ExportOptions& options, ClippedCells cells) {
    const Model& model = view.model;
    Scene scene{SceneFrame(model, options.enu ? SceneFrame::Axes::enu : SceneFrame::Axes::grid, options.vertical_crs),
                Coloring(view, options.color_property, options.color_map),
                scene_cells(view, options.progress, cells),
                {},
                {}};
    report_progress(options.progress, "write scene", 0.2);
    const double reach = options.max_extrapolation.value_or(1);
    for (const Section& section : options.sections.empty() ? default_sections(model) : options.sections) {
        ScenePart part = section_part(scene.cells, section, scene.coloring, scene.frame, reach);
        if (part.triangles.empty() && !options.sections.empty()) {
            throw UsageError("`section` " + section.name + " does not meet the model");
        }
        append(scene.parts, {std::move(part)});
    }
    append(scene.parts, isosurface_parts(scene.cells, options, scene.coloring, scene.frame));
    append(scene.parts, surface_parts(scene.cells, view, scene.frame));
    report_progress(options.progress, "write scene", 0.4);
    for (std::size_t b = 0; b < model.barriers.size(); ++b) {
        if (!is_bound(model.barriers[b].sheet.kind)) {  // the model ends there
            append(scene.parts, {barrier_part(model, b, scene.frame)});
        }
    }
    append(scene.parts, borehole_parts(view, scene.coloring, scene.frame));
    append(scene.parts, {frame_part(model, scene.frame)});
    scene.block_volume = block_volumes(scene.cells);
    return scene;
}

ScenePart frame_part(const Model& model, const SceneFrame& frame) {
    const Box3& extent = model.domain.extent;
    Rings rings = model.domain.outline;
    if (rings.empty()) {
        rings = {
            {extent.lo, {extent.hi.x, extent.lo.y, 0}, {extent.hi.x, extent.hi.y, 0}, {extent.lo.x, extent.hi.y, 0}}};
    }
    ScenePart part;
    part.name = "extent";
    part.kind = ScenePart::Kind::frame;
    part.color = {0.45, 0.48, 0.52};
    std::vector<Vec3> places;
    for (const std::vector<Vec3>& ring : rings) {
        const auto first = static_cast<std::uint32_t>(places.size());
        const auto n = static_cast<std::uint32_t>(ring.size());
        for (std::uint32_t k = 0; k < n; ++k) {
            const std::uint32_t here = first + 2 * k;
            const std::uint32_t next = first + 2 * ((k + 1) % n);
            places.push_back({ring[k].x, ring[k].y, extent.lo.z});
            places.push_back({ring[k].x, ring[k].y, extent.hi.z});
            part.lines.push_back({here, next});
            part.lines.push_back({here + 1, next + 1});
            if (n <= 12) {  // else they would be a fence
                part.lines.push_back({here, here + 1});
            }
        }
    }
    part.positions = frame.positions(places);
    return part;
}

std::vector<Vec3> vertex_normals(const std::vector<Vec3>& positions, const std::vector<Triangle>& triangles) {
    std::vector<Vec3> normals(positions.size());
    for (const auto& [a, b, c] : triangles) {
        const Vec3 normal = cross(positions[b] - positions[a], positions[c] - positions[a]);
        for (const std::uint32_t v : {a, b, c}) {
            normals[v] = normals[v] + normal;
        }
    }
    for (Vec3& normal : normals) {
        const double l = length(normal);
        normal = l > 0 ? normal / l : Vec3{0, 1, 0};
    }
    return normals;
}

}  // namespace terratet
