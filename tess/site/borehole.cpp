// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/borehole.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace terratet {

namespace {

constexpr double degree = std::numbers::pi / 180;

/// Directions closer than this to opposite have no arc between them.
constexpr double nearly_opposite = std::numbers::pi - 1e-6;

Vec3 direction(const SurveyStation& station) {
    const double inclination = station.inclination_deg * degree;
    const double azimuth = station.azimuth_deg * degree;
    return {std::sin(inclination) * std::sin(azimuth), std::sin(inclination) * std::cos(azimuth),
            -std::cos(inclination)};
}

/// By the arctangent: exact near 0, where an arccosine loses half of the digits.
double angle_between(const Vec3& a, const Vec3& b) {
    return std::atan2(length(cross(a, b)), dot(a, b));
}

/// Chord over arc of the mean of two tangents that are `turn` apart, the "ratio factor" 2/β·tan(β/2).
double ratio_factor(double turn) {
    return turn < 1e-6 ? 1 + turn * turn / 12 : 2 / turn * std::tan(turn / 2);
}

/// The displacement after the first `fraction` of an arc of length `arc` from tangent `from` to tangent `to`.
Vec3 along_arc(const Vec3& from, const Vec3& to, double turn, double arc, double fraction) {
    const double part = fraction * turn;
    const Vec3 tangent = turn < 1e-12 ? from : (std::sin(turn - part) * from + std::sin(part) * to) / std::sin(turn);
    return 0.5 * fraction * arc * ratio_factor(part) * (from + tangent);
}

std::vector<SurveyStation> normalized(std::vector<SurveyStation> stations) {
    if (stations.empty()) {
        return {SurveyStation{}};
    }
    std::ranges::stable_sort(stations, {}, &SurveyStation::depth);
    const auto repeated = std::ranges::unique(stations, {}, &SurveyStation::depth);
    stations.erase(repeated.begin(), repeated.end());
    if (stations.front().depth > 0) {
        SurveyStation at_collar = stations.front();
        at_collar.depth = 0;
        stations.insert(stations.begin(), at_collar);
    }
    return stations;
}

}  // namespace

Trajectory::Trajectory(const Vec3& collar, std::vector<SurveyStation> stations, Desurvey method)
    : stations_(normalized(std::move(stations))), positions_{collar}, method_(method) {
    assert(is_finite(collar) && stations_.front().depth == 0);
    for (const SurveyStation& station : stations_) {
        directions_.push_back(direction(station));
    }
    for (std::size_t i = 0; i + 1 < stations_.size(); ++i) {
        positions_.push_back(advance(i, stations_[i + 1].depth - stations_[i].depth));
    }
}

Trajectory::Trajectory(std::vector<double> depths, std::vector<Vec3> points)
    : positions_(std::move(points)), method_(Desurvey::tangential) {
    assert(!depths.empty() && depths.size() == positions_.size() && depths.front() >= 0);
    for (std::size_t i = 0; i + 1 < depths.size(); ++i) {
        directions_.push_back((positions_[i + 1] - positions_[i]) / (depths[i + 1] - depths[i]));
    }
    const Vec3 last = directions_.empty() ? Vec3{0, 0, -1} : directions_.back();
    directions_.push_back(length(last) > 0 ? last / length(last) : Vec3{0, 0, -1});
    if (depths.front() > 0) {
        positions_.insert(positions_.begin(), positions_.front() - depths.front() * directions_.front());
        directions_.insert(directions_.begin(), directions_.front());
        depths.insert(depths.begin(), 0);
    }
    for (std::size_t i = 0; i < depths.size(); ++i) {
        const Vec3& way = directions_[i];
        const double azimuth = std::atan2(way.x, way.y) / degree;
        stations_.push_back({depths[i], azimuth, angle_between(way, Vec3{0, 0, -1}) / degree});
    }
}

Vec3 Trajectory::position(double depth) const {
    const auto below = std::ranges::upper_bound(stations_, depth, {}, &SurveyStation::depth);
    const auto station = static_cast<std::size_t>(std::max<std::ptrdiff_t>(below - stations_.begin(), 1) - 1);
    return advance(station, depth - stations_[station].depth);
}

Vec3 Trajectory::advance(std::size_t station, double distance) const {
    const Vec3& start = positions_[station];
    const Vec3& from = directions_[station];
    if (station + 1 == stations_.size() || method_ == Desurvey::tangential || distance <= 0) {
        return start + distance * from;
    }
    const Vec3& to = directions_[station + 1];
    const double leg = stations_[station + 1].depth - stations_[station].depth;
    const double turn = angle_between(from, to);
    if (method_ == Desurvey::minimum_curvature && turn < nearly_opposite) {
        return start + along_arc(from, to, turn, leg, distance / leg);
    }
    return start + std::min(distance, leg / 2) * from + std::max(distance - leg / 2, 0.0) * to;
}

std::vector<double> Trajectory::polyline_depths(double deepest, double max_turn_deg) const {
    assert(deepest >= 0 && max_turn_deg > 0);
    std::vector<double> depths{0};
    const auto add = [&](double depth) {
        if (depth > depths.back() && depth < deepest) {
            depths.push_back(depth);
        }
    };
    for (std::size_t i = 0; i + 1 < stations_.size() && stations_[i].depth < deepest; ++i) {
        const double turn = angle_between(directions_[i], directions_[i + 1]);
        const bool arc = method_ == Desurvey::minimum_curvature && turn < nearly_opposite;
        const int pieces = arc ? std::max(1, static_cast<int>(std::ceil(turn / (max_turn_deg * degree))))
                               : (method_ == Desurvey::tangential ? 1 : 2);
        const double leg = stations_[i + 1].depth - stations_[i].depth;
        for (int piece = 1; piece < pieces; ++piece) {
            add(stations_[i].depth + leg * piece / pieces);
        }
        add(stations_[i + 1].depth);
    }
    if (deepest > 0) {
        depths.push_back(deepest);
    }
    return depths;
}

}  // namespace terratet
