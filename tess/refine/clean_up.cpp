// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/refine/clean_up.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

#include "tess/mesh/gap_cell.hpp"

namespace terratet {

namespace {

using delaunay::Cell;
using delaunay::Facet;

constexpr int candidate_count = 12;
constexpr int candidate_count_thorough = 48;
constexpr std::size_t few_patients = 32;  ///< a thorough sweep takes some 30 ms for each
constexpr int severity_steps = 1000;
constexpr std::uint32_t in_hole = no_index - 1;  ///< a tag that nobody else gives

int steps_below(double value, double limit) {
    return limit > 0 && value < limit ? 1 + static_cast<int>((severity_steps - 1) * (1 - std::max(0.0, value) / limit))
                                      : 0;
}

}  // namespace

CleanUp::CleanUp(delaunay::Core& core, LiveVertices& vertices, const InsertionRule& rule, const ConflictSearch& search,
                 ResidualTest& residuals, const Criteria& criteria, const Frame& frame, const Progress& progress)
    : core_(core),
      vertices_(vertices),
      rule_(rule),
      search_(search),
      residuals_(residuals),
      criteria_(criteria),
      frame_(frame),
      progress_(progress),
      sharpest_(sharpness(std::cos((criteria.dihedral_deg + 0.01) * std::numbers::pi / 180))),
      handles_(core.vertices.size()) {
    for (const auto vertex : core_.triangulation.finite_vertex_handles()) {
        handles_[vertex->info()] = vertex;
    }
}

CleanUpReport CleanUp::run() {
    if (core_.triangulation.dimension() < 3) {
        return report_;
    }
    std::vector<Cell> cells;
    for (const Cell cell : core_.triangulation.finite_cell_handles()) {
        if (!clearly_above_limits(cell)) {  // a list of all would be a tenth of the memory
            cells.push_back(cell);
        }
    }
    sweep_until_settled(below_limits(std::exchange(cells, {})), true);
    return report_;
}

CleanUpReport CleanUp::run(const std::vector<Cell>& cells) {
    sweep_until_settled(below_limits(cells), false);
    return report_;
}

void CleanUp::sweep_until_settled(std::vector<Patient> all, bool last_resorts) {
    for (bool settled = false; !settled;) {
        thorough_ = false;
        settled = !sweep(all);
        while (!changed_.empty()) {  // what a change touched may be mended now; the others are asked again at the end
            all = patients_after(all);
            std::vector<Patient> touched;
            std::ranges::copy_if(all, std::back_inserter(touched), [&](const Patient& patient) {
                return std::ranges::any_of(patient.vertices, [&](std::uint32_t v) { return changed_.contains(v); });
            });
            sweep(touched);
        }
        if (settled && last_resorts && all.size() <= few_patients) {
            thorough_ = true;
            settled = !sweep(all);
            all = patients_after(all);
        }
    }
}

bool CleanUp::sweep(const std::vector<Patient>& waiting) {
    changed_.clear();
    bool changed = false;
    for (std::size_t i = 0; i < waiting.size(); ++i) {
        if (i % 64 == 0) {
            report_progress(progress_, "clean up", static_cast<double>(i) / static_cast<double>(waiting.size()));
        }
        changed = treat(waiting[i]) || changed;
    }
    return changed;
}

int CleanUp::severity(const JudgedCell& cell) const {
    if (gap_barrier(cell.vertices, core_.vertices) >= 0 || rule_.smooth(cell)) {
        return 0;
    }
    const double angle = std::acos(cosine_of(cell_sharpness(cell.points))) * 180 / std::numbers::pi;
    const double volume = std::abs(cell.sphere.six_volumes) / 6;
    return std::max(steps_below(angle, criteria_.dihedral_deg), steps_below(volume, criteria_.v_min));
}

void CleanUp::add(const JudgedCell& cell, State& state) const {
    if (const int how_bad = severity(cell); how_bad > 0) {
        state.severities.push_back(how_bad);
    }
    if (gap_barrier(cell.vertices, core_.vertices) >= 0) {
        return;
    }
    if (rule_.violation_in_force(cell) <= 1) {
        if (residuals_.active()) {
            state.unknown.push_back(cell);
        }
        return;
    }
    if (const Proposal proposal = rule_.propose(cell); proposal.reason == Reason::none) {
        state.open = true;
    } else {
        ++state.blocked;
    }
}

bool CleanUp::better(State& after, State& before) const {
    std::ranges::sort(after.severities, std::greater());
    std::ranges::sort(before.severities, std::greater());
    return !after.open && (thorough_ || after.blocked <= before.blocked) &&
           std::ranges::lexicographical_compare(after.severities, before.severities) && within_tolerance(after);
}

/// Asks the estimator: the last question, of the few changes that geometry welcomes.
bool CleanUp::within_tolerance(const State& state) const {
    if (!residuals_.active()) {
        return true;
    }
    std::vector<JudgedCell> treatable;
    std::ranges::copy_if(state.unknown, std::back_inserter(treatable),
                         [&](const JudgedCell& cell) { return rule_.propose(cell).reason == Reason::none; });
    return std::ranges::all_of(residuals_.of(treatable), [](const Residual& r) { return r.ratio <= 1; });
}

bool CleanUp::movable(std::uint32_t vertex) const {
    const Vertex& v = core_.vertices[vertex];
    return v.role == Role::inserted && handles_[vertex] != delaunay::VertexHandle() && !rule_.near_box(v.position);
}

/// The same, known what they were before the last sweep: those left of them, and those among the cells since then.
std::vector<CleanUp::Patient> CleanUp::patients_after(const std::vector<Patient>& before) const {
    std::vector<Cell> cells;
    for (const Patient& patient : before) {
        if (const auto cell = cell_of(patient)) {
            cells.push_back(*cell);  // the same vertices, but one of them may have moved
        }
    }
    for (const std::uint32_t vertex : changed_) {
        if (handles_[vertex] != delaunay::VertexHandle()) {
            core_.triangulation.finite_incident_cells(handles_[vertex], std::back_inserter(cells));
        }
    }
    return below_limits(cells);
}

/// Nearly all cells are, and this is all that is asked of them.
bool CleanUp::clearly_above_limits(Cell cell) const {
    const CellPoints p{delaunay::from_cgal(cell->vertex(0)->point()), delaunay::from_cgal(cell->vertex(1)->point()),
                       delaunay::from_cgal(cell->vertex(2)->point()), delaunay::from_cgal(cell->vertex(3)->point())};
    const double six_volumes = std::abs(dot(p[1] - p[0], cross(p[2] - p[0], p[3] - p[0])));
    return cell_sharpness(p) < sharpest_ && six_volumes > 6.01 * criteria_.v_min;
}

/// Each once, worst first.
std::vector<CleanUp::Patient> CleanUp::below_limits(const std::vector<Cell>& cells) const {
    std::vector<Patient> result;
    for (const Cell cell : cells) {
        if (clearly_above_limits(cell)) {
            continue;
        }
        const JudgedCell judged_cell = judged(cell);
        if (const int how_bad = severity(judged_cell); how_bad > 0) {
            result.push_back({how_bad, judged_cell.vertices});
        }
    }
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
}

std::optional<Cell> CleanUp::cell_of(const Patient& patient) const {
    const auto& v = patient.vertices;
    for (const std::uint32_t vertex : v) {
        if (handles_[vertex] == delaunay::VertexHandle()) {
            return std::nullopt;  // removed meanwhile, and the cell with it
        }
    }
    Cell cell;
    int i = 0;
    int j = 0;
    int k = 0;
    int l = 0;
    const bool exists =
        core_.triangulation.is_cell(handles_[v[0]], handles_[v[1]], handles_[v[2]], handles_[v[3]], cell, i, j, k, l);
    return exists ? std::optional(cell) : std::nullopt;
}

/// A cell that a change made has a vertex among these, or had one.
void CleanUp::note_change(const std::vector<Cell>& cells) {
    for (const Cell cell : cells) {
        for (int k = 0; k < 4; ++k) {
            if (!core_.triangulation.is_infinite(cell->vertex(k))) {
                changed_.insert(cell->vertex(k)->info());
            }
        }
    }
}

/// First its own vertices; in a thorough sweep then those around it, since a sliver may hang on a neighbour's place.
bool CleanUp::treat(const Patient& patient) {
    if (!cell_of(patient)) {
        return false;
    }
    const auto mends = [&](std::uint32_t vertex) { return movable(vertex) && mend(vertex, patient); };
    return std::ranges::any_of(patient.vertices, mends) ||
           (thorough_ && (std::ranges::any_of(neighbours(patient), mends) || refill_around(patient)));
}

/// All that share an edge with one of the cell's vertices, by index.
std::vector<std::uint32_t> CleanUp::neighbours(const Patient& patient) const {
    std::vector<delaunay::VertexHandle> link;
    for (const std::uint32_t vertex : patient.vertices) {
        core_.triangulation.finite_adjacent_vertices(handles_[vertex], std::back_inserter(link));
    }
    std::vector<std::uint32_t> result;
    for (const auto vertex : link) {
        if (std::ranges::find(patient.vertices, vertex->info()) == patient.vertices.end()) {
            result.push_back(vertex->info());
        }
    }
    std::ranges::sort(result);
    result.erase(std::ranges::unique(result).begin(), result.end());
    return result;
}

/// Takes the vertex out and looks whether the hole is better without it, else with it elsewhere; failing both puts it
/// back, which restores the very same cells.
bool CleanUp::mend(std::uint32_t vertex, const Patient& patient) {
    auto& triangulation = core_.triangulation;
    const Vec3 old_place = core_.vertices[vertex].position;
    State star_before;
    Vec3 centre;
    double reach = std::numeric_limits<double>::infinity();
    std::vector<Cell> star;
    triangulation.finite_incident_cells(handles_[vertex], std::back_inserter(star));
    for (const Cell cell : star) {
        add(judged(cell), star_before);
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
    State without;
    for (const Cell cell : hole_) {
        add(judged(cell), without);
    }
    if (better(without, star_before)) {
        note_change(hole_);
        handles_[vertex] = {};
        removed_.push_back(vertex);
        ++report_.removed;
        return true;
    }

    std::array<std::uint64_t, 5> seed{core_.vertices[vertex].id};
    for (std::size_t i = 0; i < 4; ++i) {
        seed[i + 1] = core_.vertices[patient.vertices[i]].id;
    }
    BallPoints ball(seed);
    std::vector<Vec3> places{centre};
    const int count = thorough_ ? candidate_count_thorough : candidate_count;
    for (int i = 0; i < count; ++i) {
        places.push_back(old_place + reach * (0.1 + 0.8 * i / count) * ball.next());
    }
    if (thorough_) {
        add_places_for_hole(ball, places);
    }
    for (const Vec3& place : places) {
        if (try_place(vertex, frame_.snapped(place), star_before)) {
            ++report_.moved;
            return true;
        }
    }
    vertices_.revalue(vertex, old_place);
    put(vertex, old_place, hole_.front());
    return false;
}

/// Where insertion itself would put a vertex into the hole, and around it.
void CleanUp::add_places_for_hole(BallPoints& ball, std::vector<Vec3>& places) const {
    std::vector<JudgedCell> cells;
    for (const Cell cell : hole_) {
        cells.push_back(judged(cell));
    }
    std::ranges::sort(cells, {}, &JudgedCell::vertices);
    for (const JudgedCell& cell : cells) {
        const Proposal proposal = rule_.propose(cell);
        if (proposal.reason == Reason::none && !proposal.projected && rule_.violation_in_force(cell) > 1) {
            places.push_back(proposal.point);
            for (int i = 0; i < 3; ++i) {
                places.push_back(proposal.point + candidate_radius * proposal.radius * ball.next());
            }
        }
    }
}

/// With the vertex out: puts it at `place` if that is allowed and better than how things were.
bool CleanUp::try_place(std::uint32_t vertex, const Vec3& place, const State& star_before) {
    if (!rule_.allows(place)) {
        return false;
    }
    auto& triangulation = core_.triangulation;
    delaunay::Triangulation::Locate_type where{};
    int li = 0;
    int lj = 0;
    const Cell start = triangulation.locate(delaunay::to_cgal(place), where, li, lj, hole_.front());
    if (where == delaunay::Triangulation::VERTEX || triangulation.is_infinite(start)) {
        return false;
    }
    search_.find(place, start, zone_);
    vertices_.revalue(vertex, place);
    const double l_min = rule_.resolution().l_min(place);
    State after;
    for (const Facet& facet : zone_.boundary) {
        std::array<std::uint32_t, 4> vertices{vertex};
        CellPoints points{place};
        bool finite = true;
        for (int k = 1; k < 4; ++k) {
            const auto corner = facet.first->vertex((facet.second + k) & 3);
            finite = finite && !triangulation.is_infinite(corner);
            vertices[static_cast<std::size_t>(k)] = corner->info();
            points[static_cast<std::size_t>(k)] = delaunay::from_cgal(corner->point());
            if (finite && distance(points[static_cast<std::size_t>(k)], place) < l_min) {
                return false;
            }
        }
        if (finite) {
            add(judged(vertices, points), after);
            if (after.open) {
                return false;
            }
        }
    }
    // What stays of the hole counts as new as well; what goes from outside it counts as old.
    State before = star_before;
    for (const Cell cell : hole_) {
        cell->info().tag = in_hole;
    }
    for (const Cell cell : zone_.cells) {
        if (cell->info().tag == in_hole) {
            cell->info().tag = no_index;
        } else if (!triangulation.is_infinite(cell)) {
            add(judged(cell), before);
        }
    }
    for (const Cell cell : hole_) {
        if (cell->info().tag == in_hole) {
            cell->info().tag = no_index;
            add(judged(cell), after);
        }
    }
    if (!better(after, before)) {
        return false;
    }
    note_change(hole_);
    note_change(zone_.cells);
    changed_.insert(vertex);
    put(vertex, place, hole_.front());
    return true;
}

void CleanUp::put(std::uint32_t vertex, const Vec3& place, Cell near) {
    const auto handle = core_.triangulation.insert(delaunay::to_cgal(place), near);
    handle->info() = vertex;
    handles_[vertex] = handle;
    core_.vertices[vertex].position = place;
}

}  // namespace terratet
