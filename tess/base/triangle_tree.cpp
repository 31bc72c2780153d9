// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/base/triangle_tree.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "tess/base/box_tree.hpp"
#include "tess/base/sight.hpp"
#include "tess/base/slab.hpp"

namespace terratet {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Corners = std::array<Vec3, 3>;

constexpr std::uint32_t leaf_size = 2;

Kernel::Point_3 point(const Vec3& p) {
    return {p.x, p.y, p.z};
}

Kernel::Triangle_3 triangle(const Corners& c) {
    return {point(c[0]), point(c[1]), point(c[2])};
}

double squared_distance_to(const Box3& box, const Vec3& p) {
    return squared_distance(p, box.clamped(p));
}

/// \pre not empty
Slab slab_of(const std::vector<Corners>& triangles) {
    Vec3 normal;
    for (const auto& [a, b, c] : triangles) {
        normal = normal + cross(b - a, c - a);
    }
    Slab slab(triangles.front()[0], normal);
    for (const auto& corners : triangles) {
        for (const Vec3& p : corners) {
            slab.extend(p);
        }
    }
    return slab;
}

std::vector<Corners> with_area(std::span<const Vec3> points, std::span<const Triangle> given) {
    std::vector<Corners> triangles;
    for (const Triangle& t : given) {
        const Corners corners{points[t[0]], points[t[1]], points[t[2]]};
        if (!triangle(corners).is_degenerate()) {  // has no inside, and CGAL's predicates ask for one
            triangles.push_back(corners);
        }
    }
    return triangles;
}

}  // namespace

struct TriangleTree::Impl {
    explicit Impl(std::vector<Corners> all)
        : slab(slab_of(all)),
          tree(
              std::move(all), leaf_size,
              [](auto& node, const Corners& c) {
                  for (const Vec3& p : c) {
                      node.box.extend(p);
                  }
              },
              [](const Corners& c, int axis) { return c[0][axis] + c[1][axis] + c[2][axis]; }) {}

    /// Calls test(triangle) at leaves that `misses` lets by, until one is true.
    template <class Misses, class Test>
    [[nodiscard]] bool any(const Misses& misses, const Test& test) const {
        return tree.any([&](const auto& node) { return !misses(node.box); }, test);
    }

    struct Nearest {
        const Corners* triangle = nullptr;
        Vec3 place;
        double squared_distance = std::numeric_limits<double>::infinity();
    };
    [[nodiscard]] Nearest nearest(const Vec3& p) const {
        Nearest best;
        static_cast<void>(any([&](const Box3& box) { return squared_distance_to(box, p) >= best.squared_distance; },
                              [&](const Corners& c) {
                                  const Vec3 place = closest_point_on_triangle(p, c[0], c[1], c[2]);
                                  if (const double d = squared_distance(p, place); d < best.squared_distance) {
                                      best = {&c, place, d};
                                  }
                                  return best.squared_distance == 0;
                              }));
        return best;
    }

    /// Nothing but triangle `own` between a and b?
    [[nodiscard]] bool clear(const Vec3& a, const Vec3& b, const Corners* own) const {
        const Sight sight(a, b);
        const Kernel::Segment_3 segment(point(a), point(b));
        return !any([&](const Box3& box) { return sight.misses(box); },
                    [&](const Corners& c) { return &c != own && CGAL::do_intersect(triangle(c), segment); });
    }

    /// The side told by this triangle, if nothing hides some point inside it, seen in the direction of `towards`.
    [[nodiscard]] std::optional<std::int8_t> side_by(const Corners& own, const Vec3& p, const Vec3& towards) const {
        const Vec3 middle = (own[0] + own[1] + own[2]) / 3;
        for (const double share : {0.02, 1.0, 0.3}) {
            const Vec3 inside = towards + share * (middle - towards);
            if (p != inside && !clear(p, inside, &own)) {
                continue;
            }
            switch (CGAL::orientation(point(own[0]), point(own[1]), point(own[2]), point(p))) {
                case CGAL::POSITIVE:
                    return std::int8_t{1};
                case CGAL::NEGATIVE:
                    return std::int8_t{-1};
                default:
                    return triangle(own).has_on(point(p)) ? std::optional<std::int8_t>{std::int8_t{0}} : std::nullopt;
            }
        }
        return {};
    }

    Slab slab;
    BoxTree<Corners> tree;
};

TriangleTree::TriangleTree(std::span<const Vec3> points, std::span<const Triangle> given) {
    auto triangles = with_area(points, given);
    if (!triangles.empty()) {
        impl_ = std::make_unique<Impl>(std::move(triangles));
    }
}

TriangleTree::~TriangleTree() = default;
TriangleTree::TriangleTree(TriangleTree&&) noexcept = default;
TriangleTree& TriangleTree::operator=(TriangleTree&&) noexcept = default;

bool TriangleTree::meets(const Vec3& a, const Vec3& b) const {
    const auto piece = impl_ ? impl_->slab.piece(a, b) : std::nullopt;
    if (!piece) {
        return false;
    }
    if (a == b) {
        return impl_->any([&](const Box3& box) { return !box.contains(a); },
                          [p = point(a)](const Corners& c) { return CGAL::do_intersect(triangle(c), p); });
    }
    const Sight sight(piece->first, piece->second);
    return impl_->any([&](const Box3& box) { return sight.misses(box); },
                      [segment = Kernel::Segment_3(point(a), point(b))](const Corners& c) {
                          return CGAL::do_intersect(triangle(c), segment);
                      });
}

Vec3 TriangleTree::mean_normal() const {
    return impl_ ? impl_->slab.normal() : Vec3{};
}

double TriangleTree::distance_to(const Vec3& p) const {
    return impl_ ? std::sqrt(impl_->nearest(p).squared_distance) : std::numeric_limits<double>::infinity();
}

std::optional<Vec3> TriangleTree::nearest_to(const Vec3& p) const {
    return impl_ ? std::optional(impl_->nearest(p).place) : std::nullopt;
}

Vec3 TriangleTree::normal_at(const Vec3& p) const {
    Vec3 sum;
    if (impl_) {
        static_cast<void>(impl_->any([&](const Box3& box) { return !box.contains(p); },
                                     [&](const Corners& c) {
                                         if (CGAL::do_intersect(triangle(c), point(p))) {
                                             const Vec3 normal = cross(c[1] - c[0], c[2] - c[0]);
                                             sum = sum + normal / length(normal);
                                         }
                                         return false;
                                     }));
    }
    return sum;
}

std::int8_t TriangleTree::side_of(const Vec3& p) const {
    if (!impl_) {
        return 0;
    }
    const auto nearest = impl_->nearest(p);
    if (const auto side = impl_->side_by(*nearest.triangle, p, nearest.place)) {
        return *side;
    }
    double reach = nearest.squared_distance;
    for (int widening = 0; widening < 20; ++widening) {  // an edge or corner is nearest: its other triangles, then more
        reach = 2 * reach + 1e-18;
        std::optional<std::int8_t> side;
        static_cast<void>(impl_->any([&](const Box3& box) { return squared_distance_to(box, p) > reach; },
                                     [&](const Corners& c) {
                                         side = impl_->side_by(c, p, (c[0] + c[1] + c[2]) / 3);
                                         return side.has_value();
                                     }));
        if (side) {
            return *side;
        }
    }
    const Corners& c = *nearest.triangle;
    return CGAL::orientation(point(c[0]), point(c[1]), point(c[2]), point(p)) == CGAL::NEGATIVE ? std::int8_t{-1}
                                                                                                : std::int8_t{1};
}

}  // namespace terratet
