// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read/meshes/mesh_readers.hpp"
#include "io/read/meshes/text_cursor.hpp"
#include "tess/error.hpp"
#include "tess/samples.hpp"

namespace terratet {
namespace {

/// The next line that is no comment.
std::string_view next_line(TextCursor& text) {
    std::string_view line;
    while (text.next(line)) {
        line = trimmed(line.substr(0, line.find('#')));
        if (!line.empty()) {
            return line;
        }
    }
    return {};
}

}  // namespace

void read_off(std::string_view bytes, MeshBuilder& mesh) {
    TextCursor text(bytes);
    std::string_view line = next_line(text);
    const std::string_view keyword = next_word(line);
    if (keyword.ends_with("BINARY") || line.find("BINARY") != std::string_view::npos) {
        throw InputError("binary OFF is not read; save it as text");
    }
    if (keyword.find('4') != std::string_view::npos || keyword.find('n') != std::string_view::npos) {
        throw InputError("OFF of other than three dimensions is no surface in space");
    }
    line = trimmed(line);
    line = line.empty() ? next_line(text) : line;
    const auto vertices = whole_number<std::uint64_t>(next_word(line));
    const auto faces = whole_number<std::uint64_t>(next_word(line));
    if (!vertices || !faces || *vertices > bytes.size() / 2 || *faces > bytes.size() / 2) {
        throw InputError("no OFF: the counts of vertices and faces are not there, or more than the file can hold");
    }
    for (std::uint64_t i = 0; i < *vertices; ++i) {
        line = next_line(text);
        if (line.empty()) {
            throw InputError("cut off after " + std::to_string(i) + " of " + std::to_string(*vertices) + " vertices");
        }
        const auto x = whole_number<double>(next_word(line));
        const auto y = whole_number<double>(next_word(line));
        const auto z = whole_number<double>(next_word(line));
        mesh.vertex({x.value_or(missing), y.value_or(missing), z.value_or(missing)}, text.line());
    }
    for (std::uint64_t i = 0; i < *faces; ++i) {
        line = next_line(text);
        if (line.empty()) {
            return mesh.reject(text.line(),
                               "cut off after " + std::to_string(i) + " of " + std::to_string(*faces) + " faces");
        }
        const auto corners = whole_number<std::uint64_t>(next_word(line));
        std::vector<std::int64_t> indices;
        for (std::uint64_t k = 0; corners && k < *corners && !line.empty(); ++k) {
            indices.push_back(whole_number<std::int64_t>(next_word(line)).value_or(-1));
        }
        if (!corners || indices.size() < *corners) {
            mesh.reject(text.line(), "a face needs a number of corners, and as many vertices");
            continue;
        }
        mesh.face(indices, text.line());
    }
}

}  // namespace terratet
