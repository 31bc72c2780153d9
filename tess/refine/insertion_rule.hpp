// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Rules 1 to 3 of refinement (DESIGN §4.3) as pure functions of one cell: is it bad, and where would its new vertex
/// go? The refiner acts on them and the cell table explains with them, so a reason code is the very reason the refiner
/// had.

#include <array>
#include <span>

#include "tess/barrier_query.hpp"
#include "tess/criteria.hpp"
#include "tess/domain.hpp"
#include "tess/frame.hpp"
#include "tess/mesh/quality.hpp"
#include "tess/model/resolution.hpp"
#include "tess/property.hpp"
#include "tess/refine/box_faces.hpp"
#include "tess/refinement.hpp"

namespace terratet {

/// A cell as the rules see it: its vertices ascending by index, so that results do not depend on how it is stored.
struct JudgedCell {
    std::array<std::uint32_t, 4> vertices;
    CellPoints points;
    Circumsphere sphere;
};

/// A cell of a mesh, likewise.
JudgedCell judged(const TetMesh& mesh, std::array<std::uint32_t, 4> cell);

/// Where a bad cell's new vertex would go. Distances to other vertices are still to be tested when `projected`.
struct Proposal {
    Reason reason = Reason::none;  ///< none: acceptable so far
    Vec3 point;                    ///< snapped
    bool projected = false;        ///< a split of the hull box' boundary in the circumcentre's stead
    double radius = 0;             ///< of the circumsphere
};

/// Where rules 4 and 6 try points around a circumcentre, in circumradii: still well inside every such sphere.
inline constexpr double candidate_radius = 0.3;

class InsertionRule {
  public:
    /// All references must outlive the rule.
    InsertionRule(const Criteria& criteria, const Domain& domain, const Frame& frame, const BarrierQuery& barriers,
                  std::span<const Property> properties, const VertexValues& values);

    /// Tells of a vertex: those on the hull box count for rule 3. All have to be told of before a place is asked for.
    void note_vertex(const Vec3& place) { faces_of_box_.insert(place); }

    /// Largest ratio of a measure to its limit over the insertion criteria in force; above 1 the cell is bad. Exact
    /// only above 1. Exemption as smooth is not considered.
    [[nodiscard]] double violation(const JudgedCell& cell) const;

    /// Below df_min, or half the tolerance, along all edges: exempt from shape and l_max.
    [[nodiscard]] bool smooth(const JudgedCell& cell) const;

    /// Varies by half the tolerance or more, so that its residual cannot be known without asking.
    [[nodiscard]] bool unsure(const JudgedCell& cell) const;

    /// What is left of the violation when a smooth cell's shape and l_max are forgiven.
    [[nodiscard]] double violation_in_force(const JudgedCell& cell) const;

    /// Of a bad cell: by its aspect alone.
    [[nodiscard]] bool merely_flat(const JudgedCell& cell) const;

    /// Rules 2 and 3.
    [[nodiscard]] Proposal propose(const JudgedCell& cell) const;

    /// If the split proposed comes too near a vertex: the circumcentre after all, or on the box where that is near;
    /// none when the box is so far from it that another vertex may be nearer than half the circumradius.
    [[nodiscard]] std::optional<Vec3> instead_of_split(const JudgedCell& cell) const;

    /// Rules 2 and 3 for a point near a circumcentre (rule 4): in the box, outside the balls of its boundary's parts
    /// and the faults' zones.
    [[nodiscard]] bool allows(const Vec3& point) const;

    /// Nearer than l_min to the hull box, or on it.
    [[nodiscard]] bool near_box(const Vec3& point) const { return near_face(point, resolution_.l_min(point)); }

    [[nodiscard]] const ResolutionField& resolution() const { return resolution_; }

    /// Another l_min between the samples (ResolutionField::between).
    void set_between(double l_min) { resolution_.set_between(l_min); }

  private:
    [[nodiscard]] double size_violation(const JudgedCell& cell) const;
    [[nodiscard]] double shape_violation(const JudgedCell& cell) const;
    [[nodiscard]] double variation_violation(const JudgedCell& cell) const;
    [[nodiscard]] bool varies_less(const JudgedCell& cell, std::size_t property, double limit) const;
    [[nodiscard]] bool near_face(const Vec3& point, double margin) const;

    const Criteria& criteria_;
    const Domain& domain_;
    const Frame& frame_;
    const BarrierQuery& barriers_;
    ResolutionField resolution_;
    BoxFaces faces_of_box_;
    std::span<const Property> properties_;
    const VertexValues& values_;
    bool has_variation_;
    std::vector<double> smooth_below_;  ///< by property; 0: whatever it varies by
    bool has_smooth_;
};

}  // namespace terratet
