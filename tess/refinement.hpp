// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Refinement (paper 4.2; DESIGN §4.3): insert a vertex for every bad cell that can be improved, until each cell meets
/// the criteria or carries the reason why not. Always Delaunay.
///
/// Guarantees
/// l_min and l_max are those in force where they are asked for (resolution.hpp).
///  R1  Inserted vertices never exceed the packing bound, and refinement terminates.
///  R2  Each cell outside the gaps meets every insertion criterion or carries a reason code.
///  R3  No inserted vertex is nearer than l_min to any other vertex.
///  R4  With l_max ≥ 4 l_min no edge exceeds l_max in cells that are not exempt as smooth and whose circumcentre lies
///      in the extent and outside the faults' protection zones.
///  R5  The tessellation is Delaunay.
///  R6  The same input gives the same result, at any thread count and in any order of rows.
///  R7  Refining again inserts, moves and removes nothing.

#include <cstdint>
#include <map>
#include <string>

#include "tess/progress.hpp"

namespace terratet {

/// Why a bad cell was left as it is.
enum class Reason : std::uint8_t {
    none,        ///< the cell meets the criteria
    smooth,      ///< exempt: every |Δf| along its edges is below df_min, or half the tolerance
    too_close,   ///< the new vertex would come nearer than l_min to another
    near_face,   ///< so would the projection of its circumcentre onto the hull box
    near_fault,  ///< the new vertex would lie in a fault's protection zone
    no_center,   ///< its circumcentre is not a finite number
    fault_gap,   ///< between the two seed sheets of a fault: never judged
};

/// "too_close" and so on: the report's keys.
std::string to_string(Reason reason);

struct RefineOptions {
    std::uint64_t max_vertices = 50'000'000;  ///< throws Error when the tessellation would exceed it
    bool candidates = true;                   ///< rule 4: try points around a circumcentre that would make a flat star
    bool clean_up = true;                     ///< rule 6: move or remove inserted vertices of slivers and tiny cells
    bool residuals = true;                    ///< false leaves the residual criterion to the clean-up
    /// With a tolerance l_min between samples goes down from l_min to Criteria::l_min_between by steps of √2. It stops
    /// before a step that is thought to take more vertices in all than these, or when the cells left to be off hold
    /// less than a thousandth of the box. 0: at the end alone.
    std::uint64_t enough_vertices = 0;
    Progress progress;
};

struct RefineReport {
    std::uint64_t inserted = 0;               ///< whatever became of them later; also by the clean-up
    std::uint64_t moved = 0;                  ///< moves by the clean-up
    std::uint64_t removed = 0;                ///< by the clean-up
    std::uint64_t estimates = 0;              ///< places at which the values were asked for
    double bound = 0;                         ///< R1
    double l_min_between = 0;                 ///< what the steps came to
    bool stopped = false;                     ///< by the number of vertices
    std::map<Reason, std::uint64_t> skipped;  ///< bad cells left, by reason
};

}  // namespace terratet
