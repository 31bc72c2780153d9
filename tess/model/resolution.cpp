// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/model/resolution.hpp"

#include <cmath>
#include <numbers>

#include "tess/error.hpp"
#include "tess/model/block_finder.hpp"

namespace terratet {

namespace {

using Where = ResolutionOverride::Where;

bool touch(const Box3& a, const Box3& b) {
    return a.lo.x <= b.hi.x && b.lo.x <= a.hi.x && a.lo.y <= b.hi.y && b.lo.y <= a.hi.y && a.lo.z <= b.hi.z &&
           b.lo.z <= a.hi.z;
}

}  // namespace

struct ResolutionField::Blocks : BlockFinder {
    using BlockFinder::BlockFinder;
    std::vector<std::int32_t> of_override;  ///< block that each override names; −1: none

    /// The same whatever was asked before: between two cells, as the middle of an edge of the hull box may be, the one
    /// towards a point of no symmetry.
    [[nodiscard]] std::int32_t block_at(const Vec3& place, const Box3& hull) const {
        const Vec3 size = hull.size();
        const Vec3 target = hull.lo + Vec3{0.37 * size.x, 0.53 * size.y, 0.71 * size.z};
        return at(place + 1e-6 * (target - place));  // more than the walk forgives
    }
};

ResolutionField::ResolutionField(const Criteria& criteria, const Domain& domain, std::span<const Barrier> barriers)
    : criteria_(criteria),
      domain_(domain),
      between_(criteria.l_min_between > 0 ? std::min(criteria.l_min_between, criteria.l_min) : criteria.l_min),
      fine_(criteria.fine) {
    const auto names_block = [](const ResolutionOverride& part) { return part.where == Where::block; };
    if (std::ranges::none_of(criteria.overrides, names_block)) {
        return;
    }
    blocks_ = std::make_unique<Blocks>(domain, barriers);
    for (const ResolutionOverride& part : criteria.overrides) {
        blocks_->of_override.push_back(names_block(part) ? blocks_->at(part.point) : -1);
        if (names_block(part) && blocks_->of_override.back() < 0) {
            throw UsageError(
                "`overrides`: the point that names a fault block lies in none: it is outside the extent, "
                "or on a fault");
        }
    }
}

ResolutionField::~ResolutionField() = default;
ResolutionField::ResolutionField(ResolutionField&&) noexcept = default;

double ResolutionField::l_min_by_part(const Vec3& place, double elsewhere) const {
    const std::int32_t block = blocks_ ? blocks_->block_at(place, domain_.hull) : -1;
    for (std::size_t i = criteria_.overrides.size(); i-- > 0;) {
        const ResolutionOverride& part = criteria_.overrides[i];
        if (part.where == Where::box ? part.box.contains(place) : block >= 0 && blocks_->of_override[i] == block) {
            return part.l_min;
        }
    }
    return elsewhere;
}

double ResolutionField::l_max_by_part(const CellPoints& cell) const {
    const Box3 box = bounding_box(cell);
    const std::int32_t block =
        blocks_ ? blocks_->block_at(0.25 * (cell[0] + cell[1] + cell[2] + cell[3]), domain_.hull) : -1;
    double finest = std::numeric_limits<double>::infinity();
    for (std::size_t i = criteria_.overrides.size(); i-- > 0;) {
        const ResolutionOverride& part = criteria_.overrides[i];
        const bool in_part = part.where == Where::block && block >= 0 && blocks_->of_override[i] == block;
        if (in_part || (part.where == Where::box && touch(part.box, box))) {
            finest = std::min(finest, part.l_max);
        }
        if (in_part || (part.where == Where::box && part.box.contains(box.lo) && part.box.contains(box.hi))) {
            return finest;  // what lies below this part is covered by it
        }
    }
    return std::min(finest, criteria_.l_max);
}

double ResolutionField::smallest_l_min() const {
    double smallest = std::min(between_, fine_.smallest());
    for (const ResolutionOverride& part : criteria_.overrides) {
        smallest = std::min(smallest, part.l_min);
    }
    return smallest;
}

double ResolutionField::largest_by_part(double elsewhere) const {
    for (const ResolutionOverride& part : criteria_.overrides) {
        elsewhere = std::max(elsewhere, part.l_min);
    }
    return elsewhere;
}

double ResolutionField::largest_l_min() const {
    return largest_by_part(between_);
}

double ResolutionField::largest_sample_l_min() const {
    return largest_by_part(criteria_.l_min);
}

double ResolutionField::packing_bound() const {
    double bound = terratet::packing_bound(domain_.hull, between_) + fine_.packing_bound(largest_l_min());
    for (const ResolutionOverride& part : criteria_.overrides) {
        const Box3& hull = domain_.hull;
        const Box3 box = part.where == Where::box ? Box3{hull.clamped(part.box.lo), hull.clamped(part.box.hi)} : hull;
        bound += terratet::packing_bound(box, part.l_min);
    }
    return bound;
}

double packing_bound(const Box3& hull, double l_min) {
    // |Ω ⊕ B(l/2)| for a box (Steiner's formula), against the volume a point of a densest packing takes: l³/√2.
    const Vec3 a = hull.size();
    const double r = l_min / 2;
    const double swollen = a.x * a.y * a.z + 2 * r * (a.x * a.y + a.y * a.z + a.z * a.x) +
                           std::numbers::pi * r * r * (a.x + a.y + a.z) + 4.0 / 3 * std::numbers::pi * r * r * r;
    return std::ceil(std::numbers::sqrt2 * swollen / (l_min * l_min * l_min));
}

}  // namespace terratet
