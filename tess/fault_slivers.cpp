// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/fault_slivers.hpp"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Delaunay_triangulation_cell_base_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "tess/fault_mesh.hpp"
#include "tess/quality.hpp"

namespace terratet {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_3<std::uint32_t, Kernel>;
using Delaunay = CGAL::Delaunay_triangulation_3<
    Kernel, CGAL::Triangulation_data_structure_3<VertexBase, CGAL::Delaunay_triangulation_cell_base_3<Kernel>>>;
using Vertex = Delaunay::Vertex_handle;
using Cell = Delaunay::Cell_handle;
using Corners = std::array<std::uint32_t, 4>;  ///< sites

constexpr double flat_deg = 1.2;  ///< a degree, and something for what sealing moves later
constexpr int rounds = 6;
constexpr std::uint64_t tries = 6;  ///< for each sliver in a round

std::uint64_t mixed(std::uint64_t key) {  // splitmix64's finaliser
    key += 0x9e3779b97f4a7c15ULL;
    key = (key ^ (key >> 30)) * 0xbf58476d1ce4e5b9ULL;
    key = (key ^ (key >> 27)) * 0x94d049bb133111ebULL;
    return key ^ (key >> 31);
}

Kernel::Point_3 to_cgal(const Vec3& p) {
    return {p.x, p.y, p.z};
}

/// Site 2k is the + seed of pair k, site 2k + 1 its − seed.
class Mender {
  public:
    Mender(std::vector<MovablePair>& pairs, double reach, const Frame& frame, const MayMove& may_move, const Poll& poll)
        : pairs_(pairs), given_(pairs), reach_(reach), frame_(frame), may_move_(may_move), poll_(poll) {
        std::vector<std::pair<Kernel::Point_3, std::uint32_t>> points;
        for (std::uint32_t k = 0; k < pairs.size(); ++k) {
            points.emplace_back(to_cgal(pairs[k].plus), 2 * k);
            points.emplace_back(to_cgal(pairs[k].minus), 2 * k + 1);
        }
        tessellation_.insert(points.begin(), points.end());
        vertices_.resize(points.size());
        for (const auto vertex : tessellation_.finite_vertex_handles()) {
            vertices_[vertex->info()] = vertex;
        }
    }

    SliversMended run() {
        SliversMended result;
        result.moved.assign(pairs_.size(), 0);
        for (std::uint64_t round = 0;; ++round) {
            const std::vector<Corners> slivers = find_slivers();
            result.after = slivers.size();
            result.before = round == 0 ? slivers.size() : result.before;
            if (slivers.empty() || round == rounds) {
                break;
            }
            for (const Corners& sliver : slivers) {
                ask(poll_);
                mend(sliver, round * tries);
            }
        }
        for (std::size_t k = 0; k < pairs_.size(); ++k) {
            result.moved[k] = pairs_[k].plus != given_[k].plus || pairs_[k].minus != given_[k].minus ? 1 : 0;
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
        bool plus = false;
        bool minus = false;
        bool one = true;
        for (std::size_t i = 0; i < 4; ++i) {
            v[i] = cell->vertex(static_cast<int>(i))->info();
            plus = plus || v[i] % 2 == 0;
            minus = minus || v[i] % 2 == 1;
            one = one && pairs_[v[i] / 2].owner == pairs_[v[0] / 2].owner;
        }
        if (one && plus && minus) {
            return false;
        }
        const CellPoints points{position(v[0]), position(v[1]), position(v[2]), position(v[3])};
        static const double sharp = sharpness(std::cos(flat_deg * std::numbers::pi / 180));
        if (cell_sharpness(points, -1, sharp) <= sharp) {
            return false;
        }
        const CellQuality quality = cell_quality(points);
        return quality.dihedral_min_deg < flat_deg && !(quality.circumradius > reach_ && quality.volume > 0);
    }

    [[nodiscard]] std::vector<Corners> find_slivers() const {
        std::vector<Corners> slivers;
        for (const auto cell : tessellation_.finite_cell_handles()) {
            if (Corners v{}; is_sliver(cell, v)) {
                std::ranges::sort(v);
                slivers.push_back(v);
            }
        }
        std::ranges::sort(slivers);
        return slivers;
    }

    /// Of the cells round these sites.
    [[nodiscard]] std::size_t slivers_round(const std::set<std::uint32_t>& sites) const {
        std::set<Corners> slivers;
        std::vector<Cell> cells;
        for (const std::uint32_t site : sites) {
            cells.clear();
            tessellation_.incident_cells(vertices_[site], std::back_inserter(cells));
            for (const Cell& cell : cells) {
                if (Corners v{}; is_sliver(cell, v)) {
                    std::ranges::sort(v);
                    slivers.insert(v);
                }
            }
        }
        return slivers.size();
    }

    void add_neighbours(std::uint32_t site, std::set<std::uint32_t>& sites) const {
        std::vector<Vertex> round;
        tessellation_.finite_adjacent_vertices(vertices_[site], std::back_inserter(round));
        for (const Vertex& vertex : round) {
            sites.insert(vertex->info());
        }
    }

    void mend(const Corners& sliver, std::uint64_t first) {
        Cell cell;
        for (std::uint64_t number = first; number < first + tries; ++number) {
            if (!tessellation_.is_cell(vertices_[sliver[0]], vertices_[sliver[1]], vertices_[sliver[2]],
                                       vertices_[sliver[3]], cell)) {
                return;
            }
            try_to_move(sliver[mixed(number) % 4] / 2, number);
        }
    }

    void try_to_move(std::uint32_t pair, std::uint64_t number) {
        const MovablePair before = pairs_[pair];
        if (before.along <= 0 && before.height <= 0) {
            return;
        }
        const MovablePair after = proposal(pair, number);
        if (after.plus == after.minus || !may_move_(pair, after.plus, after.minus)) {
            return;
        }
        std::set<std::uint32_t> sites{2 * pair, 2 * pair + 1};
        add_neighbours(2 * pair, sites);
        add_neighbours(2 * pair + 1, sites);
        const std::size_t slivers_before = slivers_round(sites);
        put(pair, after);
        if (slivers_round(sites) >= slivers_before) {
            put(pair, before);
        }
    }

    [[nodiscard]] MovablePair proposal(std::uint32_t pair, std::uint64_t number) const {
        const auto random = [&](std::uint64_t which) {
            return static_cast<double>(mixed(mixed(4 * number + which) ^ pair) >> 11U) * 0x1p-53;
        };
        MovablePair result = given_[pair];
        const Vec3 middle = 0.5 * (result.plus + result.minus);
        const Vec3 half = (1 + result.height * (2 * random(0) - 1)) * (0.5 * (result.plus - result.minus));
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

    void put(std::uint32_t pair, const MovablePair& at) {
        for (const std::uint32_t site : {2 * pair, 2 * pair + 1}) {
            tessellation_.remove(vertices_[site]);
        }
        pairs_[pair] = at;
        for (const std::uint32_t site : {2 * pair, 2 * pair + 1}) {
            vertices_[site] = tessellation_.insert(to_cgal(position(site)));
            vertices_[site]->info() = site;
        }
    }

    std::vector<MovablePair>& pairs_;
    std::vector<MovablePair> given_;
    double reach_;
    const Frame& frame_;
    const MayMove& may_move_;
    const Poll& poll_;
    Delaunay tessellation_;
    std::vector<Vertex> vertices_;  ///< by site
};

}  // namespace

SliversMended mend_slivers(std::vector<MovablePair>& pairs, double reach, const Frame& frame, const MayMove& may_move,
                           const Poll& poll) {
    return Mender(pairs, reach, frame, may_move, poll).run();
}

}  // namespace terratet
