// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The clean-up's last resort: vertices that give way to others.
#include <algorithm>
#include <iterator>

#include "tess/mesh/gap_cell.hpp"
#include "tess/refine/clean_up.hpp"

namespace terratet {

namespace {

using delaunay::Cell;
using delaunay::Facet;

constexpr int refill_count = 8;
constexpr int refill_count_of_three = 3;
constexpr std::size_t refill_vertices = 12;  ///< more would be another tessellation

}  // namespace

/// Each vertex of the cell gives way to others: alone, with one of its neighbours, or with two.
bool CleanUp::refill_around(const Patient& patient) {
    for (const std::uint32_t vertex : patient.vertices) {
        if (!movable(vertex)) {
            continue;
        }
        std::vector<std::uint32_t> others = neighbours({patient.severity, {vertex, vertex, vertex, vertex}});
        std::erase_if(others, [&](std::uint32_t other) { return !movable(other); });
        std::vector<std::vector<std::uint32_t>> groups{{vertex}};
        for (const std::uint32_t other : others) {
            groups.push_back({vertex, other});
        }
        for (std::size_t i = 0; i < others.size(); ++i) {
            for (std::size_t j = i + 1; j < others.size(); ++j) {
                groups.push_back({vertex, others[i], others[j]});
            }
        }
        for (const auto& group : groups) {
            std::array<std::uint64_t, 3> seed{};
            std::ranges::transform(group, seed.begin(), [&](std::uint32_t v) { return core_.vertices[v].id; });
            BallPoints ball(seed);
            const int tries = group.size() < 3 ? refill_count : refill_count_of_three;
            for (int i = 0; i < tries; ++i) {
                if (refill(group, i == 0 ? nullptr : &ball)) {
                    return true;
                }
            }
        }
    }
    return false;
}

/// Takes the vertices out and treats the bad cells there as insertion does, with other vertices at their circumcentres
/// or, with `ball`, around them, until there are none. Accepts those in their stead if that is better; else restores
/// the very same cells.
bool CleanUp::refill(const std::vector<std::uint32_t>& vertices, BallPoints* ball) {
    auto& triangulation = core_.triangulation;
    const std::size_t first = vertices_.size();
    State before;
    std::set<Cell> fresh;
    std::vector<delaunay::VertexHandle> link;
    triangulation.finite_adjacent_vertices(handles_[vertices.front()], std::back_inserter(link));
    const auto anchor = *std::ranges::find_if(
        link, [&](delaunay::VertexHandle v) { return std::ranges::count(vertices, v->info()) == 0; });
    for (const std::uint32_t vertex : vertices) {
        std::vector<Cell> cells;
        triangulation.finite_incident_cells(handles_[vertex], std::back_inserter(cells));
        for (const Cell cell : cells) {
            if (fresh.erase(cell) == 0) {
                add(judged(cell), before);
            }
        }
        cells.clear();
        triangulation.remove_and_give_new_cells(handles_[vertex], std::back_inserter(cells));
        std::ranges::copy_if(cells, std::inserter(fresh, fresh.end()),
                             [&](Cell cell) { return !triangulation.is_infinite(cell); });
    }
    bool possible = true;
    while (possible && worst_open(fresh)) {
        possible = vertices_.size() < first + refill_vertices && insert_into(fresh, ball, before);
    }
    State after;
    for (const Cell cell : fresh) {
        add(judged(cell), after);
    }
    if (possible && better(after, before)) {
        note_change({fresh.begin(), fresh.end()});
        for (const std::uint32_t vertex : vertices) {
            handles_[vertex] = {};
            removed_.push_back(vertex);
        }
        report_.removed += vertices.size();
        report_.inserted += vertices_.size() - first;
        return true;
    }
    while (vertices_.size() > first) {
        triangulation.remove(handles_.back());
        handles_.pop_back();
        vertices_.pop();
    }
    for (const std::uint32_t vertex : vertices) {
        put(vertex, core_.vertices[vertex].position, anchor->cell());
    }
    return false;
}

/// Treats the worst of the fresh cells. What that destroys of others adds to `before`.
bool CleanUp::insert_into(std::set<Cell>& fresh, BallPoints* ball, State& before) {
    const auto [bad, start] = *worst_open(fresh);
    const Proposal proposal = rule_.propose(bad);
    if (proposal.projected) {
        return false;
    }
    Vec3 place = proposal.point;
    if (ball != nullptr) {
        const Vec3 around = frame_.snapped(place + candidate_radius * proposal.radius * ball->next());
        place = rule_.allows(around) ? around : place;
    }
    if (!search_.find(place, start, zone_) || !zone_clear_of(place)) {
        return false;
    }
    for (const Cell cell : zone_.cells) {
        if (fresh.erase(cell) == 0) {
            add(judged(cell), before);
        }
    }
    auto& triangulation = core_.triangulation;
    const auto handle = triangulation.insert_in_hole(delaunay::to_cgal(place), zone_.cells.begin(), zone_.cells.end(),
                                                     zone_.boundary.front().first, zone_.boundary.front().second);
    handle->info() = vertices_.append(place);
    handles_.push_back(handle);
    triangulation.finite_incident_cells(handle, std::inserter(fresh, fresh.end()));
    return true;
}

/// Of the cells that insertion would treat the worst, by its vertices where there are several.
std::optional<std::pair<JudgedCell, Cell>> CleanUp::worst_open(const std::set<Cell>& cells) const {
    std::optional<std::pair<JudgedCell, Cell>> worst;
    double most = 1;
    for (const Cell cell : cells) {
        const JudgedCell judged_cell = judged(cell);
        if (gap_barrier(judged_cell.vertices, core_.vertices) >= 0) {
            continue;
        }
        const double violation = rule_.violation_in_force(judged_cell);
        const bool worse =
            violation > most || (worst && violation == most && judged_cell.vertices < worst->first.vertices);
        if (worse && rule_.propose(judged_cell).reason == Reason::none) {
            worst = {judged_cell, cell};
            most = violation;
        }
    }
    return worst;
}

/// Whether zone_, which is that of `place`, holds finite cells alone and no vertex nearer than l_min.
bool CleanUp::zone_clear_of(const Vec3& place) const {
    const double l_min = rule_.resolution().l_min(place);
    return std::ranges::none_of(zone_.cells, [&](Cell cell) { return core_.triangulation.is_infinite(cell); }) &&
           std::ranges::none_of(zone_.boundary, [&](const Facet& facet) {
               for (int k = 1; k < 4; ++k) {
                   const auto corner = facet.first->vertex((facet.second + k) & 3);
                   if (!core_.triangulation.is_infinite(corner) &&
                       distance(delaunay::from_cgal(corner->point()), place) < l_min) {
                       return true;
                   }
               }
               return false;
           });
}

}  // namespace terratet
