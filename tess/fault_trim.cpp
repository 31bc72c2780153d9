// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/fault_trim.hpp"

#include <map>

#include "tess/fault_clip.hpp"

namespace terratet {
namespace {

/// Distance beyond a wanted clearance, over a set of triangles with a clearance each.
class Clearance {
  public:
    /// Values are right up to `horizon` and no larger beyond.
    Clearance(std::vector<TriangleCorners> triangles, std::vector<double> wanted, double horizon)
        : wanted_(std::move(wanted)), horizon_(horizon) {
        std::vector<double> reach = wanted_;
        for (double& r : reach) {
            r += horizon;
        }
        grid_ = TriangleGrid(std::move(triangles), reach);
    }

    /// Smallest over the triangles of distance − clearance; negative: too near. Changes no faster than p moves.
    double operator()(const Vec3& p, std::uint32_t* which = nullptr) const {
        double least = horizon_;
        for (const std::uint32_t i : grid_.candidates(p)) {
            const double value = std::sqrt(grid_.squared_distance_to(i, p)) - wanted_[i];
            if (value < least) {
                least = value;
                if (which != nullptr) {
                    *which = i;
                }
            }
        }
        return least;
    }

  private:
    TriangleGrid grid_;
    std::vector<double> wanted_;
    double horizon_;
};

void add_triangles(const FaultMesh& mesh, std::vector<TriangleCorners>& to) {
    for (const Triangle& t : mesh.triangles) {
        to.push_back(corners(mesh, t));
    }
}

/// Cuts where the clearance ends, then moves triangles that come too near after all (a distance is not linear) to the
/// far side of the cut.
CutMesh cut_clear(const FaultMesh& mesh, const Clearance& clearance, double slack) {
    std::vector<double> level;
    for (const Vec3& p : mesh.points) {
        level.push_back(clearance(p) - slack);
    }
    CutMesh cut = cut_at_zero(mesh, level);
    FaultMesh clear{cut.above.points, {}};
    FaultMesh near{cut.above.points, {}};
    for (const Triangle& t : cut.above.triangles) {
        const bool safe = at_least_throughout(corners(cut.above, t), clearance, 0, 0.2 * slack);
        (safe ? clear : near).triangles.push_back(t);
    }
    compact(clear);
    compact(near);
    append(cut.below, near);
    return {std::move(clear), std::move(cut.below)};
}

}  // namespace

TrimmedFault trim_beside(const FaultMesh& sheet, const FaultMesh& around, const std::vector<Fault>& accepted,
                         double protection_radius, double width, double margin_width) {
    TrimmedFault result{sheet, around, {}};
    Box3 box = bounding_box(sheet.points);
    for (const Vec3& p : around.points) {
        box.extend(p);
    }
    std::vector<TriangleCorners> foreign;
    std::vector<double> wanted;
    std::vector<std::size_t> owner;
    for (std::size_t f = 0; f < accepted.size(); ++f) {
        const double clearance =
            std::max(accepted[f].protection_radius + 0.5 * width, protection_radius + 0.5 * accepted[f].width) *
            (1 + 1e-9);
        const Box3 near = box.grown(2 * clearance);
        for (const Surface* part : {&accepted[f].sheet, &accepted[f].margin}) {
            for (const Triangle& t : part->triangles) {
                const TriangleCorners c = {part->vertices[t[0]], part->vertices[t[1]], part->vertices[t[2]]};
                Box3 own;
                for (const Vec3& p : c) {
                    own.extend(p);
                }
                if (own.lo.x <= near.hi.x && own.hi.x >= near.lo.x && own.lo.y <= near.hi.y && own.hi.y >= near.lo.y &&
                    own.lo.z <= near.hi.z && own.hi.z >= near.lo.z) {
                    foreign.push_back(c);
                    wanted.push_back(clearance);
                    owner.push_back(f);
                }
            }
        }
    }
    if (foreign.empty()) {
        return result;
    }
    const double slack = 0.03 * protection_radius;
    const Clearance from_others(std::move(foreign), std::move(wanted), 2 * protection_radius);
    CutMesh kept_sheet = cut_clear(sheet, from_others, slack);
    CutMesh kept_around = cut_clear(around, from_others, slack);
    if (kept_sheet.below.triangles.empty() && kept_around.below.triangles.empty()) {
        return result;
    }
    std::map<std::size_t, double> taken;
    std::vector<TriangleCorners> gaps;
    add_triangles(kept_sheet.below, gaps);
    add_triangles(kept_around.below, gaps);
    for (const TriangleCorners& t : gaps) {
        std::uint32_t which = 0;
        from_others(centroid(t), &which);
        taken[owner[which]] += length(area_vector(t));
    }
    const auto most =
        std::max_element(taken.begin(), taken.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
    result.nearest = accepted[most->first].name;
    std::vector<double> width_of_gaps(gaps.size(), margin_width);
    const Clearance from_gaps(std::move(gaps), std::move(width_of_gaps), 2 * protection_radius);
    CutMesh whole = cut_clear(kept_sheet.above, from_gaps, slack);
    result.sheet = std::move(whole.above);
    result.margin = std::move(kept_around.above);
    append(result.margin, whole.below);
    return result;
}

}  // namespace terratet
