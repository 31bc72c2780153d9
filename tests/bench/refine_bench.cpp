// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// Refinement against TetGen on the same points, to the same largest volume and radius-edge ratio, in one run.
///
///   refine_bench [RUNS]
///
/// Points: the paper's arrangement (4 holes × 42, one plane of 15 × 31) and a large one (200 holes × 50, 5 planes).
/// TetGen gets the box as its facets and the points as additional ones; we get the box's gridded faces. Both end with
/// cells below the volume and radius-edge limits. TetGen runs with its optimisation off (O0) and at its default.

#define TETLIBRARY  // the library interface of the header
#include <tetgen.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include "tess/density.hpp"
#include "tess/quality.hpp"
#include "tess/refine.hpp"
#include "tests/bench/memory.hpp"
#include "tests/support.hpp"

namespace {

using namespace terratet;

const Box3 box{{0, 0, 0}, {740, 1000, 1000}};

std::vector<Vec3> arrangement(bool large) {
    testing::Random random(5);
    Samples samples;
    const int holes = large ? 200 : 4;
    const int records = large ? 50 : 42;
    for (int hole = 0; hole < holes; ++hole) {
        const double x = large ? random(30, 710) : (hole % 2 == 0 ? 270 : 470);
        const double y = large ? random(30, 970) : (hole < 2 ? 400 : 600);
        for (int i = 0; i < records; ++i) {
            samples.positions.push_back({x + 3 * std::sin(0.1 * i) + random(0, 0.02), y + 2 * std::cos(0.13 * i),
                                         60 + (large ? 18.0 : 20.0) * i});
        }
    }
    for (int plane = 0; plane < (large ? 5 : 1); ++plane) {
        const double dip = 0.6 + 0.1 * plane;
        for (int i = 0; i < 15; ++i) {
            for (int j = 0; j < 31; ++j) {
                samples.positions.push_back(
                    {(large ? 100 + 80 * plane : 160) + 20 * i * std::cos(dip) + random(0, 1e-3),
                     (large ? 150 + 60 * plane : 150) + 20.0 * j,
                     (large ? 100 + 120 * plane : 350) + 20 * i * std::sin(dip)});
            }
        }
    }
    std::erase_if(samples.positions, [](const Vec3& p) { return !Box3{{8, 8, 8}, {732, 992, 992}}.contains(p); });
    const std::vector<Fault> no_faults;
    const auto kept = edit_density(samples, 8, DensityMode::canonical, FaultProximity(no_faults)).kept;
    std::vector<Vec3> points;
    for (const auto i : kept) {
        points.push_back(samples.positions[i]);
    }
    return points;
}

struct Result {
    std::size_t points = 0;
    std::size_t cells = 0;
    double seconds = 0;
    double dihedral_p1_deg = 0;
    double sharp_percent = 0;  ///< cells with a dihedral angle below 5°
};

class Timer {
  public:
    [[nodiscard]] double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

  private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

template <class CornersOfCell>
Result measured(std::size_t points, std::size_t cells, double seconds, const CornersOfCell& corners_of_cell) {
    std::vector<double> angles(cells);
    for (std::size_t c = 0; c < cells; ++c) {
        angles[c] = cell_quality(corners_of_cell(c)).dihedral_min_deg;
    }
    std::ranges::sort(angles);
    const auto sharp = std::ranges::lower_bound(angles, 5.0) - angles.begin();
    return {points, cells, seconds, angles[cells / 100],
            100.0 * static_cast<double>(sharp) / static_cast<double>(cells)};
}

Result ours(const std::vector<Vec3>& points, double volume, double radius_edge) {
    Criteria criteria;
    criteria.v_max = volume;
    criteria.radius_edge = radius_edge;
    criteria.aspect = 0;
    const double edge = std::cbrt(volume * 6 * std::sqrt(2.0));  // of the regular cell of that volume
    criteria.l_max = 4 * edge;                                   // not in force: volume and shape are
    criteria.l_min = edge / 8;
    const Timer timer;
    const Domain domain{box, box};
    const Frame frame;
    const std::vector<Fault> no_faults;
    std::vector<Vertex> vertices;
    for (const Vec3& p : points) {
        vertices.push_back({vertices.size(), p, Role::sample, static_cast<std::int32_t>(vertices.size()), 0});
    }
    for (const Vec3& p : face_grid(box, criteria.l_min, 1.2 * edge, points, frame)) {
        vertices.push_back({vertices.size(), p, Role::domain, -1, 0});
    }
    Tessellation tessellation;
    tessellation.insert(vertices);
    VertexValues values{{}, std::vector<double>(vertices.size(), 0)};
    const ValueSource no_values = [](std::span<const ValueQuery> queries) {
        return ValueBatch{{}, std::vector<double>(queries.size(), 0)};
    };
    refine(tessellation, values, domain, frame, FaultProximity(no_faults), criteria, {}, no_values,
           {.candidates = std::getenv("TERRATET_BENCH_PLAIN") == nullptr});
    const double seconds = timer.seconds();
    const TetMesh mesh = tessellation.mesh();
    return measured(mesh.points.size(), mesh.cells.size(), seconds, [&](std::size_t c) {
        const auto& v = mesh.cells[c];
        return CellPoints{mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]], mesh.points[v[3]]};
    });
}

Result tetgen(const std::vector<Vec3>& points, double volume, double radius_edge, const std::string& more) {
    const Timer timer;
    tetgenio in;
    tetgenio additional;
    tetgenio out;
    in.numberofpoints = 8;
    in.pointlist = new double[24];
    for (int i = 0; i < 8; ++i) {
        in.pointlist[3 * i] = (i & 1) != 0 ? box.hi.x : box.lo.x;
        in.pointlist[3 * i + 1] = (i & 2) != 0 ? box.hi.y : box.lo.y;
        in.pointlist[3 * i + 2] = (i & 4) != 0 ? box.hi.z : box.lo.z;
    }
    constexpr int faces[6][4] = {{0, 2, 6, 4}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 1, 3, 2}, {4, 5, 7, 6}};
    in.numberoffacets = 6;
    in.facetlist = new tetgenio::facet[6];
    for (int f = 0; f < 6; ++f) {
        tetgenio::facet& facet = in.facetlist[f];
        tetgenio::init(&facet);
        facet.numberofpolygons = 1;
        facet.polygonlist = new tetgenio::polygon[1];
        tetgenio::init(facet.polygonlist);
        facet.polygonlist[0].numberofvertices = 4;
        facet.polygonlist[0].vertexlist = new int[4];
        std::copy(std::begin(faces[f]), std::end(faces[f]), facet.polygonlist[0].vertexlist);
    }
    additional.numberofpoints = static_cast<int>(points.size());
    additional.pointlist = new double[3 * points.size()];
    for (std::size_t i = 0; i < points.size(); ++i) {
        additional.pointlist[3 * i] = points[i].x;
        additional.pointlist[3 * i + 1] = points[i].y;
        additional.pointlist[3 * i + 2] = points[i].z;
    }
    std::string switches = "piQq" + std::to_string(radius_edge) + "a" + std::to_string(volume) + more;
    tetrahedralize(switches.data(), &in, &out, &additional);
    const double seconds = timer.seconds();
    return measured(static_cast<std::size_t>(out.numberofpoints), static_cast<std::size_t>(out.numberoftetrahedra),
                    seconds, [&](std::size_t c) {
                        CellPoints corners;
                        for (std::size_t k = 0; k < 4; ++k) {
                            const double* p = out.pointlist + 3 * out.tetrahedronlist[4 * c + k];
                            corners[k] = {p[0], p[1], p[2]};
                        }
                        return corners;
                    });
}

double print(const std::string& tool, int runs, const std::function<Result()>& work) {
    std::vector<double> seconds;
    Result result;
    const std::size_t peak = bench::peak_memory_of([&] { work(); });
    for (int run = 0; run < runs; ++run) {
        result = work();
        seconds.push_back(result.seconds);
    }
    std::ranges::sort(seconds);
    const double median = seconds[seconds.size() / 2];
    const double rate = static_cast<double>(result.cells) / median / 1e3;
    std::printf(
        "  %-28s %9zu points %9zu cells  %7.3f s  %6.0f k cells/s  %5.0f B/vertex  1 %% of cells below %4.1f deg, %.2f "
        "%% below 5\n",
        tool.c_str(), result.points, result.cells, median, rate,
        static_cast<double>(peak) / static_cast<double>(result.points), result.dihedral_p1_deg, result.sharp_percent);
    std::fflush(stdout);
    return rate;
}

}  // namespace

int main(int argc, char** argv) {
    const int runs = argc > 1 ? std::atoi(argv[1]) : 5;
    for (const bool large : {false, true}) {
        const auto points = arrangement(large);
        for (const double volume : {60000.0, 1300.0}) {
            std::printf("%s: %zu points, V <= %g, R/l <= 2, median of %d runs\n", large ? "200 holes" : "4 holes",
                        points.size(), volume, runs);
            const double own = print("terratet", runs, [&] { return ours(points, volume, 2); });
            const double plain =
                print("TetGen, optimisation off", runs, [&] { return tetgen(points, volume, 2, "O0"); });
            const double full = print("TetGen", runs, [&] { return tetgen(points, volume, 2, ""); });
            std::printf("  cells per second: %.2f x TetGen without optimisation, %.2f x TetGen\n", own / plain,
                        own / full);
        }
    }
}
