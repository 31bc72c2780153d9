// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/refine/samples_in_cell.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tess/base/tetrahedron.hpp"

namespace terratet {

namespace {

constexpr std::uint32_t leaf_size = 8;

/// The cell's four sides and its box, to pass over parts of the tree.
struct Planes {
    Box3 box;
    std::array<Vec3, 4> normal;  ///< outwards
    std::array<double, 4> offset{};

    explicit Planes(const CellPoints& p) {
        for (std::size_t k = 0; k < 4; ++k) {
            box.extend(p[k]);
            const Vec3& a = p[facet_corners[k][0]];
            normal[k] = cross(p[facet_corners[k][1]] - a, p[facet_corners[k][2]] - a);
            normal[k] = dot(normal[k], p[k] - a) > 0 ? -1.0 * normal[k] : normal[k];
            offset[k] = dot(normal[k], a);
        }
    }

    [[nodiscard]] bool misses(const Box3& other) const {
        for (int axis = 0; axis < 3; ++axis) {
            if (other.hi[axis] < box.lo[axis] || other.lo[axis] > box.hi[axis]) {
                return true;
            }
        }
        for (std::size_t k = 0; k < 4; ++k) {
            const Vec3& n = normal[k];
            const Vec3 innermost{n.x > 0 ? other.lo.x : other.hi.x, n.y > 0 ? other.lo.y : other.hi.y,
                                 n.z > 0 ? other.lo.z : other.hi.z};
            if (dot(n, innermost) > offset[k] + 1e-9 * std::abs(offset[k])) {
                return true;
            }
        }
        return false;
    }
};

}  // namespace

std::array<double, 4> weights_at(const CellPoints& p, const Vec3& place) {
    const Vec3 a = p[1] - p[0];
    const Vec3 b = p[2] - p[0];
    const Vec3 c = p[3] - p[0];
    const Vec3 q = place - p[0];
    const double volume = dot(a, cross(b, c));
    const double u = dot(q, cross(b, c)) / volume;
    const double v = dot(a, cross(q, c)) / volume;
    const double w = dot(a, cross(b, q)) / volume;
    return {1 - u - v - w, u, v, w};
}

SamplesInCell::SamplesInCell(std::span<const Vec3> places) {
    std::vector<Place> numbered;
    numbered.reserve(places.size());
    for (const Vec3& place : places) {
        numbered.push_back({place, static_cast<std::uint32_t>(numbered.size())});
    }
    tree_ = BoxTree<Place>(
        std::move(numbered), leaf_size, [](auto& node, const Place& place) { node.box.extend(place.position); },
        [](const Place& place, int axis) { return place.position[axis]; });
}

void SamplesInCell::find(const CellPoints& cell, std::vector<Inside>& found) const {
    found.clear();
    const Planes planes(cell);
    const auto wanted = [&](const auto& node) { return !planes.misses(node.box); };
    static_cast<void>(tree_.any(wanted, [&](const Place& place) {
        const auto weights = weights_at(cell, place.position);
        if (std::ranges::all_of(weights, [](double w) { return w >= -1e-12; })) {
            found.push_back({place.sample, weights});
        }
        return false;  // all are wanted
    }));
}

}  // namespace terratet
