// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>

#include "io/base/lower_case.hpp"
#include "io/read/meshes/byte_cursor.hpp"
#include "io/read/meshes/mesh_readers.hpp"
#include "io/read/meshes/text_cursor.hpp"
#include "tess/samples.hpp"

namespace terratet {
namespace {

constexpr std::size_t header_bytes = 80;
constexpr std::size_t triangle_bytes = 50;

void read_binary(std::string_view bytes, MeshBuilder& mesh) {
    ByteCursor cursor(bytes.substr(header_bytes));
    const auto count = cursor.take<std::uint32_t>();
    for (std::uint32_t i = 0; i < count; ++i) {
        cursor.skip(3 * sizeof(float));  // the normal
        std::array<std::int64_t, 3> corners{};
        for (std::int64_t& corner : corners) {
            const double x = cursor.take<float>();
            const double y = cursor.take<float>();
            const double z = cursor.take<float>();
            corner = mesh.shared_vertex({x, y, z}, std::int64_t{i} + 1);
        }
        cursor.skip(sizeof(std::uint16_t));
        mesh.face(corners, std::int64_t{i} + 1);
    }
}

void read_text(std::string_view bytes, MeshBuilder& mesh) {
    TextCursor text(bytes);
    std::vector<std::int64_t> corners;
    std::string_view line;
    while (text.next(line)) {
        std::string_view words = line;
        const std::string keyword = lower_case(next_word(words));
        if (keyword == "vertex") {
            const auto x = whole_number<double>(next_word(words));
            const auto y = whole_number<double>(next_word(words));
            const auto z = whole_number<double>(next_word(words));
            corners.push_back(
                mesh.shared_vertex({x.value_or(missing), y.value_or(missing), z.value_or(missing)}, text.line()));
        } else if (keyword == "endloop" || keyword == "endfacet") {
            if (!corners.empty()) {
                mesh.face(corners, text.line());
            }
            corners.clear();
        } else if (keyword == "solid" && !trimmed(words).empty()) {
            mesh.object(to_utf8(trimmed(words)));
        }
    }
    if (!corners.empty()) {
        mesh.reject(text.line(), "the file ends within a facet; is it cut off?");
    }
}

}  // namespace

bool is_binary_stl(std::string_view bytes, std::size_t file_size) {
    if (bytes.size() < header_bytes + sizeof(std::uint32_t)) {
        return false;
    }
    const auto count = ByteCursor(bytes.substr(header_bytes)).take<std::uint32_t>();
    return count > 0 && file_size == header_bytes + sizeof(std::uint32_t) + triangle_bytes * std::size_t{count};
}

void read_stl(std::string_view bytes, MeshBuilder& mesh) {
    is_binary_stl(bytes, bytes.size()) ? read_binary(bytes, mesh) : read_text(bytes, mesh);
}

}  // namespace terratet
