// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// The tessellation for ParaView and everything else that reads VTK: Float64 coordinates in the model's CRS, all
/// properties, roles, regions and quality.

#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <variant>

#include "io/export.hpp"
#include "io/write/clip.hpp"
#include "io/write/vtk_xml.hpp"
#include "io/write/vtu_fields.hpp"
#include "io/write/write_voronoi.hpp"
#include "tess/mesh/quality.hpp"

namespace terratet {
namespace {

constexpr std::uint8_t vtk_tetra = 10;

/// What is written, whole or clipped.
struct Contents {
    std::vector<Vec3> points;  ///< true coordinates
    std::vector<std::array<std::uint32_t, 4>> cells;
    std::vector<std::uint32_t> parent;  ///< of each cell, the tessellation's
    std::vector<float> radius_edge;
    std::vector<float> aspect;
    std::vector<float> dihedral;
    std::vector<std::int32_t> region;
    std::vector<std::uint8_t> in_extent;
    std::vector<Vertex> vertices;
    std::vector<std::int64_t> ids;  ///< −1 for points that are no vertices
    std::vector<std::vector<double>> values;
    std::vector<double> extrapolation;
    std::optional<ClippedShapes> shapes;  ///< when clipped
};

Contents whole(const ModelView& view) {
    Contents contents;
    contents.points = view.mesh.points;
    contents.cells = view.mesh.cells;
    contents.parent.resize(contents.cells.size());
    std::iota(contents.parent.begin(), contents.parent.end(), 0U);
    contents.radius_edge = view.cells.radius_edge;
    contents.aspect = view.cells.aspect;
    contents.dihedral = view.cells.dihedral_min_deg;
    contents.region = view.cells.region;
    contents.in_extent = view.cells.in_extent;
    contents.vertices = view.model.vertices;
    for (const Vertex& vertex : contents.vertices) {
        contents.ids.push_back(static_cast<std::int64_t>(vertex.id));
    }
    contents.values = view.model.vertex_values.values;
    contents.extrapolation = view.model.vertex_values.extrapolation;
    return contents;
}

/// The column of the parents' table that each cell inherits.
template <class To, class From>
std::vector<To> inherited(const std::vector<From>& column, const std::vector<std::uint32_t>& parent) {
    std::vector<To> result(parent.size());
    for (std::size_t c = 0; c < parent.size(); ++c) {
        result[c] = static_cast<To>(column[parent[c]]);
    }
    return result;
}

/// Of cells that are not the tessellation's own.
void measure_changed(const ClippedMesh& mesh, Contents& contents) {
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
        if (mesh.changed[c] != 0) {
            const auto& v = mesh.cells[c];
            const CellQuality quality =
                cell_quality({mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]], mesh.points[v[3]]});
            contents.radius_edge[c] = static_cast<float>(quality.radius_edge);
            contents.aspect[c] = static_cast<float>(quality.aspect);
            contents.dihedral[c] = static_cast<float>(quality.dihedral_min_deg);
        }
    }
}

Contents clipped(const ModelView& view, const Progress& progress) {
    ClippedMesh mesh = clip_to_extent(view, ClippedCells::mended, progress);
    Contents contents;
    contents.vertices = mesh.vertices(view.model);
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
        const bool is_vertex = mesh.place[i] < view.model.vertices.size();
        contents.ids.push_back(is_vertex ? static_cast<std::int64_t>(contents.vertices[i].id) : -1);
    }
    for (std::size_t p = 0; p < view.model.properties.size(); ++p) {
        contents.values.push_back(mesh.values(view.model, p));
    }
    contents.extrapolation = mesh.extrapolation(view.model);
    contents.radius_edge = inherited<float>(view.cells.radius_edge, mesh.parent);
    contents.aspect = inherited<float>(view.cells.aspect, mesh.parent);
    contents.dihedral = inherited<float>(view.cells.dihedral_min_deg, mesh.parent);
    measure_changed(mesh, contents);
    contents.shapes = clipped_shapes(view, mesh);
    contents.points = std::move(mesh.points);
    contents.cells = std::move(mesh.cells);
    contents.parent = std::move(mesh.parent);
    contents.region = std::move(mesh.region);
    contents.in_extent.assign(contents.cells.size(), 1);
    return contents;
}

/// Indices in 32 bits as long as they fit.
class Indices {
  public:
    template <class Fill>
    Indices(std::size_t count, std::uint64_t largest, Fill&& value_at) {
        if (largest <= static_cast<std::uint64_t>(std::numeric_limits<std::int32_t>::max())) {
            fill<std::int32_t>(count, value_at);
        } else {
            fill<std::int64_t>(count, value_at);
        }
    }
    [[nodiscard]] VtkArray array(const char* name) const {
        return std::visit([name](const auto& values) { return vtk_array(name, values); }, values_);
    }

  private:
    template <class T, class Fill>
    void fill(std::size_t count, Fill& value_at) {
        std::vector<T> values(count);
        for (std::size_t i = 0; i < count; ++i) {
            values[i] = static_cast<T>(value_at(i));
        }
        values_ = std::move(values);
    }
    std::variant<std::vector<std::int32_t>, std::vector<std::int64_t>> values_;
};

/// Cells between a fault's sheets are thin on purpose: their quality would be all that a scale shows.
void hide_gaps(const std::vector<std::int32_t>& fault, Contents& contents) {
    for (std::size_t c = 0; c < fault.size(); ++c) {
        if (fault[c] >= 0) {
            contents.radius_edge[c] = contents.aspect[c] = contents.dihedral[c] =
                std::numeric_limits<float>::quiet_NaN();
        }
    }
}

}  // namespace

OutputRecord write_vtu(const ModelView& view, const std::string& path, const ExportOptions& options) {
    if (options.voronoi) {
        return write_voronoi_vtu(view, path, options);
    }
    OutputFile file(path, options.overwrite);
    const Model& model = view.model;
    Contents contents = options.margin ? whole(view) : clipped(view, options.progress);
    for (Vec3& point : contents.points) {
        point = model.frame.to_world(point);
    }
    const VertexArrays of_vertices(model, {std::move(contents.vertices), std::move(contents.ids),
                                           std::move(contents.values), std::move(contents.extrapolation)});

    VtkPiece piece;
    piece.points = contents.points.size();
    piece.cells = contents.cells.size();
    piece.coordinates = {"Points", "Float64", 3, std::as_bytes(std::span(contents.points))};
    static_assert(sizeof(Vec3) == 3 * sizeof(double));

    const Indices connectivity(4 * piece.cells, piece.points,
                               [&](std::size_t i) { return contents.cells[i / 4][i % 4]; });
    const Indices offsets(piece.cells, 4 * piece.cells, [](std::size_t c) { return 4 * (c + 1); });
    const std::vector<std::uint8_t> types(piece.cells, vtk_tetra);
    piece.topology = {connectivity.array("connectivity"), offsets.array("offsets"), vtk_array("types", types)};

    piece.point_data = of_vertices.arrays();
    piece.active_scalars = of_vertices.first_property();

    const auto fault = inherited<std::int32_t>(view.cells.barrier, contents.parent);
    hide_gaps(fault, contents);
    const auto reason = inherited<std::uint8_t>(view.cells.reason, contents.parent);
    piece.cell_data = {vtk_array("MaterialIDs", contents.region),
                       vtk_array("fault", fault),
                       vtk_array("in_extent", contents.in_extent),
                       vtk_array("radius_edge", contents.radius_edge),
                       vtk_array("aspect", contents.aspect),
                       vtk_array("dihedral", contents.dihedral),
                       vtk_array("reason", reason)};
    piece.field_data = vtu_field_data(model, view.cells, of_vertices.property_names());
    write_vtk(piece, options.compress.value_or(true), file, options.progress);
    return {path, file.commit(), contents.shapes};
}

}  // namespace terratet
