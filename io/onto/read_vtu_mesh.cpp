// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <iterator>

#include "io/onto/mesh_formats.hpp"
#include "io/read/meshes/vtk_tags.hpp"

namespace terratet {
namespace {

std::int64_t whole(double number) {
    return number >= -1 && number < 9e15 ? static_cast<std::int64_t>(number) : -1;
}

std::vector<std::int64_t> wholes(const std::vector<double>& numbers) {
    std::vector<std::int64_t> result;
    result.reserve(numbers.size());
    for (const double number : numbers) {
        result.push_back(whole(number));
    }
    return result;
}

void append_shifted(std::vector<std::int64_t>& to, const std::vector<std::int64_t>& from, std::int64_t shift) {
    for (const std::int64_t number : from) {
        to.push_back(number < 0 ? number : number + shift);
    }
}

/// Of polyhedra: how many faces, and of each how many nodes and which.
void append_faces(std::vector<std::int64_t>& to, const std::vector<std::int64_t>& faces,
                  const std::vector<std::int64_t>& ends, std::int64_t first_node) {
    std::size_t begin = 0;
    for (const std::int64_t end_number : ends) {
        if (end_number < 0) {
            continue;  // no polyhedron
        }
        const std::size_t end = std::min(static_cast<std::size_t>(end_number), faces.size());
        std::size_t left = 0;  // nodes of the face
        for (std::size_t i = begin; i < end; ++i) {
            const bool count = i == begin || left == 0;
            left = i == begin ? 0 : count ? static_cast<std::size_t>(std::max<std::int64_t>(faces[i], 0)) : left - 1;
            to.push_back(count ? faces[i] : faces[i] + first_node);
        }
        begin = end;
    }
}

/// One Piece as it is written.
struct Piece {
    std::vector<double> points;
    std::vector<std::int64_t> nodes, ends, faces, face_ends;
    std::vector<std::uint8_t> types;
};

void append(PlaceMesh& mesh, const Piece& piece) {
    const auto first = static_cast<std::int64_t>(mesh.points.size());
    const auto first_end = static_cast<std::int64_t>(mesh.nodes.size());
    for (std::size_t i = 0; i + 2 < piece.points.size(); i += 3) {
        mesh.points.push_back({piece.points[i], piece.points[i + 1], piece.points[i + 2]});
    }
    append_shifted(mesh.nodes, piece.nodes, first);
    append_shifted(mesh.ends, piece.ends, first_end);
    if (!piece.face_ends.empty() || !mesh.face_ends.empty()) {
        mesh.face_ends.resize(mesh.types.size(), -1);
        const auto first_face = static_cast<std::int64_t>(mesh.faces.size());
        append_faces(mesh.faces, piece.faces, piece.face_ends, first);
        append_shifted(mesh.face_ends, piece.face_ends, first_face);
        mesh.face_ends.resize(mesh.types.size() + piece.types.size(), -1);
    }
    mesh.types.insert(mesh.types.end(), piece.types.begin(), piece.types.end());
}

}  // namespace

PlaceMesh read_vtu_mesh(std::string_view bytes) {
    const VtkEncoding encoding = vtk_encoding(bytes, "UnstructuredGrid");
    VtkTags tags(bytes.substr(0, bytes.find("<AppendedData")));
    VtkTag tag;
    std::string section;
    PlaceMesh mesh;
    Piece piece;
    while (tags.next(tag)) {
        if (tag.name == "Piece") {
            piece = {};
        } else if (tag.name == "/Piece") {
            append(mesh, piece);
        } else if (tag.name == "Points" || tag.name == "Cells") {
            section = std::string(tag.name);
        } else if (tag.name.starts_with('/') && tag.name.substr(1) == section) {
            section.clear();
        } else if (tag.name == "DataArray" && !section.empty()) {
            const std::vector<double> numbers = vtk_array(tag.attributes, tags.until_next(), encoding, bytes.size());
            const std::string_view name = tag.value("Name");
            if (section == "Points") {
                piece.points = numbers;
            } else if (name == "connectivity") {
                piece.nodes = wholes(numbers);
            } else if (name == "offsets") {
                piece.ends = wholes(numbers);
            } else if (name == "faces") {
                piece.faces = wholes(numbers);
            } else if (name == "faceoffsets") {
                piece.face_ends = wholes(numbers);
            } else if (name == "types") {
                for (const double number : numbers) {
                    piece.types.push_back(static_cast<std::uint8_t>(whole(number)));
                }
            }
        }
    }
    return mesh;
}

}  // namespace terratet
