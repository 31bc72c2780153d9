// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// How many vertices a mesh within the criteria takes.
///
///   vertices_bench
///
/// First the whole job (faults in pairs, edges up to l_max, R/ℓ ≤ 2, β ≤ 8): plain circumcentre insertion against
/// insertion with candidates and clean-up. Then the bare points in the box, where TetGen can follow: its volume bound
/// is bisected until its longest edge is no longer than ours.

#include <cmath>
#include <cstdio>

#include "own_mesh.hpp"
#include "refinement_sites.hpp"
#include "tess/barrier_query.hpp"
#include "tess/value_source.hpp"

using namespace terratet;
using namespace terratet::bench;

namespace {

std::vector<RefinementSite> sites() {
    std::vector<RefinementSite> all = {twin(), made_up()};
    for (const double l_min : {300.0, 200.0}) {
        if (auto site = babbitt(l_min)) {
            site->name += l_min == 300 ? ", 300 ft" : ", 200 ft";
            all.push_back(std::move(*site));
        } else {
            std::printf("Babbitt is left out: the public data are not there\n");
        }
    }
    return all;
}

/// No property decides anything here: every value is 1.
ValueSourceFactory constant() {
    return [](const Model& model, const BarrierQuery&) -> ValueSource {
        return [count = model.properties.size()](std::span<const ValueQuery> queries) {
            return ValueBatch{std::vector(count, std::vector<double>(queries.size(), 1)),
                              std::vector<double>(queries.size(), 0)};
        };
    };
}

BuildReport built(const RefinementSite& site, bool plain) {
    BuildOptions options = site.options;
    options.refine.candidates = !plain;
    options.refine.clean_up = !plain;
    BuildReport report;
    build(site.site, options, constant(), report);
    return report;
}

void whole_job(const RefinementSite& site) {
    const BuildReport plain = built(site, true);
    const BuildReport full = built(site, false);
    const auto added = [](const BuildReport& report) { return report.final.vertices - report.initial.vertices; };
    std::printf("| %s | %zu | %zu | %zu | %.2f | %.2f | %.1f° | %.1f° |\n", site.name.c_str(), full.initial.vertices,
                plain.final.vertices, full.final.vertices,
                static_cast<double>(full.final.vertices) / static_cast<double>(plain.final.vertices),
                static_cast<double>(added(full)) / static_cast<double>(added(plain)), plain.final.dihedral_p1_deg,
                full.final.dihedral_p1_deg);
    std::fflush(stdout);
}

MeshResult own(const PointsInBox& task, const Criteria& criteria, bool plain) {
    RefineOptions options;
    options.candidates = !plain;
    options.clean_up = !plain;
    return measured(refined(task, criteria, criteria.l_max, options));
}

#ifdef TERRATET_TETGEN
/// TetGen's mesh with the largest volume bound at which no edge is longer than `edge`.
MeshResult tetgen_to_edge(const PointsInBox& task, double edge) {
    double enough = std::pow(edge / 4, 3);  // surely
    double too_much = std::pow(edge, 3);
    MeshResult best = tetgen(task, enough, 2, "");
    while (best.longest_edge > edge) {
        too_much = enough;
        enough /= 2;
        best = tetgen(task, enough, 2, "");
    }
    while (too_much / enough > 1.01) {
        const double middle = std::sqrt(enough * too_much);
        const MeshResult mesh = tetgen(task, middle, 2, "");
        if (mesh.longest_edge > edge) {
            too_much = middle;
        } else {
            enough = middle;
            best = mesh;
        }
    }
    return best;
}
#endif

void bare(const RefinementSite& site) {
    const PointsInBox task = bare_points(site);
    for (const double aspect : {8.0, 0.0}) {
        Criteria criteria = site.options.criteria;
        criteria.aspect = aspect;
        const MeshResult plain = own(task, criteria, true);
        const MeshResult full = own(task, criteria, false);
        std::printf("| %s | %zu | %s | %zu | %zu | %.2f | %.1f |", site.name.c_str(), task.points.size(),
                    aspect > 0 ? "8" : "–", plain.vertices, full.vertices,
                    static_cast<double>(full.vertices) / static_cast<double>(plain.vertices), full.longest_edge);
#ifdef TERRATET_TETGEN
        const MeshResult peer = tetgen_to_edge(task, full.longest_edge);
        std::printf(" %zu | %.2f | %.1f |", peer.vertices,
                    static_cast<double>(full.vertices) / static_cast<double>(peer.vertices), peer.longest_edge);
#endif
        std::printf("\n");
        std::fflush(stdout);
    }
}

}  // namespace

int main() {
    const auto all = sites();
    std::printf(
        "The whole job, β ≤ 8\n\n| site | initial vertices | plain | candidates, clean-up | ratio | of the inserted | "
        "1 "
        "%% of dihedrals below: plain | candidates, clean-up |\n|---|---|---|---|---|---|---|---|\n");
    for (const RefinementSite& site : all) {
        whole_job(site);
    }
    std::printf(
        "\nBare points in the box\n\n| site | points | β | plain | candidates, clean-up | ratio | longest edge | "
        "TetGen "
        "| ours / TetGen | its longest edge |\n|---|---|---|---|---|---|---|---|---|---|\n");
    for (const RefinementSite& site : all) {
        bare(site);
    }
}
