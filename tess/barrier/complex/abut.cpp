// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <map>
#include <set>

#include "tess/barrier/complex/cut_sheets.hpp"
#include "tess/barrier/complex/triangle_aabb.hpp"

namespace terratet {
namespace {

using triangle_aabb::Kernel;
using triangle_aabb::Tree;
using triangle_aabb::Triangles;

constexpr double grazing = 0.34;     ///< sine of 20°
constexpr double overshoot = 0.3;    ///< of the tolerance, beyond the other sheet
constexpr double turn_limit = 0.87;  ///< cosine of 30°: a triangle turned further has folded

Kernel::Point_3 point(const Vec3& p) {
    return {p.x, p.y, p.z};
}

/// Outward directions of the rim's points, tangent to the sheet.
std::map<std::uint32_t, Vec3> outward_directions(const TriMesh& mesh) {
    std::map<std::uint32_t, Vec3> result;
    const std::vector<Vec3> normals = vertex_normals(mesh);
    for (const RimEdge& e : rim_edges(mesh)) {
        const Vec3 outward =
            unit(cross(mesh.points[e.to] - mesh.points[e.from], unit(normals[e.from] + normals[e.to])));
        for (const std::uint32_t v : {e.from, e.to}) {
            result[v] = result[v] + outward;
        }
    }
    for (auto& [v, direction] : result) {
        direction = unit(direction);
    }
    return result;
}

/// All sheets' triangles with their owners.
class Neighbourhood {
  public:
    explicit Neighbourhood(const std::vector<Sheet>& sheets) {
        for (std::uint32_t i = 0; i < sheets.size(); ++i) {
            for (const Triangle& t : sheets[i].mesh.triangles) {
                const TriangleCorners c = corners(sheets[i].mesh, t);
                const Kernel::Triangle_3 triangle(point(c[0]), point(c[1]), point(c[2]));
                if (!triangle.is_degenerate()) {
                    triangles_.push_back(triangle);
                    normals_.push_back(unit(area_vector(c)));
                    owners_.push_back(i);
                }
            }
        }
        tree_.insert(triangles_.cbegin(), triangles_.cend());
        tree_.build();
    }
    Neighbourhood(const Neighbourhood&) = delete;
    Neighbourhood& operator=(const Neighbourhood&) = delete;

    /// How far from p, in this direction and up to `reach` (a fiftieth of it backwards), the first other sheet is met;
    /// negative infinity when none is, or at a grazing angle.
    [[nodiscard]] double distance_ahead(const Vec3& p, const Vec3& direction, double reach, std::uint32_t own) const {
        std::vector<Tree::Primitive_id> met;
        const Kernel::Segment_3 way(point(p - 0.02 * reach * direction), point(p + reach * direction));
        tree_.all_intersected_primitives(way, std::back_inserter(met));
        double nearest = std::numeric_limits<double>::infinity();
        for (const auto& triangle : met) {
            const auto i = static_cast<std::size_t>(triangle - triangles_.cbegin());
            const double steepness = dot(normals_[i], direction);
            if (owners_[i] != own && std::abs(steepness) >= grazing) {
                const Kernel::Point_3& corner = triangle->vertex(0);
                const Vec3 to_plane = Vec3{corner.x(), corner.y(), corner.z()} - p;
                nearest = std::min(nearest, std::max(0.0, dot(to_plane, normals_[i]) / steepness));
            }
        }
        return nearest <= reach * 1.01 ? nearest : -std::numeric_limits<double>::infinity();
    }

  private:
    Triangles triangles_;
    std::vector<Vec3> normals_;
    std::vector<std::uint32_t> owners_;
    Tree tree_;
};

/// Points of triangles that turned too far or meet others of the sheet.
std::set<std::uint32_t> folded_points(const TriMesh& mesh, const std::vector<Vec3>& before) {
    std::set<std::uint32_t> folded;
    for (const Triangle& t : mesh.triangles) {
        const Vec3 now = unit(area_vector(corners(mesh, t)));
        const Vec3 then = unit(area_vector({before[t[0]], before[t[1]], before[t[2]]}));
        if (dot(now, then) < turn_limit) {
            folded.insert(t.begin(), t.end());
        }
    }
    SheetComplex alone{mesh.points, mesh.triangles, {}};
    alone.sheet.assign(mesh.triangles.size(), 0);
    for (const auto& pair : crossing_triangles(alone)) {
        for (const std::uint32_t t : pair) {
            folded.insert(mesh.triangles[t].begin(), mesh.triangles[t].end());
        }
    }
    return folded;
}

}  // namespace

std::size_t extend_to_neighbours(std::vector<Sheet>& sheets, double tolerance, const Poll& poll) {
    if (sheets.size() < 2) {
        return 0;
    }
    const Neighbourhood neighbourhood(sheets);
    std::size_t total = 0;
    for (std::uint32_t i = 0; i < sheets.size(); ++i) {
        ask(poll);
        TriMesh& mesh = sheets[i].mesh;
        const std::vector<Vec3> before = mesh.points;
        std::set<std::uint32_t> moved;
        for (const auto& [v, direction] : outward_directions(mesh)) {
            const double ahead = neighbourhood.distance_ahead(mesh.points[v], direction, tolerance, i);
            if (std::isfinite(ahead)) {
                mesh.points[v] = mesh.points[v] + (ahead + overshoot * tolerance) * direction;
                moved.insert(v);
            }
        }
        while (!moved.empty()) {
            bool undone = false;
            for (const std::uint32_t v : folded_points(mesh, before)) {
                if (moved.erase(v) > 0) {
                    mesh.points[v] = before[v];
                    undone = true;
                }
            }
            if (!undone) {
                break;
            }
        }
        total += moved.size();
    }
    return total;
}

}  // namespace terratet
