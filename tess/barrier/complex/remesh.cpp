// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/barrier/complex/remesh.hpp"

#include <CGAL/AABB_segment_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>

#include "tess/barrier/complex/complex_editor.hpp"
#include "tess/barrier/complex/complex_mender.hpp"
#include "tess/base/point_grid.hpp"

namespace terratet {
namespace {

constexpr double longest = 4.0 / 3;   ///< of the wanted edge length: split above
constexpr double shortest = 0.7;      ///< contract below
constexpr double corner_turn = 1.05;  ///< radians: rims and junctions that turn more keep a node there
constexpr int rounds = 6;
constexpr int later_rounds = 2;  ///< from triangles that suit all but the newest wishes
constexpr int repairs = 8;
constexpr int patience = 2;  ///< repairs that may bring nothing
constexpr int openings = 3;

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

using PatchTarget = Target<Kernel::Triangle_3, CGAL::AABB_triangle_primitive>;
using LineTarget = Target<Kernel::Segment_3, CGAL::AABB_segment_primitive>;

}  // namespace

class SheetRemesher::Impl {
  public:
    Impl(const SheetComplex& complex, const SizeField& sizes, double snap, Contract later, std::span<const char> bounds)
        : numbering_(patches(complex, EdgeTable(complex.triangles))),
          editor_(complex, numbering_, sizes, bounds),
          mender_(editor_),
          sizes_(sizes),
          snap_(snap),
          later_(later) {
        set_targets(complex);
        keep_corners(complex);
    }

    Result pass(const Poll& poll) {
        poll_ = poll;
        const bool first = passes_++ == 0;
        if (!first) {
            editor_.wake_only(editor_.update_sizes());
            editor_.wake_neighbours(3);
        }
        for (int round = 0; round < (first ? rounds : later_rounds); ++round) {
            split_long();
            contract_short(later_);
            if (!first || round > 0) {
                mender_.flatten_thin();
                mender_.snap_close(snap_);
                contract_short(later_);
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

    void set_targets(const SheetComplex& complex) {
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
    void keep_corners(const SheetComplex& complex) {
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

    [[nodiscard]] Vec3 on_surface(std::uint32_t patch, const Vec3& p) const { return surfaces_[patch]->nearest(p); }

    /// On a line on all these bounds, if there is one.
    [[nodiscard]] Vec3 on_line(const Ties& ties, const Vec3& p) const {
        const auto lines = lines_.find(ties);
        return lines == lines_.end() ? p : lines->second.nearest(p);
    }

    void split_long() {
        for (bool any = true; any;) {
            ask(poll_);
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

    void contract_short(Contract where = Contract::where_changed) {
        for (int pass = 0; pass < 4; ++pass) {
            ask(poll_);
            auto edges = editor_.edges();
            std::erase_if(edges, [&](const auto& e) {
                return (where == Contract::where_changed && !editor_.awake(e[0]) && !editor_.awake(e[1])) ||
                       editor_.edge_length(e[0], e[1]) > shortest * editor_.target(e[0], e[1]);
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
                const bool done = editor_.contract(u, v) || editor_.contract(v, u);
                any = any || done;
            }
            if (!any) {
                return;
            }
        }
    }

    void flip_all(int passes) {
        for (int pass = 0; pass < passes; ++pass) {
            ask(poll_);
            bool any = false;
            for (const auto& [u, v] : editor_.edges()) {
                any = ((editor_.awake(u) || editor_.awake(v)) && editor_.flip(u, v)) || any;
            }
            if (!any) {
                return;
            }
        }
    }

    /// Centroidal for triangles inside a patch, halfway between neighbours along a chain.
    void smooth(double share) {
        ask(poll_);
        for (std::uint32_t v = 0; v < editor_.point_count(); ++v) {
            if (!editor_.awake(v) || editor_.star(v).empty()) {
                continue;
            }
            const auto classified = editor_.classify(v);
            if (classified.kind == PointKind::node) {
                continue;
            }
            const Vec3 to =
                classified.kind == PointKind::chain ? evened(v, classified.along, share) : centred(v, share);
            if (editor_.stays_sound(v, to)) {
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

    /// Verifies, and repairs by snapping from farther and farther as long as that helps; then by opening what could
    /// not be zipped. Keeps the best.
    Result settle() {
        Best best;
        int last_gain = 0;
        for (int repair = 0; assess(best) && repair < repairs; ++repair) {
            last_gain = best.is_latest ? repair : last_gain;
            if (repair >= last_gain + patience || snap_ <= 0) {
                break;
            }
            mender_.flatten_thin();
            mender_.snap_close(std::min(snap_ + 0.02 * (repair + 1), 0.3));
            contract_short();
            flip_all(3);
            if (repair % 2 == 1) {
                smooth(0.3);
            }
        }
        for (int opening = 0; best.barriers > 0 && opening < openings; ++opening) {
            mender_.open_wedges();
            assess(best);
        }
        return std::move(best.result);
    }

    struct Best {
        Result result;
        std::size_t barriers = std::numeric_limits<std::size_t>::max();
        bool is_latest = false;  ///< or are its triangles others than the editor's?
    };

    /// Compares the triangles as they are with the best, and wakes the points that something is wrong about, if any.
    bool assess(Best& best) {
        ask(poll_);
        mender_.drop_flaps();
        editor_.join_bounds();
        SheetComplex now = editor_.result();
        restore_sense(now);  // of triangles that coincided one stayed, whichever way it was turned
        auto crossings = crossing_triangles(now);
        const Trouble sharp = sharp_wedges(now);
        const Trouble flat = thin_triangles(now, sizes_);
        const std::size_t barriers = 1000 * crossings.size() + sharp.count + flat.count;
        std::vector<Vec3> places = sharp.places;
        places.insert(places.end(), flat.places.begin(), flat.places.end());
        for (const auto& pair : crossings) {
            for (const std::uint32_t t : pair) {
                const TriangleCorners c = corners(now, t);
                places.insert(places.end(), c.begin(), c.end());
            }
        }
        best.is_latest = barriers < best.barriers;
        if (best.is_latest) {
            best.barriers = barriers;
            best.result = {std::move(now), std::move(crossings)};
        }
        wake_about(std::move(places));
        return barriers > 0;
    }

    /// What is wrong with a result, and the points it is wrong about.
    struct Trouble {
        std::size_t count = 0;
        std::vector<Vec3> places;
    };

    static Trouble thin_triangles(const SheetComplex& complex, const SizeField& sizes) {
        Trouble trouble;
        for (std::uint32_t t = 0; t < complex.triangles.size(); ++t) {
            const TriangleCorners c = corners(complex, t);
            const double side = std::max({distance(c[0], c[1]), distance(c[1], c[2]), distance(c[2], c[0])});
            if (2 * length(area_vector(c)) < least_height * sizes.at(c[0]) * side) {
                ++trouble.count;
                trouble.places.insert(trouble.places.end(), c.begin(), c.end());
            }
        }
        return trouble;
    }

    static Trouble sharp_wedges(const SheetComplex& complex) {
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

    void wake_about(std::vector<Vec3> places) {
        std::ranges::sort(places);
        std::vector<std::uint32_t> points;
        for (std::uint32_t v = 0; v < editor_.point_count(); ++v) {
            if (std::ranges::binary_search(places, editor_.point(v))) {
                points.push_back(v);
            }
        }
        editor_.wake_only(points);
        editor_.wake_neighbours(2);
    }

    Patches numbering_;
    ComplexEditor editor_;
    ComplexMender mender_;
    const SizeField& sizes_;
    double snap_;
    Contract later_;
    int passes_ = 0;
    Poll poll_;
    std::vector<std::unique_ptr<PatchTarget>> surfaces_;
    std::map<Ties, LineTarget> lines_;  ///< rims and junctions, by the bounds they are on
};

SheetRemesher::SheetRemesher(const SheetComplex& complex, const SizeField& sizes, double snap, Contract later,
                             std::span<const char> bounds)
    : impl_(std::make_unique<Impl>(complex, sizes, snap, later, bounds)) {}

SheetRemesher::~SheetRemesher() = default;

SheetRemesher::Result SheetRemesher::pass(const Poll& poll) {
    return impl_->pass(poll);
}

void SheetRemesher::keep(const std::vector<char>& active) {
    impl_->keep(active);
}

}  // namespace terratet
