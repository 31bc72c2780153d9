// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/barrier/complex/repair.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>

#include <numeric>

#include "tess/barrier/complex/sheet_complex.hpp"
#include "tess/base/grid.hpp"

namespace terratet {
namespace {

using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;

constexpr std::uint32_t unplaced = ~std::uint32_t{0};

/// Each vertex's place among the distinct positions, sorted; a position nearer than the tolerance to an earlier one is
/// folded into it.
std::vector<std::uint32_t> merged_points(const std::vector<Vec3>& vertices, double tolerance,
                                         std::vector<Vec3>& points) {
    std::vector<std::uint32_t> order;
    for (std::uint32_t v = 0; v < vertices.size(); ++v) {
        if (is_acceptable(vertices[v])) {
            order.push_back(v);
        }
    }
    std::sort(order.begin(), order.end(), [&](auto a, auto b) { return vertices[a] < vertices[b]; });
    Grid<std::uint32_t> near(tolerance);
    std::vector<std::uint32_t> place(vertices.size(), unplaced);
    for (const std::uint32_t v : order) {
        const Vec3& p = vertices[v];
        near.visit(p, [&](std::uint32_t k) {
            if (distance(points[k], p) <= tolerance) {
                place[v] = std::min(place[v], k);
            }
        });
        if (place[v] == unplaced) {
            place[v] = static_cast<std::uint32_t>(points.size());
            near.insert(p, place[v]);
            points.push_back(p);
        }
    }
    return place;
}

/// Height over the longest edge no more than the tolerance: nothing but rounding.
bool is_degenerate(const TriangleCorners& t, double tolerance) {
    const double longest = std::max({distance(t[0], t[1]), distance(t[1], t[2]), distance(t[2], t[0])});
    return 2 * length(area_vector(t)) <= tolerance * longest || longest == 0;
}

std::vector<Triangle> usable_triangles(const Surface& surface, const std::vector<std::uint32_t>& place,
                                       const TriMesh& mesh, double tolerance) {
    std::vector<Triangle> kept;
    for (const Triangle& source : surface.triangles) {
        Triangle t{};
        bool usable = true;
        for (std::size_t k = 0; k < 3; ++k) {
            const bool known = source[k] < place.size() && place[source[k]] < mesh.points.size();
            t[k] = known ? place[source[k]] : 0;
            usable = usable && known;
        }
        if (!usable || t[0] == t[1] || t[1] == t[2] || t[2] == t[0] || is_degenerate(corners(mesh, t), tolerance)) {
            continue;
        }
        std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
        kept.push_back(t);
    }
    // Doubled ones differ at most in sense once the smallest corner leads.
    const auto sense_free = [](const Triangle& t) {
        return Triangle{t[0], std::min(t[1], t[2]), std::max(t[1], t[2])};
    };
    std::sort(kept.begin(), kept.end(), [&](const Triangle& a, const Triangle& b) {
        return std::pair(sense_free(a), a) < std::pair(sense_free(b), b);
    });
    kept.erase(std::unique(kept.begin(), kept.end(),
                           [&](const Triangle& a, const Triangle& b) { return sense_free(a) == sense_free(b); }),
               kept.end());
    return kept;
}

/// Makes neighbours agree and splits what is not a surface, duplicating points (CGAL).
TriMesh oriented(const TriMesh& soup) {
    std::vector<Point> points;
    for (const Vec3& p : soup.points) {
        points.emplace_back(p.x, p.y, p.z);
    }
    std::vector<std::vector<std::size_t>> polygons;
    for (const Triangle& t : soup.triangles) {
        polygons.push_back({t[0], t[1], t[2]});
    }
    CGAL::Polygon_mesh_processing::orient_polygon_soup(points, polygons);
    TriMesh mesh;
    for (const Point& p : points) {
        mesh.points.push_back({p.x(), p.y(), p.z()});
    }
    for (const auto& polygon : polygons) {
        mesh.triangles.push_back({static_cast<std::uint32_t>(polygon[0]), static_cast<std::uint32_t>(polygon[1]),
                                  static_cast<std::uint32_t>(polygon[2])});
    }
    return mesh;
}

std::vector<TriMesh> connected_parts(const TriMesh& mesh) {
    std::vector<std::uint32_t> parent(mesh.points.size());
    std::iota(parent.begin(), parent.end(), 0U);
    const auto root = [&](std::uint32_t v) {
        while (parent[v] != v) {
            v = parent[v] = parent[parent[v]];
        }
        return v;
    };
    for (const Triangle& t : mesh.triangles) {
        for (const std::uint32_t v : {t[1], t[2]}) {
            const std::uint32_t a = root(t[0]);
            const std::uint32_t b = root(v);
            parent[std::max(a, b)] = std::min(a, b);
        }
    }
    std::vector<TriMesh> parts;
    std::vector<std::uint32_t> part_of(mesh.points.size(), unplaced);  // of roots
    std::vector<std::uint32_t> place(mesh.points.size(), unplaced);    // of a point in its part: it has only one
    for (Triangle t : mesh.triangles) {
        std::uint32_t& index = part_of[root(t[0])];
        if (index == unplaced) {
            index = static_cast<std::uint32_t>(parts.size());
            parts.emplace_back();
        }
        TriMesh& part = parts[index];
        for (std::uint32_t& v : t) {
            if (place[v] == unplaced) {
                place[v] = static_cast<std::uint32_t>(part.points.size());
                part.points.push_back(mesh.points[v]);
            }
            v = place[v];
        }
        part.triangles.push_back(t);
    }
    return parts;
}

Vec3 total_area_vector(const TriMesh& mesh) {
    Vec3 sum;
    for (const Triangle& t : mesh.triangles) {
        sum = sum + area_vector(corners(mesh, t));
    }
    return sum;
}

void flip(TriMesh& mesh) {
    for (Triangle& t : mesh.triangles) {
        std::swap(t[1], t[2]);
    }
}

/// Upwards; for a steep surface, along the axis it faces most.
bool faces_forward(const Vec3& normal) {
    if (std::abs(normal.z) > 0.1 * length(normal)) {
        return normal.z > 0;
    }
    return std::abs(normal.x) >= std::abs(normal.y) ? normal.x > 0 : normal.y > 0;
}

}  // namespace

RepairedSheet repair_sheet(const Surface& surface, double tolerance) {
    RepairedSheet result;
    TriMesh soup;
    const std::vector<std::uint32_t> place = merged_points(surface.vertices, tolerance, soup.points);
    soup.triangles = usable_triangles(surface, place, soup, tolerance);
    result.dropped = surface.triangles.size() - soup.triangles.size();
    compact(soup);
    result.area = area(soup);
    result.parts = connected_parts(oriented(soup));
    std::stable_sort(result.parts.begin(), result.parts.end(),
                     [](const TriMesh& a, const TriMesh& b) { return area(a) > area(b); });
    Vec3 reference;
    for (TriMesh& part : result.parts) {
        if (surface.kind == SurfaceKind::domain) {
            break;  // its walls face out as they come
        }
        const Vec3 facing = total_area_vector(part);
        if (reference == Vec3{} ? !faces_forward(facing) : dot(facing, reference) < 0) {
            flip(part);
        }
        if (reference == Vec3{}) {
            reference = total_area_vector(part);
        }
    }
    return result;
}

double drop_self_crossings(RepairedSheet& repaired) {
    double dropped_area = 0;
    std::vector<TriMesh> sound;
    for (TriMesh& part : repaired.parts) {
        SheetComplex alone{part.points, part.triangles, std::vector<std::uint32_t>(part.triangles.size(), 0)};
        const auto crossings = crossing_triangles(alone);
        if (crossings.empty()) {
            sound.push_back(std::move(part));
            continue;
        }
        std::vector<std::uint32_t> meets(part.triangles.size(), 0);
        for (const auto& [s, t] : crossings) {
            ++meets[s];
            ++meets[t];
        }
        std::vector<char> dropped(part.triangles.size(), 0);
        for (const auto& [s, t] : crossings) {
            if (dropped[s] == 0 && dropped[t] == 0) {
                dropped[meets[s] >= meets[t] ? s : t] = 1;
            }
        }
        TriMesh rest{part.points, {}};
        for (std::size_t t = 0; t < dropped.size(); ++t) {
            if (dropped[t] == 0) {
                rest.triangles.push_back(part.triangles[t]);
            } else {
                dropped_area += length(area_vector(corners(part, part.triangles[t])));
            }
        }
        compact(rest);
        for (TriMesh& piece : connected_parts(oriented(rest))) {
            sound.push_back(std::move(piece));
        }
    }
    repaired.parts = std::move(sound);
    return dropped_area;
}

}  // namespace terratet
