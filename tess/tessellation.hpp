// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The dynamic Delaunay tessellation: vertices with their records and values, cells kept Delaunay under insertion and
/// removal.
///
/// Guarantee R5: it is the Delaunay tessellation of its vertices, by exact predicates. For given coordinates it is
/// unique, ties included, whatever the order of insertion (CGAL's symbolic perturbation depends on coordinates alone),
/// so a model keeps its vertices only.

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "tess/geometry.hpp"

namespace terratet {

/// Why a vertex is there.
enum class Role : std::uint8_t {
    sample,    ///< a kept sample; owner: its index in Model::samples
    seed,      ///< one of a fault's mirrored seeds; owner: index in Model::faults; side +1 or −1
    domain,    ///< on the hull box; owner −1
    inserted,  ///< by refinement; owner −1
};

struct Vertex {
    std::uint64_t id = 0;  ///< unique in a model, given in a canonical order of the data, never of arrival
    Vec3 position;         ///< frame-local, snapped (Frame::snapped)
    Role role = Role::inserted;
    std::int32_t owner = -1;
    std::int8_t side = 0;

    friend bool operator==(const Vertex&, const Vertex&) = default;
};

/// Flat copy of the cells for writers, statistics and resampling. Vertex i is vertices()[i]; cells have positive
/// orientation, start with their smallest vertex and are sorted, so that equal tessellations give equal arrays.
struct TetMesh {
    std::vector<Vec3> points;
    std::vector<std::array<std::uint32_t, 4>> cells;
    std::vector<std::array<std::int32_t, 4>> neighbours;  ///< of cell c opposite its vertex k; −1 on the hull
};

class Tessellation {
  public:
    Tessellation();
    ~Tessellation();
    Tessellation(Tessellation&&) noexcept;
    Tessellation& operator=(Tessellation&&) noexcept;

    /// Adds vertices in bulk, in spatially sorted order; n log n in practice, ~250 k/s on one core.
    /// \pre Ids ascend, all above those present; positions are finite and distinct from each other and from those
    /// present.
    void insert(std::span<const Vertex> vertices);

    /// In ascending id.
    [[nodiscard]] std::span<const Vertex> vertices() const;
    [[nodiscard]] std::size_t cell_count() const;  ///< finite cells
    [[nodiscard]] std::uint64_t next_id() const;   ///< one above the largest id ever present

    /// O(n log n).
    [[nodiscard]] TetMesh mesh() const;

    /// Re-verifies guarantee R5 from scratch with exact predicates: every cell positively oriented and locally Delaunay
    /// across every facet, neighbours mutual. ~10 µs a cell.
    [[nodiscard]] bool is_delaunay() const;

    /// The kernel behind it, for the algorithms of this floor (tess/delaunay.hpp).
    struct Kernel;
    [[nodiscard]] Kernel& kernel() { return *kernel_; }
    [[nodiscard]] const Kernel& kernel() const { return *kernel_; }

  private:
    std::unique_ptr<Kernel> kernel_;
};

}  // namespace terratet
