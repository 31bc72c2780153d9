// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/clean_up.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tess/cells.hpp"
#include "tess/live_cell.hpp"

namespace terratet {

namespace {

using delaunay::Cell;
using delaunay::Facet;

constexpr int candidate_count = 12;
constexpr int severity_steps = 1000;
constexpr std::uint32_t in_hole = 0;

int steps_below(double value, double limit) {
    return limit > 0 && value < limit ? 1 + static_cast<int>((severity_steps - 1) * (1 - std::max(0.0, value) / limit))
                                      : 0;
}

bool falls(const std::vector<int>& after, const std::vector<int>& before) {
    return std::ranges::lexicographical_compare(after, before);
}

}  // namespace

CleanUp::CleanUp(Tessellation::Kernel& kernel, const InsertionRule& rule, const ConflictSearch& search,
                 const Criteria& criteria, const Frame& frame, Revalue revalue, const Progress& progress)
    : kernel_(kernel),
      rule_(rule),
      search_(search),
      criteria_(criteria),
      frame_(frame),
      revalue_(std::move(revalue)),
      progress_(progress),
      handles_(kernel.vertices.size()) {
    for (const auto vertex : kernel_.triangulation.finite_vertex_handles()) {
        handles_[vertex->info()] = vertex;
    }
}

CleanUpReport CleanUp::run() {
    if (kernel_.triangulation.dimension() < 3) {
        return report_;
    }
    for (bool changed = true; changed;) {
        changed = false;
        const auto waiting = patients();
        for (std::size_t i = 0; i < waiting.size(); ++i) {
            if (i % 64 == 0) {
                report_progress(progress_, "clean up", static_cast<double>(i) / static_cast<double>(waiting.size()));
            }
            changed = treat(waiting[i]) || changed;
        }
    }
    return report_;
}

int CleanUp::severity(const JudgedCell& cell) const {
    if (gap_fault(cell.vertices, kernel_.vertices) >= 0) {
        return 0;
    }
    const double angle = std::acos(sharpest_dihedral_cosine(cell.points)) * 180 / std::numbers::pi;
    const CellPoints& p = cell.points;
    const double volume = std::abs(dot(p[1] - p[0], cross(p[2] - p[0], p[3] - p[0]))) / 6;
    return std::max(steps_below(angle, criteria_.dihedral_deg), steps_below(volume, criteria_.v_min));
}

/// Cells below a clean-up limit with a vertex that may be touched, worst first.
std::vector<CleanUp::Patient> CleanUp::patients() const {
    std::vector<Patient> result;
    for (const auto cell : kernel_.triangulation.finite_cell_handles()) {
        const bool touchable = std::ranges::any_of(std::array{0, 1, 2, 3}, [&](int k) {
            return kernel_.vertices[cell->vertex(k)->info()].role == Role::inserted;
        });
        if (touchable) {
            const JudgedCell judged_cell = judged(cell);
            if (const int how_bad = severity(judged_cell); how_bad > 0) {
                result.push_back({how_bad, judged_cell.vertices});
            }
        }
    }
    std::ranges::sort(result, [](const Patient& a, const Patient& b) {
        return a.severity != b.severity ? a.severity > b.severity : a.vertices < b.vertices;
    });
    return result;
}

bool CleanUp::treat(const Patient& patient) {
    for (const std::uint32_t vertex : patient.vertices) {
        if (handles_[vertex] == delaunay::VertexHandle()) {
            return false;  // removed meanwhile, and the cell with it
        }
    }
    const auto& v = patient.vertices;
    Cell cell;
    int i = 0;
    int j = 0;
    int k = 0;
    int l = 0;
    if (!kernel_.triangulation.is_cell(handles_[v[0]], handles_[v[1]], handles_[v[2]], handles_[v[3]], cell, i, j, k,
                                       l)) {
        return false;
    }
    return std::ranges::any_of(v, [&](std::uint32_t vertex) {
        return kernel_.vertices[vertex].role == Role::inserted && mend(vertex, patient);
    });
}

/// Takes the vertex out and looks whether the hole is better without it, else with it elsewhere; failing both puts it
/// back, which restores the very same cells.
bool CleanUp::mend(std::uint32_t vertex, const Patient& patient) {
    auto& triangulation = kernel_.triangulation;
    const Vec3 old_place = kernel_.vertices[vertex].position;
    Severities star_before;
    Vec3 centre;
    double reach = std::numeric_limits<double>::infinity();
    std::vector<Cell> star;
    triangulation.finite_incident_cells(handles_[vertex], std::back_inserter(star));
    for (const Cell cell : star) {
        star_before.push_back(severity(judged(cell)));
    }
    std::vector<delaunay::VertexHandle> link;
    triangulation.finite_adjacent_vertices(handles_[vertex], std::back_inserter(link));
    std::ranges::sort(link, {}, [](delaunay::VertexHandle h) { return h->info(); });
    for (const auto neighbour : link) {
        const Vec3 p = delaunay::from_cgal(neighbour->point());
        centre = centre + p / static_cast<double>(link.size());
        reach = std::min(reach, distance(p, old_place));
    }

    hole_.clear();
    triangulation.remove_and_give_new_cells(handles_[vertex], std::back_inserter(hole_));
    std::erase_if(hole_, [&](Cell cell) { return triangulation.is_infinite(cell); });
    Severities without;
    bool sound = true;
    for (const Cell cell : hole_) {
        const JudgedCell judged_cell = judged(cell);
        without.push_back(severity(judged_cell));
        sound = sound && rule_.violation_in_force(judged_cell) <= 1;
    }
    std::ranges::sort(star_before, std::greater());
    std::ranges::sort(without, std::greater());
    std::erase(star_before, 0);
    std::erase(without, 0);
    if (sound && falls(without, star_before)) {
        handles_[vertex] = {};
        removed_.push_back(vertex);
        ++report_.removed;
        return true;
    }

    std::array<std::uint64_t, 5> seed{kernel_.vertices[vertex].id};
    for (std::size_t i = 0; i < 4; ++i) {
        seed[i + 1] = kernel_.vertices[patient.vertices[i]].id;
    }
    BallPoints ball(seed);
    for (int i = -1; i < candidate_count; ++i) {
        const Vec3 place = i < 0 ? centre : old_place + reach * (0.1 + 0.8 * i / candidate_count) * ball.next();
        if (try_place(vertex, frame_.snapped(place), star_before)) {
            ++report_.moved;
            return true;
        }
    }
    revalue_(vertex, old_place);
    put(vertex, old_place);
    return false;
}

/// With the vertex out: puts it at `place` if that is allowed and better than how things were.
bool CleanUp::try_place(std::uint32_t vertex, const Vec3& place, const Severities& star_before) {
    if (!rule_.allows(place)) {
        return false;
    }
    auto& triangulation = kernel_.triangulation;
    delaunay::Triangulation::Locate_type where{};
    int li = 0;
    int lj = 0;
    const Cell start = triangulation.locate(delaunay::to_cgal(place), where, li, lj, hole_.front());
    if (where == delaunay::Triangulation::VERTEX || triangulation.is_infinite(start)) {
        return false;
    }
    search_.find(place, start, zone_);
    revalue_(vertex, place);
    const double l_min = rule_.resolution().l_min(place);
    Severities after;
    for (const Facet& facet : zone_.boundary) {
        std::array<std::pair<std::uint32_t, Vec3>, 4> corners{};
        corners[0] = {vertex, place};
        bool finite = true;
        for (int k = 1; k < 4; ++k) {
            const auto corner = facet.first->vertex((facet.second + k) & 3);
            finite = finite && !triangulation.is_infinite(corner);
            corners[static_cast<std::size_t>(k)] = {corner->info(), delaunay::from_cgal(corner->point())};
            if (finite && distance(corners[static_cast<std::size_t>(k)].second, place) < l_min) {
                return false;
            }
        }
        if (finite) {
            const JudgedCell fresh = judged(corners);
            if (rule_.violation_in_force(fresh) > 1) {
                return false;
            }
            after.push_back(severity(fresh));
        }
    }
    // What stays of the hole counts as new as well; what goes from outside it counts as old.
    Severities before = star_before;
    for (const Cell cell : hole_) {
        cell->info().tag = in_hole;
    }
    for (const Cell cell : zone_.cells) {
        if (cell->info().tag == in_hole) {
            cell->info().tag = delaunay::none;
        } else if (!triangulation.is_infinite(cell)) {
            before.push_back(severity(judged(cell)));
        }
    }
    bool sound = true;
    for (const Cell cell : hole_) {
        if (cell->info().tag == in_hole) {
            cell->info().tag = delaunay::none;
            const JudgedCell rest = judged(cell);
            sound = sound && rule_.violation_in_force(rest) <= 1;
            after.push_back(severity(rest));
        }
    }
    std::erase(before, 0);
    std::erase(after, 0);
    std::ranges::sort(before, std::greater());
    std::ranges::sort(after, std::greater());
    if (!sound || !falls(after, before)) {
        return false;
    }
    put(vertex, place);
    return true;
}

void CleanUp::put(std::uint32_t vertex, const Vec3& place) {
    const auto handle = kernel_.triangulation.insert(delaunay::to_cgal(place), hole_.front());
    handle->info() = vertex;
    handles_[vertex] = handle;
    kernel_.vertices[vertex].position = place;
}

}  // namespace terratet
