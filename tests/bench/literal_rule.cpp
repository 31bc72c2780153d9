// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// The paper's refinement to the letter, on CGAL's Delaunay triangulation and without any guard of ours: as long as a
/// cell is poor, insert the centre of its circumsphere (section 4.2 b), wherever that is. docs/olkiluoto.md cites what
/// it prints.
///
///   literal_rule [INSERTIONS=100000]
///
/// The points are the twin's: samples after density edition at L_min = 20 m, the fracture as two sets of points. A cell
/// is poor with an edge above L_max = 80 m, a volume above 72 000 m³ or β above 8, which the paper leaves open; cells
/// between the two sets are not judged, nor are V_min and edges below L_min: no insertion could mend those. It stops
/// when no cell is poor, a coordinate is no finite number, or INSERTIONS are done.

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <deque>

#include "refinement_sites.hpp"
#include "tess/barrier_query.hpp"
#include "tess/model/density_edition.hpp"

using namespace terratet;

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_3<bool, Kernel>;  // of the fracture?
using Delaunay = CGAL::Delaunay_triangulation_3<
    Kernel, CGAL::Triangulation_data_structure_3<VertexBase, CGAL::Delaunay_triangulation_cell_base_3<Kernel>>>;

constexpr double l_min = 20;
constexpr double l_max = 80;
constexpr double v_max = 72'000;
constexpr double beta_max = 8;
constexpr double gap = 1;  ///< between the fracture's two sets: the paper says "very small"

CellPoints corners(Delaunay::Cell_handle cell) {
    CellPoints points;
    for (int k = 0; k < 4; ++k) {
        const auto& p = cell->vertex(k)->point();
        points[static_cast<std::size_t>(k)] = {p.x(), p.y(), p.z()};
    }
    return points;
}

bool in_fracture(Delaunay::Cell_handle cell) {
    return cell->vertex(0)->info() && cell->vertex(1)->info() && cell->vertex(2)->info() && cell->vertex(3)->info();
}

bool poor(Delaunay::Cell_handle cell) {
    if (in_fracture(cell)) {
        return false;
    }
    const CellQuality quality = cell_quality(corners(cell));
    return !(quality.longest_edge <= l_max && quality.volume <= v_max && quality.aspect <= beta_max);
}

/// The dynamic list: cells wait in turn, known by their vertices, since other insertions may have replaced them.
class LiteralRefiner {
  public:
    explicit LiteralRefiner(Delaunay& delaunay) : delaunay_(delaunay) {
        for (const auto cell : delaunay_.finite_cell_handles()) {
            list(cell);
        }
    }

    enum class State { going, done, not_finite };

    /// One insertion, or the news that there is none to make.
    State step() {
        while (!list_.empty()) {
            const auto v = list_.front();
            list_.pop_front();
            Delaunay::Cell_handle cell;
            if (!delaunay_.is_cell(v[0], v[1], v[2], v[3], cell)) {
                continue;
            }
            const Circumsphere sphere = circumsphere(corners(cell));
            if (!is_finite(sphere.center)) {
                return State::not_finite;
            }
            const std::size_t before = delaunay_.number_of_vertices();
            const auto vertex = delaunay_.insert({sphere.center.x, sphere.center.y, sphere.center.z}, cell);
            if (delaunay_.number_of_vertices() == before) {
                continue;  // rounded onto a vertex
            }
            vertex->info() = false;
            star_.clear();
            delaunay_.finite_incident_cells(vertex, std::back_inserter(star_));
            for (const auto fresh : star_) {
                list(fresh);
            }
            return State::going;
        }
        return State::done;
    }

  private:
    void list(Delaunay::Cell_handle cell) {
        if (poor(cell)) {
            list_.push_back({cell->vertex(0), cell->vertex(1), cell->vertex(2), cell->vertex(3)});
        }
    }

    Delaunay& delaunay_;
    std::deque<std::array<Delaunay::Vertex_handle, 4>> list_;
    std::vector<Delaunay::Cell_handle> star_;
};

void add(Delaunay& delaunay, const Vec3& p, bool fracture) {
    delaunay.insert({p.x, p.y, p.z})->info() = fracture;
}

Delaunay initial(const bench::RefinementSite& twin, bool corners_of_box) {
    Delaunay delaunay;
    const std::vector<Barrier> no_faults;
    Samples samples = selected(twin.site.samples, canonical_order(twin.site.samples));
    for (const auto i : edit_density(samples, l_min, DensityMode::paper, BarrierQuery(no_faults)).kept) {
        add(delaunay, samples.positions[i], false);
    }
    const Surface& fracture = twin.site.surfaces.front();
    const auto& [a, b, c] = fracture.triangles.front();
    Vec3 normal = cross(fracture.vertices[b] - fracture.vertices[a], fracture.vertices[c] - fracture.vertices[a]);
    normal = normal / length(normal);
    for (const Vec3& p : fracture.vertices) {
        add(delaunay, p + gap / 2 * normal, true);
        add(delaunay, p - gap / 2 * normal, true);
    }
    const Box3& box = twin.options.extent;
    for (int i = 0; corners_of_box && i < 8; ++i) {
        add(delaunay, {i & 1 ? box.hi.x : box.lo.x, i & 2 ? box.hi.y : box.lo.y, i & 4 ? box.hi.z : box.lo.z}, false);
    }
    return delaunay;
}

void print(const Delaunay& delaunay, std::size_t inserted) {
    double longest = 0;
    double shortest = std::numeric_limits<double>::infinity();
    std::size_t judged = 0;
    std::size_t bad = 0;
    Box3 hull;
    for (const auto cell : delaunay.finite_cell_handles()) {
        for (const Vec3& p : corners(cell)) {
            hull.extend(p);
        }
        if (!in_fracture(cell)) {
            const CellQuality quality = cell_quality(corners(cell));
            longest = std::max(longest, quality.longest_edge);
            shortest = std::min(shortest, quality.shortest_edge);
            ++judged;
            bad += poor(cell) ? 1 : 0;
        }
    }
    std::printf("| %zu | %zu | %.3g | %.3g | %.3g | %zu (%.1f %%) |\n", inserted, delaunay.number_of_vertices(),
                hull.diagonal(), longest, shortest, bad,
                100.0 * static_cast<double>(bad) / static_cast<double>(judged));
    std::fflush(stdout);
}

void run(const bench::RefinementSite& twin, bool corners_of_box, std::size_t most) {
    Delaunay delaunay = initial(twin, corners_of_box);
    std::printf(
        "\n%s\n\n| inserted | vertices | diagonal of the hull, m | longest edge, m | shortest edge, m | poor cells "
        "|\n|---|---|---|---|---|---|\n",
        corners_of_box ? "with the corners of the site's box" : "the points alone");
    print(delaunay, 0);
    LiteralRefiner refiner(delaunay);
    std::size_t inserted = 0;
    auto state = LiteralRefiner::State::going;
    for (std::size_t next = 100; inserted < most && state == LiteralRefiner::State::going;) {
        state = refiner.step();
        inserted += state == LiteralRefiner::State::going ? 1 : 0;
        if (inserted == next || inserted == most || state != LiteralRefiner::State::going) {
            print(delaunay, inserted);
            next *= 10;
        }
    }
    std::printf("\n%s\n", state == LiteralRefiner::State::done         ? "no cell is poor: it ended by itself"
                          : state == LiteralRefiner::State::not_finite ? "stopped: a circumcentre is no finite number"
                                                                       : "stopped: as many insertions as allowed");
}

}  // namespace

int main(int argc, char** argv) {
    const std::size_t most = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 100'000;
    const bench::RefinementSite twin = bench::twin();
    run(twin, false, most);
    run(twin, true, most);
}
