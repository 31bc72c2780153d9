// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/edit/close_crossings.hpp"

#include <algorithm>
#include <cmath>

#include "tess/mesh/quality.hpp"

namespace terratet {
namespace {

constexpr double closable = 0.99;     ///< radius of a ball that one flake closes, in protection radii
constexpr double flake_share = 1e-3;  ///< size of a flake, likewise

bool keeps_out(const Vertex& vertex) {
    return vertex.role == Role::sample || vertex.role == Role::inserted;
}

bool has(const std::array<std::uint32_t, 4>& cell, std::uint32_t vertex) {
    return std::ranges::find(cell, vertex) != cell.end();
}

/// By edge, that of its cells with the smallest ball.
std::vector<Circumsphere> smallest_balls(std::span<const CrossingEdge> edges, const TetMesh& mesh) {
    std::vector<Circumsphere> balls(edges.size());
    for (Circumsphere& ball : balls) {
        ball.squared_radius = std::numeric_limits<double>::infinity();
    }
    for (const auto& cell : mesh.cells) {
        for (std::size_t e = 0; e < edges.size(); ++e) {
            if (has(cell, edges[e].a) && has(cell, edges[e].b)) {
                const Circumsphere ball = circumsphere(cell_points(mesh, cell));
                balls[e] = ball.squared_radius < balls[e].squared_radius ? ball : balls[e];
            }
        }
    }
    return balls;
}

void add_flake(Barrier& barrier, const Vec3& center, const Frame& frame) {
    const double size = flake_share * barrier.protection_radius;
    Surface& margin = barrier.margin;
    const auto first = static_cast<std::uint32_t>(margin.vertices.size());
    for (const Vec3& corner : {center, center + Vec3{size, 0, 0}, center + Vec3{0, size, 0}}) {
        margin.vertices.push_back(frame.snapped(corner));
    }
    margin.triangles.push_back({first, first + 1, first + 2});
}

}  // namespace

bool close_crossings(std::span<const CrossingEdge> edges, const TetMesh& mesh, Model& model) {
    const std::vector<Circumsphere> balls = smallest_balls(edges, mesh);
    bool added = false;
    for (std::size_t e = 0; e < edges.size(); ++e) {
        Barrier& barrier = model.barriers[static_cast<std::size_t>(edges[e].barrier)];
        std::vector<Vec3> ends;
        for (const std::uint32_t v : {edges[e].a, edges[e].b}) {
            if (keeps_out(model.vertices[v])) {
                ends.push_back(model.vertices[v].position);
            }
        }
        if (ends.empty()) {
            continue;
        }
        if (std::sqrt(balls[e].squared_radius) <= closable * barrier.protection_radius) {
            ends = {balls[e].center};
        }
        for (const Vec3& place : ends) {
            add_flake(barrier, place, model.frame);
        }
        added = true;
    }
    return added;
}

}  // namespace terratet
