// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Points tied to the bounds of a model: where the ground or a wall ends on another sheet, the points of both stay one.
#include <algorithm>
#include <cmath>
#include <numbers>
#include "tess/barrier/complex/complex_editor.hpp"

namespace terratet {

/// Pieces by their first triangles.
void ComplexEditor::number_bounds(std::span<const char> bounds) {
    std::vector<std::uint32_t> waiting;
    for (std::uint32_t first = 0; first < triangles_.size(); ++first) {
        const std::uint32_t sheet = triangles_[first].sheet;
        if (sheet >= bounds.size() || bounds[sheet] == 0 || triangles_[first].bound != unbound) {
            continue;
        }
        bounded_ = true;
        triangles_[first].bound = first;
        waiting.push_back(first);
        while (!waiting.empty()) {
            const Triangle corners = triangles_[waiting.back()].corners;
            waiting.pop_back();
            for (std::size_t k = 0; k < 3; ++k) {
                for (const std::uint32_t t : edge_triangles(corners[k], corners[(k + 1) % 3])) {
                    if (triangles_[t].sheet == sheet && triangles_[t].bound == unbound) {
                        triangles_[t].bound = first;
                        waiting.push_back(t);
                    }
                }
            }
        }
    }
}

ComplexEditor::Ties ComplexEditor::ties(const std::vector<std::uint32_t>& of_triangles) const {
    Ties result;
    for (const std::uint32_t t : of_triangles) {
        if (triangles_[t].bound != unbound) {
            result.push_back(triangles_[t].bound);
        }
    }
    std::ranges::sort(result);
    result.erase(std::ranges::unique(result).begin(), result.end());
    return result;
}

bool ComplexEditor::may_join(std::uint32_t from, std::uint32_t into) const {
    return !bounded_ || std::ranges::includes(ties_at(into), ties_at(from));
}

ComplexEditor::Ties ComplexEditor::common_ties(std::uint32_t u, std::uint32_t v) const {
    Ties common;
    std::ranges::set_intersection(ties_at(u), ties_at(v), std::back_inserter(common));
    return common;
}

void ComplexEditor::join_bounds() {
    for (std::uint32_t t = 0; bounded_ && t < triangles_.size(); ++t) {
        if (!triangles_[t].alive || triangles_[t].bound != unbound) {
            continue;
        }
        const Triangle c = triangles_[t].corners;
        Ties all;
        std::ranges::set_intersection(common_ties(c[0], c[1]), ties_at(c[2]), std::back_inserter(all));
        if (!all.empty()) {
            remove_triangle(t);
        }
    }
    const auto count = static_cast<std::uint32_t>(triangles_.size());
    for (std::uint32_t t = 0; bounded_ && t < count; ++t) {
        for (std::size_t k = 0; k < 3 && triangles_[t].alive && triangles_[t].bound == unbound; ++k) {
            const std::uint32_t u = triangles_[t].corners[k];
            const std::uint32_t v = triangles_[t].corners[(k + 1) % 3];
            for (const std::uint32_t bound : common_ties(u, v)) {
                flip_for(u, v, bound);
            }
        }
    }
}

/// Makes uv an edge of the bound if it is the other diagonal there.
bool ComplexEditor::flip_for(std::uint32_t u, std::uint32_t v, std::uint32_t bound) {
    const auto is_of_bound = [&](std::uint32_t t) { return triangles_[t].bound == bound; };
    if (std::ranges::any_of(edge_triangles(u, v), is_of_bound)) {
        return false;
    }
    for (const std::uint32_t t : star_[u]) {
        if (!is_of_bound(t)) {
            continue;
        }
        const Triangle c = triangles_[t].corners;
        const auto at = static_cast<std::size_t>(std::ranges::find(c, u) - c.begin());
        const std::uint32_t a = c[(at + 1) % 3];
        const std::uint32_t b = c[(at + 2) % 3];
        const std::vector<std::uint32_t> of_edge = edge_triangles(a, b);
        if (!is_feature(of_edge) && std::ranges::all_of(of_edge, is_of_bound) &&
            std::ranges::any_of(of_edge, [&](std::uint32_t other) { return has(triangles_[other].corners, v); })) {
            return turn_edge(a, b, of_edge);
        }
    }
    return false;
}

}  // namespace terratet
