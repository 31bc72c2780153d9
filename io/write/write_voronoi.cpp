// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/write/write_voronoi.hpp"

#include <algorithm>

#include "io/write/vtu_fields.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

constexpr std::uint8_t vtk_polyhedron = 42;
constexpr const char* own_arrays[] = {"MaterialIDs", "volume", "area", "barrier", "barrier_area"};

/// A polyhedron's points, each once, and its faces as VTK's streams of numbers have them.
struct Polyhedra {
    std::vector<std::int64_t> connectivity;
    std::vector<std::int64_t> offsets;
    std::vector<std::int64_t> faces;
    std::vector<std::int64_t> face_offsets;
};

Polyhedra polyhedra_of(const VoronoiComplex& complex, const WallsOfCells& walls, std::size_t cells) {
    Polyhedra result;
    for (std::size_t cell = 0; cell < cells; ++cell) {
        const auto first = result.connectivity.size();
        const auto of_cell = walls.of(cell);
        result.faces.push_back(std::ssize(of_cell));
        for (const std::uint32_t w : of_cell) {
            const auto polygon = complex.polygon(complex.walls[w]);
            result.faces.push_back(std::ssize(polygon));
            const auto begin = result.faces.size();
            result.faces.insert(result.faces.end(), polygon.begin(), polygon.end());
            if (complex.walls[w].cell != cell) {  // seen from the other side
                std::reverse(result.faces.begin() + static_cast<std::ptrdiff_t>(begin), result.faces.end());
            }
            result.connectivity.insert(result.connectivity.end(), polygon.begin(), polygon.end());
        }
        const auto of_this = result.connectivity.begin() + static_cast<std::ptrdiff_t>(first);
        std::sort(of_this, result.connectivity.end());
        result.connectivity.erase(std::unique(of_this, result.connectivity.end()), result.connectivity.end());
        result.offsets.push_back(std::ssize(result.connectivity));
        result.face_offsets.push_back(std::ssize(result.faces));
    }
    return result;
}

struct CellColumns {
    std::vector<double> area;           ///< of all walls
    std::vector<std::int32_t> barrier;  ///< that a wall stands for; the first
    std::vector<double> barrier_area;   ///< of such walls
};

CellColumns columns_of(const MappedVoronoi& voronoi, const WallsOfCells& walls) {
    const std::size_t cells = voronoi.cells.vertex.size();
    CellColumns columns{std::vector<double>(cells), std::vector<std::int32_t>(cells, -1), std::vector<double>(cells)};
    for (std::size_t cell = 0; cell < cells; ++cell) {
        for (const std::uint32_t w : walls.of(cell)) {
            const double area = length(voronoi.measures.area[w]);
            columns.area[cell] += area;
            if (const std::int32_t barrier = voronoi.cells.barrier[w]; barrier >= 0) {
                std::int32_t& first = columns.barrier[cell];
                first = first < 0 ? barrier : std::min(first, barrier);
                columns.barrier_area[cell] += area;
            }
        }
    }
    return columns;
}

template <class T>
std::vector<T> of_cells(const std::vector<T>& of_vertices, const std::vector<std::uint32_t>& vertex) {
    std::vector<T> result;
    result.reserve(vertex.size());
    for (const std::uint32_t v : vertex) {
        result.push_back(of_vertices[v]);
    }
    return result;
}

VertexTable table_of(const Model& model, const std::vector<std::uint32_t>& vertex) {
    VertexTable table;
    table.vertices = of_cells(model.vertices, vertex);
    for (const Vertex& v : table.vertices) {
        table.ids.push_back(static_cast<std::int64_t>(v.id));
    }
    for (const auto& values : model.vertex_values.values) {
        table.values.push_back(of_cells(values, vertex));
    }
    table.extrapolation = of_cells(model.vertex_values.extrapolation, vertex);
    return table;
}

}  // namespace

MappedVoronoi mapped_voronoi(const ModelView& view, const Progress& progress) {
    const Frame& frame = view.model.frame;
    MappedVoronoi result;
    const BarrierQuery barriers(view.model.barriers);
    result.cells =
        voronoi_cells(view.model, view.mesh, view.cells, barriers, [&] { report_progress(progress, "voronoi", 0); });
    std::vector<Vec3>& points = result.points;
    points = result.cells.complex.points;
    for (Vec3& point : points) {  // near the origin: where coordinates are large, areas would lose digits
        point = frame.to_world_size(point);
    }
    result.measures = measure(result.cells.complex, points, result.cells.vertex.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        points[i] = frame.to_world(result.cells.complex.points[i]);
    }
    return result;
}

OutputRecord write_voronoi_vtu(const ModelView& view, const std::string& path, const ExportOptions& options) {
    OutputFile file(path, options.overwrite);
    const MappedVoronoi voronoi = mapped_voronoi(view, options.progress);
    const auto& [cells, points, measures] = voronoi;
    const std::size_t count = cells.vertex.size();
    const WallsOfCells walls = walls_of_cells(cells.complex, count);
    const Polyhedra polyhedra = polyhedra_of(cells.complex, walls, count);
    VtkPiece piece;
    piece.points = points.size();
    piece.cells = count;
    piece.coordinates = {"Points", "Float64", 3, std::as_bytes(std::span(points))};
    const std::vector<std::uint8_t> types(count, vtk_polyhedron);
    piece.topology = {vtk_array("connectivity", polyhedra.connectivity), vtk_array("offsets", polyhedra.offsets),
                      vtk_array("types", types), vtk_array("faces", polyhedra.faces),
                      vtk_array("faceoffsets", polyhedra.face_offsets)};
    const VertexArrays of_vertices(view.model, table_of(view.model, cells.vertex), own_arrays);
    const CellColumns columns = columns_of(voronoi, walls);
    piece.cell_data = of_vertices.arrays();
    piece.cell_data.insert(
        piece.cell_data.end(),
        {vtk_array("MaterialIDs", cells.region), vtk_array("volume", measures.volume), vtk_array("area", columns.area),
         vtk_array("barrier", columns.barrier), vtk_array("barrier_area", columns.barrier_area)});
    piece.field_data = vtu_field_data(view.model, view.cells, of_vertices.property_names());
    write_vtk(piece, options.compress.value_or(true), file, options.progress);
    return {path, file.commit(), {}};
}

}  // namespace terratet
