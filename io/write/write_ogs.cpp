// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// Meshes for OpenGeoSys 6: the tetrahedra in NAME.vtu, with MaterialIDs; in a folder NAME the facets of each barrier
/// and of each side of the extent, whose bulk_node_ids and bulk_element_ids say what in the former they are.

#include <algorithm>
#include <limits>

#include "io/write/clip.hpp"
#include "io/write/companions.hpp"
#include "io/write/mesh_groups.hpp"
#include "io/write/vtk_xml.hpp"
#include "io/write/vtu_fields.hpp"

namespace terratet {
namespace {

/// Elements of one kind with their points.
struct Elements {
    std::vector<Vec3> points;
    std::vector<std::int64_t> connectivity;
    std::vector<std::int64_t> offsets;
    std::vector<std::uint8_t> types;

    void add(std::span<const std::uint32_t> corners) {
        constexpr std::uint8_t vtk_triangle = 5;
        constexpr std::uint8_t vtk_tetra = 10;
        connectivity.insert(connectivity.end(), corners.begin(), corners.end());
        offsets.push_back(std::ssize(connectivity));
        types.push_back(corners.size() == 3 ? vtk_triangle : vtk_tetra);
    }
    [[nodiscard]] VtkPiece piece() const {
        VtkPiece piece;
        piece.points = points.size();
        piece.cells = types.size();
        piece.coordinates = {"Points", "Float64", 3, std::as_bytes(std::span(points))};
        piece.topology = {vtk_array("connectivity", connectivity), vtk_array("offsets", offsets),
                          vtk_array("types", types)};
        return piece;
    }
};

/// Facets with the bulk's numbers.
struct Submesh {
    Elements elements;
    std::vector<std::uint64_t> nodes;
    std::vector<std::uint64_t> cells;

    Submesh(const MeshGroup& group, const std::vector<Vec3>& points) {
        for (const auto& v : group.elements) {
            nodes.insert(nodes.end(), v.begin(), v.begin() + 3);
        }
        std::ranges::sort(nodes);
        nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
        for (const std::uint64_t node : nodes) {
            elements.points.push_back(points[node]);
        }
        for (std::size_t e = 0; e < group.elements.size(); ++e) {
            Triangle corners{};
            for (std::size_t k = 0; k < 3; ++k) {
                const auto at = std::ranges::lower_bound(nodes, std::uint64_t{group.elements[e][k]});
                corners[k] = static_cast<std::uint32_t>(at - nodes.begin());
            }
            elements.add(corners);
            cells.push_back(group.cells[e]);
        }
    }
};

/// Blocks have their own numbers; gaps follow, since OpenGeoSys takes none below 0.
std::vector<std::int32_t> materials(const ModelView& view, const ClippedMesh& mesh) {
    std::vector<std::int32_t> result = mesh.region;
    for (std::size_t c = 0; c < result.size(); ++c) {
        if (result[c] < 0) {
            result[c] = view.cells.region_count + 1 + view.cells.barrier[mesh.parent[c]];
        }
    }
    return result;
}

}  // namespace

OutputRecord write_ogs(const ModelView& view, const std::string& path, const ExportOptions& options) {
    OutputFile file(path, options.overwrite);
    const ClippedMesh mesh = clip_to_extent(view, ClippedCells::mended, options.progress);
    Elements bulk;
    for (const Vec3& point : mesh.points) {
        bulk.points.push_back(view.model.frame.to_world(point));
    }
    for (const auto& cell : mesh.cells) {
        bulk.add(cell);
    }
    VertexTable table;
    table.vertices = mesh.vertices(view.model);
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
        const bool is_vertex = mesh.place[i] < view.model.vertices.size();
        table.ids.push_back(is_vertex ? static_cast<std::int64_t>(table.vertices[i].id) : -1);
    }
    for (std::size_t p = 0; p < view.model.properties.size(); ++p) {
        table.values.push_back(mesh.values(view.model, p));
    }
    table.extrapolation = mesh.extrapolation(view.model);
    const VertexArrays of_vertices(view.model, std::move(table));
    const std::vector<std::int32_t> material = materials(view, mesh);
    VtkPiece piece = bulk.piece();
    piece.point_data = of_vertices.arrays();
    piece.cell_data = {vtk_array("MaterialIDs", material)};
    piece.field_data = vtu_field_data(view.model, view.cells, of_vertices.property_names());
    write_vtk(piece, options.compress.value_or(true), file, options.progress);

    Companions companions(path);
    std::uint64_t bytes = 0;
    for (const MeshGroup& group : mesh_groups(view, mesh)) {
        if (group.dimension != 2) {
            continue;
        }
        const Submesh submesh(group, bulk.points);
        VtkPiece part = submesh.elements.piece();
        part.point_data = {vtk_array("bulk_node_ids", submesh.nodes)};
        part.cell_data = {vtk_array("bulk_element_ids", submesh.cells)};
        OutputFile part_file(companions.path_of(group.name, ".vtu"), options.overwrite);
        write_vtk(part, options.compress.value_or(true), part_file, options.progress);
        bytes += part_file.commit();
    }
    return {path, bytes + file.commit(), clipped_shapes(view, mesh)};
}

}  // namespace terratet
