// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// What makes a cell bad, and the resolution everything else follows from (paper, 4.1 a and 4.2 a).

#include <vector>

#include "tess/geometry.hpp"
#include "tess/property.hpp"

namespace terratet {

/// Limits on the variation of one property along an edge, in the property's scale.
struct VariationLimits {
    double df_min = 0;     ///< below it along all its edges a cell is smooth: exempt from shape and l_max. 0: never
    double df_max = 0;     ///< above it along an edge a cell is bad; 0: no limit
    double tolerance = 0;  ///< how far the field may be from what was measured; 0: no matter. Not for a category
    double residual = 0;   ///< how far from the estimator in between: the tolerance, or what noise the estimator leaves
                           ///< if that is more; 0: not asked
    Vec3 trend{};          ///< gradient of the samples' common trend: with a tolerance, what follows it does not vary
    friend bool operator==(const VariationLimits&, const VariationLimits&) = default;
};

/// Another resolution in a part of the ground.
struct ResolutionOverride {
    enum class Where {
        box,    ///< in `box`
        block,  ///< in the fault block that holds `point`, as far as the extent reaches
    };
    Where where = Where::box;
    Box3 box;
    Vec3 point;
    double l_min = 0;
    double l_max = 0;
    friend bool operator==(const ResolutionOverride&, const ResolutionOverride&) = default;
};

/// Where samples ask for a finer l_min to be within the tolerance: it grows by 0.4 of the distance from there.
struct FinePlace {
    Vec3 position;
    double l_min = 0;
    friend bool operator==(const FinePlace&, const FinePlace&) = default;
};

/// Lengths are in the frame's unit, volumes in its cube. 0 switches a criterion off, except l_min and l_max.
struct Criteria {
    double l_min = 0;         ///< no inserted vertex comes nearer than this to another; density of the samples
    double l_max = 0;         ///< longest edge wanted; guarantee R4 needs l_max ≥ 4 l_min
    double radius_edge = 2;   ///< largest circumradius over shortest edge R/ℓ; above: skinny
    double aspect = 8;        ///< largest β = circumradius over inscribed radius (regular cell: 3); above: flat
    double v_min = 0;         ///< clean-up only: insertion can never enlarge a cell
    double v_max = 0;         ///< largest volume
    double dihedral_deg = 5;  ///< clean-up only: smallest dihedral angle
    std::vector<VariationLimits> variation;     ///< one per property of the model; empty: none
    std::vector<ResolutionOverride> overrides;  ///< of l_min and l_max; where they overlap, the last one counts

    // With a tolerance
    double l_min_between = 0;       ///< l_min of inserted vertices away from fine places; 0: l_min
    double l_min_floor = 0;         ///< no fine place asks for less; 0: 1e-4 of the diagonal
    bool shape_everywhere = false;  ///< else cells that vary by less than half of it are exempt from shape and l_max
    std::vector<FinePlace> fine;    ///< what the samples ask for, fixed before refinement

    [[nodiscard]] bool has_variation() const;  ///< some limit is in force
    [[nodiscard]] bool has_tolerance() const;
    [[nodiscard]] bool has_residual() const;
    friend bool operator==(const Criteria&, const Criteria&) = default;
};

/// How long edges on the box's faces may be: l_max, but where a tolerance decides, cells may be as large as they like.
double longest_on_faces(const Criteria& criteria);

/// Throws UsageError when the numbers contradict each other: l_min or l_max not positive, l_max < l_min, a limit
/// negative or not finite, radius_edge below 1, aspect below 3, df_min above df_max; likewise in an override, or a box
/// without volume.
void validate(const Criteria& criteria);

}  // namespace terratet
