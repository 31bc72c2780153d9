// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/barrier/seeds/leak_sheets.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "tess/base/seed_grid.hpp"
#include "tess/base/tri_mesh.hpp"

namespace terratet {
namespace {

constexpr double sight = 1.0;          ///< how far from a seed its planes lie, in spacings
constexpr double same_normal = 0.99;   ///< cosine of the angle up to which two planes are as one,
constexpr double level = 0.98;         ///< cosine of the angle up to which a sheet does not count as bent,
constexpr double plain_radius = 0.75;  ///< looked at so far from a seed, in spacings
constexpr std::size_t most_planes = 24;
constexpr double wide = 1.9;          ///< in protection radii: larger triangles are looked at in parts
constexpr double close_probes = 0.2;  ///< in protection radii: probes nearer to each other than that,
constexpr double close_out = 0.9;     ///< and standing out into directions with this cosine at least, tell the same

double widest_protection(std::span<const Barrier> barriers) {
    double widest = std::numeric_limits<double>::min();
    for (const Barrier& barrier : barriers) {
        widest = std::max(widest, barrier.protection_radius);
    }
    return widest;
}

/// Triangles with an edge that no other shares.
std::vector<char> at_rims(const std::vector<TriangleCorners>& triangles) {
    using Sides = std::pair<Vec3, Vec3>;
    const auto edge = [](const TriangleCorners& c, std::size_t k) { return Sides(std::minmax(c[k], c[(k + 1) % 3])); };
    std::map<Sides, int> uses;
    for (const TriangleCorners& c : triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            ++uses[edge(c, k)];
        }
    }
    std::vector<char> result;
    for (const TriangleCorners& c : triangles) {
        result.push_back(uses[edge(c, 0)] == 1 || uses[edge(c, 1)] == 1 || uses[edge(c, 2)] == 1 ? 1 : 0);
    }
    return result;
}

/// The triangle in equal parts, like it, none with an edge above `longest`; at most some thousand.
std::vector<TriangleCorners> parts_of(const TriangleCorners& whole, double longest) {
    std::vector<TriangleCorners> parts{whole};
    for (double edge =
             std::max({distance(whole[0], whole[1]), distance(whole[1], whole[2]), distance(whole[2], whole[0])});
         edge > longest && parts.size() < 1024; edge /= 2) {
        std::vector<TriangleCorners> smaller;
        for (const auto& [a, b, c] : parts) {
            const Vec3 ab = 0.5 * (a + b);
            const Vec3 bc = 0.5 * (b + c);
            const Vec3 ca = 0.5 * (c + a);
            smaller.insert(smaller.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        }
        parts = std::move(smaller);
    }
    return parts;
}

}  // namespace

bool is_wanted(const SheetPlane& plane, const std::vector<SheetPlane>& planes) {
    return planes.size() < most_planes && plane.normal != Vec3{} &&
           std::ranges::none_of(planes, [&](const SheetPlane& other) {
               return std::abs(dot(other.normal, plane.normal)) > same_normal &&
                      std::abs(dot(other.base - plane.base, plane.normal)) < same_height * plane.protection;
           });
}

LeakSheets::LeakSheets(std::span<const Barrier> barriers)
    : barriers_(barriers), query_(barriers), widest_protection_(terratet::widest_protection(barriers)) {
    std::vector<TriangleCorners> triangles;
    std::vector<double> reach;
    for (std::uint32_t f = 0; f < barriers_.size(); ++f) {
        const Surface& sheet = barriers_[f].sheet;
        boxes_.push_back(bounding_box(sheet.vertices));
        for (const Triangle& t : sheet.triangles) {
            triangles.push_back({sheet.vertices[t[0]], sheet.vertices[t[1]], sheet.vertices[t[2]]});
            reach.push_back(sight * barriers_[f].spacing);
            barrier_of_.push_back(f);
        }
    }
    at_rim_ = at_rims(triangles);
    for (const TriangleCorners& c : triangles) {
        normals_.push_back(unit(area_vector(c)));
    }
    grid_ = TriangleGrid(std::move(triangles), reach);
}

bool LeakSheets::is_plain(std::uint32_t barrier, const Vec3& place, const Vec3& normal) const {
    const double near = plain_radius * barriers_[barrier].spacing;
    return std::ranges::all_of(grid_.candidates(place), [&](std::uint32_t t) {
        return (barrier_of_[t] == barrier && at_rim_[t] == 0 && dot(normals_[t], normal) > level) ||
               grid_.squared_distance_to(t, place) >= near * near;
    });
}

std::vector<SheetPlane> LeakSheets::planes_about(std::uint32_t owner, const Vec3& base, const Vec3& normal) const {
    std::vector<SheetPlane> planes{{base, normal, barriers_[owner].protection_radius}};
    const double near = sight * barriers_[owner].spacing;
    for (const std::uint32_t t : grid_.candidates(base)) {
        const SheetPlane plane{grid_.triangle(t)[0], normals_[t], barriers_[barrier_of_[t]].protection_radius};
        if (is_wanted(plane, planes) && grid_.squared_distance_to(t, base) < near * near) {
            planes.push_back(plane);
        }
    }
    return planes;
}

LeakProbes LeakSheets::probes(const ProtectionZone& zone, const Box3& hull, const Poll& poll) const {
    std::vector<LeakProbe> placed;
    SeedGrid places({}, close_probes * widest_protection_);
    const auto place = [&](const Vec3& over, const Vec3& out, std::uint32_t f) {
        const std::optional<Vec3> free = zone.pushed_out(over);
        if (!free || !hull.contains(*free)) {
            return;
        }
        const LeakProbe probe{*free, *free == over ? out : Vec3{}, f};
        bool there = false;
        places.visit(probe.place, [&](std::uint32_t k) {
            const Vec3& other = placed[k].out;
            const bool alike = probe.out == Vec3{} ? other == Vec3{} : dot(other, probe.out) > close_out;
            there = there || (placed[k].barrier == f && alike &&
                              distance(placed[k].place, probe.place) < close_probes * barriers_[f].protection_radius);
        });
        if (!there) {
            places.insert(probe.place);
            placed.push_back(probe);
        }
    };
    const auto place_over = [&](const TriangleCorners& c, std::uint32_t t) {
        const Vec3 middle = centroid(c);
        if (is_plain(barrier_of_[t], middle, normals_[t])) {
            return;
        }
        for (const Vec3& x : {middle, 0.5 * (middle + c[0]), 0.5 * (middle + c[1]), 0.5 * (middle + c[2])}) {
            for (const double side : {1.0, -1.0}) {
                const Vec3 out = side * normals_[t];
                place(x + just_beyond * barriers_[barrier_of_[t]].protection_radius * out, out, barrier_of_[t]);
            }
        }
    };
    for (std::uint32_t t = 0; t < grid_.size(); ++t) {
        if (t % 64 == 0) {
            ask(poll);
        }
        const double longest = wide * barriers_[barrier_of_[t]].protection_radius;
        for (const TriangleCorners& part : parts_of(grid_.triangle(t), longest)) {
            place_over(part, t);
        }
    }
    return LeakProbes(std::move(placed));
}

bool LeakSheets::crosses(std::uint32_t f, const Vec3& a, const Vec3& b) const {
    if (!boxes_[f].meets_box_of(a, b)) {
        return false;
    }
    return query_.crosses(static_cast<std::int32_t>(f), a, b);
}

Vec3 LeakSheets::crossing_place(std::uint32_t f, const Vec3& a, const Vec3& b) const {
    double before = 0;
    double after = 1;
    for (int i = 0; i < 40; ++i) {
        const double middle = 0.5 * (before + after);
        (crosses(f, a, a + middle * (b - a)) ? after : before) = middle;
    }
    return a + after * (b - a);
}

bool LeakSheets::hide(const Vec3& a, const Vec3& b) const {
    for (std::uint32_t f = 0; f < barriers_.size(); ++f) {
        if (crosses(f, a, b)) {
            return true;
        }
    }
    return false;
}

double LeakSheets::distance_to_others(std::uint32_t barrier, const Vec3& p, double most) const {
    for (std::uint32_t f = 0; f < barriers_.size(); ++f) {
        if (f != barrier && distance(p, boxes_[f].clamped(p)) < most) {
            most = std::min(most, query_.distance_to_sheet(static_cast<std::int32_t>(f), p));
        }
    }
    return most;
}

Vec3 LeakSheets::normal_at(std::uint32_t barrier, const Vec3& place) const {
    double least = std::numeric_limits<double>::infinity();
    Vec3 normal;
    for (const std::uint32_t t : grid_.candidates(place)) {
        const double square = grid_.squared_distance_to(t, place);
        if (barrier_of_[t] == barrier && square < least) {
            least = square;
            normal = normals_[t];
        }
    }
    return normal;
}

}  // namespace terratet
