// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read/meshes/mesh_readers.hpp"
#include "io/read/meshes/text_cursor.hpp"
#include "tess/samples.hpp"

namespace terratet {
namespace {

Vec3 three_numbers(std::string_view words) {
    const auto x = whole_number<double>(next_word(words));
    const auto y = whole_number<double>(next_word(words));
    const auto z = whole_number<double>(next_word(words));
    return {x.value_or(missing), y.value_or(missing), z.value_or(missing)};
}

/// "7", "7/1", "7//3": vertices count from 1, or back from the last one.
void face(std::string_view words, std::int64_t line, MeshBuilder& mesh) {
    std::vector<std::int64_t> corners;
    for (std::string_view word = next_word(words); !word.empty(); word = next_word(words)) {
        const auto index = whole_number<std::int64_t>(word.substr(0, word.find('/')));
        if (!index) {
            return mesh.reject(line, "a face needs numbers of vertices: \"" + excerpt(word) + "\"");
        }
        const auto count = static_cast<std::int64_t>(mesh.vertices());
        corners.push_back(*index < 0 && *index >= -count ? count + *index : *index < 0 ? -1 : *index - 1);
    }
    mesh.face(corners, line);
}

}  // namespace

void read_obj(std::string_view bytes, MeshBuilder& mesh) {
    TextCursor text(bytes);
    std::string continued;
    std::string_view line;
    while (text.next(line)) {
        if (line.ends_with('\\')) {
            continued += std::string(line.substr(0, line.size() - 1)) + " ";
            continue;
        }
        const std::string whole = continued + std::string(line);
        continued.clear();
        std::string_view words = whole;
        const std::string_view keyword = next_word(words);
        if (keyword == "v") {
            mesh.vertex(three_numbers(words), text.line());
        } else if (keyword == "f" || keyword == "fo") {
            face(words, text.line(), mesh);
        } else if ((keyword == "o" || keyword == "g") && !trimmed(words).empty()) {
            mesh.object(to_utf8(trimmed(words)));
        }
    }
}

}  // namespace terratet
