// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read/meshes/read_mesh.hpp"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <cpl_vsi.h>

#include <array>

#include "io/base/gdal_scope.hpp"
#include "io/base/lower_case.hpp"
#include "io/read/meshes/mesh_readers.hpp"
#include "io/read/meshes/text_cursor.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

constexpr vsi_l_offset most_bytes = vsi_l_offset{1} << 31U;

struct Head {
    std::string bytes;
    std::size_t size = 0;  ///< of the whole file; 0: not known
};

Head head_of(const std::string& path) {
    const GdalScope quiet(path);
    Head head;
    VSIStatBufL status;
    if (VSIStatExL(path.c_str(), &status, VSI_STAT_SIZE_FLAG | VSI_STAT_EXISTS_FLAG | VSI_STAT_NATURE_FLAG) == 0) {
        if (VSI_ISDIR(status.st_mode)) {
            return head;
        }
        head.size = static_cast<std::size_t>(status.st_size);
    }
    if (VSILFILE* const file = VSIFOpenL(path.c_str(), "rb")) {
        head.bytes.resize(4096);
        head.bytes.resize(VSIFReadL(head.bytes.data(), 1, head.bytes.size(), file));
        VSIFCloseL(file);
    }
    return head;
}

/// The first line that is not blank and no comment, and the one after it.
std::array<std::string_view, 2> first_lines(std::string_view text) {
    TextCursor cursor(text);
    std::array<std::string_view, 2> lines;
    std::size_t found = 0;
    std::string_view line;
    while (found < lines.size() && cursor.next(line)) {
        if (!line.empty() && !line.starts_with('#')) {
            lines[found++] = line;
        }
    }
    return lines;
}

bool is_obj(const std::string& path, std::string_view line) {
    const std::string_view keyword = next_word(line);
    static constexpr std::array<std::string_view, 11> keywords{"v",      "vn",     "vt", "f", "o", "g",
                                                               "mtllib", "usemtl", "s",  "l", "p"};
    return EQUAL(CPLGetExtension(path.c_str()), "obj") && std::ranges::find(keywords, keyword) != keywords.end();
}

bool is_off(std::string_view line) {
    const std::string_view keyword = next_word(line);
    return keyword.size() <= 9 && (keyword.ends_with("OFF") || keyword == "OFF");
}

bool is_irap(std::array<std::string_view, 2> lines) {
    int numbers = 0;
    std::string_view first = lines[0];
    if (next_word(first) != "-996") {
        return false;
    }
    for (std::string_view* rest : {&first, &lines[1]}) {
        for (std::string_view word = next_word(*rest); !word.empty(); word = next_word(*rest)) {
            numbers += whole_number<double>(word) ? 1 : 100;
        }
    }
    return numbers == 7;
}

/// Comments (999), then 0 and SECTION; or the signature of the binary kind.
bool is_dxf(const std::string& path, std::string_view bytes) {
    TextCursor text(bytes);
    std::string_view code;
    std::string_view value;
    while (text.next(code) && code == "999" && text.next(value)) {
    }
    return bytes.starts_with("AutoCAD Binary DXF") || EQUAL(CPLGetExtension(path.c_str()), "dxf") ||
           (code == "0" && text.next(value) && value == "SECTION");
}

const char* describe(MeshFormat format) {
    static constexpr std::array<const char*, 7> names{"an OBJ needs v and f lines",
                                                      "a PLY needs vertices and faces",
                                                      "an STL needs facets",
                                                      "an OFF needs vertices and faces",
                                                      "a VTP needs polygons or strips",
                                                      "a DXF needs 3DFACEs or polyface meshes",
                                                      "an Irap grid needs nodes with heights, two by two"};
    return names[static_cast<std::size_t>(format)];
}

std::string whole_file(const std::string& path) {
    const GdalScope quiet(path);
    GByte* bytes = nullptr;
    vsi_l_offset size = 0;
    if (!VSIIngestFile(nullptr, path.c_str(), &bytes, &size, static_cast<GIntBig>(most_bytes))) {
        throw InputError(path + ": cannot be read, or is larger than 2 GiB" +
                         (quiet.failed() ? " (" + quiet.failure() + ")" : ""));
    }
    std::string result(reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(size));
    VSIFree(bytes);
    return result;
}

}  // namespace

std::optional<MeshFormat> mesh_format(const std::string& path) {
    const Head head = head_of(path);
    const std::string_view bytes(head.bytes);
    const auto lines = first_lines(bytes);
    if (bytes.starts_with("ply\n") || bytes.starts_with("ply\r")) {
        return MeshFormat::ply;
    }
    if (is_binary_stl(bytes, head.size)) {
        return MeshFormat::stl;
    }
    if (bytes.find("<VTKFile") != std::string_view::npos) {
        return MeshFormat::vtp;
    }
    if (lower_case(lines[0].substr(0, 5)) == "solid" && lower_case(lines[1].substr(0, 5)) == "facet") {
        return MeshFormat::stl;
    }
    if (is_irap(lines) || is_binary_irap(bytes)) {
        return MeshFormat::irap;
    }
    if (is_dxf(path, bytes)) {
        return MeshFormat::dxf;
    }
    return is_off(lines[0])         ? std::optional(MeshFormat::off)
           : is_obj(path, lines[0]) ? std::optional(MeshFormat::obj)
                                    : std::nullopt;
}

std::vector<Surface> read_mesh(const std::string& path, MeshFormat format, SurfaceKind kind, Diagnostics& diagnostics) {
    static constexpr std::array readers{read_obj, read_ply, read_stl, read_off, read_vtp, read_dxf, read_irap};
    const std::string bytes = whole_file(path);
    MeshBuilder mesh(path, kind, diagnostics);
    try {
        readers[static_cast<std::size_t>(format)](bytes, mesh);
    } catch (const InputError& error) {
        throw InputError(path + ": " + error.what());
    }
    return mesh.finish(describe(format));
}

}  // namespace terratet
