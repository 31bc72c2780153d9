// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/outline.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_plus_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polyline_simplification_2/Squared_distance_cost.h>
#include <CGAL/Polyline_simplification_2/Stop_above_cost_threshold.h>
#include <CGAL/Polyline_simplification_2/simplify.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

namespace terratet {
namespace {

constexpr double shown = 0.1;     ///< in spacings: corners that stand out less go
constexpr double shortest = 0.7;  ///< in spacings: edges that are shorter go

namespace simplification = CGAL::Polyline_simplification_2;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = simplification::Vertex_base_2<Kernel>;
using FaceBase = CGAL::Constrained_triangulation_face_base_2<Kernel>;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>,
                                               CGAL::Exact_predicates_tag>;
using Polylines = CGAL::Constrained_triangulation_plus_2<Triangulation>;

Vec3 flat(const Vec3& p) {
    return {p.x, p.y, 0};
}

/// Twice the area of abc, positive when it turns left.
double turn(const Vec3& a, const Vec3& b, const Vec3& c) {
    return cross(b - a, c - a).z;
}

double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
    const double square = squared_distance(a, b);
    const double t = square > 0 ? std::clamp(dot(p - a, b - a) / square, 0.0, 1.0) : 0.0;
    return distance(p, a + t * (b - a));
}

double ring_area(const std::vector<Vec3>& ring) {
    double twice = 0;
    for (std::size_t i = 2; i < ring.size(); ++i) {
        twice += turn(ring[0], ring[i - 1], ring[i]);
    }
    return twice / 2;
}

/// The edges that one triangle alone has, with that triangle on their left, end to end. From the smallest point of each
/// ring: a corner of its hull.
Rings boundary(const std::vector<Surface>& surfaces) {
    std::set<std::pair<Vec3, Vec3>> edges;
    for (const Surface& surface : surfaces) {
        for (const Triangle& t : surface.kind == SurfaceKind::domain ? surface.triangles : std::vector<Triangle>{}) {
            std::array<Vec3, 3> c{flat(surface.vertices[t[0]]), flat(surface.vertices[t[1]]),
                                  flat(surface.vertices[t[2]])};
            if (turn(c[0], c[1], c[2]) < 0) {
                std::swap(c[1], c[2]);
            }
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec3& a = c[k];
                const Vec3& b = c[(k + 1) % 3];
                if (edges.erase({b, a}) == 0) {
                    edges.emplace(a, b);
                }
            }
        }
    }
    Rings rings;
    while (!edges.empty()) {
        std::vector<Vec3>& ring = rings.emplace_back();
        const Vec3 start = edges.begin()->first;
        for (Vec3 at = start; ring.empty() || at != start;) {
            const auto edge = edges.lower_bound({at, {-2 * max_coordinate, 0, 0}});
            ring.push_back(at);
            if (edge == edges.end() || edge->first != at) {
                break;  // of overlapping polygons: not closed
            }
            at = edge->second;
            edges.erase(edge);
        }
    }
    std::erase_if(rings, [](const auto& ring) { return ring.size() < 3; });
    return rings;
}

Rings without_small_forms(const Rings& rings, double spacing) {
    Polylines polylines;
    for (const auto& ring : rings) {
        std::vector<Kernel::Point_2> points;
        for (const Vec3& p : ring) {
            points.emplace_back(p.x, p.y);
        }
        polylines.insert_constraint(points.begin(), points.end(), true);
    }
    const double least = shown * spacing;
    simplification::simplify(polylines, simplification::Squared_distance_cost(),
                             simplification::Stop_above_cost_threshold(least * least));
    Rings result;
    for (auto line = polylines.constraints_begin(); line != polylines.constraints_end(); ++line) {
        std::vector<Vec3>& ring = result.emplace_back();
        for (auto p = polylines.points_in_constraint_begin(*line); p != polylines.points_in_constraint_end(*line);
             ++p) {
            ring.push_back({p->x(), p->y(), 0});
        }
        ring.pop_back();  // the first again
    }
    std::erase_if(result, [](const auto& ring) { return ring.size() < 3; });
    std::ranges::sort(result);
    return result;
}

/// Removes corners between short edges while that changes no ring's relation to itself and the others.
class EdgeLengthener {
  public:
    EdgeLengthener(Rings& rings, double least) : rings_(rings), least_(least) {}

    void run() {
        for (std::size_t r = 0; r < rings_.size(); ++r) {
            while (const std::optional<std::size_t> corner = cheapest(r)) {
                rings_[r].erase(rings_[r].begin() + static_cast<std::ptrdiff_t>(*corner));
            }
        }
    }

  private:
    [[nodiscard]] std::optional<std::size_t> cheapest(std::size_t r) const {
        const auto& ring = rings_[r];
        std::optional<std::size_t> best;
        double least = least_;
        for (std::size_t i = 0; i < ring.size() && ring.size() > 3; ++i) {
            const Vec3& a = ring[(i + ring.size() - 1) % ring.size()];
            const Vec3& b = ring[(i + 1) % ring.size()];
            const double height = distance_to_segment(ring[i], a, b);
            if (height < least && std::min(distance(a, ring[i]), distance(ring[i], b)) < least_ &&
                is_free(a, ring[i], b)) {
                best = i;
                least = height;
            }
        }
        return best;
    }

    /// Does nothing lie in the triangle but its corners, nor cross its edge ab?
    [[nodiscard]] bool is_free(const Vec3& a, const Vec3& corner, const Vec3& b) const {
        const std::array<Vec3, 3> t = turn(a, corner, b) > 0 ? std::array{a, corner, b} : std::array{a, b, corner};
        for (const auto& ring : rings_) {
            for (std::size_t i = 0; i < ring.size(); ++i) {
                const Vec3& p = ring[i];
                const Vec3& q = ring[(i + 1) % ring.size()];
                const bool own = p == a || p == b || p == corner;
                if (!own && turn(t[0], t[1], p) >= 0 && turn(t[1], t[2], p) >= 0 && turn(t[2], t[0], p) >= 0) {
                    return false;
                }
                if (!own && q != a && q != b && q != corner && turn(a, b, p) * turn(a, b, q) <= 0 &&
                    turn(p, q, a) * turn(p, q, b) <= 0) {
                    return false;
                }
            }
        }
        return true;
    }

    Rings& rings_;
    double least_;
};

double deviation(const Rings& from, const Rings& to) {
    double most = 0;
    for (const auto& ring : from) {
        for (const Vec3& p : ring) {
            double least = std::numeric_limits<double>::infinity();
            for (const auto& other : to) {
                for (std::size_t i = 0; i < other.size(); ++i) {
                    least = std::min(least, distance_to_segment(p, other[i], other[(i + 1) % other.size()]));
                }
            }
            most = std::max(most, least);
        }
    }
    return most;
}

std::size_t corner_count(const Rings& rings) {
    std::size_t count = 0;
    for (const auto& ring : rings) {
        count += ring.size();
    }
    return count;
}

}  // namespace

Rings outline_of(const std::vector<Surface>& surfaces, double spacing, OutlineReport& report) {
    Rings all = boundary(surfaces);
    report = {};
    report.corners_in = corner_count(all);
    report.area_in = area(all);
    const std::size_t before = all.size();
    std::erase_if(all, [&](const auto& ring) { return std::abs(ring_area(ring)) < spacing * spacing; });
    Rings rings = without_small_forms(all, spacing);
    EdgeLengthener(rings, shortest * spacing).run();
    report.dropped = before - rings.size();
    report.corners = corner_count(rings);
    report.area = area(rings);
    report.deviation = rings.empty() ? 0 : deviation(all, rings);
    return rings;
}

double area(const Rings& rings) {
    double sum = 0;
    for (const auto& ring : rings) {
        sum += ring_area(ring);
    }
    return sum;
}

Box3 bounding_box(const Rings& rings) {
    Box3 box;
    for (const auto& ring : rings) {
        for (const Vec3& p : ring) {
            box.extend(flat(p));
        }
    }
    return box;
}

double length_inside(const Vec3& a, const Vec3& b, const Box3& box) {
    double from = 0;
    double to = 1;
    for (const int axis : {0, 1}) {
        const double tolerance = 1e-9 * box.size()[axis];
        const double lo = box.lo[axis] + tolerance - a[axis];
        const double hi = box.hi[axis] - tolerance - a[axis];
        const double way = b[axis] - a[axis];
        if (way == 0) {
            to = lo >= 0 || hi <= 0 ? from : to;
        } else {
            from = std::max(from, std::min(lo / way, hi / way));
            to = std::min(to, std::max(lo / way, hi / way));
        }
    }
    return std::max(0.0, to - from) * distance(a, b);
}

std::vector<Surface> domain_walls(const Rings& outline, const std::string& name, const std::string& file,
                                  const Box3& extent, double reach) {
    const double bottom = extent.lo.z - reach;
    const double top = extent.hi.z + reach;
    std::array<Surface, 3> walls;
    for (std::size_t k = 0; k < walls.size(); ++k) {
        walls[k] = {name + " " + std::string(1, static_cast<char>('a' + k)), SurfaceKind::domain, {}, {}, file};
    }
    for (const auto& ring : outline) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Vec3& a = ring[i];
            const Vec3& b = ring[(i + 1) % ring.size()];
            if (length_inside(a, b, extent) == 0) {
                continue;
            }
            Surface& wall = walls[i + 1 == ring.size() && ring.size() % 2 == 1 ? 2 : i % 2];
            const auto first = static_cast<std::uint32_t>(wall.vertices.size());
            wall.vertices.insert(wall.vertices.end(),
                                 {{a.x, a.y, bottom}, {b.x, b.y, bottom}, {b.x, b.y, top}, {a.x, a.y, top}});
            wall.triangles.push_back({first, first + 1, first + 2});
            wall.triangles.push_back({first, first + 2, first + 3});
        }
    }
    std::vector<Surface> used;
    for (Surface& wall : walls) {
        if (!wall.triangles.empty()) {
            used.push_back(std::move(wall));
        }
    }
    return used;
}

Outline::Outline(const Rings& rings) : box_(bounding_box(rings)) {
    const std::size_t corners = corner_count(rings);
    if (corners == 0) {
        return;
    }
    strips_.resize(corners);
    height_ = std::max(box_.size().y / static_cast<double>(corners), std::numeric_limits<double>::min());
    for (const auto& ring : rings) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Edge edge{ring[i], ring[(i + 1) % ring.size()]};
            const auto [low, high] = std::minmax({edge.a.y, edge.b.y});
            for (std::size_t k = strip(low); k <= strip(high); ++k) {
                strips_[k].push_back(edge);
            }
        }
    }
}

std::size_t Outline::strip(double y) const {
    const double k = std::floor((y - box_.lo.y) / height_);
    return static_cast<std::size_t>(std::clamp(k, 0.0, static_cast<double>(strips_.size() - 1)));
}

bool Outline::contains(const Vec3& p) const {
    if (strips_.empty()) {
        return true;
    }
    bool inside = false;
    for (const Edge& e : strips_[strip(p.y)]) {
        if ((e.a.y > p.y) != (e.b.y > p.y)) {
            const bool left = turn(e.a.y < e.b.y ? e.a : e.b, e.a.y < e.b.y ? e.b : e.a, flat(p)) > 0;
            inside = inside != left;
        }
    }
    return inside;
}

}  // namespace terratet
