// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/criteria.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "tess/error.hpp"

namespace terratet {

namespace {

void require(bool condition, const std::string& message) {
    if (!condition) {
        throw UsageError(message);
    }
}

void require_limit(double value, double smallest, const std::string& option) {
    require(std::isfinite(value) && (value == 0 || value >= smallest),
            option + " is " + std::to_string(value) + "; it must be 0 (off) or at least " + std::to_string(smallest));
}

void require_resolution(double l_min, double l_max, const std::string& where) {
    require(std::isfinite(l_min) && l_min > 0, "`l_min` must be a positive length" + where);
    require(std::isfinite(l_max) && l_max > 0, "`l_max` must be a positive length" + where);
    require(l_max >= l_min,
            "`l_max` (" + std::to_string(l_max) + ") is below `l_min` (" + std::to_string(l_min) + ")" + where);
}

}  // namespace

bool Criteria::has_variation() const {
    return has_tolerance() ||
           std::ranges::any_of(variation, [](const VariationLimits& v) { return v.df_min > 0 || v.df_max > 0; });
}

bool Criteria::has_tolerance() const {
    return std::ranges::any_of(variation, [](const VariationLimits& v) { return v.tolerance > 0; });
}

bool Criteria::has_residual() const {
    return std::ranges::any_of(variation, [](const VariationLimits& v) { return v.residual > 0; });
}

double longest_on_faces(const Criteria& criteria) {
    return criteria.has_tolerance() && !criteria.shape_everywhere ? std::numeric_limits<double>::infinity()
                                                                  : criteria.l_max;
}

void validate(const Criteria& criteria) {
    require_resolution(criteria.l_min, criteria.l_max, "");
    for (const ResolutionOverride& part : criteria.overrides) {
        require_resolution(part.l_min, part.l_max, ", also in `overrides`");
        require(part.where == ResolutionOverride::Where::block || part.box.volume() > 0,
                "`overrides`: the box has no volume");
    }
    require_limit(criteria.radius_edge, 1, "`radius_edge`");
    require_limit(criteria.aspect, 3, "`aspect`");
    require_limit(criteria.v_min, 0, "`v_min`");
    require_limit(criteria.v_max, 0, "`v_max`");
    require(std::isfinite(criteria.dihedral_deg) && criteria.dihedral_deg >= 0 && criteria.dihedral_deg < 70.5,
            "`dihedral_deg` must lie in 0…70.5 degrees, the regular cell's");
    for (const VariationLimits& limits : criteria.variation) {
        require_limit(limits.df_min, 0, "`df_min`");
        require_limit(limits.df_max, 0, "`df_max`");
        require(limits.df_max == 0 || limits.df_min <= limits.df_max, "`df_min` is above `df_max`");
        require_limit(limits.tolerance, 0, "`tolerance`");
        require_limit(limits.residual, 0, "the tolerance between samples");
    }
    require_limit(criteria.l_min_between, 0, "`l_min` between samples");
    require_limit(criteria.l_min_floor, 0, "`lmin_floor`");
    for (const FinePlace& place : criteria.fine) {
        require(std::isfinite(place.l_min) && place.l_min > 0, "a fine place's `l_min` must be a positive length");
    }
}

}  // namespace terratet
