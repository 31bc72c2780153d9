// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read/surfaces/polygon_surface.hpp"

#include <algorithm>

namespace terratet {

std::string PolygonSurface::add(const PolygonRings& rings) {
    std::vector<Vec3> corners;
    for (const auto& ring : rings) {
        if (ring.size() < 3) {
            return "a polygon with fewer than three corners";
        }
        corners.insert(corners.end(), ring.begin(), ring.end());
    }
    if (!std::all_of(corners.begin(), corners.end(), is_acceptable)) {
        return "coordinates must be numbers within 1e9";
    }
    const bool triangle = corners.size() == 3;  // kept even without area, as in other formats: repair sees to it
    const std::vector<Triangle> triangles = triangle ? std::vector<Triangle>{{0, 1, 2}} : triangulate_polygon(rings);
    if (triangles.empty()) {
        return "a polygon of " + std::to_string(corners.size()) + " corners that crosses itself or has no area";
    }
    for (const Triangle& t : triangles) {
        const Triangle joined{index(corners[t[0]]), index(corners[t[1]]), index(corners[t[2]])};
        if (joined[0] == joined[1] || joined[1] == joined[2] || joined[2] == joined[0]) {
            return "a triangle with two corners at one place";
        }
        triangles_.push_back(joined);
    }
    return {};
}

Surface PolygonSurface::finish(std::string name) const {
    Surface surface;
    surface.name = std::move(name);
    std::vector<std::uint32_t> rank(index_.size());
    for (const auto& [position, first_index] : index_) {  // ascending positions
        rank[first_index] = static_cast<std::uint32_t>(surface.vertices.size());
        surface.vertices.push_back(position);
    }
    for (const Triangle& t : triangles_) {
        Triangle sorted{rank[t[0]], rank[t[1]], rank[t[2]]};
        std::rotate(sorted.begin(), std::min_element(sorted.begin(), sorted.end()), sorted.end());
        surface.triangles.push_back(sorted);
    }
    std::sort(surface.triangles.begin(), surface.triangles.end());
    return surface;
}

namespace {

/// Open, and without consecutive repetitions.
std::vector<Vec3> ring_of(const OGRLinearRing& ring) {
    std::vector<Vec3> points;
    for (int i = 0; i < ring.getNumPoints(); ++i) {
        const Vec3 p{ring.getX(i), ring.getY(i), ring.getZ(i)};
        if (points.empty() || points.back() != p) {
            points.push_back(p);
        }
    }
    if (points.size() > 1 && points.front() == points.back()) {
        points.pop_back();
    }
    return points;
}

}  // namespace

PolygonRings rings_of(const OGRPolygon& polygon) {
    PolygonRings rings;
    for (const OGRLinearRing* ring : polygon) {
        rings.push_back(ring_of(*ring));
    }
    return rings;
}

}  // namespace terratet
