// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/barrier/complex/measure_sheet.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tess/barrier/complex/triangle_aabb.hpp"

namespace terratet {
namespace {

using triangle_aabb::Kernel;
using triangle_aabb::Tree;
using triangle_aabb::Triangles;

/// A mesh to measure distances from. Not movable: the tree points into the triangles.
class Measured {
  public:
    explicit Measured(const TriMesh& mesh) {
        const auto point = [&](std::uint32_t v) {
            return Kernel::Point_3(mesh.points[v].x, mesh.points[v].y, mesh.points[v].z);
        };
        for (const Triangle& t : mesh.triangles) {
            if (const Kernel::Triangle_3 triangle(point(t[0]), point(t[1]), point(t[2])); !triangle.is_degenerate()) {
                triangles_.push_back(triangle);
                normals_.push_back(unit(area_vector(corners(mesh, t))));
            }
        }
        tree_.insert(triangles_.cbegin(), triangles_.cend());
        if (!empty()) {
            tree_.build();
            tree_.accelerate_distance_queries();
        }
    }
    Measured(const Measured&) = delete;
    Measured& operator=(const Measured&) = delete;

    [[nodiscard]] bool empty() const { return triangles_.empty(); }

    struct Nearest {
        double distance = 0;
        Vec3 normal;
    };
    [[nodiscard]] Nearest nearest(const Vec3& p) const {
        const auto found = tree_.closest_point_and_primitive({p.x, p.y, p.z});
        return {std::sqrt(CGAL::squared_distance(found.first, Kernel::Point_3(p.x, p.y, p.z))),
                normals_[static_cast<std::size_t>(found.second - triangles_.cbegin())]};
    }

  private:
    Triangles triangles_;
    std::vector<Vec3> normals_;
    Tree tree_;
};

void add_distances(const TriMesh& from, const Measured& to, const Box3& where, std::vector<double>& distances) {
    const auto add = [&](const Vec3& p) {
        if (where.contains(p)) {
            distances.push_back(to.nearest(p).distance);
        }
    };
    std::ranges::for_each(from.points, add);
    for (const Triangle& t : from.triangles) {
        add(centroid(corners(from, t)));
    }
}

bool overlap(const Box3& a, const Box3& b) {
    return a.lo.x <= b.hi.x && b.lo.x <= a.hi.x && a.lo.y <= b.hi.y && b.lo.y <= a.hi.y && a.lo.z <= b.hi.z &&
           b.lo.z <= a.hi.z;
}

double widest_angle(const TriangleCorners& t) {
    double widest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 u = t[(k + 1) % 3] - t[k];
        const Vec3 w = t[(k + 2) % 3] - t[k];
        widest = std::max(widest, std::atan2(length(cross(u, w)), dot(u, w)));
    }
    return widest;
}

}  // namespace

bool suits(const TriMesh& mesh, double spacing, double widest) {
    const double wanted = spacing * std::numbers::sqrt2 / 2 * (1 + 1e-6);
    double total = 0;
    double unsuitable = 0;
    for (const Triangle& t : mesh.triangles) {
        const TriangleCorners c = corners(mesh, t);
        const double own = length(area_vector(c));
        total += own;
        unsuitable += covering_radius(c) > wanted || widest_angle(c) > widest ? own : 0;
    }
    double rim = 0;
    for (const RimEdge& e : rim_edges(mesh)) {
        rim += distance(mesh.points[e.from], mesh.points[e.to]);
    }
    const double needed = total / (spacing * spacing) + 0.5 * rim / spacing + 1;  // of a square lattice
    return unsuitable <= 0.02 * total && static_cast<double>(mesh.points.size()) <= 1.6 * needed;
}

Deviation deviation(const TriMesh& a, const TriMesh& b, const Box3& where) {
    const Measured first(a);
    const Measured second(b);
    std::vector<double> distances;
    if (!first.empty() && !second.empty()) {
        add_distances(a, second, where, distances);
        add_distances(b, first, where, distances);
    }
    if (distances.empty()) {
        return {};
    }
    std::ranges::sort(distances);
    const auto at = [&](double share) {
        return distances[static_cast<std::size_t>(share * static_cast<double>(distances.size() - 1))];
    };
    return {at(0.5), at(0.95), distances.back()};
}

struct Alongside::Impl {
    explicit Impl(const TriMesh& mesh) : box(bounding_box(mesh.points)), target(mesh) {}
    Box3 box;
    Measured target;
};

Alongside::Alongside(const TriMesh& mesh) : impl_(std::make_unique<Impl>(mesh)) {}
Alongside::~Alongside() = default;

double Alongside::share_of(const TriMesh& other, const Box3& where, double near) const {
    if (impl_->target.empty() || !overlap(impl_->box.grown(near), bounding_box(other.points))) {
        return 0;
    }
    double total = 0;
    double shared = 0;
    for (const Triangle& t : other.triangles) {
        std::vector<TriangleCorners> open{corners(other, t)};
        const Vec3 normal = unit(area_vector(open.front()));
        const double whole = length(area_vector(open.front()));
        while (!open.empty()) {
            const TriangleCorners piece = open.back();
            open.pop_back();
            const Vec3 middle = centroid(piece);
            const double area = length(area_vector(piece));
            if (radius_about(middle, piece) > 4 * near && area > 1e-3 * whole) {
                const auto quarters = quartered(piece);
                open.insert(open.end(), quarters.begin(), quarters.end());
                continue;
            }
            if (!where.contains(middle)) {
                continue;
            }
            total += area;
            if (impl_->box.grown(near).contains(middle)) {
                const auto nearest = impl_->target.nearest(middle);
                shared += nearest.distance < near && std::abs(dot(nearest.normal, normal)) > 0.866 ? area : 0;
            }
        }
    }
    return total > 0 ? shared / total : 0;
}

double Alongside::distance_of(const TriMesh& other, const Box3& where, double share, double most) const {
    double nearer = 0;
    double far = most;
    while (far - nearer > 1e-3 * most) {
        const double middle = 0.5 * (nearer + far);
        (share_of(other, where, middle) > share ? far : nearer) = middle;
    }
    return far;
}

bool touch(const TriMesh& a, const TriMesh& b) {
    if (!overlap(bounding_box(a.points), bounding_box(b.points))) {
        return false;
    }
    Triangles triangles;
    for (const Triangle& t : a.triangles) {
        const auto point = [&](std::uint32_t v) {
            return Kernel::Point_3(a.points[v].x, a.points[v].y, a.points[v].z);
        };
        if (const Kernel::Triangle_3 own(point(t[0]), point(t[1]), point(t[2])); !own.is_degenerate()) {
            triangles.push_back(own);
        }
    }
    const Tree tree(triangles.cbegin(), triangles.cend());
    return std::ranges::any_of(b.triangles, [&](const Triangle& t) {
        const auto point = [&](std::uint32_t v) {
            return Kernel::Point_3(b.points[v].x, b.points[v].y, b.points[v].z);
        };
        const Kernel::Triangle_3 own(point(t[0]), point(t[1]), point(t[2]));
        return !own.is_degenerate() && tree.do_intersect(own);
    });
}

}  // namespace terratet
