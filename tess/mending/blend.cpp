// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/mending/blend.hpp"

#include <algorithm>

namespace terratet {
namespace {

constexpr double short_of_vertex = 1e-3;  ///< of the way to it: it may stand on a fault
constexpr std::size_t max_steps = 200;

}  // namespace

bool is_hidden(const BarrierQuery& barriers, const Vec3& p, const Vec3& vertex) {
    return !barriers.empty() && barriers.crosses_any(p, vertex + short_of_vertex * (p - vertex));
}

Blend OwnSideField::at(const Vec3& p, std::uint32_t cell) const {
    std::array<double, 4> weights = weights_in(cell, p);
    for (std::size_t step = 0; step < max_steps; ++step) {
        const auto k = static_cast<std::size_t>(std::ranges::min_element(weights) - weights.begin());
        const std::int32_t next = mesh_.neighbours[cell][k];
        if (weights[k] >= 0 || next < 0 || gap_[static_cast<std::size_t>(next)] >= 0) {
            break;
        }
        cell = static_cast<std::uint32_t>(next);
        weights = weights_in(cell, p);
    }
    return seen_from(p, cell, weights);
}

std::array<double, 4> OwnSideField::weights_in(std::uint32_t cell, const Vec3& p) const {
    const auto& v = mesh_.cells[cell];
    std::array<double, 4> volumes{};
    double sum = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        std::array<Vec3, 4> q{};
        for (std::size_t i = 0; i < 4; ++i) {
            q[i] = i == k ? p : mesh_.points[v[i]];
        }
        volumes[k] = dot(cross(q[1] - q[0], q[2] - q[0]), q[3] - q[0]);
        sum += volumes[k];
    }
    for (double& volume : volumes) {
        volume = sum > 0 ? volume / sum : 0.25;
    }
    return volumes;
}

Blend OwnSideField::seen_from(const Vec3& p, std::uint32_t cell, const std::array<double, 4>& weights) const {
    const auto& v = mesh_.cells[cell];
    std::array<std::size_t, 4> order{0, 1, 2, 3};
    std::ranges::sort(order, [&](std::size_t i, std::size_t j) {
        return weights[i] != weights[j] ? weights[i] > weights[j] : v[i] < v[j];
    });
    Blend result;
    std::size_t count = 0;
    double sum = 0;
    for (const std::size_t i : order) {
        if (weights[i] > 0 && !is_hidden(barriers_, p, mesh_.points[v[i]])) {
            result.vertices[count] = v[i];
            result.weights[count] = weights[i];
            sum += weights[i];
            ++count;
        }
    }
    if (count == 0) {
        result.vertices[0] = v[order[0]];
        result.weights[0] = sum = 1;
    }
    for (double& weight : result.weights) {
        weight /= sum;
    }
    return result;
}

}  // namespace terratet
