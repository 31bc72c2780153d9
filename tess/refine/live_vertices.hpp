// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The vertices of a tessellation under refinement, and their values.
///
/// Where criteria ask for values they are estimated as vertices come and move; otherwise all at the end, in batches.

#include "tess/mesh/delaunay.hpp"
#include "tess/refine/residual.hpp"
#include "tess/value_source.hpp"

namespace terratet {

class LiveVertices {
  public:
    /// All references must outlive the object. append() throws UsageError beyond `max_vertices`; `l_min` and
    /// `bound` (R1) are for its message.
    LiveVertices(delaunay::Core& core, VertexValues& values, const ValueSource& source, bool values_at_once,
                 std::uint64_t max_vertices, double l_min, double bound);

    /// A vertex of role inserted, with the next id. Its place in the triangulation is the caller's business. Its
    /// values may be known already, if those before it have theirs.
    std::uint32_t append(const Vec3& place, const Estimate* known = nullptr);

    /// Takes the last one back, as if it had never been.
    void pop();

    /// Estimates the vertex' values at another place, if it has any yet.
    void revalue(std::uint32_t vertex, const Vec3& place);

    /// Takes vertices that are no longer in the triangulation out of the tables; the others keep ids and order.
    void drop(const std::vector<std::uint32_t>& removed);

    /// Values for all that have none yet.
    void complete();

    [[nodiscard]] std::size_t size() const { return core_.vertices.size(); }

    /// So many places were asked for.
    [[nodiscard]] std::uint64_t asked() const { return asked_; }

  private:
    [[nodiscard]] std::size_t valued() const { return values_.extrapolation.size(); }

    delaunay::Core& core_;
    VertexValues& values_;
    const ValueSource& source_;
    bool values_at_once_;
    std::uint64_t max_vertices_;
    std::size_t others_;  ///< there from the start
    double l_min_;
    double bound_;
    std::uint64_t asked_ = 0;
};

}  // namespace terratet
