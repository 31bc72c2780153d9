// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/barrier/complex/sheet_wall.hpp"

#include <algorithm>

#include "tess/barrier/complex/triangle_aabb.hpp"

namespace terratet {
namespace {

using triangle_aabb::Kernel;
using triangle_aabb::Tree;
using triangle_aabb::Triangles;

Kernel::Point_3 point(const Vec3& p) {
    return {p.x, p.y, p.z};
}

}  // namespace

struct SheetWall::Impl {
    const SheetComplex& complex;
    Triangles triangles;
    std::vector<std::uint32_t> number;  ///< in the complex
    Tree tree;

    explicit Impl(const SheetComplex& c) : complex(c) {
        for (std::uint32_t t = 0; t < complex.triangles.size(); ++t) {
            const TriangleCorners k = corners(complex, t);
            const Kernel::Triangle_3 triangle(point(k[0]), point(k[1]), point(k[2]));
            if (!triangle.is_degenerate()) {
                triangles.push_back(triangle);
                number.push_back(t);
            }
        }
        tree.insert(triangles.cbegin(), triangles.cend());
        if (!triangles.empty()) {
            tree.build();
        }
    }

    [[nodiscard]] std::uint32_t number_of(Triangles::const_iterator i) const {
        return number[static_cast<std::size_t>(i - triangles.cbegin())];
    }
};

SheetWall::SheetWall(const SheetComplex& complex) : impl_(std::make_unique<Impl>(complex)) {}
SheetWall::~SheetWall() = default;

bool SheetWall::between(const Vec3& a, const Vec3& b, std::optional<std::uint32_t> except) const {
    if (impl_->triangles.empty() || a == b) {
        return false;
    }
    const Kernel::Segment_3 way(point(a), point(b));
    if (!except) {
        return impl_->tree.do_intersect(way);
    }
    std::vector<Tree::Primitive_id> met;
    impl_->tree.all_intersected_primitives(way, std::back_inserter(met));
    return std::ranges::any_of(met, [&](const auto& i) { return impl_->number_of(i) != *except; });
}

double SheetWall::distance_to_others(const Vec3& p, std::uint32_t surface, double limit) const {
    std::vector<Tree::Primitive_id> near;
    impl_->tree.all_intersected_primitives(Kernel::Sphere_3(point(p), limit * limit), std::back_inserter(near));
    double least = limit * limit;
    for (const auto& i : near) {
        const std::uint32_t t = impl_->number_of(i);
        if (impl_->complex.sheet[t] != surface) {
            const TriangleCorners k = corners(impl_->complex, t);
            least = std::min(least, squared_distance(p, closest_point_on_triangle(p, k[0], k[1], k[2])));
        }
    }
    return std::sqrt(least);
}

}  // namespace terratet
