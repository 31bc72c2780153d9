// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// Time to a mesh of a number of cells, side by side with TetGen, CGAL's Mesh_3 and Gmsh.
///
///   refine_bench [--runs N=5] [--cells N]… [--scaling N]…
///
/// The points of the paper's experiment in their box. Each tool's size is first chosen so that it makes about the
/// wanted number of cells (100 000 and 1 000 000 unless given); then all run in turn, N times, and the medians of their
/// CPU times are scaled to exactly that number. --scaling measures our own cost per inserted vertex and memory instead,
/// at the given numbers of cells.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <string>

#include "memory.hpp"
#include "own_mesh.hpp"
#include "refinement_sites.hpp"
#include "tess/error.hpp"

using namespace terratet;
using namespace terratet::bench;

namespace {

OwnMesh own(const PointsInBox& task, double volume, double aspect, bool plain) {
    RefineOptions options;
    options.candidates = !plain;
    options.clean_up = !plain;
    return refined(task, volume_criteria(volume, aspect), 1.2 * edge_of_volume(volume), options);
}

/// A generator to time. `volume` bounds its cells, or is that of a regular cell with edges of its size.
struct Tool {
    std::string name;
    std::function<std::optional<MeshResult>(const PointsInBox&, double volume)> run;
    double volume = 0;
    std::vector<MeshResult> results = {};

    [[nodiscard]] double median_seconds(double cells) const {
        std::vector<double> seconds;
        for (const MeshResult& result : results) {
            seconds.push_back(result.seconds * cells / static_cast<double>(result.cells));
        }
        std::ranges::sort(seconds);
        return seconds[seconds.size() / 2];
    }
};

std::vector<Tool> tools() {
    const auto ours = [](double aspect, bool plain) {
        return [=](const PointsInBox& task, double volume) { return measured(own(task, volume, aspect, plain)); };
    };
    std::vector<Tool> all = {{"Terratet, insertion alone", ours(0, true)},
                             {"Terratet", ours(0, false)},
                             {"Terratet, β ≤ 8", ours(8, false)}};
#ifdef TERRATET_TETGEN
    // O0 alone changes nothing in TetGen 1.5.0: it still mends dihedral angles above 165°, unless o says that none is.
    all.push_back(
        {"TetGen `O0o/180`", [](const auto& task, double volume) { return tetgen(task, volume, 2, "O0o/180"); }});
    all.push_back({"TetGen", [](const auto& task, double volume) { return tetgen(task, volume, 2, ""); }});
#endif
    for (const bool optimise : {false, true}) {
        for (const int threads : {1, 2}) {
            all.push_back({std::string("CGAL Mesh_3") + (threads == 2 ? ", two threads" : "") +
                               (optimise ? "" : ", not optimising"),
                           [=](const auto& task, double volume) {
                               return mesh_3(task, edge_of_volume(volume), optimise, threads);
                           }});
        }
#ifdef TERRATET_GMSH_PEER
        all.push_back({optimise ? "Gmsh" : "Gmsh, not optimising",
                       [=](const auto& task, double volume) { return gmsh(task, edge_of_volume(volume), optimise); }});
#endif
    }
    return all;
}

/// One run at tool.volume; false when the tool fails.
bool run_once(Tool& tool, const PointsInBox& task) {
    const auto result = tool.run(task, tool.volume);
    if (result) {
        tool.results.push_back(*result);
    } else {
        std::printf("%s failed\n", tool.name.c_str());
    }
    return result.has_value();
}

/// Finds the volume at which the tool makes `cells` cells within 5 %, or as near as a few tries come, the first of them
/// on fewer. Leaves one result at that volume, or none when the tool fails.
void calibrate(Tool& tool, const PointsInBox& task, double cells) {
    Tool best = tool;
    double nearest = std::numeric_limits<double>::infinity();
    const double first = std::min(cells, std::max(cells / 10, 1e5));
    tool.volume = 1.6 * task.box.volume() / first;
    for (const double next : {first, cells, cells, cells, cells}) {
        tool.results.clear();
        if (!run_once(tool, task)) {
            return;
        }
        const auto made = static_cast<double>(tool.results.front().cells);
        if (const double off = std::abs(std::log(made / cells)); off < nearest) {
            nearest = off;
            best = tool;
        }
        if (nearest < 0.05) {
            break;
        }
        tool.volume *= made / next;
    }
    tool = best;
}

void compare(const PointsInBox& task, double cells, int runs) {
    std::vector<Tool> all = tools();
    for (Tool& tool : all) {
        calibrate(tool, task, cells);
    }
    std::erase_if(all, [](const Tool& tool) { return tool.results.empty(); });
    for (int run = 1; run < runs; ++run) {
        for (Tool& tool : all) {
            run_once(tool, task);
        }
    }
    std::printf(
        "\n%.0f cells from %zu points, R/l <= 2, medians of %d\n\n| | cells | vertices | seconds | k cells/s | 1 %% of "
        "dihedrals below | cells below 5° |\n|---|---|---|---|---|---|---|\n",
        cells, task.points.size(), runs);
    for (const Tool& tool : all) {
        const MeshResult& one = tool.results.front();
        std::printf("| %s | %zu | %zu | %.3f | %.0f | %.1f° | %.3f %% |\n", tool.name.c_str(), one.cells, one.vertices,
                    tool.median_seconds(cells), cells / tool.median_seconds(cells) / 1000, one.dihedral_p1_deg,
                    one.sharp_percent);
    }
    const auto ratio = [&](const std::string& ours, const std::string& peer) {
        const auto a = std::ranges::find(all, ours, &Tool::name);
        const auto b = std::ranges::find(all, peer, &Tool::name);
        if (a != all.end() && b != all.end()) {
            std::printf("%s / %s: %.2f\n", ours.c_str(), peer.c_str(),
                        a->median_seconds(cells) / b->median_seconds(cells));
        }
    };
    std::printf("\n");
    ratio("Terratet, insertion alone", "TetGen `O0o/180`");
    for (const char* ours : {"Terratet", "Terratet, β ≤ 8"}) {
        for (const char* peer : {"TetGen", "CGAL Mesh_3, not optimising", "CGAL Mesh_3, two threads, not optimising",
                                 "CGAL Mesh_3", "CGAL Mesh_3, two threads", "Gmsh, not optimising", "Gmsh"}) {
            ratio(ours, peer);
        }
    }
    std::fflush(stdout);
}

void scaling(const PointsInBox& task, double cells, int runs) {
    for (const bool plain : {true, false}) {
        Tool tool{"", [&](const PointsInBox& t, double volume) { return measured(own(t, volume, 8, plain)); }};
        calibrate(tool, task, cells);
        const std::size_t peak = peak_memory_of([&] { own(task, tool.volume, 8, plain); });
        std::vector<double> each;
        std::size_t vertices = 0;
        std::size_t made = 0;
        for (int run = 0; run < runs; ++run) {
            const OwnMesh mesh = own(task, tool.volume, 8, plain);
            each.push_back(1e6 * mesh.refine_seconds / static_cast<double>(mesh.report.inserted));
            vertices = mesh.tessellation.vertices().size();
            made = mesh.tessellation.cell_count();
        }
        std::ranges::sort(each);
        std::printf("| %zu | %zu | %s | %.2f | %.0f |\n", made, vertices,
                    plain ? "alone" : "with candidates and clean-up", each[each.size() / 2],
                    static_cast<double>(peak) / static_cast<double>(vertices));
        std::fflush(stdout);
    }
}

}  // namespace

int main(int argc, char** argv) {
    int runs = 5;
    std::vector<double> sizes;
    std::vector<double> growth;
    for (int i = 1; i + 1 < argc; i += 2) {
        if (std::strcmp(argv[i], "--runs") == 0) {
            runs = std::max(1, std::atoi(argv[i + 1]));
        } else if (std::strcmp(argv[i], "--cells") == 0) {
            sizes.push_back(std::atof(argv[i + 1]));
        } else if (std::strcmp(argv[i], "--scaling") == 0) {
            growth.push_back(std::atof(argv[i + 1]));
        } else {
            throw UsageError(std::string("refine_bench does not know ") + argv[i]);
        }
    }
    const PointsInBox task = bare_points(twin());
    if (sizes.empty() && growth.empty()) {
        sizes = {1e5, 1e6};
    }
    for (const double cells : sizes) {
        compare(task, cells, runs);
    }
    if (!growth.empty()) {
        std::printf(
            "| cells | vertices | insertion | µs per inserted vertex | bytes per vertex |\n|---|---|---|---|---|\n");
    }
    for (const double cells : growth) {
        scaling(task, cells, runs);
    }
}
