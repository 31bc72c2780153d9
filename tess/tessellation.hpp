// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The dynamic Delaunay tessellation: vertices with their records, cells kept Delaunay under insertion and
/// removal.
///
/// Guarantee R5: it is the Delaunay tessellation of its vertices, by exact predicates. For given coordinates it is
/// unique, ties included, whatever the order of insertion (CGAL's symbolic perturbation depends on coordinates alone),
/// so a model keeps its vertices only.

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "tess/progress.hpp"
#include "tess/tet_mesh.hpp"

namespace terratet {

class Tessellation;

namespace delaunay {

struct Core;  ///< what is behind a tessellation: the business of this floor alone (delaunay.hpp)
Core& core(Tessellation& tessellation);

}  // namespace delaunay

class Tessellation {
  public:
    Tessellation();
    ~Tessellation();
    Tessellation(Tessellation&&) noexcept;
    Tessellation& operator=(Tessellation&&) noexcept;

    /// Adds vertices in bulk, in spatially sorted order; n log n in practice, ~250 k/s on one core.
    /// \pre Ids ascend, all above those present; positions are finite and distinct from each other and from those
    /// present.
    void insert(std::span<const Vertex> vertices, const Poll& poll = {});

    /// In ascending id.
    [[nodiscard]] std::span<const Vertex> vertices() const;
    [[nodiscard]] std::size_t cell_count() const;  ///< finite cells
    [[nodiscard]] std::uint64_t next_id() const;   ///< one above the largest id ever present

    /// O(n log n).
    [[nodiscard]] TetMesh mesh() const;

    /// Re-verifies guarantee R5 from scratch with exact predicates: every cell positively oriented and locally Delaunay
    /// across every facet, neighbours mutual. ~10 µs a cell.
    [[nodiscard]] bool is_delaunay() const;

  private:
    friend delaunay::Core& delaunay::core(Tessellation& tessellation);
    std::unique_ptr<delaunay::Core> core_;
};

}  // namespace terratet
