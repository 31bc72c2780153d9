// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/barrier/complex/complex_mender.hpp"

#include <CGAL/Bbox_3.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace terratet {
namespace {

/// Surely farther from the triangle than the limit?
bool beyond_box(const Vec3& p, const TriangleCorners& c, double limit) {
    for (int axis = 0; axis < 3; ++axis) {
        const auto [least, most] = std::minmax({c[0][axis], c[1][axis], c[2][axis]});
        if (p[axis] < least - limit || p[axis] > most + limit) {
            return true;
        }
    }
    return false;
}

CGAL::Bbox_3 box_of(const TriangleCorners& c) {
    const auto [x0, x1] = std::minmax({c[0].x, c[1].x, c[2].x});
    const auto [y0, y1] = std::minmax({c[0].y, c[1].y, c[2].y});
    const auto [z0, z1] = std::minmax({c[0].z, c[1].z, c[2].z});
    return {x0, y0, z0, x1, y1, z1};
}

}  // namespace

/// The triangles whose boxes come nearer to a point than `share` of its size, but for its own: boxes of all sizes
/// are no worse than boxes of one.
ComplexMender::Nearby ComplexMender::triangles_near_points(double share) const {
    using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::uint32_t>;
    std::vector<Box> around;
    for (std::uint32_t v = 0; v < editor_.point_count(); ++v) {
        if (editor_.awake(v) && !editor_.star(v).empty()) {
            const double reach = share * editor_.size(v);
            const Vec3 lo = editor_.point(v) - Vec3{reach, reach, reach};
            const Vec3 hi = editor_.point(v) + Vec3{reach, reach, reach};
            around.emplace_back(CGAL::Bbox_3(lo.x, lo.y, lo.z, hi.x, hi.y, hi.z), v);
        }
    }
    std::vector<Box> boxes;
    for (std::uint32_t t = 0; t < editor_.triangles().size(); ++t) {
        if (editor_.triangles()[t].alive) {
            const TriangleCorners c = editor_.corners(t);
            boxes.emplace_back(box_of(c), t);
        }
    }
    std::vector<std::array<std::uint32_t, 2>> pairs;
    CGAL::box_intersection_d(around.begin(), around.end(), boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
        if (!std::ranges::count(editor_.triangles()[b.info()].corners, a.info())) {
            pairs.push_back({a.info(), b.info()});
        }
    });
    std::ranges::sort(pairs);
    Nearby result;
    result.begin.assign(editor_.point_count() + 1, 0);
    for (const auto& [v, t] : pairs) {
        ++result.begin[v + 1];
        result.triangles.push_back(t);
    }
    std::partial_sum(result.begin.begin(), result.begin.end(), result.begin.begin());
    return result;
}

void ComplexMender::snap_close(double share) {
    const Nearby nearby = triangles_near_points(1.3 * share);  // points move meanwhile
    const auto count = static_cast<std::uint32_t>(editor_.point_count());
    for (std::uint32_t v = 0; v < count; ++v) {
        for (int again = 0; again < 3 && !editor_.star(v).empty(); ++again) {
            const double limit = share * editor_.size(v);
            double nearest = limit * limit;
            std::uint32_t which = 0;
            bool found = false;
            for (const std::uint32_t t : nearby.of(v)) {
                const auto& triangle = editor_.triangles()[t];
                if (!triangle.alive || triangle.corners[0] == v || triangle.corners[1] == v ||
                    triangle.corners[2] == v) {
                    continue;
                }
                const TriangleCorners c = editor_.corners(t);  // points may have moved since
                if (beyond_box(editor_.point(v), c, limit) || is_needle(t)) {
                    continue;
                }
                const Vec3 foot = closest_point_on_triangle(editor_.point(v), c[0], c[1], c[2]);
                if (const double d = squared_distance(foot, editor_.point(v)); d < nearest) {
                    nearest = d;
                    which = t;
                    found = true;
                }
            }
            if (!found || snap_onto(v, which)) {
                break;
            }
        }
    }
}

void ComplexMender::flatten_thin() {
    const std::size_t count = editor_.triangles().size();  // what comes of it waits for the next round
    for (std::uint32_t t = 0; t < count; ++t) {
        if (!editor_.triangles()[t].alive) {
            continue;
        }
        const TriangleCorners c = editor_.corners(t);
        const Triangle ends = editor_.triangles()[t].corners;
        std::size_t apex = 0;
        for (std::size_t k = 1; k < 3; ++k) {
            if (distance(c[(k + 1) % 3], c[(k + 2) % 3]) > distance(c[(apex + 1) % 3], c[(apex + 2) % 3])) {
                apex = k;
            }
        }
        const std::uint32_t a = ends[(apex + 1) % 3];
        const std::uint32_t b = ends[(apex + 2) % 3];
        const double base = editor_.edge_length(a, b);
        if (2 * length(area_vector(c)) >= least_height * editor_.size(ends[apex]) * base) {
            continue;
        }
        const double along = dot(c[apex] - editor_.point(a), editor_.point(b) - editor_.point(a)) / (base * base);
        if (along < 0.1 || along > 0.9) {
            unite(ends[apex], along < 0.5 ? a : b);
        } else if (const Ties of_apex = editor_.ties_at(ends[apex]),
                   of_base = editor_.ties(editor_.edge_triangles(a, b));
                   std::ranges::includes(of_apex, of_base) || std::ranges::includes(of_base, of_apex)) {
            const Vec3 foot = editor_.point(a) + along * (editor_.point(b) - editor_.point(a));
            unite(ends[apex], editor_.split_edge(a, b, foot));
        }
    }
}

/// The one that is freer to move gives way; two that are bound to different places stay.
void ComplexMender::unite(std::uint32_t u, std::uint32_t v) {
    if (!editor_.may_join(u, v) || (editor_.classify(u).kind > editor_.classify(v).kind && editor_.may_join(v, u))) {
        std::swap(u, v);
    }
    if (editor_.may_join(u, v)) {
        editor_.merge(u, v);
    }
}

bool ComplexMender::is_needle(std::uint32_t t) const {
    const TriangleCorners c = editor_.corners(t);
    const double side = std::max({distance(c[0], c[1]), distance(c[1], c[2]), distance(c[2], c[0])});
    return length(area_vector(c)) < 1e-4 * side * side;
}

ComplexMender::Foot ComplexMender::foot_on(std::uint32_t t, const Vec3& p, double touching) const {
    const TriangleCorners c = editor_.corners(t);
    const Triangle ends = editor_.triangles()[t].corners;
    const Vec3 place = closest_point_on_triangle(p, c[0], c[1], c[2]);
    for (std::size_t k = 3; k-- > 0;) {
        if (distance(c[k], place) < touching) {
            return {c[k], {ends[k]}, editor_.ties_at(ends[k])};
        }
    }
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 along = c[(k + 1) % 3] - c[k];
        const Vec3 on_edge = c[k] + dot(place - c[k], along) / squared_length(along) * along;
        if (distance(on_edge, place) < touching) {
            const std::uint32_t next = ends[(k + 1) % 3];
            Ties ties = editor_.ties(editor_.edge_triangles(ends[k], next));
            return {ties.empty() ? place : on_edge, {ends[k], next}, std::move(ties)};
        }
    }
    return {place, {ends[0], ends[1], ends[2]}, editor_.ties({t})};
}

/// The point of the two that has more ties stays where it is. True when v is gone, or cannot be snapped.
bool ComplexMender::snap_onto(std::uint32_t v, std::uint32_t t) {
    const Foot foot = foot_on(t, editor_.point(v), 0.05 * editor_.size(v));
    const Ties ties = editor_.ties_at(v);
    const bool may_go = std::ranges::includes(foot.ties, ties);
    const bool may_stay = std::ranges::includes(ties, foot.ties);
    if (!may_go && !may_stay) {
        return true;
    }
    const bool is_corner = foot.of.size() == 1;
    const std::uint32_t into = is_corner             ? foot.of[0]
                               : foot.of.size() == 2 ? editor_.split_edge(foot.of[0], foot.of[1], foot.place)
                                                     : editor_.split_triangle(t, foot.place);
    const PointKind kind = editor_.classify(v).kind;
    if (!may_stay || (may_go && is_corner && editor_.classify(into).kind > kind)) {
        editor_.merge(v, into);
        return true;
    }
    if (ties.empty() && kind == PointKind::interior && !is_corner) {
        editor_.move(v, 0.5 * (editor_.point(v) + foot.place));
    }
    editor_.merge(into, v);
    return false;
}

void ComplexMender::open_wedges() {
    for (const auto& [u, v] : editor_.edges()) {
        const std::vector<std::uint32_t> of_edge = editor_.edge_triangles(u, v);
        if (of_edge.size() < 2 || !editor_.awake(u) || !editor_.awake(v)) {
            continue;
        }
        for (std::size_t j = 1; j < of_edge.size(); ++j) {
            for (std::size_t i = 0; i < j; ++i) {
                turn_apart(wing(of_edge[i], u, v), wing(of_edge[j], u, v));
            }
        }
    }
}

void ComplexMender::turn_apart(const Wing& one, const Wing& other) {
    constexpr double ample = 1.05;       // what is just enough would be too little after rounding
    constexpr double coinciding = 1e-6;  // no telling which way is apart
    const double angle = std::atan2(length(cross(one.away, other.away)), dot(one.away, other.away));
    if (angle >= least_wedge || angle < coinciding) {
        return;
    }
    const auto is_free = [&](std::uint32_t v) {
        return editor_.classify(v).kind == PointKind::interior && editor_.ties_at(v).empty();
    };
    const bool one_moves = is_free(one.apex);
    const bool other_moves = is_free(other.apex);
    const double turn = (ample * least_wedge - angle) / (one_moves && other_moves ? 2 : 1);
    const auto move = [&](const Wing& wing, const Wing& from) {
        const Vec3 apart = unit(dot(wing.away, from.away) * wing.away - from.away);
        const Vec3 to = wing.foot + wing.height * (std::cos(turn) * wing.away + std::sin(turn) * apart);
        if (editor_.stays_sound(wing.apex, to)) {
            editor_.move(wing.apex, to);
        }
    };
    if (one_moves) {
        move(one, other);
    }
    if (other_moves) {
        move(other, one);
    }
}

ComplexMender::Wing ComplexMender::wing(std::uint32_t t, std::uint32_t u, std::uint32_t v) const {
    const Vec3 way = unit(editor_.point(v) - editor_.point(u));
    const Triangle& ends = editor_.triangles()[t].corners;
    const auto apex = *std::ranges::find_if(ends, [&](std::uint32_t w) { return w != u && w != v; });
    const Vec3 to = editor_.point(apex) - editor_.point(u);
    const Vec3 across = to - dot(to, way) * way;
    return {apex, unit(across), editor_.point(u) + dot(to, way) * way, length(across)};
}

void ComplexMender::drop_flaps() {
    for (bool any = true; any;) {
        any = false;
        for (std::uint32_t t = 0; t < editor_.triangles().size(); ++t) {
            if (editor_.triangles()[t].alive && is_flap(t)) {
                editor_.remove_triangle(t);
                any = true;
            }
        }
    }
}

bool ComplexMender::is_flap(std::uint32_t t) const {
    const Triangle& ends = editor_.triangles()[t].corners;
    bool hangs = false;
    bool lies_on_another = false;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t u = ends[k];
        const std::uint32_t v = ends[(k + 1) % 3];
        const std::vector<std::uint32_t> of_edge = editor_.edge_triangles(u, v);
        hangs = hangs || of_edge.size() == 1;
        lies_on_another = lies_on_another || std::ranges::any_of(of_edge, [&](std::uint32_t other) {
                              return other != t && editor_.triangles()[other].sheet == editor_.triangles()[t].sheet &&
                                     dot(wing(t, u, v).away, wing(other, u, v).away) > std::cos(least_wedge);
                          });
    }
    return hangs && lies_on_another;
}

}  // namespace terratet
