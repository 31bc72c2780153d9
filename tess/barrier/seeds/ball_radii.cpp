// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/barrier/seeds/ball_radii.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tess/base/random_share.hpp"

namespace terratet {
namespace {

constexpr double widest = 0.06;  ///< by which part a radius may grow
constexpr double lift = 0.6;     ///< by which part seeds may be lifted that give up their certificate,
constexpr double aside = 0.1;    ///< and how far they then stand aside, over the edges
constexpr double reach = 1.5;    ///< of the grid of seeds, over the largest radius: they move less than the rest

}  // namespace

BallPair radical_pair(const TriangleCorners& c, const std::array<double, 3>& radii) {
    const Vec3 u = c[1] - c[0];
    const Vec3 w = c[2] - c[0];
    const double uu = squared_length(u);
    const double uw = dot(u, w);
    const double ww = squared_length(w);
    const double determinant = uu * ww - uw * uw;
    if (!(determinant > 1e-12 * uu * ww)) {
        return {};
    }
    const double square = radii[0] * radii[0];
    const double first = 0.5 * (uu + square - radii[1] * radii[1]);
    const double second = 0.5 * (ww + square - radii[2] * radii[2]);
    const Vec3 x = ((first * ww - second * uw) / determinant) * u + ((second * uu - first * uw) / determinant) * w;
    const double height_squared = square - squared_length(x);
    return height_squared > 1e-6 * square ? BallPair{c[0] + x, std::sqrt(height_squared)} : BallPair{};
}

BallRadii::BallRadii(const BallTask& task, std::span<const Vec3> places)
    : task_(task),
      seeds_(places, reach * std::ranges::max(task.radii)),
      star_(task.radii.size()),
      given_(task.radii.begin(), task.radii.end()),
      most_(task.radii.size(), std::numeric_limits<double>::infinity()),
      triangle_(places.size() / 2, -1) {
    std::vector<double> largest;
    const SheetComplex& complex = task.complex;
    for (std::uint32_t t = 0; t < complex.triangles.size(); ++t) {
        largest.resize(std::max<std::size_t>(largest.size(), complex.sheet[t] + 1), 0);
        for (const std::uint32_t v : complex.triangles[t]) {
            largest[complex.sheet[t]] = std::max(largest[complex.sheet[t]], given_[v]);
        }
    }
    for (std::uint32_t t = 0; t < complex.triangles.size(); ++t) {
        for (const std::uint32_t v : complex.triangles[t]) {
            most_[v] = std::min(most_[v], largest[complex.sheet[t]]);
            if (task.pairs[t].height > 0) {
                star_[v].push_back(t);
                triangle_[task.numbers[t]] = t;
            }
        }
    }
}

std::vector<PairMove> BallRadii::propose(std::size_t pair, std::uint64_t number, const std::vector<MovablePair>& now) {
    if (triangle_[pair] < 0) {
        return {};
    }
    lifted_ = -1;
    const auto t = static_cast<std::size_t>(triangle_[pair]);
    if (number >= last_resort_from && number % 2 == 1) {
        return lifted(pair, number);
    }
    if (task_.placed[t] == 0) {
        return {};
    }
    point_ = task_.complex.triangles[t][mixed_key(number) % 3];
    const double share = random_share(mixed_key(number) ^ pair);
    radius_ = std::min(most_[point_], given_[point_] * (1 + widest * share));
    if (std::abs(radius_ - task_.radii[point_]) < 1e-4 * radius_) {
        return {};
    }
    const double before = std::exchange(task_.radii[point_], radius_);
    const std::vector<std::uint32_t>& star = star_[point_];
    pairs_.clear();
    bool good = true;
    for (const std::uint32_t s : star) {
        const Triangle& v = task_.complex.triangles[s];
        const BallPair fresh =
            radical_pair(corners(task_.complex, s), {task_.radii[v[0]], task_.radii[v[1]], task_.radii[v[2]]});
        pairs_.emplace_back(s, std::exchange(task_.pairs[s], fresh));
        good = good && fresh.height > 0 && fresh.height <= highest(s);
    }
    std::vector<PairMove> moves;
    if (good) {
        const auto seeds = settled_seeds(task_.complex, task_.radii, task_.pairs, ball_depth, star, round(star));
        for (std::size_t i = 0; i < star.size(); ++i) {
            moves.push_back(
                {task_.numbers[star[i]], task_.frame.snapped(seeds[i][0]), task_.frame.snapped(seeds[i][1])});
            good = good && task_.sees(star[i], seeds[i][0]) && task_.sees(star[i], seeds[i][1]);
        }
        good = good && fits(point_, radius_, moves, now);
    }
    task_.radii[point_] = before;
    for (auto& [s, kept] : pairs_) {
        std::swap(task_.pairs[s], kept);
    }
    return good ? moves : std::vector<PairMove>{};
}

/// No pair is wider than the balls were at first.
double BallRadii::highest(std::uint32_t t) const {
    const Triangle& v = task_.complex.triangles[t];
    return std::max({given_[v[0]], given_[v[1]], given_[v[2]]}) / (1 + widest);
}

/// Higher over its foot, and a little aside.
std::vector<PairMove> BallRadii::lifted(std::size_t pair, std::uint64_t number) {
    const auto t = static_cast<std::uint32_t>(triangle_[pair]);
    const TriangleCorners c = corners(task_.complex, t);
    const auto share = [&](std::uint64_t which) { return random_share(mixed_key(3 * number + which) ^ pair); };
    const Triangle& v = task_.complex.triangles[t];
    const BallPair over = radical_pair(c, {task_.radii[v[0]], task_.radii[v[1]], task_.radii[v[2]]});
    if (!(over.height > 0)) {
        return {};
    }
    const Vec3 foot = over.foot + aside * ((2 * share(0) - 1) * (c[1] - c[0]) + (2 * share(1) - 1) * (c[2] - c[0]));
    const Vec3 up = std::min(highest(t), over.height * (1 + lift * share(2))) * unit(area_vector(c));
    const PairMove move{pair, task_.frame.snapped(foot + up), task_.frame.snapped(foot - up)};
    if (!clear_of_balls(move, 0.1 * ball_tolerance) || !task_.sees(t, move.plus) || !task_.sees(t, move.minus)) {
        return {};
    }
    lifted_ = t;
    return {move};
}

void BallRadii::accept() {
    if (lifted_ >= 0) {
        const auto t = static_cast<std::uint32_t>(lifted_);
        task_.placed[t] = 0;
        task_.pairs[t] = {};
        for (const std::uint32_t v : task_.complex.triangles[t]) {
            std::erase(star_[v], t);
        }
        return;
    }
    task_.radii[point_] = radius_;
    for (const auto& [s, fresh] : pairs_) {
        task_.pairs[s] = fresh;
    }
}

/// Of the corners of certified triangles.
bool BallRadii::clear_of_balls(const PairMove& move, double tolerance) const {
    bool clear = true;
    for (const Vec3& seed : {move.plus, move.minus}) {
        task_.points.visit(seed, [&](std::uint32_t v) {
            clear = clear && (task_.certified[v] == 0 ||
                              distance(task_.points.point(v), seed) >= task_.radii[v] * (1 - tolerance));
        });
    }
    return clear;
}

/// \pre The radius is that of the point.
bool BallRadii::fits(std::uint32_t point, double radius, const std::vector<PairMove>& moves,
                     const std::vector<MovablePair>& now) const {
    bool good = std::ranges::all_of(moves, [&](const PairMove& move) { return clear_of_balls(move, ball_tolerance); });
    const Vec3& center = task_.points.point(point);
    seeds_.visit(center, [&](std::uint32_t site) {
        const bool moves_too = std::ranges::find(moves, site / 2, &PairMove::pair) != moves.end();
        const Vec3& seed = site % 2 == 0 ? now[site / 2].plus : now[site / 2].minus;
        good = good && (moves_too || distance(center, seed) >= radius * (1 - 0.1 * ball_tolerance));
    });
    return good;
}

/// All that share a corner with one of them.
std::vector<std::uint32_t> BallRadii::round(std::span<const std::uint32_t> triangles) const {
    std::vector<std::uint32_t> result;
    for (const std::uint32_t t : triangles) {
        for (const std::uint32_t v : task_.complex.triangles[t]) {
            result.insert(result.end(), star_[v].begin(), star_[v].end());
        }
    }
    std::ranges::sort(result);
    result.erase(std::ranges::unique(result).begin(), result.end());
    return result;
}

}  // namespace terratet
