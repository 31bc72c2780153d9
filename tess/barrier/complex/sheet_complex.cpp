// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/barrier/complex/sheet_complex.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

namespace terratet {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Kernel::Point_3 point(const Vec3& p) {
    return {p.x, p.y, p.z};
}

std::uint32_t opposite(const Triangle& t, std::uint32_t a, std::uint32_t b) {
    for (const std::uint32_t v : t) {
        if (v != a && v != b) {
            return v;
        }
    }
    return t[0];
}

/// The edge of t that does not touch its corner v meets the other triangle?
bool far_edge_meets(const SheetComplex& complex, const Triangle& t, std::uint32_t v, const Kernel::Triangle_3& other) {
    std::array<std::uint32_t, 2> ends{};
    std::size_t n = 0;
    for (const std::uint32_t w : t) {
        if (w != v && n < 2) {
            ends[n++] = w;
        }
    }
    return CGAL::do_intersect(Kernel::Segment_3(point(complex.points[ends[0]]), point(complex.points[ends[1]])), other);
}

bool improper(const SheetComplex& complex, std::uint32_t i, std::uint32_t j) {
    const Triangle& s = complex.triangles[i];
    const Triangle& t = complex.triangles[j];
    std::array<std::uint32_t, 3> common{};
    std::size_t shared = 0;
    for (const std::uint32_t v : s) {
        if (std::find(t.begin(), t.end(), v) != t.end()) {
            common[shared++] = v;
        }
    }
    const auto triangle = [&](const Triangle& x) {
        return Kernel::Triangle_3(point(complex.points[x[0]]), point(complex.points[x[1]]),
                                  point(complex.points[x[2]]));
    };
    if (shared == 3) {
        return true;
    }
    if (shared == 2) {
        const Kernel::Point_3 a = point(complex.points[common[0]]);
        const Kernel::Point_3 b = point(complex.points[common[1]]);
        const Kernel::Point_3 c = point(complex.points[opposite(s, common[0], common[1])]);
        const Kernel::Point_3 d = point(complex.points[opposite(t, common[0], common[1])]);
        return CGAL::coplanar(a, b, c, d) && CGAL::coplanar_orientation(a, b, c, d) == CGAL::POSITIVE;
    }
    const Kernel::Triangle_3 first = triangle(s);
    const Kernel::Triangle_3 second = triangle(t);
    if (first.is_degenerate() || second.is_degenerate()) {
        return false;  // the triangles beside it tell
    }
    if (shared == 1) {
        return far_edge_meets(complex, s, common[0], second) || far_edge_meets(complex, t, common[0], first);
    }
    return CGAL::do_intersect(first, second);
}

}  // namespace

TriangleCorners corners(const SheetComplex& complex, std::uint32_t triangle) {
    const Triangle& t = complex.triangles[triangle];
    return {complex.points[t[0]], complex.points[t[1]], complex.points[t[2]]};
}

void compact(SheetComplex& complex) {
    TriMesh mesh{std::move(complex.points), std::move(complex.triangles)};
    compact(mesh);
    complex.points = std::move(mesh.points);
    complex.triangles = std::move(mesh.triangles);
}

TriMesh sheet_of(const SheetComplex& complex, std::uint32_t sheet) {
    TriMesh mesh{complex.points, {}};
    for (std::size_t t = 0; t < complex.triangles.size(); ++t) {
        if (complex.sheet[t] == sheet) {
            mesh.triangles.push_back(complex.triangles[t]);
        }
    }
    compact(mesh);
    return mesh;
}

EdgeTable::EdgeTable(std::span<const Triangle> triangles) {
    std::vector<std::array<std::uint32_t, 3>> uses;
    uses.reserve(3 * triangles.size());
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [a, b] = std::minmax(triangles[t][k], triangles[t][(k + 1) % 3]);
            uses.push_back({a, b, t});
        }
    }
    std::ranges::sort(uses);
    for (const auto& [a, b, t] : uses) {
        if (edges_.empty() || edges_.back().a != a || edges_.back().b != b) {
            const auto begin = static_cast<std::uint32_t>(triangles_.size());
            edges_.push_back({a, b, begin, begin});
        }
        triangles_.push_back(t);
        ++edges_.back().end;
    }
}

std::span<const std::uint32_t> EdgeTable::triangles(std::uint32_t a, std::uint32_t b) const {
    if (a > b) {
        std::swap(a, b);
    }
    const auto found =
        std::ranges::lower_bound(edges_, std::pair(a, b), {}, [](const Edge& e) { return std::pair(e.a, e.b); });
    if (found == edges_.end() || found->a != a || found->b != b) {
        return {};
    }
    return triangles(*found);
}

bool is_smooth(const SheetComplex& complex, std::span<const std::uint32_t> of_edge) {
    return of_edge.size() == 2 && complex.sheet[of_edge[0]] == complex.sheet[of_edge[1]];
}

Patches patches(const SheetComplex& complex, const EdgeTable& edges) {
    std::vector<std::uint32_t> parent(complex.triangles.size());
    std::iota(parent.begin(), parent.end(), 0U);
    const auto root = [&](std::uint32_t t) {
        while (parent[t] != t) {
            t = parent[t] = parent[parent[t]];
        }
        return t;
    };
    for (const EdgeTable::Edge& e : edges.edges()) {
        const auto of_edge = edges.triangles(e);
        if (is_smooth(complex, of_edge)) {
            const std::uint32_t a = root(of_edge[0]);
            const std::uint32_t b = root(of_edge[1]);
            parent[std::max(a, b)] = std::min(a, b);
        }
    }
    Patches result;
    result.of_triangle.resize(complex.triangles.size());
    for (std::uint32_t t = 0; t < complex.triangles.size(); ++t) {
        result.of_triangle[t] = root(t) == t ? result.count++ : result.of_triangle[root(t)];
    }
    return result;
}

void restore_sense(SheetComplex& complex) {
    const EdgeTable edges(complex.triangles);
    const auto runs = [&](std::uint32_t t, std::uint32_t a, std::uint32_t b) {  // does its sense take it from a to b?
        const Triangle& v = complex.triangles[t];
        return (v[0] == a && v[1] == b) || (v[1] == a && v[2] == b) || (v[2] == a && v[0] == b);
    };
    std::vector<std::vector<std::pair<std::uint32_t, bool>>> neighbours(complex.triangles.size());
    for (const EdgeTable::Edge& e : edges.edges()) {
        const auto of_edge = edges.triangles(e);
        for (const std::uint32_t s : of_edge) {
            const auto same = [&](std::uint32_t t) { return complex.sheet[t] == complex.sheet[s]; };
            if (std::ranges::count_if(of_edge, same) == 2) {
                for (const std::uint32_t t : of_edge) {
                    if (t != s && same(t)) {
                        neighbours[s].emplace_back(t, runs(s, e.a, e.b) == runs(t, e.a, e.b));
                    }
                }
            }
        }
    }
    enum : std::uint8_t { unseen, as_is, turned };
    std::vector<std::uint8_t> sense(complex.triangles.size(), unseen);
    for (std::uint32_t first = 0; first < complex.triangles.size(); ++first) {
        if (sense[first] != unseen) {
            continue;
        }
        std::vector<std::uint32_t> piece{first};
        sense[first] = as_is;
        double area_turned = 0;
        double area = 0;
        for (std::size_t next = 0; next < piece.size(); ++next) {
            const std::uint32_t t = piece[next];
            const double here = length(area_vector(corners(complex, t)));
            area += here;
            area_turned += sense[t] == turned ? here : 0;
            for (const auto& [other, opposed] : neighbours[t]) {
                if (sense[other] == unseen) {
                    sense[other] = opposed == (sense[t] == as_is) ? turned : as_is;
                    piece.push_back(other);
                }
            }
        }
        const std::uint8_t wrong = area_turned > 0.5 * area ? as_is : turned;
        for (const std::uint32_t t : piece) {
            if (sense[t] == wrong) {
                std::swap(complex.triangles[t][1], complex.triangles[t][2]);
            }
        }
    }
}

void halve_corners(SheetComplex& complex, const std::vector<char>& marked) {
    const EdgeTable edges(complex.triangles);
    std::vector<std::array<std::uint32_t, 3>> halves;  // ends and middle
    for (const EdgeTable::Edge& e : edges.edges()) {
        const auto of_edge = edges.triangles(e);
        if (of_edge.size() == 2 && !is_smooth(complex, of_edge) &&
            std::ranges::all_of(of_edge, [&](std::uint32_t t) { return marked[complex.sheet[t]] != 0; })) {
            halves.push_back({e.a, e.b, static_cast<std::uint32_t>(complex.points.size())});
            complex.points.push_back(0.5 * (complex.points[e.a] + complex.points[e.b]));
        }
    }
    std::map<std::array<std::uint32_t, 2>, std::uint32_t> middle_of;
    for (const auto& [a, b, middle] : halves) {
        middle_of[{a, b}] = middle;
    }
    for (std::uint32_t t = 0; t < complex.triangles.size() && !halves.empty(); ++t) {  // new ones are looked at as well
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = complex.triangles[t][k];
            const std::uint32_t b = complex.triangles[t][(k + 1) % 3];
            const auto half = middle_of.find({std::min(a, b), std::max(a, b)});
            if (half != middle_of.end()) {
                const std::uint32_t apex = complex.triangles[t][(k + 2) % 3];
                complex.triangles[t] = {a, half->second, apex};
                complex.triangles.push_back({half->second, b, apex});
                complex.sheet.push_back(complex.sheet[t]);
            }
        }
    }
}

Fan fan_about(const SheetComplex& complex, std::span<const std::uint32_t> of_edge, std::uint32_t a, std::uint32_t b) {
    const Vec3 origin = complex.points[a];
    const Vec3 along = unit(complex.points[b] - origin);
    std::vector<std::pair<double, std::uint32_t>> directions;
    Vec3 first;
    Vec3 second;
    for (const std::uint32_t t : of_edge) {
        Vec3 away = complex.points[opposite(complex.triangles[t], a, b)] - origin;
        away = unit(away - dot(away, along) * along);
        if (directions.empty()) {
            first = away;
            second = cross(along, first);
        }
        const double turn = std::atan2(dot(away, second), dot(away, first));
        directions.emplace_back(directions.empty() ? 0 : (turn < 0 ? turn + 2 * std::numbers::pi : turn), t);
    }
    std::ranges::sort(directions);
    Fan fan;
    for (std::size_t k = 0; k < directions.size(); ++k) {
        fan.triangles.push_back(directions[k].second);
        const double next =
            k + 1 < directions.size() ? directions[k + 1].first : directions[0].first + 2 * std::numbers::pi;
        fan.angle.push_back(next - directions[k].first);
    }
    return fan;
}

double wedge_angle(const SheetComplex& complex, std::span<const std::uint32_t> of_edge, std::uint32_t a,
                   std::uint32_t b) {
    if (of_edge.size() < 2) {
        return std::numbers::pi;
    }
    const Fan fan = fan_about(complex, of_edge, a, b);
    return *std::ranges::min_element(fan.angle);
}

std::vector<std::array<std::uint32_t, 2>> crossing_triangles(const SheetComplex& complex) {
    using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::uint32_t>;
    std::vector<Box> boxes;
    boxes.reserve(complex.triangles.size());
    for (std::uint32_t t = 0; t < complex.triangles.size(); ++t) {
        CGAL::Bbox_3 box;
        for (const Vec3& p : corners(complex, t)) {
            box += point(p).bbox();
        }
        boxes.emplace_back(box, t);
    }
    std::vector<std::array<std::uint32_t, 2>> found;
    CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& s, const Box& t) {
        if (improper(complex, s.info(), t.info())) {
            const auto [i, j] = std::minmax({s.info(), t.info()});
            found.push_back({i, j});
        }
    });
    std::ranges::sort(found);
    return found;
}

}  // namespace terratet
