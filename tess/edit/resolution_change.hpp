// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Where a change of criteria changes the resolution.

#include <algorithm>
#include <vector>

#include "tess/model.hpp"
#include "tess/model/resolution.hpp"

namespace terratet {

class ResolutionChange {
  public:
    /// All must outlive it. \pre The criteria differ in their overrides alone.
    ResolutionChange(const ResolutionField& old_field, const ResolutionField& new_field, const Model& before,
                     const Model& after)
        : old_(old_field), new_(new_field) {
        const auto& a = before.criteria.overrides;
        const auto& b = after.criteria.overrides;
        const auto first = std::ranges::mismatch(a, b);  // from there on one may cover another
        for (const auto& [from, to] : {std::pair(first.in1, a.end()), std::pair(first.in2, b.end())}) {
            for (auto part = from; part != to; ++part) {
                boxes_.push_back(part->where == ResolutionOverride::Where::box ? part->box : after.domain.hull);
            }
        }
    }

    /// They hold all places where it may differ.
    [[nodiscard]] const std::vector<Box3>& boxes() const { return boxes_; }

    [[nodiscard]] bool coarser_at(const Vec3& p) const {
        return std::ranges::any_of(boxes_, [&](const Box3& box) { return box.contains(p); }) &&
               (new_.l_min(p) > old_.l_min(p) || new_.l_max({p, p, p, p}) > old_.l_max({p, p, p, p}));
    }

  private:
    const ResolutionField& old_;
    const ResolutionField& new_;
    std::vector<Box3> boxes_;
};

}  // namespace terratet
