// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/natural/changed_places.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "interp/base/stamped.hpp"
#include "interp/sites/ball_bins.hpp"
#include "interp/sites/stars.hpp"

namespace terratet {
namespace {

constexpr double hair = 1e-9;              // of lengths that were computed
constexpr double thickness_change = 1.9;   // of the sites along their axes; Surroundings allows for 2
constexpr std::size_t uncertain_max = 64;  // cells whose spheres are not known: each place is asked of each

/// Some cells of a tessellation, each once.
class CellSet {
  public:
    explicit CellSet(const CompactDelaunay& mesh) : mesh_(mesh) { taken_.clear(mesh.cells().size()); }

    /// What has the place in its sphere or on it, or nearly so.
    void add_zone(const Vec3& p) {
        seen_.clear(mesh_.cells().size());
        std::vector<std::int32_t> zone;
        const auto enter = [&](std::int32_t id) {
            if (id >= 0 && !seen_.contains(id)) {
                seen_.insert(id);
                const auto& cell = mesh_.cells()[static_cast<std::size_t>(id)];
                if (!(squared_distance(p, cell.center) > (1 + hair) * cell.squared_radius)) {  // NaN: rather yes
                    zone.push_back(id);
                }
            }
        };
        enter(mesh_.locate(p, mesh_.start_near(p)).cell);
        for (std::size_t i = 0; i < zone.size(); ++i) {
            for (const std::int32_t next : mesh_.cells()[static_cast<std::size_t>(zone[i])].neighbour) {
                enter(next);
            }
        }
        std::ranges::for_each(zone, [this](std::int32_t id) { add(id); });
    }

    void add(std::int32_t id) {
        if (id >= 0 && !taken_.contains(id)) {
            taken_.insert(id);
            cells_.push_back(id);
        }
    }

    void add_neighbours() {
        for (std::size_t i = 0, end = cells_.size(); i < end; ++i) {
            for (const std::int32_t next : mesh_.cells()[static_cast<std::size_t>(cells_[i])].neighbour) {
                add(next);
            }
        }
    }

    [[nodiscard]] const std::vector<std::int32_t>& cells() const { return cells_; }

    void put_corners(std::vector<Vec3>& out) const {
        for (const std::int32_t id : cells_) {
            for (const std::int32_t v : mesh_.cells()[static_cast<std::size_t>(id)].vertex) {
                if (!mesh_.is_ghost(v)) {
                    out.push_back(mesh_.points()[static_cast<std::size_t>(v)]);
                }
            }
        }
    }

  private:
    const CompactDelaunay& mesh_;
    StampedSet seen_, taken_;
    std::vector<std::int32_t> cells_;
};

class MeshChange final : public ChangedPlaces {
  public:
    MeshChange(const SiteMesh& sites, std::vector<Ball> balls,
               std::vector<std::pair<const CompactDelaunay*, std::int32_t>> uncertain, std::vector<Vec3> exchanged,
               std::vector<std::pair<Vec3, double>> turns)
        : sites_(sites),
          balls_(sites.tessellation().box(), std::move(balls)),
          uncertain_(std::move(uncertain)),
          box_(bounding_box(exchanged)),
          exchanged_(exchanged.empty() ? std::nullopt : std::make_optional<SiteTree>(exchanged)),
          turns_(std::move(turns)) {}

    [[nodiscard]] bool at(const Vec3& place, double way) const override {
        const SiteQuery query = sites_.query(place);
        if (!is_finite(query.at)) {
            return false;
        }
        if (balls_.contains(query.within)) {
            return true;
        }
        const bool in_doubt = std::ranges::any_of(uncertain_, [&](const auto& cell) {
            return cell.first->in_conflict(cell.first->cells()[static_cast<std::size_t>(cell.second)], query.within);
        });
        return in_doubt || is_within(query.at, way * (1 + hair));
    }

  private:
    /// A changed site, or the way to one by a turn.
    [[nodiscard]] bool is_within(const Vec3& at, double way) const {
        const double squared = way * way;
        if (exchanged_ && squared_distance(at, box_.clamped(at)) <= squared) {
            thread_local std::vector<NearSite> near;
            near.clear();
            exchanged_->nearest(at, 1, squared, near);
            if (!near.empty()) {
                return true;
            }
        }
        return std::ranges::any_of(turns_,
                                   [&](const auto& turn) { return distance(at, turn.first) + turn.second <= way; });
    }

    const SiteMesh& sites_;
    BallBins balls_;
    std::vector<std::pair<const CompactDelaunay*, std::int32_t>> uncertain_;
    Box3 box_;
    std::optional<SiteTree> exchanged_;  ///< none: values alone changed
    std::vector<std::pair<Vec3, double>> turns_;
};

/// Nothing that holds for the sites as a whole has changed.
bool comparable(const SiteMesh& before, const SiteMesh& after) {
    const PrincipalBox& a = before.principal_box();
    const PrincipalBox& b = after.principal_box();
    bool alike =
        before.tessellation().box() == after.tessellation().box() && !a.flat_and_tilted() && !b.flat_and_tilted();
    for (int i = 0; i < 3; ++i) {
        alike = alike && a.thickness(i) <= thickness_change * b.thickness(i) &&
                b.thickness(i) <= thickness_change * a.thickness(i);
    }
    return alike;
}

}  // namespace

std::unique_ptr<const ChangedPlaces> changed_places(const SlopedSites& before, const SlopedSites& after,
                                                    const ExchangedSites& exchanged) {
    if (!comparable(before.sites, after.sites)) {
        return nullptr;
    }
    std::vector<Vec3> places;
    for (const Vec3& place : exchanged.places) {
        places.push_back(after.sites.index().metric()(place));
    }
    std::vector<Vec3> touched = places;
    std::vector<Ball> balls;
    std::vector<std::pair<const CompactDelaunay*, std::int32_t>> uncertain;
    const auto take = [&](const CompactDelaunay& mesh, const CellSet& set) {
        for (const std::int32_t id : set.cells()) {
            const auto& cell = mesh.cells()[static_cast<std::size_t>(id)];
            if (std::isnan(cell.squared_radius)) {
                uncertain.emplace_back(&mesh, id);
            } else {
                balls.push_back({cell.center, cell.squared_radius});
            }
        }
    };
    for (const SiteMesh* sites : {&before.sites, &after.sites}) {
        CellSet exchange(sites->tessellation());
        std::ranges::for_each(places, [&](const Vec3& p) { exchange.add_zone(p); });
        exchange.put_corners(touched);
        exchange.add_neighbours();
        take(sites->tessellation(), exchange);
    }
    CellSet sloped(before.sites.tessellation());
    for (const std::int32_t site : after.slopes.take_over(before.slopes, exchanged.before, touched)) {
        for (const std::int32_t id : before.slopes.stars().of(site)) {
            sloped.add(id);
        }
    }
    take(before.sites.tessellation(), sloped);
    if (uncertain.size() > uncertain_max) {
        return nullptr;
    }
    return std::make_unique<const MeshChange>(after.sites, std::move(balls), std::move(uncertain), std::move(places),
                                              after.sites.index().changed_ways(before.sites.index()));
}

}  // namespace terratet
