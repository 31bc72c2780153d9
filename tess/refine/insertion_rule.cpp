// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/refine/insertion_rule.hpp"

#include <algorithm>
#include <cmath>

#include "tess/base/tetrahedron.hpp"

namespace terratet {

namespace {

/// Whether β = R·A/(3V) exceeds `limit`, and if so by what factor; 1 otherwise. With f_i twice the faces' areas,
/// A² = (Σf_i)²/4 ≤ Σf_i², which acquits most cells without a root.
double aspect_violation(const CellPoints& p, double squared_radius, double volume, double limit) {
    const Vec3 a = p[1] - p[0];
    const Vec3 b = p[2] - p[0];
    const Vec3 c = p[3] - p[0];
    const std::array<Vec3, 3> faces{cross(b, c), cross(c, a), cross(a, b)};
    const std::array<double, 4> squares{squared_length(faces[0]), squared_length(faces[1]), squared_length(faces[2]),
                                        squared_length(faces[0] + faces[1] + faces[2])};
    const double allowed = 3 * volume * limit;
    if (squared_radius * (squares[0] + squares[1] + squares[2] + squares[3]) <= allowed * allowed) {
        return 1;
    }
    const double area =
        (std::sqrt(squares[0]) + std::sqrt(squares[1]) + std::sqrt(squares[2]) + std::sqrt(squares[3])) / 2;
    const double factor = std::sqrt(squared_radius) * area / allowed;
    return factor <= 1 ? 1 : factor;
}

/// All but coplanar, so that its circumcentre is made of rounding errors, which grow with this ratio: beyond it a
/// thousandth of the radius would no longer be sure.
bool is_flat_by_rounding(const JudgedCell& cell) {
    constexpr double largest_condition = 1e12;
    const CellPoints& p = cell.points;
    const double product = squared_distance(p[1], p[0]) * squared_distance(p[2], p[0]) * squared_distance(p[3], p[0]);
    const double least = std::sqrt(product) / largest_condition;
    return !(std::abs(cell.sphere.six_volumes) >= least);
}

/// By property, the variation below which a cell is smooth; 0 where none counts.
std::vector<double> smooth_limits(const Criteria& criteria) {
    std::vector<double> limits;
    for (const VariationLimits& v : criteria.variation) {
        const double tolerance = criteria.shape_everywhere ? 0 : std::max(v.tolerance, v.residual);
        limits.push_back(v.df_min > 0 ? v.df_min : tolerance / 2);
    }
    return limits;
}

}  // namespace

JudgedCell judged(const TetMesh& mesh, std::array<std::uint32_t, 4> cell) {
    std::ranges::sort(cell);
    const CellPoints points = cell_points(mesh, cell);
    return {cell, points, circumsphere(points)};
}

InsertionRule::InsertionRule(const Criteria& criteria, const Domain& domain, const Frame& frame,
                             const BarrierQuery& barriers, std::span<const Property> properties,
                             const VertexValues& values)
    : criteria_(criteria),
      domain_(domain),
      frame_(frame),
      barriers_(barriers),
      resolution_(criteria, domain, barriers.barriers()),
      faces_of_box_(domain.hull),
      properties_(properties),
      values_(values),
      has_variation_(std::ranges::any_of(criteria.variation, [](const auto& v) { return v.df_max > 0; })),
      smooth_below_(smooth_limits(criteria)),
      has_smooth_(std::ranges::any_of(smooth_below_, [](double limit) { return limit > 0; })) {}

/// Of edges, R/ℓ and volume: what insertion mends for certain.
double InsertionRule::size_violation(const JudgedCell& cell) const {
    const CellPoints& p = cell.points;
    double shortest = std::numeric_limits<double>::infinity();
    double longest = 0;
    for (const auto& [i, j] : cell_edges) {
        const double d = squared_distance(p[i], p[j]);
        shortest = std::min(shortest, d);
        longest = std::max(longest, d);
    }
    // Most cells are good: roots are for the others.
    const double l_max = resolution_.l_max(p);
    const Circumsphere& sphere = cell.sphere;
    const double ratio = criteria_.radius_edge;
    const double volume = std::abs(sphere.six_volumes) / 6;
    double worst = 0;
    if (!(longest <= l_max * l_max)) {
        worst = std::sqrt(longest) / l_max;
    }
    if (ratio > 0 && !(sphere.squared_radius <= ratio * ratio * shortest)) {
        worst = std::max(worst, std::sqrt(sphere.squared_radius / shortest) / ratio);
    }
    if (criteria_.v_max > 0 && !(volume <= criteria_.v_max)) {
        worst = std::max(worst, std::cbrt(volume / criteria_.v_max));
    }
    return worst;
}

double InsertionRule::shape_violation(const JudgedCell& cell) const {
    double worst = size_violation(cell);
    if (criteria_.aspect > 0 && worst <= 1) {
        const double volume = std::abs(cell.sphere.six_volumes) / 6;
        worst = std::max(worst, aspect_violation(cell.points, cell.sphere.squared_radius, volume, criteria_.aspect));
    }
    return std::isnan(worst) ? std::numeric_limits<double>::infinity() : worst;
}

double InsertionRule::variation_violation(const JudgedCell& cell) const {
    double worst = 0;
    for (std::size_t property = 0; property < criteria_.variation.size(); ++property) {
        const double limit = criteria_.variation[property].df_max;
        if (limit <= 0) {
            continue;
        }
        const auto& column = values_.values[property];
        for (const auto& [i, j] : cell_edges) {
            // An edge across a fault is exempt: a jump there is what the fault is for.
            const double df =
                scaled_difference(properties_[property], column[cell.vertices[i]], column[cell.vertices[j]]);
            if (df > limit * worst && !barriers_.seen_by(property).crosses_any(cell.points[i], cell.points[j])) {
                worst = df / limit;
            }
        }
    }
    return worst;
}

bool InsertionRule::merely_flat(const JudgedCell& cell) const {
    return size_violation(cell) <= 1 && (!has_variation_ || variation_violation(cell) <= 1);
}

bool InsertionRule::varies_less(const JudgedCell& cell, std::size_t property, double limit) const {
    const Property& kind = properties_[property];
    const Vec3& trend = criteria_.variation[property].trend;
    const auto& column = values_.values[property];
    return std::ranges::all_of(cell_edges, [&](const auto& edge) {
        const auto [i, j] = edge;
        const double from = column[cell.vertices[i]];
        const double to = column[cell.vertices[j]];
        if (trend == Vec3{}) {
            return scaled_difference(kind, from, to) < limit;
        }
        const double beside = to_scale(kind, to) - to_scale(kind, from) - dot(trend, cell.points[j] - cell.points[i]);
        return !(std::abs(beside) >= limit);
    });
}

bool InsertionRule::smooth(const JudgedCell& cell) const {
    if (!has_smooth_) {
        return false;
    }
    for (std::size_t property = 0; property < smooth_below_.size(); ++property) {
        if (smooth_below_[property] > 0 && !varies_less(cell, property, smooth_below_[property])) {
            return false;
        }
    }
    return true;
}

bool InsertionRule::unsure(const JudgedCell& cell) const {
    for (std::size_t property = 0; property < criteria_.variation.size(); ++property) {
        const double residual = criteria_.variation[property].residual;
        if (residual > 0 && !varies_less(cell, property, residual / 2)) {
            return true;
        }
    }
    return false;
}

double InsertionRule::violation(const JudgedCell& cell) const {
    const double shape = shape_violation(cell);
    return has_variation_ ? std::max(shape, variation_violation(cell)) : shape;
}

double InsertionRule::violation_in_force(const JudgedCell& cell) const {
    if (!smooth(cell)) {
        return violation(cell);
    }
    double worst = has_variation_ ? variation_violation(cell) : 0;
    if (criteria_.v_max > 0) {
        worst = std::max(worst, std::cbrt(std::abs(cell.sphere.six_volumes) / 6 / criteria_.v_max));
    }
    return worst;
}

bool InsertionRule::near_face(const Vec3& point, double margin) const {
    for (int axis = 0; axis < 3; ++axis) {
        if (point[axis] < domain_.hull.lo[axis] + margin || point[axis] > domain_.hull.hi[axis] - margin) {
            return true;
        }
    }
    return false;
}

Proposal InsertionRule::propose(const JudgedCell& cell) const {
    const Circumsphere& sphere = cell.sphere;
    Proposal proposal;
    proposal.radius = std::sqrt(sphere.squared_radius);
    if (!is_finite(sphere.center) || !std::isfinite(proposal.radius) || is_flat_by_rounding(cell)) {
        proposal.reason = Reason::no_center;
        return proposal;
    }
    if (proposal.radius < resolution_.l_min(domain_.hull.clamped(sphere.center))) {  // the nearest vertex is at R
        proposal.reason = Reason::too_close;
        return proposal;
    }
    const auto split = faces_of_box_.split_for(sphere.center);
    proposal.projected = split.has_value();
    proposal.point = split.value_or(sphere.center);
    proposal.point = frame_.snapped(proposal.point);
    if (!barriers_.empty() && barriers_.protecting_barrier(proposal.point) >= 0) {
        proposal.reason = Reason::near_fault;
    }
    return proposal;
}

std::optional<Vec3> InsertionRule::instead_of_split(const JudgedCell& cell) const {
    const Vec3& centre = cell.sphere.center;
    const double radius = std::sqrt(cell.sphere.squared_radius);
    const double margin = std::max(resolution_.l_min(domain_.hull.clamped(centre)) / 2, radius / 4);
    Vec3 place = centre;
    for (int axis = 0; axis < 3; ++axis) {
        if (centre[axis] < domain_.hull.lo[axis] + margin) {
            place[axis] = domain_.hull.lo[axis];
        } else if (centre[axis] > domain_.hull.hi[axis] - margin) {
            place[axis] = domain_.hull.hi[axis];
        }
    }
    place = frame_.snapped(place);
    const bool allowed = distance(place, centre) <= radius / 2 && radius >= resolution_.l_min(place) &&
                         (barriers_.empty() || barriers_.protecting_barrier(place) < 0);
    return allowed ? std::optional(place) : std::nullopt;
}

bool InsertionRule::allows(const Vec3& point) const {
    return is_finite(point) && !near_face(point, resolution_.l_min(point) / 2) && !faces_of_box_.split_for(point) &&
           (barriers_.empty() || barriers_.protecting_barrier(point) < 0);
}

}  // namespace terratet
