// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Rule 6 of refinement (DESIGN §4.3): what insertion cannot mend, slivers and cells below v_min, is mended by moving
/// or removing inserted vertices. Samples, seeds and the box's vertices stay.
///
/// A change is accepted only if the guards of insertion hold, it leaves no cell that insertion would have to treat and
/// no more cells than before that insertion cannot treat, and the sorted list of severities of what it touches falls.
/// Severities are whole numbers, so by the multiset ordering of Dershowitz and Manna (1979) the sweeps end. Candidates
/// depend on ids and places alone: the last sweep, which accepts nothing, is the proof that cleaning up again would do
/// nothing either (R7). Vertices within l_min of the box stay, since cells near it may be untreated because of them.
///
/// Once a sweep finds nothing and only few cells are left, more is tried for them: more places, their neighbours, and
/// vertices that give way, alone, in pairs or in threes, to what insertion puts in their stead. For so few, cells that
/// insertion cannot treat may become more.

#include <optional>
#include <set>

#include "tess/mesh/conflict_zone.hpp"
#include "tess/refine/insertion_rule.hpp"
#include "tess/refine/live_cell.hpp"
#include "tess/refine/live_vertices.hpp"
#include "tess/refine/residual.hpp"

namespace terratet {

struct CleanUpReport {
    std::uint64_t inserted = 0;  ///< in removed ones' stead
    std::uint64_t moved = 0;     ///< accepted moves; a vertex may move more than once
    std::uint64_t removed = 0;
};

class CleanUp {
  public:
    CleanUp(delaunay::Core& core, LiveVertices& vertices, const InsertionRule& rule, const ConflictSearch& search,
            ResidualTest& residuals, const Criteria& criteria, const Frame& frame, const Progress& progress);

    /// Removed vertices are gone from the triangulation but still in the core's table: removed() tells which.
    CleanUpReport run();

    /// The same for some cells and what comes of them, by ordinary sweeps alone.
    CleanUpReport run(const std::vector<delaunay::Cell>& cells);

    [[nodiscard]] const std::vector<std::uint32_t>& removed() const { return removed_; }

  private:
    /// Of some cells: what a change is judged by.
    struct State {
        std::vector<int> severities;  ///< falling, without zeros
        int blocked = 0;              ///< cells that break an insertion criterion and carry a reason why that stays so
        bool open = false;            ///< some cell breaks an insertion criterion and could be treated
        std::vector<JudgedCell> unknown;  ///< that could be treated if their residual called for it
    };

    struct Patient {
        int severity;
        std::array<std::uint32_t, 4> vertices;

        friend bool operator==(const Patient&, const Patient&) = default;
        friend bool operator<(const Patient& a, const Patient& b) {  // worst first
            return a.severity != b.severity ? a.severity > b.severity : a.vertices < b.vertices;
        }
    };

    [[nodiscard]] bool clearly_above_limits(delaunay::Cell cell) const;
    [[nodiscard]] std::vector<Patient> below_limits(const std::vector<delaunay::Cell>& cells) const;
    [[nodiscard]] std::vector<Patient> patients_after(const std::vector<Patient>& before) const;
    [[nodiscard]] std::optional<delaunay::Cell> cell_of(const Patient& patient) const;
    void note_change(const std::vector<delaunay::Cell>& cells);
    [[nodiscard]] int severity(const JudgedCell& cell) const;
    void add(const JudgedCell& cell, State& state) const;
    [[nodiscard]] bool better(State& after, State& before) const;
    [[nodiscard]] bool within_tolerance(const State& state) const;
    [[nodiscard]] bool movable(std::uint32_t vertex) const;
    [[nodiscard]] std::vector<std::uint32_t> neighbours(const Patient& patient) const;
    void sweep_until_settled(std::vector<Patient> all, bool last_resorts);
    bool sweep(const std::vector<Patient>& waiting);
    bool treat(const Patient& patient);
    bool mend(std::uint32_t vertex, const Patient& patient);
    void add_places_for_hole(BallPoints& ball, std::vector<Vec3>& places) const;
    bool refill(const std::vector<std::uint32_t>& vertices, BallPoints* ball);
    bool refill_around(const Patient& patient);
    bool insert_into(std::set<delaunay::Cell>& fresh, BallPoints* ball, State& before);
    [[nodiscard]] std::optional<std::pair<JudgedCell, delaunay::Cell>> worst_open(
        const std::set<delaunay::Cell>& cells) const;
    [[nodiscard]] bool zone_clear_of(const Vec3& place) const;
    bool try_place(std::uint32_t vertex, const Vec3& place, const State& star_before);
    void put(std::uint32_t vertex, const Vec3& place, delaunay::Cell near);

    delaunay::Core& core_;
    LiveVertices& vertices_;
    const InsertionRule& rule_;
    const ConflictSearch& search_;
    ResidualTest& residuals_;
    const Criteria& criteria_;
    const Frame& frame_;
    const Progress& progress_;
    double sharpest_;  ///< sharpness of the limit, with room for rounding
    std::vector<delaunay::VertexHandle> handles_;
    std::vector<std::uint32_t> removed_;
    CleanUpReport report_;
    std::vector<delaunay::Cell> hole_;  ///< the cells that fill a removed vertex' star
    Zone zone_;
    std::set<std::uint32_t> changed_;  ///< vertices of all cells that came with the sweep's changes
    bool thorough_ = false;  ///< once an ordinary sweep finds nothing more and few are left: more places, more vertices
};

}  // namespace terratet
