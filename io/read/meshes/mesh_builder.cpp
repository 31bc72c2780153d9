// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read/meshes/mesh_builder.hpp"

#include <cpl_conv.h>

#include <algorithm>
#include <limits>

#include "io/base/text_lines.hpp"
#include "tess/base/no_index.hpp"
#include "tess/error.hpp"
#include "tess/samples.hpp"

namespace terratet {

MeshBuilder::MeshBuilder(const std::string& file, SurfaceKind kind, Diagnostics& diagnostics)
    : file_(file), kind_(kind), rejections_(diagnostics, file) {
    objects_.push_back({to_utf8(CPLGetBasename(file.c_str())), {}});
}

void MeshBuilder::vertex(const Vec3& position, std::int64_t line) {
    if (vertices_.size() >= std::numeric_limits<std::uint32_t>::max() - 1) {
        throw InputError(file_ + ": more than 4294967294 vertices");
    }
    const bool good = is_acceptable(position);
    vertices_.push_back(good ? position : Vec3{missing, missing, missing});
    if (!good) {
        reject(line, "coordinates must be numbers within 1e9");
    }
}

std::int64_t MeshBuilder::shared_vertex(const Vec3& position, std::int64_t line) {
    if (!is_acceptable(position)) {
        vertex(position, line);
        return static_cast<std::int64_t>(vertices_.size()) - 1;
    }
    const auto [entry, added] = known_.emplace(position, static_cast<std::int64_t>(vertices_.size()));
    if (added) {
        vertex(position, line);
    }
    return entry->second;
}

void MeshBuilder::face(std::span<const std::int64_t> corners, std::int64_t line) {
    std::vector<std::uint32_t> indices;
    for (const std::int64_t corner : corners) {
        if (corner < 0 || corner >= static_cast<std::int64_t>(vertices_.size()) ||
            !is_finite(vertices_[static_cast<std::size_t>(corner)])) {
            return reject(line, "the face names vertex " + std::to_string(corner + 1) + ", which is not there");
        }
        const auto index = static_cast<std::uint32_t>(corner);
        if (indices.empty() || indices.back() != index) {
            indices.push_back(index);
        }
    }
    if (indices.size() > 1 && indices.front() == indices.back()) {
        indices.pop_back();
    }
    if (indices.size() < 3 || (indices.size() == 3 && corners.size() == 3 && indices[0] == indices[2])) {
        return reject(line, "the face has fewer than three different corners");
    }
    if (indices.size() == 3) {
        return triangle(indices[0], indices[1], indices[2]);
    }
    std::vector<Vec3> ring;
    std::ranges::transform(indices, std::back_inserter(ring), [&](std::uint32_t i) { return vertices_[i]; });
    const std::vector<Triangle> triangles = triangulate_polygon(std::span(&ring, 1));
    if (triangles.empty()) {
        return reject(line, "the face crosses itself or has no area");
    }
    for (const Triangle& t : triangles) {
        triangle(indices[t[0]], indices[t[1]], indices[t[2]]);
    }
}

void MeshBuilder::object(const std::string& name) {
    if (objects_.back().triangles.empty()) {
        objects_.pop_back();
    }
    const auto known = std::ranges::find(objects_, name, &Object::name);
    if (known != objects_.end()) {
        std::rotate(known, known + 1, objects_.end());  // goes on
    } else {
        objects_.push_back({name, {}});
    }
}

std::vector<Surface> MeshBuilder::finish(const std::string& what) {
    std::vector<Surface> surfaces;
    std::vector<std::uint32_t> place(vertices_.size(), no_index);
    for (Object& object : objects_) {
        if (object.triangles.empty()) {
            continue;
        }
        std::ranges::fill(place, no_index);
        for (const Triangle& t : object.triangles) {
            for (const std::uint32_t corner : t) {
                place[corner] = 0;
            }
        }
        Surface surface{object.name, kind_, {}, std::move(object.triangles), to_utf8(file_)};
        for (std::size_t i = 0; i < vertices_.size(); ++i) {
            if (place[i] != no_index) {
                place[i] = static_cast<std::uint32_t>(surface.vertices.size());
                surface.vertices.push_back(vertices_[i]);
            }
        }
        for (Triangle& t : surface.triangles) {
            std::ranges::for_each(t, [&](std::uint32_t& corner) { corner = place[corner]; });
        }
        surfaces.push_back(std::move(surface));
    }
    if (surfaces.empty()) {
        throw InputError(file_ + ": no triangle in it" + rejections_.first() + "; " + what);
    }
    std::ranges::stable_sort(surfaces, {}, &Surface::name);
    return surfaces;
}

}  // namespace terratet
