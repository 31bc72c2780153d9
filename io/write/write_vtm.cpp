// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// All that ParaView shows of a model in one multiblock file: the mesh, the boreholes as lines with their samples'
/// values, the barriers. NAME.vtm names the pieces, which lie in a folder NAME beside it and are there first.

#include <algorithm>
#include <filesystem>

#include "io/base/output_file.hpp"
#include "io/export.hpp"
#include "io/read/column_names.hpp"
#include "io/style/markup.hpp"
#include "io/write/companions.hpp"
#include "io/write/vtk_xml.hpp"

namespace terratet {
namespace {

namespace fs = std::filesystem;

/// Lines or triangles with the arrays that they have.
struct Shapes {
    std::vector<Vec3> points;  ///< true coordinates
    std::vector<std::int32_t> connectivity;
    std::vector<std::int32_t> offsets;
    std::vector<std::int32_t> number;  ///< of each cell: its borehole, its barrier
};

/// The samples of each borehole by depth; a hole of fewer than two as it runs.
std::vector<std::vector<std::uint32_t>> samples_of_holes(const Model& model) {
    std::vector<std::vector<std::uint32_t>> of_hole(model.boreholes.size());
    for (std::uint32_t s = 0; s < model.samples.size(); ++s) {
        if (const std::int32_t hole = model.samples.borehole[s]; hole >= 0) {
            of_hole[static_cast<std::size_t>(hole)].push_back(s);
        }
    }
    for (auto& samples : of_hole) {
        std::ranges::stable_sort(samples, {}, [&](std::uint32_t s) { return model.samples.depth[s]; });
    }
    return of_hole;
}

void end_line(std::size_t first, std::int32_t hole, Shapes& shapes) {
    for (std::size_t i = first; i < shapes.points.size(); ++i) {
        shapes.connectivity.push_back(static_cast<std::int32_t>(i));
    }
    shapes.offsets.push_back(static_cast<std::int32_t>(shapes.connectivity.size()));
    shapes.number.push_back(hole);
}

VtkPiece piece_of(const Shapes& shapes, VtkPiece::Kind kind, const char* number, const Model& model) {
    VtkPiece piece;
    piece.kind = kind;
    piece.points = shapes.points.size();
    piece.cells = shapes.offsets.size();
    piece.coordinates = {"Points", "Float64", 3, std::as_bytes(std::span(shapes.points))};
    piece.topology = {vtk_array("connectivity", shapes.connectivity), vtk_array("offsets", shapes.offsets)};
    piece.cell_data = {vtk_array(number, shapes.number)};
    piece.field_data = {{"CRS", {model.frame.crs_wkt}}};
    return piece;
}

std::uint64_t write_boreholes(const Model& model, const std::string& path, const ExportOptions& options) {
    Shapes shapes;
    std::vector<std::vector<double>> values(model.properties.size());
    std::vector<double> depth;
    const auto of_hole = samples_of_holes(model);
    for (std::size_t hole = 0; hole < of_hole.size(); ++hole) {
        const std::size_t first = shapes.points.size();
        const bool by_samples = of_hole[hole].size() > 1;
        const Borehole& borehole = model.boreholes[hole];
        const std::size_t count = by_samples ? of_hole[hole].size() : borehole.path.size();
        for (std::size_t i = 0; i < count; ++i) {
            const std::uint32_t s = by_samples ? of_hole[hole][i] : 0;
            shapes.points.push_back(model.frame.to_world(by_samples ? model.samples.positions[s] : borehole.path[i]));
            depth.push_back(by_samples ? model.samples.depth[s] : borehole.path_depth[i]);
            for (std::size_t p = 0; p < values.size(); ++p) {
                values[p].push_back(by_samples ? model.samples.values[p][s] : missing);
            }
        }
        end_line(first, static_cast<std::int32_t>(hole), shapes);
    }
    VtkPiece piece = piece_of(shapes, VtkPiece::Kind::lines, "borehole", model);
    std::vector<std::string> names;
    for (const Property& property : model.properties) {
        names.push_back(property.name);
    }
    names = distinct_names(std::move(names), std::array{"depth"});
    for (std::size_t p = 0; p < values.size(); ++p) {
        piece.point_data.push_back(vtk_array(names[p], values[p]));
    }
    piece.point_data.push_back(vtk_array("depth", depth));
    piece.active_scalars = names.empty() ? "" : names[0];
    VtkStrings ids{"Boreholes", {}};
    for (const Borehole& borehole : model.boreholes) {
        ids.values.push_back(borehole.id);
    }
    piece.field_data.push_back(ids);
    OutputFile file(path, options.overwrite);
    write_vtk(piece, options.compress.value_or(true), file, options.progress);
    return file.commit();
}

std::uint64_t write_barriers(const Model& model, const std::string& path, const ExportOptions& options) {
    Shapes shapes;
    VtkStrings names{"Barriers", {}};
    for (std::size_t b = 0; b < model.barriers.size(); ++b) {
        const auto& sheet = model.barriers[b].sheet;
        const auto first = static_cast<std::int32_t>(shapes.points.size());
        names.values.push_back(model.barriers[b].name);
        for (const Vec3& vertex : sheet.vertices) {
            shapes.points.push_back(model.frame.to_world(vertex));
        }
        for (const Triangle& triangle : sheet.triangles) {
            for (const std::uint32_t corner : triangle) {
                shapes.connectivity.push_back(first + static_cast<std::int32_t>(corner));
            }
            shapes.offsets.push_back(static_cast<std::int32_t>(shapes.connectivity.size()));
            shapes.number.push_back(static_cast<std::int32_t>(b));
        }
    }
    VtkPiece piece = piece_of(shapes, VtkPiece::Kind::polys, "barrier", model);
    piece.field_data.push_back(names);
    OutputFile file(path, options.overwrite);
    write_vtk(piece, options.compress.value_or(true), file, options.progress);
    return file.commit();
}

}  // namespace

OutputRecord write_vtm(const ModelView& view, const std::string& path, const ExportOptions& options) {
    OutputFile file(path, options.overwrite);
    const Companions companions(path);
    const fs::path& folder = companions.folder();
    OutputRecord record = write_vtu(view, (folder / "mesh.vtu").string(), options);
    record.bytes += write_boreholes(view.model, (folder / "boreholes.vtp").string(), options);
    record.bytes += write_barriers(view.model, (folder / "barriers.vtp").string(), options);
    std::string text =
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"vtkMultiBlockDataSet\" version=\"1.0\" "
        "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<vtkMultiBlockDataSet>\n";
    int index = 0;
    for (const char* piece : {"mesh.vtu", "boreholes.vtp", "barriers.vtp"}) {
        const fs::path name(piece);
        text += "<DataSet index=\"" + std::to_string(index++) + "\" name=\"" + name.stem().string() + "\" file=\"" +
                markup_text((folder.filename() / name).string()) + "\"/>\n";
    }
    file.write(text + "</vtkMultiBlockDataSet>\n</VTKFile>\n");
    record.path = path;
    record.bytes += file.commit();
    return record;
}

}  // namespace terratet
