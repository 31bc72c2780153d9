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

/// The cell's four sides and its box, to pass over parts of the tree.
struct SamplesInCell::Planes {
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

SamplesInCell::SamplesInCell(std::vector<Vec3> places) : places_(std::move(places)) {
    for (std::uint32_t i = 0; i < places_.size(); ++i) {
        order_.push_back(i);
    }
    if (!order_.empty()) {
        split(0, static_cast<std::uint32_t>(order_.size()));
    }
}

void SamplesInCell::split(std::uint32_t begin, std::uint32_t end) {
    const std::size_t index = nodes_.size();
    Node node;
    node.begin = begin;
    node.end = end;
    for (std::uint32_t i = begin; i < end; ++i) {
        node.box.extend(places_[order_[i]]);
    }
    nodes_.push_back(node);
    if (end - begin <= leaf_size) {
        return;
    }
    const Vec3 size = node.box.size();
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::uint32_t middle = begin + (end - begin) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](std::uint32_t a, std::uint32_t b) { return places_[a][axis] < places_[b][axis]; });
    split(begin, middle);
    nodes_[index].right = static_cast<std::uint32_t>(nodes_.size());
    split(middle, end);
}

void SamplesInCell::find(const CellPoints& cell, std::vector<Inside>& found) const {
    found.clear();
    if (!nodes_.empty()) {
        descend(0, cell, Planes(cell), found);
    }
}

void SamplesInCell::descend(std::uint32_t index, const CellPoints& cell, const Planes& planes,
                            std::vector<Inside>& found) const {
    const Node& node = nodes_[index];
    if (planes.misses(node.box)) {
        return;
    }
    if (node.right != 0) {
        descend(index + 1, cell, planes, found);
        descend(node.right, cell, planes, found);
        return;
    }
    for (std::uint32_t i = node.begin; i < node.end; ++i) {
        const auto weights = weights_at(cell, places_[order_[i]]);
        if (std::ranges::all_of(weights, [](double w) { return w >= -1e-12; })) {
            found.push_back({order_[i], weights});
        }
    }
}

}  // namespace terratet
