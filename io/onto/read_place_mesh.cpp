// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/onto/read_place_mesh.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <limits>

#include "io/base/file_bytes.hpp"
#include "io/base/lower_case.hpp"
#include "io/onto/mesh_formats.hpp"
#include "tess/error.hpp"
#include "tess/samples.hpp"

namespace terratet {
namespace {

std::string extension_of(const std::string& path) {
    return lower_case(std::filesystem::path(path).extension().string());
}

void require_whole(const PlaceMesh& mesh) {
    if (mesh.points.empty()) {
        throw InputError("has no node");
    }
    for (const Vec3& p : mesh.points) {
        if (!is_acceptable(p)) {
            throw InputError(fmt::format("a node at {}, {}, {} is no place", p.x, p.y, p.z));
        }
    }
    std::int64_t begin = 0;
    for (const std::int64_t end : mesh.ends) {
        if (end < begin || end > std::ssize(mesh.nodes)) {
            throw InputError("the offsets of its cells do not suit their connectivity");
        }
        begin = end;
    }
    for (const std::int64_t node : mesh.nodes) {
        if (node < 0 || node >= std::ssize(mesh.points)) {
            throw InputError(fmt::format("a cell names node {}, and there are {}", node, mesh.points.size()));
        }
    }
    if (mesh.types.size() != mesh.ends.size()) {
        throw InputError(fmt::format("{} cells have {} types", mesh.ends.size(), mesh.types.size()));
    }
}

}  // namespace

bool names_mesh(const std::string& path) {
    const std::string extension = extension_of(path);
    return extension == ".vtu" || extension == ".msh";
}

PlaceMesh read_place_mesh(const Source& source) {
    const std::string bytes = file_bytes(source.path, 0, std::numeric_limits<std::size_t>::max());
    if (bytes.empty()) {
        throw InputError(source.path + ": not found, or empty");
    }
    try {
        PlaceMesh mesh = extension_of(source.path) == ".msh" ? read_msh_mesh(bytes) : read_vtu_mesh(bytes);
        require_whole(mesh);
        if (!source.srs.empty()) {
            mesh.crs = parse_crs(source.srs);
        }
        return mesh;
    } catch (const InputError& error) {
        throw InputError(source.path + ": " + error.what());
    }
}

}  // namespace terratet
