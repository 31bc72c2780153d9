// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/verify.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "tess/barrier/query/protection_radii.hpp"
#include "tess/base/tetrahedron.hpp"
#include "tess/cells.hpp"
#include "tess/cells/crossing_edges.hpp"
#include "tess/edit/sweep.hpp"
#include "tess/edit/verify_tolerance.hpp"
#include "tess/mesh/quality.hpp"
#include "tess/model/density_edition.hpp"
#include "tess/refine/refine.hpp"

namespace terratet {

namespace {

std::string show(const Model& model, const Vec3& local) {
    const Vec3 p = model.frame.to_world(local);
    std::ostringstream text;
    text.precision(12);
    text << "(" << p.x << ", " << p.y << ", " << p.z << ")";
    return text.str();
}

/// Collects offenders: the first few by name, all by number.
class Offenders {
  public:
    void add(const std::string& what) {
        if (++count_ <= 3) {
            list_ += (list_.empty() ? "" : "; ") + what;
        }
    }
    [[nodiscard]] Verdict verdict(std::string guarantee, std::string statement, const std::string& figures) const {
        const std::string detail = count_ == 0 ? figures : std::to_string(count_) + " offenders: " + list_;
        return {std::move(guarantee), count_ == 0, std::move(statement), detail};
    }

  private:
    std::size_t count_ = 0;
    std::string list_;
};

/// By brute force over all triangles.
bool in_protection_zone(const Model& model, const std::vector<std::vector<double>>& radii, const Vec3& p) {
    for (std::size_t f = 0; f < model.barriers.size(); ++f) {
        std::size_t next = 0;
        for (const Surface* part : {&model.barriers[f].sheet, &model.barriers[f].margin}) {
            for (const Triangle& t : part->triangles) {
                const auto& v = part->vertices;
                const Vec3 q = closest_point_on_triangle(p, v[t[0]], v[t[1]], v[t[2]]);
                if (distance(p, q) < radii[f][next++] * (1 + 1e-9)) {
                    return true;
                }
            }
        }
    }
    return false;
}

class Verifier {
  public:
    Verifier(const VerifiedState& state, const ValueSourceFactory& factory, bool edited, const VerifyOptions& options)
        : model_(state.model),
          edited_(edited),
          options_(options),
          proximity_(state.barriers),
          factory_(factory),
          source_(state.source),
          tessellation_(state.tessellation),
          mesh_(state.mesh),
          table_(state.cells) {
        for (const Vertex& vertex : model_.vertices) {
            if (vertex.role == Role::sample) {
                kept_.push_back(vertex.position);
            }
        }
    }

    std::vector<Verdict> run(const Progress& progress) {
        std::vector<Verdict> verdicts;
        const auto steps = {&Verifier::d1, &Verifier::d2, &Verifier::d3, &Verifier::v1, &Verifier::t1,
                            &Verifier::t2, &Verifier::f1, &Verifier::r1, &Verifier::r2, &Verifier::r3,
                            &Verifier::r4, &Verifier::r5, &Verifier::r6, &Verifier::r7, &Verifier::volume};
        for (const auto step : steps) {
            report_progress(progress, "check",
                            static_cast<double>(verdicts.size()) / static_cast<double>(steps.size()));
            verdicts.push_back((this->*step)());
        }
        return verdicts;
    }

  private:
    [[nodiscard]] const Vec3& point(std::uint32_t v) const { return mesh_.points[v]; }
    [[nodiscard]] CellPoints corners(std::size_t c) const {
        const auto& v = mesh_.cells[c];
        return {point(v[0]), point(v[1]), point(v[2]), point(v[3])};
    }

    Verdict d1() {
        Offenders offenders;
        const Sweep kept(kept_);
        for (const Vec3& p : kept_) {
            const double l_min = resolution_.sample_l_min(p);
            if (kept.any_of(p, l_min, [&](const Vec3& q) {
                    return p != q && squared_distance(p, q) < std::pow(std::min(l_min, resolution_.sample_l_min(q)), 2);
                })) {
                offenders.add("sample at " + show(model_, p));
            }
        }
        return offenders.verdict("D1", "no two kept samples are closer than lmin",
                                 std::to_string(kept_.size()) + " kept samples");
    }

    Verdict d2() {
        Offenders offenders;
        const Sweep kept(kept_);
        std::size_t dropped = 0;
        std::vector<std::vector<double>> radii;
        for (std::size_t f = 0; f < model_.barriers.size(); ++f) {
            radii.push_back(protection_radii(model_.barriers, f));
        }
        for (const Vec3& p : model_.samples.positions) {
            if (!model_.domain.extent.contains(p) || kept.contains(p)) {
                continue;
            }
            ++dropped;
            const auto any = [](const Vec3&) { return true; };
            if (!kept.any_of(p, resolution_.sample_l_min(p), any) && !in_protection_zone(model_, radii, p)) {
                offenders.add("sample at " + show(model_, p));
            }
        }
        return offenders.verdict("D2", "every dropped sample has a kept one within lmin or lies by a fault",
                                 std::to_string(dropped) + " dropped samples");
    }

    /// The samples in reversed order.
    [[nodiscard]] Samples reversed_samples() const {
        std::vector<std::uint32_t> order(model_.samples.size());
        for (std::uint32_t i = 0; i < order.size(); ++i) {
            order[i] = static_cast<std::uint32_t>(order.size()) - 1 - i;
        }
        return selected(model_.samples, order);
    }

    Verdict d3() {
        Offenders offenders;
        if (edited_) {
            return offenders.verdict("D3", "which samples are kept does not depend on their order",
                                     "not asked: the model was edited, and an edit thins only what it adds");
        }
        std::vector<std::uint32_t> inside;
        const Samples reversed = reversed_samples();
        for (const std::uint32_t i : canonical_order(reversed)) {
            if (model_.domain.extent.contains(reversed.positions[i])) {
                inside.push_back(i);
            }
        }
        const Samples samples = selected(reversed, inside);
        std::vector<Vec3> again;
        for (const std::uint32_t i : edit_density(samples, resolution_, model_.density, proximity_).kept) {
            again.push_back(samples.positions[i]);
        }
        std::vector<Vec3> kept = kept_;
        std::ranges::sort(kept);
        std::ranges::sort(again);
        if (kept != again) {
            offenders.add(std::to_string(again.size()) + " would be kept of the samples in reversed order");
        }
        return offenders.verdict("D3", "which samples are kept does not depend on their order",
                                 "the same " + std::to_string(kept.size()) + " in reversed order");
    }

    Verdict v1() {
        Offenders offenders;
        std::size_t values = 0;
        for (std::size_t i = 0; i < model_.vertices.size(); ++i) {
            const Vertex& vertex = model_.vertices[i];
            if (vertex.role != Role::sample) {
                continue;
            }
            const auto owner = static_cast<std::size_t>(vertex.owner);
            for (std::size_t p = 0; p < model_.properties.size(); ++p) {
                const double measured = model_.samples.values[p][owner];
                values += std::isnan(measured) ? 0 : 1;
                if (!std::isnan(measured) && measured != model_.vertex_values.values[p][i]) {
                    offenders.add(model_.properties[p].name + " at " + show(model_, vertex.position));
                }
            }
        }
        return offenders.verdict("V1", "kept samples carry their measured values", std::to_string(values) + " values");
    }

    Verdict t1() {
        const auto [holds, detail] = verify_between_samples(model_, mesh_, table_, source_);
        return {"T1", holds, "between samples the field is within the tolerance of the estimator", detail};
    }

    Verdict t2() {
        const auto [holds, detail] = verify_samples(model_, mesh_, table_, proximity_);
        return {"T2", holds, "every sample is met within the tolerance, or counted with its reason", detail};
    }

    Verdict f1() {
        Offenders offenders;
        for (const CrossingEdge& edge : fault_crossing_edges(model_, mesh_, proximity_)) {
            offenders.add("edge " + show(model_, point(edge.a)) + " to " + show(model_, point(edge.b)) + " crosses '" +
                          model_.barriers[static_cast<std::size_t>(edge.barrier)].name + "'");
        }
        return offenders.verdict(
            "F1", "in the extent no edge crosses a fault but between seeds of it or of faults that meet it",
            std::to_string(model_.barriers.size()) + " faults");
    }

    Verdict r1() {
        const auto inserted = std::ranges::count(model_.vertices, Role::inserted, &Vertex::role);
        const double bound = resolution_.packing_bound();
        Offenders offenders;
        if (static_cast<double>(inserted) > bound) {
            offenders.add(std::to_string(inserted) + " inserted");
        }
        std::ostringstream figures;
        figures << inserted << " inserted, bound " << static_cast<std::uint64_t>(bound);
        return offenders.verdict("R1", "inserted vertices stay within the packing bound", figures.str());
    }

    /// The insertion criteria as the user stated them, from the cell's own measures.
    [[nodiscard]] bool meets_criteria(std::size_t c) const {
        constexpr double slack = 1 + 1e-9;
        const Criteria& limits = model_.criteria;
        const CellQuality q = cell_quality(corners(c));
        const bool shape = (limits.radius_edge == 0 || q.radius_edge <= limits.radius_edge * slack) &&
                           (limits.aspect == 0 || q.aspect <= limits.aspect * slack) &&
                           (limits.v_max == 0 || q.volume <= limits.v_max * slack) &&
                           q.longest_edge <= resolution_.l_max(corners(c)) * slack;
        return shape && meets_variation(c);
    }

    [[nodiscard]] bool meets_variation(std::size_t c) const {
        for (std::size_t p = 0; p < model_.criteria.variation.size(); ++p) {
            const double limit = model_.criteria.variation[p].df_max;
            const auto& column = model_.vertex_values.values[p];
            for (const auto& [i, j] : cell_edges) {
                const auto a = mesh_.cells[c][i];
                const auto b = mesh_.cells[c][j];
                if (limit > 0 && scaled_difference(model_.properties[p], column[a], column[b]) > limit * (1 + 1e-9) &&
                    !proximity_.seen_by(p).crosses_any(point(a), point(b))) {
                    return false;
                }
            }
        }
        return true;
    }

    Verdict r2() {
        Offenders offenders;
        std::size_t excused = 0;
        for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
            if (table_.barrier[c] >= 0) {
                continue;
            }
            const bool good = meets_criteria(c);
            excused += good ? 0 : 1;
            const bool wrong_reason =
                table_.reason[c] == Reason::too_close &&
                cell_quality(corners(c)).circumradius > resolution_.largest_l_min() * (1 + 1e-9) + 1e-6;
            if ((!good && table_.reason[c] == Reason::none) || wrong_reason) {
                offenders.add("cell at " + show(model_, corners(c)[0]));
            }
        }
        return offenders.verdict(
            "R2", "each cell meets the criteria or carries a reason",
            std::to_string(excused) + " of " + std::to_string(mesh_.cells.size()) + " cells carry a reason");
    }

    Verdict r3() {
        Offenders offenders;
        std::vector<Vec3> inserted;
        std::vector<Vec3> given;
        for (const Vertex& vertex : model_.vertices) {
            (vertex.role == Role::inserted ? inserted : given).push_back(vertex.position);
        }
        const Sweep near_inserted(inserted);
        const Sweep near_given(std::move(given));
        for (const Vec3& p : inserted) {
            const double l_min = resolution_.l_min(p);
            const bool crowded = near_given.any_of(p, l_min, [](const Vec3&) { return true; }) ||
                                 near_inserted.any_of(p, l_min, [&](const Vec3& q) {
                                     const double needed = std::min(l_min, resolution_.l_min(q));
                                     return q != p && squared_distance(p, q) < needed * needed;
                                 });
            if (crowded) {
                offenders.add("vertex at " + show(model_, p));
            }
        }
        return offenders.verdict("R3", "no inserted vertex is nearer than lmin to another",
                                 std::to_string(inserted.size()) + " inserted vertices");
    }

    Verdict r4() {
        Offenders offenders;
        double longest = 0;
        std::size_t promised = 0;
        for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
            const Circumsphere sphere = circumsphere(corners(c));
            const CellQuality q = cell_quality(corners(c));
            const double l_max = resolution_.l_max(corners(c));
            if (l_max < 4 * resolution_.l_min(sphere.center) || table_.barrier[c] >= 0 ||
                table_.reason[c] == Reason::smooth || !model_.domain.extent.contains(sphere.center) ||
                proximity_.protecting_barrier(sphere.center) >= 0) {
                continue;
            }
            ++promised;
            longest = std::max(longest, q.longest_edge);
            if (q.longest_edge > l_max * (1 + 1e-9)) {
                offenders.add("edge of " + std::to_string(q.longest_edge) + " at " + show(model_, corners(c)[0]));
            }
        }
        std::ostringstream figures;
        figures << "longest edge " << longest << " in " << promised << " cells, lmax " << model_.criteria.l_max;
        return offenders.verdict("R4", "no edge above lmax away from faults and box",
                                 promised > 0 ? figures.str() : "not promised: lmax is below 4 lmin");
    }

    Verdict r5() {
        Offenders offenders;
        if (!tessellation_.is_delaunay()) {
            offenders.add("an empty-sphere test fails");
        }
        return offenders.verdict("R5", "the tessellation is Delaunay", std::to_string(mesh_.cells.size()) + " cells");
    }

    Verdict r6() {
        const std::string statement = "the same input gives the same tessellation, in any order of rows";
        Offenders offenders;
        if (edited_) {
            return offenders.verdict("R6", statement, "not asked: the model was edited");
        }
        if (!factory_) {
            return offenders.verdict("R6", statement, "not tried: building again needs the estimator");
        }
        Site site = model_;
        site.samples = reversed_samples();
        std::ranges::reverse(site.surfaces);
        BuildReport report;
        const Model again = std::move(build(std::move(site), options_of(model_), factory_, report)->model);
        if (again.vertices.size() != model_.vertices.size()) {
            offenders.add(std::to_string(again.vertices.size()) + " vertices when built again");
        }
        for (std::size_t i = 0; i < std::min(again.vertices.size(), model_.vertices.size()); ++i) {
            if (again.vertices[i].position != model_.vertices[i].position) {
                offenders.add("vertex at " + show(model_, model_.vertices[i].position));
            }
        }
        return offenders.verdict("R6", statement, "built again from reversed rows: the same vertices");
    }

    /// Refines the tessellation that R5 has looked at: what comes after has the mesh.
    Verdict r7() {
        Offenders offenders;
        VertexValues values = model_.vertex_values;
        const ValueSource none = [&](std::span<const ValueQuery> queries) {
            return ValueBatch{std::vector(model_.properties.size(), std::vector<double>(queries.size(), missing)),
                              std::vector<double>(queries.size(), 0)};
        };
        // Whether a move would be accepted can depend on values at the new place, which only the estimator knows.
        RefineOptions options;
        options.clean_up = !edited_ && (source_ || !model_.criteria.has_variation());
        options.residuals = options_.all;
        const RefineReport report =
            refine(tessellation_, values, model_.domain, model_.frame, proximity_, model_.criteria, model_.properties,
                   source_ ? source_ : none, options, dropped_samples(model_, proximity_));
        if (report.inserted + report.moved + report.removed > 0) {
            offenders.add(std::to_string(report.inserted) + " vertices would be inserted, " +
                          std::to_string(report.moved) + " moved, " + std::to_string(report.removed) + " removed");
        }
        return offenders.verdict("R7", "refining again changes nothing",
                                 edited_            ? "nothing inserted; moves are tried by a build's last sweeps"
                                 : options.clean_up ? "nothing inserted, moved or removed"
                                                    : "nothing inserted; moves need the estimator and are not tried");
    }

    Verdict volume() {
        Offenders offenders;
        long double total = 0;
        for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
            total += static_cast<long double>(cell_quality(corners(c)).volume);
        }
        const double hull = model_.domain.hull.volume();
        const double error = std::abs(static_cast<double>(total) - hull) / hull;
        std::ostringstream figures;
        figures << "relative difference " << error;
        if (!(error <= 1e-9)) {
            offenders.add(figures.str());
        }
        return offenders.verdict("volume", "the cells fill the hull box", figures.str());
    }

    const Model& model_;
    bool edited_;
    VerifyOptions options_;
    const BarrierQuery& proximity_;
    const ValueSourceFactory& factory_;
    const ValueSource& source_;
    ResolutionField resolution_{model_.criteria, model_.domain, model_.barriers};
    Tessellation& tessellation_;
    const TetMesh& mesh_;
    const CellTable& table_;
    std::vector<Vec3> kept_;
};

}  // namespace

std::vector<Verdict> verify(const VerifiedState& state, const ValueSourceFactory& factory, const Progress& progress,
                            bool edited, const VerifyOptions& options) {
    return Verifier(state, factory, edited, options).run(progress);
}

std::vector<Verdict> verify(const Model& model, const ValueSourceFactory& factory, const Progress& progress,
                            bool edited, const VerifyOptions& options) {
    const BarrierQuery barriers = model_proximity(model);
    Tessellation tessellation = tessellate(model);
    const TetMesh mesh = tessellation.mesh();
    const CellTable cells = describe_cells(model, mesh, barriers);
    const ValueSource source = factory ? factory(model, barriers) : ValueSource();
    return verify({model, barriers, tessellation, mesh, cells, source}, factory, progress, edited, options);
}

}  // namespace terratet
