// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/mending/mendable_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "tess/base/tetrahedron.hpp"
#include "tess/mesh/quality.hpp"

namespace terratet {
namespace {

constexpr double on_face = 1e-12;    ///< over the box's diagonal
constexpr double rounding = 1e-13;   ///< of six volumes, over the longest edge's cube
constexpr double sharpest = 1e-16;   ///< goodness of what has a volume
constexpr double least_flat = 1e-9;  ///< six volumes over the longest edge's cube: what a cell that is not judged has

}  // namespace

MendableStars::MendableStars(MendableMesh& mesh)
    : mesh_(mesh), star_(mesh.points.size()), by_place_(mesh.points.size()), rank_(mesh.points.size()) {
    for (std::uint32_t c = 0; c < mesh.cells.size(); ++c) {
        for (const std::uint32_t v : mesh.cells[c].corners) {
            star_[v].push_back(c);
        }
    }
    const double near = on_face * mesh.box.diagonal();
    for (const Vec3& p : mesh.points) {
        unsigned mask = 0;
        for (int axis = 0; axis < 3; ++axis) {
            mask |= std::abs(p[axis] - mesh.box.lo[axis]) <= near ? 1U << (2 * axis) : 0U;
            mask |= std::abs(p[axis] - mesh.box.hi[axis]) <= near ? 2U << (2 * axis) : 0U;
        }
        faces_.push_back(static_cast<std::uint8_t>(mask));
    }
    std::iota(by_place_.begin(), by_place_.end(), 0U);
    std::ranges::sort(by_place_, [&](std::uint32_t a, std::uint32_t b) {
        return std::tie(mesh.points[a], a) < std::tie(mesh.points[b], b);
    });
    for (std::uint32_t i = 0; i < by_place_.size(); ++i) {
        rank_[by_place_[i]] = i;
    }
    on_kept_.assign(mesh.points.size(), -1);
    mesh.moved.assign(mesh.points.size(), 0);
    std::ranges::sort(mesh.walls);
    changed_.assign(mesh.points.size(), 0);
}

bool MendableStars::has(const MendableMesh::Cell& cell, std::uint32_t v) {
    return std::ranges::find(cell.corners, v) != cell.corners.end();
}

std::uint32_t MendableStars::beyond(std::uint32_t c, std::size_t k) const {
    const Corners& v = cell(c).corners;
    const auto& o = facet_corners[k];
    for (const std::uint32_t other : star_[v[o[0]]]) {
        if (other != c && has(cell(other), v[o[1]]) && has(cell(other), v[o[2]])) {
            return other;
        }
    }
    return no_index;
}

bool MendableStars::is_wall(std::uint32_t c, std::size_t k) const {
    return !mesh_.walls.empty() && std::ranges::binary_search(mesh_.walls, ascending_facet(cell(c).corners, k));
}

bool MendableStars::is_kept(std::uint32_t c, std::size_t k) const {
    if (is_wall(c, k)) {
        return true;
    }
    const std::uint32_t other = beyond(c, k);
    if (other != no_index) {
        return cell(other).part != cell(c).part;
    }
    const Corners& v = cell(c).corners;
    const auto& o = facet_corners[k];
    return (faces_[v[o[0]]] & faces_[v[o[1]]] & faces_[v[o[2]]]) == 0;
}

bool MendableStars::on_kept(std::uint32_t v) {
    if (on_kept_[v] < 0) {
        on_kept_[v] = std::ranges::any_of(star_[v], [&](std::uint32_t c) {
            for (std::size_t k = 0; k < 4; ++k) {
                if (cell(c).corners[k] != v && is_kept(c, k)) {
                    return true;
                }
            }
            return false;
        });
    }
    return on_kept_[v] != 0;
}

std::vector<std::uint32_t> MendableStars::at_place_of(std::uint32_t v) {
    if (!on_kept(v)) {
        return {v};
    }
    std::size_t first = rank_[v];
    while (first > 0 && point(by_place_[first - 1]) == point(v)) {
        --first;
    }
    std::vector<std::uint32_t> result;
    for (; first < by_place_.size() && point(by_place_[first]) == point(v); ++first) {
        if (on_kept(by_place_[first]) && !star_[by_place_[first]].empty()) {
            result.push_back(by_place_[first]);
        }
    }
    return result;
}

std::array<Vec3, 4> MendableStars::points_of(const MendableMesh::Cell& cell) const {
    const Corners& v = cell.corners;
    return {point(v[0]), point(v[1]), point(v[2]), point(v[3])};
}

double MendableStars::goodness(const MendableMesh::Cell& cell, double floor) const {
    return goodness(points_of(cell), cell.judged, floor);
}

double MendableStars::goodness(std::uint32_t c) const {
    std::vector<double>& known = known_[edges_count_ ? 1 : 0];
    if (known.size() <= c) {
        known.resize(mesh_.cells.size(), std::numeric_limits<double>::quiet_NaN());
    }
    if (std::isnan(known[c])) {
        known[c] = goodness(cell(c));
    }
    return known[c];
}

void MendableStars::forget(std::uint32_t c) {
    for (std::vector<double>& known : known_) {
        if (c < known.size()) {
            known[c] = std::numeric_limits<double>::quiet_NaN();
        }
    }
}

double MendableStars::shortest_edge(const MendableMesh::Cell& cell) const {
    double shortest = std::numeric_limits<double>::infinity();
    for (const auto& [i, j] : cell_edges) {
        shortest = std::min(shortest, squared_distance(point(cell.corners[i]), point(cell.corners[j])));
    }
    return shortest;
}

double MendableStars::goodness_with(const MendableMesh::Cell& of, std::uint32_t v, const Vec3& at, double floor) const {
    std::array<Vec3, 4> points = points_of(of);
    points[static_cast<std::size_t>(std::ranges::find(of.corners, v) - of.corners.begin())] = at;
    return goodness(points, of.judged, floor);
}

bool MendableStars::changed_round(const MendableMesh::Cell& of, std::uint32_t since) const {
    return std::ranges::any_of(of.corners, [&](std::uint32_t v) { return changed_[v] > since; });
}

double MendableStars::goodness(const std::array<Vec3, 4>& p, bool judged, double floor) const {
    const double six_volumes = dot(cross(p[1] - p[0], p[2] - p[0]), p[3] - p[0]);
    double longest = 0;
    double shortest = std::numeric_limits<double>::infinity();
    for (const auto& [i, j] : cell_edges) {
        const double square = squared_distance(p[i], p[j]);
        longest = std::max(longest, square);
        shortest = std::min(shortest, square);
    }
    const double cube = longest * std::sqrt(longest);
    if (!(six_volumes > rounding * cube)) {
        return six_volumes < -rounding * cube ? -1 : 0;
    }
    if (!judged) {
        return six_volumes > least_flat * cube ? 1 : 0;
    }
    const double most = edges_count_ ? std::min(1.0, shortest / (mesh_.least_edge * mesh_.least_edge)) : 1;
    if (most <= floor) {
        return most;
    }
    const double sharp = cell_sharpness(p, -1, 1 - floor / most);
    const double angle = sharp > 0 ? std::max(1 - sharp, sharpest) : 1;
    return angle * most;
}

void MendableStars::apply(std::span<const std::uint32_t> old, std::span<const MendableMesh::Cell> fresh) {
    ++now_;
    for (const std::uint32_t c : old) {
        for (const std::uint32_t v : cell(c).corners) {
            changed_[v] = now_;
            std::erase(star_[v], c);
        }
        mesh_.cells[c].corners = {};
        forget(c);
    }
    for (std::size_t i = 0; i < fresh.size(); ++i) {
        const auto c = i < old.size() ? old[i] : static_cast<std::uint32_t>(mesh_.cells.size());
        if (c == mesh_.cells.size()) {
            mesh_.cells.emplace_back();
        }
        mesh_.cells[c] = fresh[i];
        mesh_.cells[c].touched = true;
        for (const std::uint32_t v : fresh[i].corners) {
            changed_[v] = now_;
            star_[v].push_back(c);
        }
    }
}

void MendableStars::move(std::uint32_t v, const Vec3& to) {
    mesh_.points[v] = to;
    mesh_.moved[v] = 1;
    ++now_;
    for (const std::uint32_t c : star_[v]) {
        mesh_.cells[c].touched = true;
        forget(c);
        for (const std::uint32_t corner : cell(c).corners) {
            changed_[corner] = now_;
        }
    }
}

}  // namespace terratet
