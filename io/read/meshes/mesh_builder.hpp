// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// A mesh as a file gives it, corner by corner and face by face, checked on the way.

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "io/base/rejections.hpp"
#include "tess/surface.hpp"

namespace terratet {

/// Faces belong to the object that was begun last; vertices to all of the file. Vertices keep their order.
class MeshBuilder {
  public:
    /// \param file  names objects that have no name, and stands in messages
    MeshBuilder(const std::string& file, SurfaceKind kind, Diagnostics& diagnostics);

    /// Counts, also when it is unacceptable (rejected): faces that name it are rejected in turn.
    void vertex(const Vec3& position, std::int64_t line);

    /// The index of a vertex at exactly this position: for formats that repeat the corners of every face.
    std::int64_t shared_vertex(const Vec3& position, std::int64_t line);

    /// Corners count from 0. Of more than three corners a polygon is triangulated in its plane. Rejected: corners that
    /// are not there, one corner twice, a polygon that crosses itself or has no area.
    void face(std::span<const std::int64_t> corners, std::int64_t line);

    void object(const std::string& name);

    void reject(std::int64_t line, const std::string& reason) {
        rejections_.add(line, [&] { return reason; });
    }

    [[nodiscard]] std::size_t vertices() const { return vertices_.size(); }

    /// One surface an object that has triangles, with the vertices that they use. Throws InputError when there is none:
    /// "FILE: no triangle …" with the first rejection and `what` it should hold.
    std::vector<Surface> finish(const std::string& what);

  private:
    void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) { objects_.back().triangles.push_back({a, b, c}); }

    struct Object {
        std::string name;
        std::vector<Triangle> triangles;
    };
    std::string file_;
    SurfaceKind kind_;
    Rejections rejections_;
    std::vector<Vec3> vertices_;  ///< NaN: rejected
    std::map<Vec3, std::int64_t> known_;
    std::vector<Object> objects_;
};

}  // namespace terratet
