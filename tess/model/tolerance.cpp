// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/model/tolerance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace terratet {

namespace {

constexpr double largest_share = 0.5;  ///< of the standard deviation
constexpr double enough_r2 = 0.97;     ///< along holes: cells do a little worse
constexpr double enough_rich = 0.08;

/// In the property's scale, ascending.
std::vector<double> sorted_scaled(const Property& property, std::span<const double> values) {
    std::vector<double> scaled;
    for (const double value : values) {
        if (const double v = to_scale(property, value); !std::isnan(v)) {
            scaled.push_back(v);
        }
    }
    std::ranges::sort(scaled);
    return scaled;
}

/// Linear between the order statistics. \pre not empty
double quantile(const std::vector<double>& sorted, double q) {
    const double at = q * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(at);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    return sorted[below] + (at - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

struct Bounds {
    double smallest = 0;
    double largest = 0;
};

Bounds bounds_of(const Property& property, std::span<const double> values) {
    if (property.kind == Kind::categorical) {
        return {};
    }
    const std::vector<double> sorted = sorted_scaled(property, values);
    if (sorted.size() < 2 || sorted.front() == sorted.back()) {
        return {};
    }
    double mean = 0;
    for (const double v : sorted) {
        mean += v / static_cast<double>(sorted.size());
    }
    double squares = 0;
    std::vector<double> deviations;
    const double median = quantile(sorted, 0.5);
    for (const double v : sorted) {
        squares += (v - mean) * (v - mean);
        deviations.push_back(std::abs(v - median));
    }
    std::ranges::sort(deviations);
    const double plain = std::sqrt(squares / static_cast<double>(sorted.size()));
    const double robust = 1.4826 * quantile(deviations, 0.5);
    const double largest = largest_share * plain;
    return {std::min(largest, std::max(robust / 4, plain / 50)), largest};
}

}  // namespace

double tolerance_of_range(const Property& property, std::span<const double> values, double percent) {
    const std::vector<double> sorted =
        property.kind == Kind::categorical ? std::vector<double>() : sorted_scaled(property, values);
    if (sorted.empty()) {
        return 0;
    }
    const double wide = quantile(sorted, 0.999) - quantile(sorted, 0.001);
    return std::max(percent / 100 * (quantile(sorted, 0.95) - quantile(sorted, 0.05)), wide / 100);
}

double largest_tolerance(const Property& property, std::span<const double> values) {
    return bounds_of(property, values).largest;
}

Vec3 common_trend(const Property& property, std::span<const Vec3> positions, std::span<const double> values) {
    constexpr double telling = 0.5;  // share of the variance
    std::vector<std::pair<Vec3, double>> known;
    Vec3 centre;
    double mean = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double v = property.kind == Kind::categorical ? missing : to_scale(property, values[i]);
        if (!std::isnan(v)) {
            known.emplace_back(positions[i], v);
        }
    }
    const auto share = 1 / static_cast<double>(known.size());
    for (const auto& [p, v] : known) {
        centre = centre + share * p;
        mean += share * v;
    }
    // The normal equations. What samples do not tell, as the slope across a single hole, is none.
    std::array<Vec3, 3> rows{};
    Vec3 right;
    double variance = 0;
    for (const auto& [p, v] : known) {
        const Vec3 d = p - centre;
        rows[0] = rows[0] + d.x * d;
        rows[1] = rows[1] + d.y * d;
        rows[2] = rows[2] + d.z * d;
        right = right + (v - mean) * d;
        variance += (v - mean) * (v - mean);
    }
    const double ridge = 1e-12 * (rows[0].x + rows[1].y + rows[2].z);
    rows[0].x += ridge;
    rows[1].y += ridge;
    rows[2].z += ridge;
    const double determinant = dot(rows[0], cross(rows[1], rows[2]));
    if (!(determinant > 0) || !(variance > 0)) {
        return {};
    }
    const Vec3 trend =
        (right.x * cross(rows[1], rows[2]) + right.y * cross(rows[2], rows[0]) + right.z * cross(rows[0], rows[1])) /
        determinant;
    return is_finite(trend) && dot(trend, right) >= telling * variance ? trend : Vec3{};
}

Retention settle_retention(const Samples& samples, std::span<const Property> properties, const Trial& trial) {
    std::vector<Bounds> bounds;
    std::vector<double> tolerance;
    for (std::size_t p = 0; p < properties.size(); ++p) {
        bounds.push_back(bounds_of(properties[p], samples.values[p]));
        tolerance.push_back(bounds.back().largest);
    }
    while (true) {
        Retention retention = trial(tolerance);
        bool enough = true;
        for (std::size_t p = 0; p < properties.size(); ++p) {
            const auto& [r2, rich] = retention.agreement[p];
            if (tolerance[p] > bounds[p].smallest && (r2 < enough_r2 || std::abs(rich - 1) > enough_rich)) {
                tolerance[p] = std::max(bounds[p].smallest, tolerance[p] / std::numbers::sqrt2);
                enough = false;
            }
        }
        if (enough) {
            return retention;
        }
    }
}

}  // namespace terratet
