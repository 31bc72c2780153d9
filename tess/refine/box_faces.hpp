// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The faces of the hull box: their triangulation by the vertices on them, and the parts of its
/// edges.
///
/// A vertex near a face makes cells along it whose circumcentres lie beyond; projected onto the face, those make
/// shorter edges still, and so on down to l_min, far from all data. So no vertex comes into the smallest ball about a
/// part of the boundary: in its stead the triangle of the face is split at its circumcentre, or the edge in its middle
/// (Shewchuk 1998). With right angles between the faces that never makes an edge shorter than half the circumradius it
/// is made for, so that sizes grow away from the data again.

#include <memory>
#include <optional>

#include "tess/geometry.hpp"

namespace terratet {

class BoxFaces {
  public:
    explicit BoxFaces(const Box3& hull);
    ~BoxFaces();
    BoxFaces(BoxFaces&&) noexcept;

    /// Points in the box count not. \pre the eight corners come before anything is asked.
    void insert(const Vec3& p);

    /// Where the boundary has to be split because `place` is beyond it or in the ball of a triangle or an edge; none
    /// when it is not. The same in any order of insertion. Logarithmic; O(1) away from the faces.
    [[nodiscard]] std::optional<Vec3> split_for(const Vec3& place) const;

  private:
    class Face;
    class Edge;
    struct Split;

    [[nodiscard]] bool is_on_boundary(const Vec3& p) const;
    [[nodiscard]] bool is_deep(const Vec3& place) const;
    [[nodiscard]] std::optional<Split> split_of_face(const Vec3& place, int axis, bool upper) const;
    [[nodiscard]] std::optional<Split> split_of_edge(const Vec3& place, int along, bool upper_u, bool upper_v) const;
    [[nodiscard]] std::optional<Split> split_of_edges(const Vec3& place) const;

    Box3 hull_;
    mutable double reach_ = 0;  ///< the widest ball's radius; 0: not known
    std::unique_ptr<std::array<Face, 6>> faces_;
    std::unique_ptr<std::array<Edge, 12>> edges_;
};

}  // namespace terratet
