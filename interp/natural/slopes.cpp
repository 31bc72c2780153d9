// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/natural/slopes.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "interp/base/stamped.hpp"

namespace terratet {
namespace {

constexpr double spread_min = 1.0 / 30;  // along an axis, of that along the widest
constexpr std::size_t rings_min = 2;
constexpr std::size_t ring_enough = 64;  // sites seen; then the first ring does
constexpr std::size_t enough = 128;      // sites seen; then the rest of a further ring need not be asked for
constexpr std::size_t reach_max = 4000;  // sites asked for at all, in either way
constexpr std::uint32_t farther_per_octant = 4;

enum State : std::uint8_t { untouched, claimed, fitted };

struct Seen {
    std::int32_t vertex;
    Eigen::Vector3d offset;
    double weight;
};

/// The axes along which the sites that are seen spread.
struct Spread {
    explicit Spread(const std::vector<Seen>& seen) {
        Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
        for (const Seen& s : seen) {
            sum += s.weight * s.offset * s.offset.transpose();
        }
        axes.compute(sum);
        least = spread_min * spread_min * axes.eigenvalues()[2];
    }
    [[nodiscard]] bool determines(int axis) const {
        return axes.eigenvalues()[axis] > 0 && axes.eigenvalues()[axis] >= least;
    }
    [[nodiscard]] bool determines_all() const { return determines(0); }  // ascending

    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes;
    double least;
};

/// Walks outwards from a site, ring by ring of natural neighbours.
class Surroundings {
  public:
    Surroundings(const SiteMesh& sites, const SheetSides& sides, const Stars& stars, std::int32_t site)
        : sites_(sites), sides_(sides), stars_(stars), points_(sites.tessellation().points()), site_(site) {
        number_.clear(points_.size());
        number_.insert(site);
        ring_ = {site};
        sides.squared_distances(site, sheet_distances_);
    }

    const std::vector<Seen>& look() {
        std::size_t asked = 0;
        for (std::size_t ring = 1; asked < reach_max && next_ring(); ++ring) {
            asked += next_.size();
            if (look_at_ring(ring)) {
                return seen_;
            }
        }
        take_across();
        if (!Spread(seen_).determines_all()) {
            look_farther();
            take_across();
        }
        return seen_;
    }

  private:
    /// Neighbours tell too little: what is seen over them, on all sides.
    void look_farther() {
        std::size_t asked = 0;
        const auto usable = [&](std::uint32_t i) {
            const auto vertex = static_cast<std::int32_t>(i);
            if (number_.contains(vertex) || asked == reach_max) {
                return false;
            }
            ++asked;
            const double open = sites_.openness(sites_.place(site_), vertex);
            if (open > 0) {
                add(vertex, open);
            }
            return open > 0;
        };
        std::vector<NearSite> near;
        sites_.tree().neighbourhood(
            point(site_), {.max_points = 8 * farther_per_octant, .per_octant = farther_per_octant}, usable, near);
    }
    /// True when what was seen is enough.
    bool look_at_ring(std::size_t ring) {
        ring_.clear();
        for (const auto& [squared_distance, vertex] : next_) {
            const double open = sites_.openness(sites_.place(site_), vertex);
            if (open > 0) {
                add(vertex, open);
            }
            if (open > 0 || ring < rings_min) {  // what is hidden in the first ring may be all there is
                ring_.push_back(vertex);
            }
            if (open > 0 && ring > 1 && seen_.size() >= enough && seen_.size() % ring_enough == 0 &&
                Spread(seen_).determines_all()) {
                return true;
            }
        }
        if (ring < rings_min && seen_.size() < ring_enough) {
            return false;
        }
        if (!Spread(seen_).determines_all() && ring > rings_min) {
            take_across();
        }
        return Spread(seen_).determines_all();
    }
    void take_across() {
        seen_.insert(seen_.end(), across_.begin(), across_.end());
        across_.clear();
    }

    /// What lies around the last ring, nearest first. False at the end of all.
    bool next_ring() {
        next_.clear();
        const CompactDelaunay& mesh = sites_.tessellation();
        for (const std::int32_t from : ring_) {
            for (const std::int32_t cell : stars_.of(from)) {
                for (const std::int32_t v : mesh.cells()[static_cast<std::size_t>(cell)].vertex) {
                    if (!number_.contains(v) && !mesh.is_ghost(v)) {
                        number_.insert(v);
                        next_.emplace_back(squared_distance(point(site_), point(v)), v);
                    }
                }
            }
        }
        std::sort(next_.begin(), next_.end());
        return !next_.empty();
    }
    void add(std::int32_t vertex, double open) {
        const Vec3 d = point(vertex) - point(site_);
        auto& list = sides_.part(site_, vertex, sheet_distances_) ? across_ : seen_;
        list.push_back({vertex, {d.x, d.y, d.z}, open / length(d)});
    }
    [[nodiscard]] const Vec3& point(std::int32_t v) const { return points_[static_cast<std::size_t>(v)]; }

    const SiteMesh& sites_;
    const SheetSides& sides_;
    const Stars& stars_;
    std::span<const Vec3> points_;
    std::int32_t site_;
    static thread_local StampedSet number_;
    std::vector<std::int32_t> ring_;
    std::vector<std::pair<double, std::int32_t>> next_;
    std::vector<double> sheet_distances_;
    std::vector<Seen> seen_;
    std::vector<Seen> across_;  ///< past a fault's end
};
thread_local StampedSet Surroundings::number_;

}  // namespace

Slopes::Slopes(const SiteMesh& sites, std::vector<std::span<const double>> columns)
    : sites_(sites),
      sides_(sites),
      columns_(std::move(columns)),
      vertex_of_(static_cast<std::size_t>(sites.tessellation().site_count())),
      states_(std::make_unique<std::atomic<std::uint8_t>[]>(vertex_of_.size())),
      shapes_(std::make_unique_for_overwrite<Shape[]>(vertex_of_.size())),
      slopes_(std::make_unique_for_overwrite<Slope[]>(vertex_of_.size() * columns_.size())) {
    for (std::int32_t v = 0; v < sites.tessellation().site_count(); ++v) {
        vertex_of_[sites.original(v)] = v;
    }
}

void Slopes::fit(std::int32_t site, Shape& shape, std::span<Slope> slopes) const {
    std::call_once(stars_wanted_, [&] { stars_ = std::make_unique<const Stars>(sites_.tessellation()); });
    Surroundings surroundings(sites_, sides_, *stars_, site);
    const auto& seen = surroundings.look();
    shape = {};
    std::fill(slopes.begin(), slopes.end(), Slope{});
    if (seen.empty()) {
        return;
    }
    const Spread spread(seen);
    Eigen::Matrix3d inverse = Eigen::Matrix3d::Zero();  // of Σ w d dᵀ, on the axes that are determined
    std::size_t determined = 0;
    for (int i = 0; i < 3; ++i) {
        if (spread.determines(i)) {
            const Eigen::Vector3d axis = spread.axes.eigenvectors().col(i);
            inverse += axis * axis.transpose() / spread.axes.eigenvalues()[i];
            ++determined;
        }
    }
    Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
    double total = 0;
    for (const Seen& s : seen) {
        squares += s.weight * s.weight * s.offset * s.offset.transpose();
        total += s.weight;
    }
    const Eigen::Matrix3d c = inverse * squares * inverse;
    shape = {c(0, 0), c(1, 1), c(2, 2), c(0, 1), c(0, 2), c(1, 2)};
    const auto n = static_cast<double>(seen.size());
    const double freedom = std::max(1.0, n - static_cast<double>(determined));
    for (std::size_t k = 0; k < columns_.size(); ++k) {
        const auto difference = [&](const Seen& s) {
            return columns_[k][sites_.original(s.vertex)] - columns_[k][sites_.original(site)];
        };
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        for (const Seen& s : seen) {
            sum += s.weight * difference(s) * s.offset;
        }
        const Eigen::Vector3d g = inverse * sum;
        double scatter = 0;
        for (const Seen& s : seen) {
            const double off = difference(s) - g.dot(s.offset);
            scatter += s.weight * off * off;
        }
        slopes[k] = {{g.x(), g.y(), g.z()}, scatter / total * n / freedom};
    }
}

Slopes::Fitted Slopes::at(std::uint32_t site, std::size_t column) const {
    const std::size_t first = site * columns_.size();
    auto& state = states_[site];
    std::uint8_t now = state.load(std::memory_order_acquire);
    if (now == untouched && state.compare_exchange_strong(now, claimed, std::memory_order_acquire)) {
        fit(vertex_of_[site], shapes_[site], {&slopes_[first], columns_.size()});
        state.store(fitted, std::memory_order_release);
        now = fitted;
    }
    if (now == fitted) {
        return {shapes_[site], slopes_[first + column]};
    }
    // Another thread is at it: rather than wait, the same once more.
    thread_local Shape shape;
    thread_local std::vector<Slope> slopes;
    slopes.resize(columns_.size());
    fit(vertex_of_[site], shape, slopes);
    return {shape, slopes[column]};
}

Slopes::Part Slopes::along_lever(std::size_t column, const Weights& weights) const {
    const Vec3& l = weights.lever;
    Vec3 gradient;
    double variance = 0;
    for (const auto& [site, weight] : weights.slope_terms.empty() ? weights.terms : weights.slope_terms) {
        const auto [shape, slope] = at(site, column);
        gradient = gradient + weight * slope.gradient;
        variance += std::abs(weight) * slope.scatter *
                    (shape[0] * l.x * l.x + shape[1] * l.y * l.y + shape[2] * l.z * l.z +
                     2 * (shape[3] * l.x * l.y + shape[4] * l.x * l.z + shape[5] * l.y * l.z));
    }
    return {dot(gradient, l), variance};
}

}  // namespace terratet
