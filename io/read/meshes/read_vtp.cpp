// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>

#include "io/read/meshes/mesh_readers.hpp"
#include "io/read/meshes/vtk_tags.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

/// One Piece: its points, and polygons or strips as corners and where each ends.
struct Piece {
    std::vector<double> points;
    std::vector<double> polygons, polygon_ends;
    std::vector<double> strips, strip_ends;
};

std::int64_t whole(double number) {
    return number >= 0 && number < 1e15 ? static_cast<std::int64_t>(number) : -1;
}

/// Calls `use` with the corners of each cell.
template <typename Use>
void for_each_cell(const std::vector<double>& corners, const std::vector<double>& ends, const Use& use) {
    std::size_t begin = 0;
    for (const double end_number : ends) {
        const std::int64_t end = whole(end_number);
        if (end < static_cast<std::int64_t>(begin) || end > static_cast<std::int64_t>(corners.size())) {
            throw InputError("the offsets of its cells do not suit their connectivity");
        }
        std::vector<std::int64_t> cell;
        for (; begin < static_cast<std::size_t>(end); ++begin) {
            cell.push_back(whole(corners[begin]));
        }
        use(cell);
    }
}

void add(const Piece& piece, MeshBuilder& mesh) {
    const auto first = static_cast<std::int64_t>(mesh.vertices());
    const auto count = static_cast<std::int64_t>(piece.points.size() / 3);
    for (std::size_t i = 0; i + 2 < piece.points.size(); i += 3) {
        mesh.vertex({piece.points[i], piece.points[i + 1], piece.points[i + 2]}, static_cast<std::int64_t>(i / 3) + 1);
    }
    std::int64_t number = 0;
    const auto in_mesh = [&](std::int64_t corner) { return corner >= 0 && corner < count ? first + corner : -1; };
    for_each_cell(piece.polygons, piece.polygon_ends, [&](std::vector<std::int64_t> cell) {
        std::ranges::transform(cell, cell.begin(), in_mesh);
        mesh.face(cell, ++number);
    });
    for_each_cell(piece.strips, piece.strip_ends, [&](const std::vector<std::int64_t>& cell) {
        ++number;
        for (std::size_t k = 0; k + 2 < cell.size(); ++k) {
            const std::size_t odd = k % 2;
            mesh.face(std::array{in_mesh(cell[k + odd]), in_mesh(cell[k + 1 - odd]), in_mesh(cell[k + 2])}, number);
        }
    });
}

}  // namespace

void read_vtp(std::string_view bytes, MeshBuilder& mesh) {
    const VtkEncoding encoding = vtk_encoding(bytes, "PolyData");
    const std::size_t appended = bytes.find("<AppendedData");
    VtkTags tags(bytes.substr(0, appended));
    VtkTag tag;
    std::string section;
    Piece piece;
    while (tags.next(tag)) {
        if (tag.name == "Piece") {
            piece = {};
        } else if (tag.name == "/Piece") {
            add(piece, mesh);
        } else if (tag.name == "Points" || tag.name == "Polys" || tag.name == "Strips") {
            section = std::string(tag.name);
        } else if (tag.name.starts_with('/') && tag.name.substr(1) == section) {
            section.clear();
        } else if (tag.name == "DataArray" && !section.empty()) {
            const bool ends = tag.value("Name") == "offsets";
            std::vector<double>& target = section == "Points"  ? piece.points
                                          : section == "Polys" ? (ends ? piece.polygon_ends : piece.polygons)
                                                               : (ends ? piece.strip_ends : piece.strips);
            target = vtk_array(tag.attributes, tags.until_next(), encoding, bytes.size());
        }
    }
}

}  // namespace terratet
