// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/barrier/complex/complex_editor.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace terratet {
namespace {

constexpr double merge_length = 0.3;  ///< of the target: nodes and chains nearer to each other than that become one

Triangle with(Triangle t, std::uint32_t v, std::uint32_t instead) {
    for (std::uint32_t& x : t) {
        x = x == v ? instead : x;
    }
    return t;
}

std::uint32_t opposite(const Triangle& t, std::uint32_t u, std::uint32_t v) {
    for (const std::uint32_t x : t) {
        if (x != u && x != v) {
            return x;
        }
    }
    return t[0];
}

double longest_edge(const TriangleCorners& t) {
    return std::max({distance(t[0], t[1]), distance(t[1], t[2]), distance(t[2], t[0])});
}

double angle_at(const Vec3& apex, const Vec3& a, const Vec3& b) {
    return std::atan2(length(cross(a - apex, b - apex)), dot(a - apex, b - apex));
}

}  // namespace

ComplexEditor::ComplexEditor(const SheetComplex& complex, const Patches& numbering, const SizeField& sizes,
                             std::span<const char> bounds)
    : field_(sizes) {
    for (const Vec3& p : complex.points) {
        add_point(p);
    }
    for (std::uint32_t t = 0; t < complex.triangles.size(); ++t) {
        add_triangle(complex.triangles[t], {{}, numbering.of_triangle[t], complex.sheet[t]});
    }
    number_bounds(bounds);
}

TriangleCorners ComplexEditor::corners(std::uint32_t t) const {
    const Triangle& c = triangles_[t].corners;
    return {points_[c[0]], points_[c[1]], points_[c[2]]};
}

std::uint32_t ComplexEditor::add_point(const Vec3& p) {
    points_.push_back(p);
    sizes_of_.push_back(field_.at(p));
    fixed_.push_back(0);
    awake_.push_back(1);
    star_.emplace_back();
    return static_cast<std::uint32_t>(points_.size() - 1);
}

void ComplexEditor::add_triangle(const Triangle& t, const WorkTriangle& like) {
    const auto number = static_cast<std::uint32_t>(triangles_.size());
    triangles_.push_back({t, like.patch, like.sheet, like.bound, true});
    for (const std::uint32_t v : t) {
        star_[v].push_back(number);
    }
}

void ComplexEditor::remove_triangle(std::uint32_t t) {
    triangles_[t].alive = false;
    for (const std::uint32_t v : triangles_[t].corners) {
        star_[v].erase(std::find(star_[v].begin(), star_[v].end(), t));
    }
}

std::optional<std::uint32_t> ComplexEditor::present(const Triangle& t) const {
    for (const std::uint32_t k : star_[t[0]]) {
        if (has(triangles_[k].corners, t[1]) && has(triangles_[k].corners, t[2])) {
            return k;
        }
    }
    return {};
}

std::vector<std::uint32_t> ComplexEditor::update_sizes() {
    std::vector<std::uint32_t> changed;
    for (std::uint32_t v = 0; v < points_.size(); ++v) {
        if (const double size = field_.at(points_[v]); size != sizes_of_[v]) {
            sizes_of_[v] = size;
            changed.push_back(v);
        }
    }
    return changed;
}

void ComplexEditor::wake_only(const std::vector<std::uint32_t>& points) {
    awake_.assign(points_.size(), 0);
    for (const std::uint32_t v : points) {
        awake_[v] = 1;
    }
}

void ComplexEditor::wake_neighbours(int rings) {
    for (int ring = 0; ring < rings; ++ring) {
        const std::vector<char> before = awake_;
        for (const WorkTriangle& triangle : triangles_) {
            if (triangle.alive &&
                std::ranges::any_of(triangle.corners, [&](std::uint32_t v) { return before[v] != 0; })) {
                for (const std::uint32_t v : triangle.corners) {
                    awake_[v] = 1;
                }
            }
        }
    }
}

bool ComplexEditor::stays_sound(std::uint32_t v, const Vec3& to) const {
    return std::ranges::all_of(star_[v], [&](std::uint32_t t) {
        const TriangleCorners before = corners(t);
        TriangleCorners after = before;
        for (std::size_t k = 0; k < 3; ++k) {
            if (triangles_[t].corners[k] == v) {
                after[k] = to;
            }
        }
        const Vec3 was = area_vector(before);
        const Vec3 is = area_vector(after);
        return dot(unit(was), unit(is)) >= 0.7 && squared_length(is) >= 0.04 * squared_length(was);
    });
}

void ComplexEditor::move(std::uint32_t v, const Vec3& to) {
    points_[v] = to;
    if (!field_.uniform()) {
        sizes_of_[v] = field_.at(to);
    }
}

std::vector<std::uint32_t> ComplexEditor::edge_triangles(std::uint32_t u, std::uint32_t v) const {
    std::vector<std::uint32_t> result;
    for (const std::uint32_t t : star_[u]) {
        if (has(triangles_[t].corners, v)) {
            result.push_back(t);
        }
    }
    return result;
}

bool ComplexEditor::is_feature(const std::vector<std::uint32_t>& of_edge) const {
    return of_edge.size() != 2 || triangles_[of_edge[0]].patch != triangles_[of_edge[1]].patch;
}

ComplexEditor::Classified ComplexEditor::classify(std::uint32_t v) const {
    struct Spoke {  // no allocation: this is the remesher's innermost question
        std::uint32_t end = 0;
        std::size_t count = 0;
        std::array<std::uint32_t, 4> patches{};  // of more triangles than that the first
    };
    std::vector<Spoke> spokes;
    spokes.reserve(12);
    for (const std::uint32_t t : star_[v]) {
        for (const std::uint32_t x : triangles_[t].corners) {
            if (x == v) {
                continue;
            }
            auto spoke = std::ranges::find(spokes, x, &Spoke::end);
            if (spoke == spokes.end()) {
                spoke = spokes.insert(spokes.end(), {x, 0, {}});
            }
            if (spoke->count < spoke->patches.size()) {
                spoke->patches[spoke->count] = triangles_[t].patch;
            }
            ++spoke->count;
        }
    }
    Classified result;
    std::vector<const Spoke*> features;
    for (Spoke& spoke : spokes) {
        std::sort(spoke.patches.begin(),
                  spoke.patches.begin() + static_cast<std::ptrdiff_t>(std::min(spoke.count, spoke.patches.size())));
        if (spoke.count != 2 || spoke.patches[0] != spoke.patches[1]) {
            features.push_back(&spoke);
            result.along.push_back(spoke.end);
        }
    }
    if (fixed_[v] != 0) {
        result.kind = PointKind::node;
    } else if (features.size() == 2) {
        result.kind = features[0]->count == features[1]->count && features[0]->patches == features[1]->patches
                          ? PointKind::chain
                          : PointKind::node;
    } else if (!features.empty()) {
        result.kind = PointKind::node;
    } else if (!star_[v].empty()) {  // inner edges only: one closed fan, or several that touch in this point
        std::size_t walked = 0;
        const std::uint32_t start = star_[v].front();
        std::uint32_t t = start;
        std::uint32_t over = opposite(triangles_[t].corners, v, v);
        do {
            const std::uint32_t next_over = opposite(triangles_[t].corners, v, over);
            const auto beyond = std::ranges::find_if(
                star_[v], [&](std::uint32_t k) { return k != t && has(triangles_[k].corners, next_over); });
            t = beyond == star_[v].end() ? start : *beyond;
            over = next_over;
        } while (++walked < star_[v].size() && t != start);
        result.kind = walked == star_[v].size() ? PointKind::interior : PointKind::node;
    }
    return result;
}

std::vector<std::array<std::uint32_t, 2>> ComplexEditor::edges() const {
    std::vector<std::array<std::uint32_t, 2>> result;
    for (const WorkTriangle& t : triangles_) {
        for (std::size_t k = 0; t.alive && k < 3; ++k) {
            const auto [u, v] = std::minmax(t.corners[k], t.corners[(k + 1) % 3]);
            result.push_back({u, v});
        }
    }
    std::ranges::sort(result);
    result.erase(std::ranges::unique(result).begin(), result.end());
    return result;
}

std::uint32_t ComplexEditor::split_edge(std::uint32_t u, std::uint32_t v, const Vec3& at) {
    const std::uint32_t middle = add_point(at);
    for (const std::uint32_t t : edge_triangles(u, v)) {
        const WorkTriangle old = triangles_[t];
        remove_triangle(t);
        add_triangle(with(old.corners, u, middle), old);
        add_triangle(with(old.corners, v, middle), old);
    }
    return middle;
}

std::uint32_t ComplexEditor::split_triangle(std::uint32_t t, const Vec3& at) {
    const std::uint32_t middle = add_point(at);
    const WorkTriangle old = triangles_[t];
    remove_triangle(t);
    for (const std::uint32_t v : old.corners) {
        add_triangle(with(old.corners, v, middle), old);
    }
    return middle;
}

/// Link condition: the points next to both ends are those opposite the edge.
bool ComplexEditor::keeps_topology(std::uint32_t u, std::uint32_t v, std::size_t shared) const {
    const auto neighbours = [&](std::uint32_t w) {
        std::vector<std::uint32_t> list;
        for (const std::uint32_t t : star_[w]) {
            for (const std::uint32_t x : triangles_[t].corners) {
                if (x != u && x != v) {
                    list.push_back(x);
                }
            }
        }
        std::ranges::sort(list);
        list.erase(std::ranges::unique(list).begin(), list.end());
        return list;
    };
    std::vector<std::uint32_t> common;
    std::ranges::set_intersection(neighbours(u), neighbours(v), std::back_inserter(common));
    return common.size() == shared;
}

bool ComplexEditor::keeps_shape(std::uint32_t u, std::uint32_t v, bool forced) const {
    const double wanted = target(u, v);
    for (const std::uint32_t t : star_[u]) {
        if (has(triangles_[t].corners, v)) {
            continue;
        }
        const TriangleCorners before = corners(t);
        TriangleCorners after = before;
        for (std::size_t k = 0; k < 3; ++k) {
            if (triangles_[t].corners[k] == u) {
                after[k] = points_[v];
            }
        }
        const Vec3 normal_before = area_vector(before);
        const Vec3 normal_after = area_vector(after);
        const double longest_before = longest_edge(before);
        const double longest_after = longest_edge(after);
        const double height_before = 2 * length(normal_before) / longest_before;
        const double height_after = 2 * length(normal_after) / longest_after;
        const bool grows = longest_after > 1.4 * wanted && longest_after > 1.001 * longest_before;
        const bool flattens =
            height_after < 0.1 * longest_after && height_after / longest_after < 0.9 * height_before / longest_before;
        if (!(height_after >= 1e-4 * wanted) || (!forced && (grows || flattens))) {
            return false;
        }
        const bool telling = height_before > (forced ? 0.3 : 0.03) * wanted;
        if (telling && dot(unit(normal_before), unit(normal_after)) < (forced ? 0.2 : 0.5)) {
            return false;
        }
    }
    return true;
}

bool ComplexEditor::contract(std::uint32_t u, std::uint32_t v) {
    const std::vector<std::uint32_t> of_edge = edge_triangles(u, v);
    if (of_edge.empty() || !may_join(u, v)) {
        return false;
    }
    const PointKind kind = classify(u).kind;
    const bool free = kind == PointKind::interior || (kind == PointKind::chain && is_feature(of_edge));
    if (!free && (classify(v).kind < kind || edge_length(u, v) > merge_length * target(u, v))) {
        return false;
    }
    if ((free && !keeps_topology(u, v, of_edge.size())) || !keeps_shape(u, v, !free)) {
        return false;
    }
    merge(u, v);
    return true;
}

void ComplexEditor::merge(std::uint32_t from, std::uint32_t into) {
    const std::vector<std::uint32_t> moved = star_[from];
    std::vector<WorkTriangle> changed;
    for (const std::uint32_t t : moved) {
        if (!has(triangles_[t].corners, into)) {
            changed.push_back(triangles_[t]);
            changed.back().corners = with(changed.back().corners, from, into);
        }
        remove_triangle(t);
    }
    for (const WorkTriangle& t : changed) {
        const std::optional<std::uint32_t> other = present(t.corners);
        if (other && t.bound != unbound && triangles_[*other].bound == unbound) {
            remove_triangle(*other);
            add_triangle(t.corners, t);
        } else if (!other) {
            add_triangle(t.corners, t);
        }
    }
    fixed_[into] = static_cast<char>(fixed_[into] | fixed_[from]);
}

bool ComplexEditor::flip(std::uint32_t u, std::uint32_t v) {
    const std::vector<std::uint32_t> of_edge = edge_triangles(u, v);
    if (is_feature(of_edge)) {
        return false;
    }
    const WorkTriangle first = triangles_[of_edge[0]];
    const std::uint32_t c = opposite(first.corners, u, v);
    const std::uint32_t d = opposite(triangles_[of_edge[1]].corners, u, v);
    constexpr double straight = std::numbers::pi * (1 + 1e-5);
    if (c == d ||
        angle_at(points_[c], points_[u], points_[v]) + angle_at(points_[d], points_[u], points_[v]) <= straight ||
        has_edge(c, d)) {
        return false;
    }
    return turn_edge(u, v, of_edge);
}

/// Unless the new triangles would fold or have no area. \pre An inner edge of a patch.
bool ComplexEditor::turn_edge(std::uint32_t u, std::uint32_t v, const std::vector<std::uint32_t>& of_edge) {
    const WorkTriangle first = triangles_[of_edge[0]];
    const std::uint32_t c = opposite(first.corners, u, v);
    const std::uint32_t d = opposite(triangles_[of_edge[1]].corners, u, v);
    const auto is_own = [&](std::uint32_t t) { return triangles_[t].sheet == first.sheet; };
    if (std::ranges::any_of(edge_triangles(c, d), is_own)) {
        return false;
    }
    const auto at = static_cast<std::size_t>(std::ranges::find(first.corners, c) - first.corners.begin());
    const std::uint32_t a = first.corners[(at + 1) % 3];
    const std::uint32_t b = first.corners[(at + 2) % 3];
    const Vec3 normal = unit(area_vector({points_[a], points_[b], points_[c]}));
    const Vec3 one = area_vector({points_[c], points_[a], points_[d]});
    const Vec3 other = area_vector({points_[d], points_[b], points_[c]});
    const double least = 0.5e-6 * target(c, d) * edge_length(c, d);
    if (length(one) < least || length(other) < least || dot(unit(one), normal) < 0.5 ||
        dot(unit(other), normal) < 0.5) {
        return false;
    }
    remove_triangle(of_edge[0]);
    remove_triangle(of_edge[1]);
    add_triangle({c, a, d}, first);
    add_triangle({d, b, c}, first);
    return true;
}

SheetComplex ComplexEditor::result() const {
    SheetComplex complex{points_, {}, {}};
    for (const WorkTriangle& t : triangles_) {
        if (t.alive) {
            complex.triangles.push_back(t.corners);
            complex.sheet.push_back(t.sheet);
        }
    }
    compact(complex);
    return complex;
}

}  // namespace terratet
