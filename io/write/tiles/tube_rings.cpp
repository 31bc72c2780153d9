// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/write/tiles/tube_rings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace terratet {
namespace {

struct Ring {
    Vec3 middle;
    Vec3 color;  ///< in metres
};

Ring ring(const ScenePart& part, std::size_t index, double color_metres) {
    Ring result;
    const std::size_t first = index * part.sides;
    for (std::size_t k = 0; k < part.sides; ++k) {
        result.middle = result.middle + part.positions[first + k] / part.sides;
    }
    const Color color = part.colors.empty() ? part.color : part.colors[first];
    result.color = color_metres * Vec3{color.r, color.g, color.b};
    return result;
}

struct Away {
    double squared = 0;  ///< in all six dimensions
    Vec3 place;
    Vec3 color;
};

/// From the straight line between two rings.
Away away(const Ring& a, const Ring& b, const Ring& p) {
    const Vec3 along = b.middle - a.middle;
    const Vec3 change = b.color - a.color;
    const double whole = squared_length(along) + squared_length(change);
    const double there = dot(p.middle - a.middle, along) + dot(p.color - a.color, change);
    const double t = whole > 0 ? std::clamp(there / whole, 0.0, 1.0) : 0;
    const Vec3 place = p.middle - a.middle - t * along;
    const Vec3 color = p.color - a.color - t * change;
    return {squared_length(place) + squared_length(color), place, color};
}

std::vector<Ring> rings_of(const ScenePart& part, double color_metres) {
    std::vector<Ring> rings;
    for (std::size_t r = 0; r < part.positions.size() / part.sides; ++r) {
        rings.push_back(ring(part, r, color_metres));
    }
    return rings;
}

}  // namespace

std::vector<double> ring_weights(const ScenePart& part, double color_metres) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const std::vector<Ring> rings = rings_of(part, color_metres);
    std::vector<double> weights(rings.size(), infinity);
    if (rings.size() <= 4) {
        return weights;
    }
    struct Run {
        std::size_t first;
        std::size_t last;
        double above;  ///< weight of the ring that parted it from others
    };
    std::vector<Run> waiting{{1, rings.size() - 2, infinity}};
    while (!waiting.empty()) {
        const auto [first, last, above] = waiting.back();
        waiting.pop_back();
        std::size_t farthest = first;
        double most = -1;
        for (std::size_t r = first + 1; r < last; ++r) {
            if (const double here = away(rings[first], rings[last], rings[r]).squared; here > most) {
                most = here;
                farthest = r;
            }
        }
        if (farthest != first) {
            weights[farthest] = std::min(above, std::sqrt(most));
            waiting.push_back({first, farthest, weights[farthest]});
            waiting.push_back({farthest, last, weights[farthest]});
        }
    }
    return weights;
}

Deviation tube_deviation(const ScenePart& part, std::span<const std::uint32_t> kept, double color_metres) {
    const std::vector<Ring> rings = rings_of(part, color_metres);
    Deviation most;
    for (std::size_t k = 0; k + 1 < kept.size(); ++k) {
        for (std::uint32_t r = kept[k] + 1; r < kept[k + 1]; ++r) {
            const Away here = away(rings[kept[k]], rings[kept[k + 1]], rings[r]);
            const Vec3 color = here.color / color_metres;
            most.extend({length(here.place), std::max({std::abs(color.x), std::abs(color.y), std::abs(color.z)})});
        }
    }
    return most;
}

std::vector<Triangle> tube_triangles(const ScenePart& part, std::span<const std::uint32_t> rings) {
    std::vector<Triangle> triangles;
    for (std::size_t r = 1; r < rings.size(); ++r) {
        const std::uint32_t lower = rings[r - 1] * part.sides;
        const std::uint32_t upper = rings[r] * part.sides;
        for (std::uint32_t k = 0; k < part.sides; ++k) {
            const std::uint32_t next = (k + 1) % part.sides;
            triangles.push_back({lower + k, lower + next, upper + next});
            triangles.push_back({lower + k, upper + next, upper + k});
        }
    }
    return triangles;
}

}  // namespace terratet
