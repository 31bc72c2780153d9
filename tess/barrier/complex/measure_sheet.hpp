// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// How faults compare, with a spacing, with what was read, and with each other.

#include <span>

#include <memory>

#include "tess/base/tri_mesh.hpp"

namespace terratet {

/// Do the points already suit the spacing: nearly all triangles covered within s/√2, no angle above `widest` (radians)
/// in nearly all, and not many more points than that takes? Such a mesh, a 20 m grid for s = 20 m, is kept point by
/// point.
bool suits(const TriMesh& mesh, double spacing, double widest);

/// Distances between two meshes, both ways, from their points and centroids that lie within `where`.
struct Deviation {
    double median = 0;
    double p95 = 0;
    double max = 0;
};
Deviation deviation(const TriMesh& a, const TriMesh& b, const Box3& where);

/// Measures how much of other meshes runs alongside one: is it a second version of it?
class Alongside {
  public:
    explicit Alongside(const TriMesh& mesh);
    ~Alongside();
    Alongside(const Alongside&) = delete;
    Alongside& operator=(const Alongside&) = delete;

    /// Share of the other's area within `where` that is nearer than `near` to the mesh and at less than 30° to it.
    [[nodiscard]] double share_of(const TriMesh& other, const Box3& where, double near) const;

    /// How near that share of the other runs, to a thousandth of `most`; no more than `most`.
    [[nodiscard]] double distance_of(const TriMesh& other, const Box3& where, double share, double most) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Do the two share a point?
bool touch(const TriMesh& a, const TriMesh& b);

}  // namespace terratet
