// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/barrier/complex/margin_row.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace terratet {
namespace {

constexpr double narrow = 25 * std::numbers::pi / 180;  ///< neighbouring triangles nearer than that share their apex

Vec3 turned(const Vec3& v, const Vec3& axis, double angle) {  // Rodrigues
    return std::cos(angle) * v + std::sin(angle) * cross(axis, v) + (1 - std::cos(angle)) * dot(axis, v) * axis;
}

/// The row of one surface, on work points of its own until it is known what stays.
class Row {
  public:
    Row(const SheetComplex& complex, const TriMesh& sheet, std::uint32_t surface)
        : complex_(complex), sheet_(sheet), surface_(surface), normals_(vertex_normals(sheet)) {}

    void build(const std::vector<RimEdge>& rim) {
        std::map<std::uint32_t, std::vector<std::size_t>> arriving;
        std::map<std::uint32_t, std::vector<std::size_t>> leaving;
        for (const RimEdge& e : rim) {
            const Vec3& a = sheet_.points[e.from];
            const Vec3& b = sheet_.points[e.to];
            const Vec3 outward = unit(cross(b - a, unit(normals_[e.from] + normals_[e.to])));
            arriving[e.to].push_back(apexes_.size());
            leaving[e.from].push_back(apexes_.size());
            apex_of_.push_back(apexes_.size());
            apexes_.push_back(0.5 * (a + b) + 0.5 * std::numbers::sqrt3 * distance(a, b) * outward);
        }
        std::vector<std::array<std::size_t, 2>> corners;  // edges arriving and leaving
        std::vector<std::uint32_t> points;
        for (const auto& [v, in] : arriving) {
            const auto out = leaving.find(v);
            if (in.size() == 1 && out != leaving.end() && out->second.size() == 1) {
                corners.push_back({in[0], out->second[0]});
                points.push_back(v);
            }
        }
        for (std::size_t k = 0; k < corners.size(); ++k) {
            if (turn(points[k], corners[k]) < narrow) {
                join(corners[k][0], corners[k][1]);
            }
        }
        for (std::size_t k = 0; k < rim.size(); ++k) {
            add({rim[k].to, rim[k].from, apex(k)});
        }
        for (std::size_t k = 0; k < corners.size(); ++k) {
            add_fan(points[k], corners[k]);
        }
    }

    /// Appends what is far enough from other surfaces.
    void append_to(SheetComplex& result, const SheetWall& wall, double clear, const Frame& frame) const {
        constexpr std::uint32_t unused = ~std::uint32_t{0};
        std::vector<std::uint32_t> place(apexes_.size(), unused);
        const auto count = static_cast<std::uint32_t>(complex_.points.size());
        for (const Triangle& t : triangles_) {
            Vec3 from;
            double length_here = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                from = t[k] < count ? complex_.points[t[k]] : from;
                length_here = std::max(length_here, distance(position(t[k]), position(t[(k + 1) % 3])));
            }
            const Vec3 middle = (position(t[0]) + position(t[1]) + position(t[2])) / 3;
            const Vec3 start = from + 1e-3 * (middle - from);
            const bool stays = std::ranges::all_of(t, [&](std::uint32_t v) {
                const double reach = clear * length_here;
                return v < count || (wall.distance_to_others(position(v), surface_, reach) >= reach &&
                                     !wall.between(start, position(v)));
            });
            if (!stays) {
                continue;
            }
            Triangle added = t;
            for (std::uint32_t& v : added) {
                if (v >= count) {
                    std::uint32_t& number = place[v - count];
                    if (number == unused) {
                        number = static_cast<std::uint32_t>(result.points.size());
                        result.points.push_back(frame.snapped(apexes_[v - count]));
                    }
                    v = number;
                }
            }
            result.triangles.push_back(added);
            result.sheet.push_back(surface_);
        }
    }

  private:
    [[nodiscard]] std::uint32_t apex(std::size_t edge) const {
        return static_cast<std::uint32_t>(complex_.points.size() + root(edge));
    }
    [[nodiscard]] std::size_t root(std::size_t k) const {
        while (apex_of_[k] != k) {
            k = apex_of_[k];
        }
        return k;
    }
    [[nodiscard]] Vec3 position(std::uint32_t v) const {
        return v < complex_.points.size() ? complex_.points[v] : apexes_[v - complex_.points.size()];
    }
    [[nodiscard]] Vec3 direction(std::uint32_t v, const Vec3& to) const {
        const Vec3 way = to - sheet_.points[v];
        return unit(way - dot(way, normals_[v]) * normals_[v]);
    }

    /// From the apex of the edge that arrives at v to that of the one that leaves, on the outer side.
    [[nodiscard]] double turn(std::uint32_t v, const std::array<std::size_t, 2>& edges) const {
        const Vec3 first = direction(v, apexes_[root(edges[0])]);
        const Vec3 last = direction(v, apexes_[root(edges[1])]);
        return std::atan2(dot(cross(first, last), normals_[v]), dot(first, last));
    }

    void join(std::size_t a, std::size_t b) {
        const auto [low, high] = std::minmax({root(a), root(b)});
        if (low != high) {
            apex_of_[high] = low;
            apexes_[low] = 0.5 * (apexes_[low] + apexes_[high]);
        }
    }

    void add_fan(std::uint32_t v, const std::array<std::size_t, 2>& edges) {
        const std::uint32_t first = apex(edges[0]);
        const std::uint32_t last = apex(edges[1]);
        const double angle = turn(v, edges);
        if (first == last || angle <= 0) {
            return;
        }
        const int steps = std::max(1, static_cast<int>(std::lround(angle / (std::numbers::pi / 3))));
        const Vec3 start = position(first) - sheet_.points[v];
        std::uint32_t before = first;
        for (int k = 1; k <= steps; ++k) {
            std::uint32_t next = last;
            if (k < steps) {
                next = static_cast<std::uint32_t>(complex_.points.size() + apexes_.size());
                apex_of_.push_back(apexes_.size());
                apexes_.push_back(sheet_.points[v] + turned(start, normals_[v], angle * k / steps));
            }
            add({v, before, next});
            before = next;
        }
    }

    void add(const Triangle& t) {
        const double area = length(area_vector({position(t[0]), position(t[1]), position(t[2])}));
        if (area > 1e-3 * squared_distance(position(t[0]), position(t[1]))) {
            triangles_.push_back(t);
        }
    }

    const SheetComplex& complex_;
    const TriMesh& sheet_;
    std::uint32_t surface_;
    std::vector<Vec3> normals_;
    std::vector<Vec3> apexes_;
    std::vector<std::size_t> apex_of_;
    std::vector<Triangle> triangles_;
};

bool near(const Vec3& p, const Box3& extent, double width) {
    return extent.grown(width).contains(p);
}

}  // namespace

SheetComplex with_margin_row(const SheetComplex& complex, const EdgeTable& edges, const SheetWall& wall, double clear,
                             const Box3& extent, double width, const Frame& frame) {
    SheetComplex result = complex;
    std::map<std::uint32_t, TriMesh> sheets;
    for (std::uint32_t t = 0; t < complex.triangles.size(); ++t) {
        sheets[complex.sheet[t]].triangles.push_back(complex.triangles[t]);
    }
    for (auto& [surface, sheet] : sheets) {
        sheet.points = complex.points;
        std::vector<RimEdge> rim = rim_edges(sheet);
        std::erase_if(rim, [&](const RimEdge& e) {
            return edges.triangles(e.from, e.to).size() > 1 ||
                   !near(0.5 * (sheet.points[e.from] + sheet.points[e.to]), extent, width);
        });
        Row row(complex, sheet, surface);
        row.build(rim);
        row.append_to(result, wall, clear, frame);
    }
    return result;
}

}  // namespace terratet
