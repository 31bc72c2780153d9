// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/refine/box_faces.hpp"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <cmath>
#include <compare>
#include <set>

namespace terratet {

namespace {

using Planar = CGAL::Delaunay_triangulation_2<CGAL::Exact_predicates_inexact_constructions_kernel>;

struct Disc {
    double squared_radius = 0;
    double u = 0;
    double v = 0;

    friend auto operator<=>(const Disc&, const Disc&) = default;
};

/// A middle between two of the corners, when it is that but for rounding. So all triangles of a square have one centre,
/// the same on opposite faces: four of these that are coplanar but for rounding would make a cell without volume.
double rounded(double centre, const std::array<std::array<double, 2>, 3>& p, std::size_t axis, double radius) {
    constexpr double rounding = 1e-10;
    for (const auto& [i, j] : {std::pair{0U, 1U}, {0U, 2U}, {1U, 2U}, {0U, 0U}, {1U, 1U}, {2U, 2U}}) {
        const double middle = 0.5 * (p[i][axis] + p[j][axis]);
        if (std::abs(centre - middle) <= rounding * radius) {
            return middle;
        }
    }
    return centre;
}

/// Relative to the first corner, with the corners in lexicographic order: the same bits for the same triangle.
Disc circumscribed(Planar::Face_handle face) {
    std::array<std::array<double, 2>, 3> p{};
    for (int k = 0; k < 3; ++k) {
        p[static_cast<std::size_t>(k)] = {face->vertex(k)->point().x(), face->vertex(k)->point().y()};
    }
    std::ranges::sort(p);
    const double au = p[1][0] - p[0][0];
    const double av = p[1][1] - p[0][1];
    const double bu = p[2][0] - p[0][0];
    const double bv = p[2][1] - p[0][1];
    const double twice = 2 * (au * bv - av * bu);
    const double aa = au * au + av * av;
    const double bb = bu * bu + bv * bv;
    const double u = (bv * aa - av * bb) / twice;
    const double v = (au * bb - bu * aa) / twice;
    const double radius = std::sqrt(u * u + v * v);
    return {u * u + v * v, rounded(p[0][0] + u, p, 0, radius), rounded(p[0][1] + v, p, 1, radius)};
}

constexpr std::array<int, 2> other_axes(int axis) {
    return axis == 0 ? std::array{1, 2} : axis == 1 ? std::array{0, 2} : std::array{0, 1};
}

}  // namespace

/// One face: the Delaunay triangulation of its vertices, in its own two coordinates.
class BoxFaces::Face {
  public:
    void insert(double u, double v) {
        const auto vertex = triangulation_.insert({u, v}, hint_);
        hint_ = vertex->face();
        if (widest_ < 0) {
            return;
        }
        auto around = triangulation_.incident_faces(vertex);
        const auto first = around;
        do {
            widen(around);
        } while (++around != first);
    }

    /// The circle about the triangle that holds a point of the face; of several the widest.
    [[nodiscard]] Disc circle_at(double u, double v) const {
        Planar::Locate_type where{};
        int i = 0;
        hint_ = triangulation_.locate({u, v}, where, i, hint_);
        std::optional<Disc> widest;
        const auto consider = [&](Planar::Face_handle face) {
            if (!triangulation_.is_infinite(face)) {
                const Disc disc = circumscribed(face);
                widest = !widest || *widest < disc ? disc : *widest;
            }
        };
        if (where == Planar::VERTEX) {
            auto around = triangulation_.incident_faces(hint_->vertex(i));
            const auto first = around;
            do {
                consider(around);
            } while (++around != first);
        } else {
            consider(hint_);
            if (where != Planar::FACE) {  // on an edge, or just beyond the border
                consider(hint_->neighbor(where == Planar::EDGE ? i : hint_->index(triangulation_.infinite_vertex())));
            }
        }
        return *widest;
    }

    /// No smaller than any triangle's squared radius: triangles come and go, and the largest may be gone.
    [[nodiscard]] double widest() const {
        if (widest_ < 0) {
            widest_ = 0;
            for (auto face : triangulation_.finite_face_handles()) {
                widen(face);
            }
        }
        return widest_;
    }

  private:
    void widen(Planar::Face_handle face) const {
        if (!triangulation_.is_infinite(face)) {
            widest_ = std::max(widest_, circumscribed(face).squared_radius);
        }
    }

    Planar triangulation_;
    mutable Planar::Face_handle hint_;
    mutable double widest_ = -1;  ///< not asked for yet
};

/// One edge of the box: where its vertices are.
class BoxFaces::Edge {
  public:
    void insert(double t) {
        const auto here = places_.insert(t).first;
        if (widest_ >= 0) {
            widen(here);
            widen(std::next(here));
        }
    }

    /// No smaller than any part's squared half.
    [[nodiscard]] double widest() const {
        if (widest_ < 0) {
            widest_ = 0;
            for (auto place = places_.begin(); place != places_.end(); ++place) {
                widen(place);
            }
        }
        return widest_;
    }

    /// The ends of the part that holds t.
    [[nodiscard]] std::array<double, 2> part_at(double t) const {
        auto upper = places_.upper_bound(t);
        upper = upper == places_.end() ? std::prev(upper) : upper == places_.begin() ? std::next(upper) : upper;
        return {*std::prev(upper), *upper};
    }

  private:
    void widen(std::set<double>::const_iterator upper) const {
        if (upper != places_.begin() && upper != places_.end()) {
            const double half = (*upper - *std::prev(upper)) / 2;
            widest_ = std::max(widest_, half * half);
        }
    }

    std::set<double> places_;
    mutable double widest_ = -1;  ///< not asked for yet
};

BoxFaces::BoxFaces(const Box3& hull)
    : hull_(hull), faces_(std::make_unique<std::array<Face, 6>>()), edges_(std::make_unique<std::array<Edge, 12>>()) {}
BoxFaces::~BoxFaces() = default;
BoxFaces::BoxFaces(BoxFaces&&) noexcept = default;

namespace {

std::size_t face_number(int axis, bool upper) {
    return static_cast<std::size_t>(2 * axis + (upper ? 1 : 0));
}

/// Of the edge along `axis`, on the lower or upper side of either other axis.
std::size_t edge_number(int axis, bool upper_first, bool upper_second) {
    return static_cast<std::size_t>(4 * axis + (upper_first ? 2 : 0) + (upper_second ? 1 : 0));
}

}  // namespace

bool BoxFaces::is_on_boundary(const Vec3& p) const {
    return p.x == hull_.lo.x || p.x == hull_.hi.x || p.y == hull_.lo.y || p.y == hull_.hi.y || p.z == hull_.lo.z ||
           p.z == hull_.hi.z;
}

void BoxFaces::insert(const Vec3& p) {
    if (!is_on_boundary(p)) {
        return;
    }
    reach_ = 0;  // a new triangle may be wider
    for (int axis = 0; axis < 3; ++axis) {
        const auto [u, v] = other_axes(axis);
        for (const bool upper : {false, true}) {
            if (p[axis] == (upper ? hull_.hi : hull_.lo)[axis]) {
                (*faces_)[face_number(axis, upper)].insert(p[u], p[v]);
            }
        }
        const bool on_edge =
            (p[u] == hull_.lo[u] || p[u] == hull_.hi[u]) && (p[v] == hull_.lo[v] || p[v] == hull_.hi[v]);
        if (on_edge) {
            (*edges_)[edge_number(axis, p[u] == hull_.hi[u], p[v] == hull_.hi[v])].insert(p[axis]);
        }
    }
}

/// Where to split, and the squared radius of the ball that calls for it.
struct BoxFaces::Split {
    Vec3 place;
    double squared_radius;
};

/// \pre the place lies in the box, or beyond no face but those that the edge joins.
std::optional<BoxFaces::Split> BoxFaces::split_of_edge(const Vec3& place, int along, bool upper_u, bool upper_v) const {
    const auto [u, v] = other_axes(along);
    const Edge& edge = (*edges_)[edge_number(along, upper_u, upper_v)];
    Vec3 middle;
    middle[u] = (upper_u ? hull_.hi : hull_.lo)[u];
    middle[v] = (upper_v ? hull_.hi : hull_.lo)[v];
    const bool beyond = (upper_u ? place[u] >= middle[u] : place[u] <= middle[u]) &&
                        (upper_v ? place[v] >= middle[v] : place[v] <= middle[v]);
    const double du = place[u] - middle[u];
    const double dv = place[v] - middle[v];
    if (!beyond && du * du + dv * dv >= edge.widest()) {
        return std::nullopt;
    }
    const auto [from, to] = edge.part_at(std::clamp(place[along], hull_.lo[along], hull_.hi[along]));
    const double half = (to - from) / 2;
    middle[along] = from + half;
    return beyond || squared_distance(place, middle) < half * half ? std::optional(Split{middle, half * half})
                                                                   : std::nullopt;
}

/// The widest of the edges' parts.
std::optional<BoxFaces::Split> BoxFaces::split_of_edges(const Vec3& place) const {
    std::optional<Split> widest;
    for (int along = 0; along < 3; ++along) {
        for (const auto& [upper_u, upper_v] : {std::pair{false, false}, {false, true}, {true, false}, {true, true}}) {
            const auto split = split_of_edge(place, along, upper_u, upper_v);
            widest = split && (!widest || split->squared_radius > widest->squared_radius) ? split : widest;
        }
    }
    return widest;
}

std::optional<BoxFaces::Split> BoxFaces::split_of_face(const Vec3& place, int axis, bool upper) const {
    const Face& face = (*faces_)[face_number(axis, upper)];
    const double depth = upper ? hull_.hi[axis] - place[axis] : place[axis] - hull_.lo[axis];
    if (depth >= 0 && depth * depth >= face.widest()) {
        return std::nullopt;
    }
    const auto [u, v] = other_axes(axis);
    const Vec3 within = hull_.clamped(place);
    const Disc disc = face.circle_at(within[u], within[v]);
    Vec3 centre;
    centre[axis] = (upper ? hull_.hi : hull_.lo)[axis];
    centre[u] = disc.u;
    centre[v] = disc.v;
    return depth < 0 || squared_distance(place, centre) < disc.squared_radius
               ? std::optional(Split{centre, disc.squared_radius})
               : std::nullopt;
}

/// Farther inside than any ball about the boundary reaches.
bool BoxFaces::is_deep(const Vec3& place) const {
    if (!(reach_ > 0)) {
        for (const Face& face : *faces_) {
            reach_ = std::max(reach_, std::sqrt(face.widest()));
        }
        for (const Edge& edge : *edges_) {
            reach_ = std::max(reach_, std::sqrt(edge.widest()));
        }
    }
    bool deep = true;
    for (int axis = 0; axis < 3; ++axis) {
        deep = deep && place[axis] - hull_.lo[axis] > reach_ && hull_.hi[axis] - place[axis] > reach_;
    }
    return deep;
}

std::optional<Vec3> BoxFaces::split_for(const Vec3& place) const {
    if (is_deep(place)) {
        return std::nullopt;
    }
    if (const auto edge = split_of_edges(place)) {
        return edge->place;
    }
    std::optional<Split> widest;
    for (int axis = 0; axis < 3; ++axis) {
        for (const bool upper : {false, true}) {
            const auto split = split_of_face(place, axis, upper);
            widest = split && (!widest || split->squared_radius > widest->squared_radius) ? split : widest;
        }
    }
    if (!widest) {
        return std::nullopt;
    }
    const auto edge = split_of_edges(widest->place);  // in whose ball, or beyond which, the triangle's centre lies
    return edge ? edge->place : widest->place;
}

}  // namespace terratet
