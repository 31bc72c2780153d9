// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/mesh/mesh_walk.hpp"

#include <algorithm>

namespace terratet {

namespace {

constexpr double inside = -1e-9;

std::array<double, 4> barycentric(const TetMesh& mesh, std::uint32_t cell, const Vec3& p) {
    const auto& v = mesh.cells[cell];
    const Vec3 a = mesh.points[v[0]] - p;
    const Vec3 b = mesh.points[v[1]] - p;
    const Vec3 c = mesh.points[v[2]] - p;
    const Vec3 d = mesh.points[v[3]] - p;
    std::array<double, 4> w{dot(b, cross(c, d)), -dot(a, cross(c, d)), dot(a, cross(b, d)), -dot(a, cross(b, c))};
    const double sum = w[0] + w[1] + w[2] + w[3];
    for (double& x : w) {
        x /= sum;
    }
    return w;
}

bool contains(const std::array<double, 4>& weights) {
    return std::ranges::all_of(weights, [](double w) { return w >= inside; });  // NaN is not inside
}

}  // namespace

std::optional<CellPosition> MeshWalk::locate(const Vec3& p) {
    const auto cell_count = static_cast<std::uint32_t>(mesh_.cells.size());
    if (cell_count == 0) {
        return std::nullopt;
    }
    std::uint32_t cell = last_;
    for (int step = 0; step < 10000; ++step) {
        const auto weights = barycentric(mesh_, cell, p);
        if (contains(weights)) {
            last_ = cell;
            return CellPosition{cell, weights};
        }
        const auto worst = static_cast<std::size_t>(std::ranges::min_element(weights) - weights.begin());
        const std::int32_t next = mesh_.neighbours[cell][worst];
        if (next < 0) {
            break;  // outside, or misled by rounding: the search below knows
        }
        cell = static_cast<std::uint32_t>(next);
    }
    for (cell = 0; cell < cell_count; ++cell) {
        const auto weights = barycentric(mesh_, cell, p);
        if (contains(weights)) {
            last_ = cell;
            return CellPosition{cell, weights};
        }
    }
    return std::nullopt;
}

}  // namespace terratet
