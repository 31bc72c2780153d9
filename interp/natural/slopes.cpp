// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/natural/slopes.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <optional>
#include <cmath>

#include "interp/natural/surroundings.hpp"

namespace terratet {
namespace {

enum State : std::uint8_t { untouched, claimed, fitted };

}  // namespace

Slopes::Slopes(const SiteMesh& sites, std::vector<std::span<const double>> columns)
    : sites_(sites),
      sides_(sites),
      columns_(std::move(columns)),
      vertex_of_(static_cast<std::size_t>(sites.tessellation().site_count())),
      states_(std::make_unique<std::atomic<std::uint8_t>[]>(vertex_of_.size())),
      shapes_(std::make_unique_for_overwrite<Shape[]>(vertex_of_.size())),
      slopes_(std::make_unique_for_overwrite<Slope[]>(vertex_of_.size() * columns_.size())),
      squared_reaches_(std::make_unique_for_overwrite<double[]>(vertex_of_.size())) {
    for (std::int32_t v = 0; v < sites.tessellation().site_count(); ++v) {
        vertex_of_[sites.original(v)] = v;
    }
}

const Stars& Slopes::stars() const {
    std::call_once(stars_wanted_, [&] { stars_ = std::make_unique<const Stars>(sites_.tessellation()); });
    return *stars_;
}

double Slopes::fit(std::int32_t site, Shape& shape, std::span<Slope> slopes) const {
    Surroundings surroundings(sites_, sides_, stars(), site);
    const auto& seen = surroundings.look();
    shape = {};
    std::fill(slopes.begin(), slopes.end(), Slope{});
    if (seen.empty()) {
        return surroundings.squared_reach();
    }
    const Spread spread(seen);
    Eigen::Matrix3d inverse = Eigen::Matrix3d::Zero();  // of Σ w d dᵀ, on the axes that are determined
    std::size_t determined = 0;
    for (int i = 0; i < 3; ++i) {
        if (spread.determines(i)) {
            const Eigen::Vector3d axis = spread.axis(i);
            inverse += axis * axis.transpose() / spread.square(i);
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
    return surroundings.squared_reach();
}

Slopes::Fitted Slopes::at(std::uint32_t site, std::size_t column) const {
    const std::size_t first = site * columns_.size();
    auto& state = states_[site];
    std::uint8_t now = state.load(std::memory_order_acquire);
    if (now == untouched && state.compare_exchange_strong(now, claimed, std::memory_order_acquire)) {
        squared_reaches_[site] = fit(vertex_of_[site], shapes_[site], {&slopes_[first], columns_.size()});
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

std::vector<std::int32_t> Slopes::take_over(const Slopes& before, std::span<const std::int64_t> before_of,
                                            std::span<const Vec3> touched) const {
    std::vector<std::int32_t> stale;
    std::vector<std::uint32_t> doubtful;  // to be fitted again, and compared
    const Box3 box = bounding_box(touched);
    const std::optional<SiteTree> tree = touched.empty() ? std::nullopt : std::make_optional<SiteTree>(touched);
    std::vector<NearSite> near;
    const auto is_touched = [&](const Vec3& p, double squared_reach) {
        if (!tree || squared_distance(p, box.clamped(p)) > squared_reach) {
            return false;
        }
        near.clear();
        tree->nearest(p, 1, squared_reach, near);
        return !near.empty();
    };
    for (std::size_t site = 0; site < before_of.size(); ++site) {
        if (before_of[site] < 0) {
            continue;
        }
        const auto old = static_cast<std::size_t>(before_of[site]);
        if (before.states_[old].load(std::memory_order_acquire) != fitted) {
            continue;
        }
        const std::int32_t vertex = before.vertex_of_[old];
        const Vec3& p = before.sites_.tessellation().points()[static_cast<std::size_t>(vertex)];
        if (is_touched(p, before.squared_reaches_[old])) {
            doubtful.push_back(static_cast<std::uint32_t>(site));
            continue;
        }
        shapes_[site] = before.shapes_[old];
        std::copy_n(&before.slopes_[old * columns_.size()], columns_.size(), &slopes_[site * columns_.size()]);
        squared_reaches_[site] = before.squared_reaches_[old];
        states_[site].store(fitted, std::memory_order_release);
    }
    std::vector<std::uint8_t> differs(doubtful.size());
    tbb::parallel_for(std::size_t(0), doubtful.size(), [&](std::size_t i) {
        const std::uint32_t site = doubtful[i];
        const auto old = static_cast<std::size_t>(before_of[site]);
        bool same = true;
        for (std::size_t c = 0; c < columns_.size(); ++c) {
            const auto [shape, slope] = at(site, c);
            same = same && shape == before.shapes_[old] && slope == before.slopes_[old * columns_.size() + c];
        }
        differs[i] = same ? 0 : 1;
    });
    for (std::size_t i = 0; i < doubtful.size(); ++i) {
        if (differs[i] != 0) {
            stale.push_back(before.vertex_of_[static_cast<std::size_t>(before_of[doubtful[i]])]);
        }
    }
    std::sort(stale.begin(), stale.end());
    return stale;
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
