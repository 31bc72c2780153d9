// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Is a mesh with split faults a proper one? Checked from the cells alone, whatever made them, by the definitions that
/// finite-element and finite-volume codes rely on.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tess/geometry.hpp"
#include "tess/tessellation.hpp"

namespace terratet {

/// Figures of a check.
struct Conformity {
    std::size_t interior_facets = 0;  ///< shared by two cells, seen from opposite sides
    std::size_t boundary_facets = 0;  ///< of one cell, on the hull box
    std::size_t mirrored_facets = 0;  ///< pairs: of one cell each, same three positions, opposite orientation
    double volume = 0;                ///< of all cells
    double volume_error = 0;          ///< against the hull box, relative

    std::size_t not_positive = 0;  ///< cells without volume, or turned inside out
    std::size_t unmatched = 0;     ///< facets of one cell that are neither on the hull box nor mirrored
    std::size_t overlapping = 0;   ///< facets of more than two cells, or of two cells on the same side
    std::size_t leaking = 0;       ///< interior facets between two regions
    std::vector<Vec3> places;      ///< of the first offenders, frame-local

    /// A mesh it is.
    [[nodiscard]] bool proper() const {
        return not_positive == 0 && unmatched == 0 && overlapping == 0 && volume_error <= 1e-9;
    }
    /// And its regions meet at split facets alone.
    [[nodiscard]] bool holds() const { return proper() && leaking == 0; }
};

/// Uses points and cells only, not the neighbours. `region` is in step with the cells; −1 is no region. O(n log n).
Conformity check_conformity(const TetMesh& mesh, std::span<const std::int32_t> region, const Box3& hull);

}  // namespace terratet
