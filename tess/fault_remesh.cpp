// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/fault_remesh.hpp"

#include <CGAL/AABB_segment_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <numeric>

#include "tess/complex_editor.hpp"
#include "tess/point_grid.hpp"

namespace terratet {
namespace {

constexpr double longest = 4.0 / 3;   ///< of the wanted edge length: split above
constexpr double shortest = 0.7;      ///< collapse below
constexpr double thin = 0.05;         ///< height of a triangle in edge lengths: taken out below
constexpr double corner_turn = 1.05;  ///< radians: rims and junctions that turn more keep a node there
constexpr double least_wedge = 10 * std::numbers::pi / 180;
constexpr int rounds = 6;
constexpr int later_rounds = 2;  ///< from triangles that suit all but the newest wishes
constexpr int repairs = 8;
constexpr int patience = 2;  ///< repairs that may bring nothing

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Kernel::Point_3 point(const Vec3& p) {
    return {p.x, p.y, p.z};
}

Vec3 vec(const Kernel::Point_3& p) {
    return {p.x(), p.y(), p.z()};
}

/// Nearest points on a set of triangles or segments. Not movable: the tree points into them.
template <class Piece, template <class, class, class> class PrimitiveOf>
class Target {
  public:
    void add(const Piece& piece) {
        if (!piece.is_degenerate()) {
            pieces_.push_back(piece);
        }
    }
    void build() {
        tree_.insert(pieces_.cbegin(), pieces_.cend());
        if (!pieces_.empty()) {
            tree_.build();
            tree_.accelerate_distance_queries();
        }
    }
    [[nodiscard]] Vec3 nearest(const Vec3& p) const { return pieces_.empty() ? p : vec(tree_.closest_point(point(p))); }

  private:
    using Iterator = typename std::vector<Piece>::const_iterator;
    using Primitive = PrimitiveOf<Kernel, Iterator, CGAL::Tag_false>;
    std::vector<Piece> pieces_;
    CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>> tree_;
};

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

using PatchTarget = Target<Kernel::Triangle_3, CGAL::AABB_triangle_primitive>;
using LineTarget = Target<Kernel::Segment_3, CGAL::AABB_segment_primitive>;

}  // namespace

class FaultRemesher::Impl {
  public:
    Impl(const FaultComplex& complex, const SizeField& sizes, double snap, std::span<const char> bounds)
        : numbering_(patches(complex, EdgeTable(complex.triangles))),
          editor_(complex, numbering_, sizes, bounds),
          sizes_(sizes),
          snap_(snap) {
        set_targets(complex);
        keep_corners(complex);
    }

    Result pass() {
        const bool first = passes_++ == 0;
        awake_.assign(editor_.point_count(), first ? 1 : 0);
        if (!first) {
            for (const std::uint32_t v : editor_.update_sizes()) {
                awake_[v] = 1;
            }
            wake_neighbours(3);
        }
        for (int round = 0; round < (first ? rounds : later_rounds); ++round) {
            split_long();
            collapse_short();
            if (!first || round > 0) {
                flatten_thin();
                snap_close(snap_);
                collapse_short();
            }
            flip_all(4);
            for (int step = 0; step < 3; ++step) {
                smooth(0.7);
            }
        }
        for (int step = 0; step < (first ? 6 : 2); ++step) {
            flip_all(1);
            smooth(0.5);
        }
        flip_all(6);
        return settle();
    }

    void keep(const std::vector<char>& active) {
        for (std::uint32_t t = 0; t < editor_.triangles().size(); ++t) {
            if (editor_.triangles()[t].alive && active[editor_.triangles()[t].sheet] == 0) {
                editor_.remove_triangle(t);
            }
        }
    }

  private:
    using Ties = ComplexEditor::Ties;

    void set_targets(const FaultComplex& complex) {
        for (std::uint32_t k = 0; k < numbering_.count; ++k) {
            surfaces_.push_back(std::make_unique<PatchTarget>());
        }
        for (std::uint32_t t = 0; t < complex.triangles.size(); ++t) {
            const TriangleCorners c = corners(complex, t);
            surfaces_[numbering_.of_triangle[t]]->add({point(c[0]), point(c[1]), point(c[2])});
        }
        for (const auto& surface : surfaces_) {
            surface->build();
        }
        const EdgeTable edges(complex.triangles);
        for (const EdgeTable::Edge& e : edges.edges()) {
            if (!is_smooth(complex, edges.triangles(e))) {
                const auto of_edge = edges.triangles(e);
                lines_[editor_.ties({of_edge.begin(), of_edge.end()})].add(
                    {point(complex.points[e.a]), point(complex.points[e.b])});
            }
        }
        for (auto& [ties, lines] : lines_) {
            lines.build();
        }
    }

    /// The sharpest turns of rims and junctions first, and none near another, or a ragged rim would stay as fine as it
    /// came.
    void keep_corners(const FaultComplex& complex) {
        std::vector<std::pair<double, std::uint32_t>> turns;
        for (std::uint32_t v = 0; v < complex.points.size(); ++v) {
            const auto classified = editor_.classify(v);
            if (classified.kind == PointKind::chain) {
                const Vec3 before = unit(complex.points[v] - complex.points[classified.along[0]]);
                const Vec3 after = unit(complex.points[classified.along[1]] - complex.points[v]);
                if (dot(before, after) < std::cos(corner_turn)) {
                    turns.emplace_back(dot(before, after), v);
                }
            }
        }
        std::ranges::sort(turns);
        PointGrid kept(sizes_.spacing());
        for (const auto& [straightness, v] : turns) {
            if (!kept.any_within(editor_.point(v), shortest * editor_.size(v))) {
                kept.insert(editor_.point(v));
                editor_.fix(v);
            }
        }
    }

    /// Only points that are awake move, flip their edges and look for what they nearly touch: after the first pass
    /// those where something is to be done, and new ones.
    [[nodiscard]] bool awake(std::uint32_t v) const { return v >= awake_.size() || awake_[v] != 0; }

    void wake_neighbours(int rings) {
        for (int ring = 0; ring < rings; ++ring) {
            const std::vector<char> before = awake_;
            for (const auto& triangle : editor_.triangles()) {
                const auto is_awake = [&](std::uint32_t v) { return v >= before.size() || before[v] != 0; };
                if (triangle.alive && std::ranges::any_of(triangle.corners, is_awake)) {
                    for (const std::uint32_t v : triangle.corners) {
                        if (v < awake_.size()) {
                            awake_[v] = 1;
                        }
                    }
                }
            }
        }
    }

    [[nodiscard]] Vec3 on_surface(std::uint32_t patch, const Vec3& p) const { return surfaces_[patch]->nearest(p); }

    /// On a line on all these bounds, if there is one.
    [[nodiscard]] Vec3 on_line(const Ties& ties, const Vec3& p) const {
        const auto lines = lines_.find(ties);
        return lines == lines_.end() ? p : lines->second.nearest(p);
    }

    void split_long() {
        for (bool any = true; any;) {
            any = false;
            auto edges = editor_.edges();
            sort_by_length(edges);
            for (auto edge = edges.rbegin(); edge != edges.rend(); ++edge) {
                const auto [u, v] = *edge;
                const double wanted = editor_.target(u, v);
                const std::vector<std::uint32_t> of_edge = editor_.edge_triangles(u, v);
                if (of_edge.empty() || editor_.edge_length(u, v) <= longest * wanted) {
                    continue;
                }
                const Vec3 middle = 0.5 * (editor_.point(u) + editor_.point(v));
                Vec3 at = editor_.is_feature(of_edge) ? on_line(editor_.ties(of_edge), middle)
                                                      : on_surface(editor_.triangles()[of_edge[0]].patch, middle);
                if (distance(at, middle) > 0.2 * wanted) {
                    at = middle;
                }
                editor_.split_edge(u, v, at);
                any = true;
            }
        }
    }

    void sort_by_length(std::vector<std::array<std::uint32_t, 2>>& edges) const {
        std::vector<std::pair<double, std::array<std::uint32_t, 2>>> keyed;
        keyed.reserve(edges.size());
        for (const auto& e : edges) {
            keyed.emplace_back(editor_.edge_length(e[0], e[1]) / editor_.target(e[0], e[1]), e);
        }
        std::ranges::sort(keyed);
        for (std::size_t i = 0; i < edges.size(); ++i) {
            edges[i] = keyed[i].second;
        }
    }

    void collapse_short() {
        for (int pass = 0; pass < 4; ++pass) {
            auto edges = editor_.edges();
            std::erase_if(edges, [&](const auto& e) {
                return editor_.edge_length(e[0], e[1]) > shortest * editor_.target(e[0], e[1]);
            });
            sort_by_length(edges);
            bool any = false;
            for (auto [u, v] : edges) {
                if (!editor_.has_edge(u, v) || editor_.edge_length(u, v) > shortest * editor_.target(u, v)) {
                    continue;
                }
                if (editor_.classify(u).kind > editor_.classify(v).kind) {
                    std::swap(u, v);
                }
                const bool done = editor_.collapse(u, v) || editor_.collapse(v, u);
                any = any || done;
            }
            if (!any) {
                return;
            }
        }
    }

    void flip_all(int passes) {
        for (int pass = 0; pass < passes; ++pass) {
            bool any = false;
            for (const auto& [u, v] : editor_.edges()) {
                any = ((awake(u) || awake(v)) && editor_.flip(u, v)) || any;
            }
            if (!any) {
                return;
            }
        }
    }

    /// Centroidal for triangles inside a patch, halfway between neighbours along a chain.
    void smooth(double share) {
        for (std::uint32_t v = 0; v < editor_.point_count(); ++v) {
            if (!awake(v) || editor_.star(v).empty()) {
                continue;
            }
            const auto classified = editor_.classify(v);
            if (classified.kind == PointKind::node) {
                continue;
            }
            const Vec3 to =
                classified.kind == PointKind::chain ? evened(v, classified.along, share) : centred(v, share);
            if (stays_sound(v, to)) {
                editor_.move(v, to);
            }
        }
    }

    [[nodiscard]] Vec3 evened(std::uint32_t v, const std::vector<std::uint32_t>& along, double share) const {
        const double one = editor_.edge_length(v, along[0]) / editor_.target(v, along[0]);
        const double other = editor_.edge_length(v, along[1]) / editor_.target(v, along[1]);
        const Vec3& farther = editor_.point(one > other ? along[0] : along[1]);
        const double step = 0.5 * std::abs(one - other) * editor_.size(v) * share;
        return on_line(editor_.ties_at(v), editor_.point(v) + step * unit(farther - editor_.point(v)));
    }

    [[nodiscard]] Vec3 centred(std::uint32_t v, double share) const {
        Vec3 sum;
        double total = 0;
        for (const std::uint32_t t : editor_.star(v)) {
            const TriangleCorners c = editor_.corners(t);
            const Vec3 area = area_vector(c);
            const double weight = length(area);
            const Vec3 middle = centroid(c);
            Vec3 aim = middle;
            if (weight > 0) {  // between centroid and circumcentre
                const Vec3 ab = c[1] - c[0];
                const Vec3 ac = c[2] - c[0];
                const Vec3 normal = cross(ab, ac);
                const Vec3 circumcenter =
                    c[0] + (squared_length(ac) * cross(normal, ab) + squared_length(ab) * cross(ac, normal)) /
                               (2 * squared_length(normal));
                if (squared_distance(circumcenter, middle) < 0.3 * editor_.size(v) * editor_.size(v)) {
                    aim = 0.5 * (middle + circumcenter);
                }
            }
            sum = sum + weight * (aim - editor_.point(v));
            total += weight;
        }
        if (!(total > 0)) {
            return editor_.point(v);
        }
        const std::uint32_t patch = editor_.triangles()[editor_.star(v).front()].patch;
        return on_surface(patch, editor_.point(v) + (share / total) * sum);
    }

    [[nodiscard]] bool stays_sound(std::uint32_t v, const Vec3& to) const {
        return std::ranges::all_of(editor_.star(v), [&](std::uint32_t t) {
            const TriangleCorners before = editor_.corners(t);
            TriangleCorners after = before;
            for (std::size_t k = 0; k < 3; ++k) {
                if (editor_.triangles()[t].corners[k] == v) {
                    after[k] = to;
                }
            }
            const Vec3 was = area_vector(before);
            const Vec3 is = area_vector(after);
            return dot(unit(was), unit(is)) >= 0.7 && squared_length(is) >= 0.04 * squared_length(was);
        });
    }

    struct Nearby {
        std::vector<std::uint32_t> triangles;
        std::vector<std::size_t> begin;  ///< by point

        [[nodiscard]] std::span<const std::uint32_t> of(std::uint32_t v) const {
            return {triangles.data() + begin[v], begin[v + 1] - begin[v]};
        }
    };

    /// The triangles whose boxes come nearer to a point than `share` of its size, but for its own: boxes of all sizes
    /// are no worse than boxes of one.
    [[nodiscard]] Nearby triangles_near_points(double share) const {
        using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::uint32_t>;
        std::vector<Box> around;
        for (std::uint32_t v = 0; v < editor_.point_count(); ++v) {
            if (awake(v) && !editor_.star(v).empty()) {
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
                boxes.emplace_back(point(c[0]).bbox() + point(c[1]).bbox() + point(c[2]).bbox(), t);
            }
        }
        std::vector<std::array<std::uint32_t, 2>> pairs;
        CGAL::box_intersection_d(around.begin(), around.end(), boxes.begin(), boxes.end(),
                                 [&](const Box& a, const Box& b) {
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

    /// Merges each point that comes nearer than `share` edge lengths to a triangle it is no corner of into that
    /// triangle: into a corner, a new point of an edge, or a new point inside, whichever is near.
    void snap_close(double share) {
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

    /// Takes out triangles almost without height: their long edge gets their third corner.
    void flatten_thin() {
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
            if (2 * length(area_vector(c)) >= thin * editor_.size(ends[apex]) * base) {
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
    void unite(std::uint32_t u, std::uint32_t v) {
        if (!editor_.may_join(u, v) ||
            (editor_.classify(u).kind > editor_.classify(v).kind && editor_.may_join(v, u))) {
            std::swap(u, v);
        }
        if (editor_.may_join(u, v)) {
            editor_.merge(u, v);
        }
    }

    [[nodiscard]] bool is_needle(std::uint32_t t) const {
        const TriangleCorners c = editor_.corners(t);
        const double side = std::max({distance(c[0], c[1]), distance(c[1], c[2]), distance(c[2], c[0])});
        return length(area_vector(c)) < 1e-4 * side * side;
    }

    /// Where a point snaps onto a triangle.
    struct Foot {
        Vec3 place;
        std::vector<std::uint32_t> of;  ///< a corner, the ends of an edge, or all three
        Ties ties;
    };

    [[nodiscard]] Foot foot_on(std::uint32_t t, const Vec3& p, double touching) const {
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
    bool snap_onto(std::uint32_t v, std::uint32_t t) {
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

    /// Merging may leave a triangle that lies on others of its sheet and hangs on them by some of its edges alone: a
    /// flap, which covers nothing that is not covered.
    void drop_flaps() {
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

    [[nodiscard]] bool is_flap(std::uint32_t t) const {
        const Triangle& ends = editor_.triangles()[t].corners;
        bool hangs = false;
        bool lies_on_another = false;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t u = ends[k];
            const std::uint32_t v = ends[(k + 1) % 3];
            const std::vector<std::uint32_t> of_edge = editor_.edge_triangles(u, v);
            hangs = hangs || of_edge.size() == 1;
            lies_on_another =
                lies_on_another || std::ranges::any_of(of_edge, [&](std::uint32_t other) {
                    return other != t && editor_.triangles()[other].sheet == editor_.triangles()[t].sheet &&
                           dot(away_from_edge(t, u, v), away_from_edge(other, u, v)) > std::cos(least_wedge);
                });
        }
        return hangs && lies_on_another;
    }

    /// Unit vector in the triangle's plane, square to its edge uv.
    [[nodiscard]] Vec3 away_from_edge(std::uint32_t t, std::uint32_t u, std::uint32_t v) const {
        const Vec3 way = unit(editor_.point(v) - editor_.point(u));
        const Triangle& ends = editor_.triangles()[t].corners;
        const auto apex = *std::ranges::find_if(ends, [&](std::uint32_t w) { return w != u && w != v; });
        const Vec3 to = editor_.point(apex) - editor_.point(u);
        return unit(to - dot(to, way) * way);
    }

    /// Verifies, and repairs by snapping from farther and farther; keeps the best.
    Result settle() {
        Result best;
        std::size_t fewest = std::numeric_limits<std::size_t>::max();
        int last_gain = 0;
        for (int repair = 0; repair <= repairs; ++repair) {
            drop_flaps();
            editor_.join_bounds();
            FaultComplex now = editor_.result();
            restore_sense(now);  // of triangles that coincided one stayed, whichever way it was turned
            auto crossings = crossing_triangles(now);
            const Trouble sharp = sharp_wedges(now);
            const Trouble flat = thin_triangles(now, sizes_);
            const std::size_t faults = 1000 * crossings.size() + sharp.count + flat.count;
            std::vector<Vec3> places = sharp.places;
            places.insert(places.end(), flat.places.begin(), flat.places.end());
            for (const auto& pair : crossings) {
                for (const std::uint32_t t : pair) {
                    const TriangleCorners c = corners(now, t);
                    places.insert(places.end(), c.begin(), c.end());
                }
            }
            if (faults < fewest) {
                fewest = faults;
                last_gain = repair;
                best = {std::move(now), std::move(crossings)};
            }
            if (fewest == 0 || repair == repairs || repair >= last_gain + patience || snap_ <= 0) {
                break;
            }
            wake_only(std::move(places));
            flatten_thin();
            snap_close(std::min(snap_ + 0.02 * (repair + 1), 0.3));
            collapse_short();
            flip_all(3);
            if (repair % 2 == 1) {
                smooth(0.3);
            }
        }
        return best;
    }

    /// What is wrong with a result, and the points it is wrong about.
    struct Trouble {
        std::size_t count = 0;
        std::vector<Vec3> places;
    };

    static Trouble thin_triangles(const FaultComplex& complex, const SizeField& sizes) {
        Trouble trouble;
        for (std::uint32_t t = 0; t < complex.triangles.size(); ++t) {
            const TriangleCorners c = corners(complex, t);
            const double side = std::max({distance(c[0], c[1]), distance(c[1], c[2]), distance(c[2], c[0])});
            if (2 * length(area_vector(c)) < thin * sizes.at(c[0]) * side) {
                ++trouble.count;
                trouble.places.insert(trouble.places.end(), c.begin(), c.end());
            }
        }
        return trouble;
    }

    static Trouble sharp_wedges(const FaultComplex& complex) {
        Trouble trouble;
        const EdgeTable edges(complex.triangles);
        for (const EdgeTable::Edge& e : edges.edges()) {
            const auto of_edge = edges.triangles(e);
            if (wedge_angle(complex, of_edge, e.a, e.b) < least_wedge) {
                ++trouble.count;
                for (const std::uint32_t t : of_edge) {
                    const TriangleCorners c = corners(complex, t);
                    trouble.places.insert(trouble.places.end(), c.begin(), c.end());
                }
            }
        }
        return trouble;
    }

    void wake_only(std::vector<Vec3> places) {
        std::ranges::sort(places);
        awake_.assign(editor_.point_count(), 0);
        for (std::uint32_t v = 0; v < awake_.size(); ++v) {
            awake_[v] = std::ranges::binary_search(places, editor_.point(v)) ? 1 : 0;
        }
        wake_neighbours(2);
    }

    Patches numbering_;
    ComplexEditor editor_;
    const SizeField& sizes_;
    double snap_;
    int passes_ = 0;
    std::vector<char> awake_;
    std::vector<std::unique_ptr<PatchTarget>> surfaces_;
    std::map<Ties, LineTarget> lines_;  ///< rims and junctions, by the bounds they are on
};

FaultRemesher::FaultRemesher(const FaultComplex& complex, const SizeField& sizes, double snap,
                             std::span<const char> bounds)
    : impl_(std::make_unique<Impl>(complex, sizes, snap, bounds)) {}

FaultRemesher::~FaultRemesher() = default;

FaultRemesher::Result FaultRemesher::pass() {
    return impl_->pass();
}

void FaultRemesher::keep(const std::vector<char>& active) {
    impl_->keep(active);
}

}  // namespace terratet
