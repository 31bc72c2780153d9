// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/natural/linear.hpp"

#include <algorithm>

#include "interp/estimator/query_order.hpp"
#include "interp/natural/cavity.hpp"
#include "interp/natural/changed_places.hpp"
#include "interp/natural/exact_volumes.hpp"
#include "interp/natural/slopes.hpp"

namespace terratet {
namespace {

constexpr double position_tolerance = 1e-12;  // of |Σ wp − q|, in distances to the farthest corner

/// Of several cells that contain q the first, wherever the walk ended.
std::int32_t first_containing(const CompactDelaunay& mesh, const Vec3& q, const CompactDelaunay::Location& at) {
    if (at.strictly_inside) {
        return at.cell;
    }
    thread_local Cavity cavity;
    cavity.find(mesh, q, at);  // q is on none of their corners, so inside all their spheres
    std::int32_t first = at.cell;
    for (const std::int32_t id : cavity.all_cells(mesh)) {
        if (id < first && mesh.contains(mesh.cells()[static_cast<std::size_t>(id)], q)) {
            first = id;
        }
    }
    return first;
}

std::array<double, 4> barycentric(const std::array<Vec3, 4>& corners, const Vec3& q, bool& fallback) {
    std::array<double, 4> shares{};
    double total = 0, farthest = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        const auto p = [&](int i) { return corners[static_cast<std::size_t>(facet_corners[k][i])] - q; };
        shares[k] = std::max(0.0, dot(p(0), cross(p(1), p(2))));
        total += shares[k];
        farthest = std::max(farthest, length(corners[k] - q));
    }
    Vec3 mean;
    for (std::size_t k = 0; k < 4; ++k) {
        shares[k] /= total;
        mean = mean + shares[k] * (corners[k] - q);
    }
    if (!(length(mean) <= position_tolerance * farthest)) {
        fallback = true;
        return exact_barycentric(corners, q);
    }
    return shares;
}

}  // namespace

LinearInCells::LinearInCells(std::vector<Vec3> sites, const BarrierQuery* barriers, const Anisotropy& anisotropy)
    : sites_(sites, barriers, anisotropy) {}

void LinearInCells::weights(std::span<const ValueQuery> queries, std::span<Weights> out) const {
    in_spatial_order(queries, out, [&](std::span<const std::uint32_t> run) {
        std::int32_t start = run.empty() ? 0 : sites_.start_near(queries[run.front()].position);
        for (const std::uint32_t i : run) {
            estimate(queries[i].position, start, out[i]);
            sites_.number_as_given(out[i]);
        }
    });
}

std::shared_ptr<const Slopes> LinearInCells::slopes(std::vector<std::span<const double>> columns) const {
    return std::make_shared<const Slopes>(sites_, std::move(columns));
}

std::unique_ptr<const ChangedPlaces> LinearInCells::changes_since(const Estimator& before, const ExchangedSites& sites,
                                                                  const Slopes* slopes_before,
                                                                  const Slopes* slopes) const {
    const auto* same = dynamic_cast<const LinearInCells*>(&before);
    return same == nullptr ? nullptr : changed_places({same->sites_, *slopes_before}, {sites_, *slopes}, sites);
}

void LinearInCells::estimate(const Vec3& place, std::int32_t& start, Weights& out) const {
    const SiteQuery query = sites_.query(place);
    const Vec3& q = query.within;
    const auto at = sites_.locate(query, start, out);
    if (at.cell < 0) {
        return;
    }
    const CompactDelaunay& mesh = sites_.tessellation();
    const auto& cell = mesh.cells()[static_cast<std::size_t>(first_containing(mesh, q, at))];
    std::array<Vec3, 4> corners;
    for (std::size_t k = 0; k < 4; ++k) {
        corners[k] = mesh.points()[static_cast<std::size_t>(cell.vertex[k])];
    }
    sites_.weigh(query, cell.vertex, barycentric(corners, q, out.fallback), out);
}

}  // namespace terratet
