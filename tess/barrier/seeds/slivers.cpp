// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/barrier/seeds/slivers.hpp"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Delaunay_triangulation_cell_base_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>

#include "tess/base/random_share.hpp"
#include "tess/base/tri_mesh.hpp"
#include "tess/mesh/bulk_insertion.hpp"
#include "tess/mesh/quality.hpp"

namespace terratet {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_3<std::uint32_t, Kernel>;
using Delaunay = CGAL::Delaunay_triangulation_3<
    Kernel, CGAL::Triangulation_data_structure_3<VertexBase, CGAL::Delaunay_triangulation_cell_base_3<Kernel>>>;
using Vertex = Delaunay::Vertex_handle;
using Cell = Delaunay::Cell_handle;
using Corners = std::array<std::uint32_t, 4>;  ///< sites, ascending

constexpr double flat_deg = 1.1;  ///< a degree, and a little for rounding
constexpr std::uint64_t rounds = last_resort_from / 8 + 10;
constexpr std::uint64_t tries = 8;  ///< for each sliver in a round

Kernel::Point_3 to_cgal(const Vec3& p) {
    return {p.x, p.y, p.z};
}

bool fills_gap(const std::array<SliverCorner, 4>& corners, const SliverRule& rule) {
    const auto plus = std::ranges::count_if(corners, &SliverCorner::plus);
    const bool one =
        std::ranges::all_of(corners, [&](const SliverCorner& corner) { return corner.owner == corners[0].owner; });
    if (one && plus > 0 && plus < 4) {
        return true;
    }
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            if (rule.apart(corners[i].position, corners[j].position)) {
                return true;
            }
        }
    }
    return false;
}

/// Site 2k is the + seed of pair k, site 2k + 1 its − seed.
class Mender {
  public:
    Mender(std::vector<MovablePair>& pairs, const SliverTask& task, const Frame& frame, const Poll& poll)
        : pairs_(pairs), given_(pairs), task_(task), frame_(frame), poll_(poll) {
        std::vector<std::pair<Kernel::Point_3, std::uint32_t>> points;
        for (std::uint32_t k = 0; k < pairs.size(); ++k) {
            points.emplace_back(to_cgal(pairs[k].plus), 2 * k);
            points.emplace_back(to_cgal(pairs[k].minus), 2 * k + 1);
        }
        PatientPoll go_on(poll);
        delaunay::insert(tessellation_, points, go_on);
        vertices_.resize(points.size());
        for (const auto vertex : tessellation_.finite_vertex_handles()) {
            vertices_[vertex->info()] = vertex;
        }
    }

    SliversMended run() {
        SliversMended result;
        std::set<Corners> slivers = all_slivers();
        result.before = slivers.size();
        for (std::uint64_t round = 0; round < rounds && !slivers.empty(); ++round) {
            std::set<Corners> left;
            for (const Corners& sliver : slivers) {
                ask(poll_);
                mend(sliver, round * tries, left);
            }
            std::erase_if(left, [&](const Corners& sliver) { return !is_there(sliver); });
            slivers = std::move(left);
        }
        result.after = slivers.size();
        for (std::size_t k = 0; k < pairs_.size(); ++k) {
            result.moved.push_back(pairs_[k].plus != given_[k].plus || pairs_[k].minus != given_[k].minus ? 1 : 0);
        }
        return result;
    }

  private:
    [[nodiscard]] const Vec3& position(std::uint32_t site) const {
        return site % 2 == 0 ? pairs_[site / 2].plus : pairs_[site / 2].minus;
    }

    [[nodiscard]] bool is_sliver(const Cell& cell, Corners& v) const {
        if (tessellation_.is_infinite(cell)) {
            return false;
        }
        std::array<SliverCorner, 4> corners;
        for (std::size_t i = 0; i < 4; ++i) {
            v[i] = cell->vertex(static_cast<int>(i))->info();
            corners[i] = {position(v[i]), pairs_[v[i] / 2].owner, v[i] % 2 == 0};
        }
        std::ranges::sort(v);
        return terratet::is_sliver(corners, task_.rule);
    }

    [[nodiscard]] std::set<Corners> all_slivers() const {
        std::set<Corners> slivers;
        PatientPoll go_on(poll_);
        for (const auto cell : tessellation_.finite_cell_handles()) {
            go_on();
            if (Corners v{}; is_sliver(cell, v)) {
                slivers.insert(v);
            }
        }
        return slivers;
    }

    [[nodiscard]] std::set<Corners> slivers_round(const std::set<std::uint32_t>& sites) const {
        std::vector<Cell> cells;
        for (const std::uint32_t site : sites) {
            tessellation_.incident_cells(vertices_[site], std::back_inserter(cells));
        }
        std::ranges::sort(cells, std::less<>{}, [](const Cell& cell) { return &*cell; });
        cells.erase(std::ranges::unique(cells).begin(), cells.end());
        std::set<Corners> slivers;
        for (const Cell& cell : cells) {
            if (Corners v{}; is_sliver(cell, v)) {
                slivers.insert(v);
            }
        }
        return slivers;
    }

    void add_neighbours(std::uint32_t site, std::set<std::uint32_t>& sites) const {
        std::vector<Vertex> round;
        tessellation_.finite_adjacent_vertices(vertices_[site], std::back_inserter(round));
        for (const Vertex& vertex : round) {
            sites.insert(vertex->info());
        }
    }

    [[nodiscard]] bool is_there(const Corners& sliver) const {
        Cell cell;
        Corners v{};
        return tessellation_.is_cell(vertices_[sliver[0]], vertices_[sliver[1]], vertices_[sliver[2]],
                                     vertices_[sliver[3]], cell) &&
               is_sliver(cell, v);
    }

    void mend(const Corners& sliver, std::uint64_t first, std::set<Corners>& left) {
        for (std::uint64_t number = first; number < first + tries; ++number) {
            if (!is_there(sliver)) {
                return;
            }
            try_to_move(sliver[(number + mixed_key(first)) % 4] / 2, number, left);
        }
        left.insert(sliver);
    }

    void try_to_move(std::uint32_t pair, std::uint64_t number, std::set<Corners>& left) {
        const bool linked = pairs_[pair].along <= 0 && pairs_[pair].height <= 0;
        const std::vector<PairMove> after = linked ? linked_proposal(pair, number) : lone_proposal(pair, number);
        if (after.empty()) {
            return;
        }
        std::vector<PairMove> before;
        std::set<std::uint32_t> own;
        for (const PairMove& move : after) {
            const auto site = static_cast<std::uint32_t>(2 * move.pair);
            before.push_back({move.pair, position(site), position(site + 1)});
            own.insert({site, site + 1});
        }
        std::set<std::uint32_t> sites;
        for (const std::uint32_t site : own) {
            add_neighbours(site, sites);
        }
        const auto other = std::ranges::find_if(sites, [&](std::uint32_t site) { return !own.contains(site); });
        const Vertex near = other == sites.end() ? Vertex{} : vertices_[*other];
        sites.insert(own.begin(), own.end());
        const std::size_t slivers_before = slivers_round(sites).size();
        put(after, near);
        if (const std::set<Corners> slivers = slivers_round(sites); slivers.size() < slivers_before) {
            left.insert(slivers.begin(), slivers.end());
            if (linked) {
                task_.linked.accept(pair, number);
            }
        } else {
            put(before, near);
        }
    }

    [[nodiscard]] std::vector<PairMove> linked_proposal(std::uint32_t pair, std::uint64_t number) const {
        return task_.linked.propose ? task_.linked.propose(pair, number, pairs_) : std::vector<PairMove>{};
    }

    [[nodiscard]] std::vector<PairMove> lone_proposal(std::uint32_t pair, std::uint64_t number) const {
        const MovablePair at = proposal(pair, number);
        const bool fits = at.plus != at.minus && task_.may_move(pair, at.plus, at.minus);
        return fits ? std::vector<PairMove>{{pair, at.plus, at.minus}} : std::vector<PairMove>{};
    }

    [[nodiscard]] MovablePair proposal(std::uint32_t pair, std::uint64_t number) const {
        const auto random = [&](std::uint64_t which) { return random_share(mixed_key(4 * number + which) ^ pair); };
        MovablePair result = given_[pair];
        const Vec3 middle = 0.5 * (result.plus + result.minus);
        const double height = result.height * (number < last_resort_from ? 1 : task_.lower);
        const Vec3 half = (1 - height * random(0)) * (0.5 * (result.plus - result.minus));
        const Vec3 normal = unit(half);
        const Vec3 level = std::abs(normal.x) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
        const Vec3 first = unit(cross(normal, level));
        const Vec3 second = cross(normal, first);
        const double angle = 2 * std::numbers::pi * random(1);
        const double way = result.along * (0.3 + 0.7 * random(2));
        const Vec3 shift = way * (std::cos(angle) * first + std::sin(angle) * second);
        result.plus = frame_.snapped(middle + shift + half);
        result.minus = frame_.snapped(middle + shift - half);
        return result;
    }

    void put(const std::vector<PairMove>& moves, Vertex hint) {
        for (const PairMove& move : moves) {
            tessellation_.remove(vertices_[2 * move.pair]);
            tessellation_.remove(vertices_[2 * move.pair + 1]);
        }
        for (const PairMove& move : moves) {
            pairs_[move.pair].plus = move.plus;
            pairs_[move.pair].minus = move.minus;
            for (const std::size_t site : {2 * move.pair, 2 * move.pair + 1}) {
                hint = tessellation_.insert(to_cgal(position(static_cast<std::uint32_t>(site))), hint);
                hint->info() = static_cast<std::uint32_t>(site);
                vertices_[site] = hint;
            }
        }
    }

    std::vector<MovablePair>& pairs_;
    std::vector<MovablePair> given_;
    const SliverTask& task_;
    const Frame& frame_;
    const Poll& poll_;
    Delaunay tessellation_;
    std::vector<Vertex> vertices_;  ///< by site
};

}  // namespace

bool is_sliver(const std::array<SliverCorner, 4>& corners, const SliverRule& rule) {
    const CellPoints p{corners[0].position, corners[1].position, corners[2].position, corners[3].position};
    static const double sharp = sharpness(std::cos(flat_deg * std::numbers::pi / 180));
    if (cell_sharpness(p, -1, sharp) <= sharp || !rule.extent.contains(0.25 * (p[0] + p[1] + p[2] + p[3]))) {
        return false;
    }
    auto ordered = corners;  // in one order whatever the cell's, for the same rounding
    std::ranges::sort(ordered, {}, &SliverCorner::position);
    const Circumsphere ball =
        circumsphere({ordered[0].position, ordered[1].position, ordered[2].position, ordered[3].position});
    return (ball.six_volumes == 0 || ball.squared_radius <= rule.reach * rule.reach) && !fills_gap(corners, rule);
}

SliversMended mend_slivers(std::vector<MovablePair>& pairs, const SliverTask& task, const Frame& frame,
                           const Poll& poll) {
    return Mender(pairs, task, frame, poll).run();
}

}  // namespace terratet
