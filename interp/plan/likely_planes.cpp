// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/plan/likely_planes.hpp"

#include <tbb/parallel_for.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

#include "interp/sites/site_tree.hpp"

namespace terratet {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double first_step = 8;
constexpr double last_step = 0.25;
constexpr std::size_t neighbours = 6;
constexpr std::size_t compared_max = 30'000;
constexpr double few_pairs = 0.2;  // of all: likeness of so many counts half
constexpr double steepest = 0.02;  // of a ratio
constexpr std::size_t slopes_at = 2000;

struct Hole {
    std::vector<Vec3> sites;  ///< along it
    std::vector<double> values;
    std::vector<double> depths;
    Vec3 middle;
};

/// Samples by their place along the hole's widest direction.
std::vector<Hole> holes_of(const SampledValues& data) {
    std::map<std::int32_t, std::vector<std::uint32_t>> members;
    for (std::uint32_t i = 0; i < data.sites.size(); ++i) {
        if (data.boreholes[i] >= 0) {
            members[data.boreholes[i]].push_back(i);
        }
    }
    std::vector<Hole> holes;
    for (auto& [number, own] : members) {
        Box3 box;
        Hole hole;
        for (const std::uint32_t i : own) {
            box.extend(data.sites[i]);
            hole.middle = hole.middle + data.sites[i] / static_cast<double>(own.size());
        }
        const Vec3 size = box.size();
        const int axis = size.z >= size.x && size.z >= size.y ? 2 : size.x >= size.y ? 0 : 1;
        std::stable_sort(own.begin(), own.end(),
                         [&](std::uint32_t a, std::uint32_t b) { return data.sites[a][axis] > data.sites[b][axis]; });
        for (const std::uint32_t i : own) {
            hole.depths.push_back(hole.sites.empty() ? 0
                                                     : hole.depths.back() + distance(hole.sites.back(), data.sites[i]));
            hole.sites.push_back(data.sites[i]);
            hole.values.push_back(data.values[i]);
        }
        if (hole.sites.size() > 1) {
            holes.push_back(std::move(hole));
        }
    }
    return holes;
}

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// Each hole with the nearest others; of too many every second, third…
Pairs pairs_of(const std::vector<Hole>& holes, double& spacing) {
    Pairs pairs;
    std::vector<double> distances;
    std::size_t compared = 0;
    for (std::uint32_t a = 0; a < holes.size(); ++a) {
        std::vector<std::pair<double, std::uint32_t>> near;
        for (std::uint32_t b = 0; b < holes.size(); ++b) {
            if (b != a) {
                near.emplace_back(distance(holes[a].middle, holes[b].middle), b);
            }
        }
        const std::size_t count = std::min(neighbours, near.size());
        std::partial_sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(count), near.end());
        for (std::size_t k = 0; k < count; ++k) {
            pairs.emplace_back(a, near[k].second);
            distances.push_back(near[k].first);
            compared += holes[a].sites.size();
        }
    }
    const auto middle = distances.begin() + std::ssize(distances) / 2;
    std::nth_element(distances.begin(), middle, distances.end());
    spacing = *middle;
    const std::size_t step = 1 + compared / compared_max;
    Pairs some;
    for (std::size_t k = 0; k < pairs.size(); k += step) {
        some.push_back(pairs[k]);
    }
    return some;
}

/// Means over a length along the hole.
std::vector<double> smoothed(const Hole& hole, double length) {
    const auto n = hole.values.size();
    std::vector<double> sums(n + 1, 0);
    std::partial_sum(hole.values.begin(), hole.values.end(), sums.begin() + 1);
    std::vector<double> out(n);
    std::size_t begin = 0;
    std::size_t end = 0;
    for (std::size_t i = 0; i < n; ++i) {
        while (hole.depths[begin] < hole.depths[i] - length) {
            ++begin;
        }
        while (end < n && hole.depths[end] <= hole.depths[i] + length) {
            ++end;
        }
        out[i] = (sums[end] - sums[begin]) / static_cast<double>(end - begin);
    }
    return out;
}

/// A log over the height along a normal, ascending.
using Profile = std::vector<std::pair<double, double>>;

Profile profile(const Hole& hole, std::span<const double> values, const Vec3& normal) {
    Profile out(values.size());
    for (std::size_t i = 0; i < out.size(); ++i) {
        out[i] = {dot(normal, hole.sites[i]), values[i]};
    }
    if (out.front().first > out.back().first) {
        std::reverse(out.begin(), out.end());
    }
    if (!std::is_sorted(out.begin(), out.end())) {
        std::sort(out.begin(), out.end());
    }
    return out;
}

/// What holes measured, smoothed alike.
class Logs {
  public:
    Logs(const std::vector<Hole>& holes, const Pairs& pairs, double length) : holes_(holes), pairs_(pairs) {
        double sum = 0;
        double squares = 0;
        double count = 0;
        for (const Hole& hole : holes) {
            values_.push_back(smoothed(hole, length));
            for (const double v : values_.back()) {
                count += 1;
                const double delta = v - sum;
                sum += delta / count;
                squares += delta * (v - sum);
            }
        }
        variance_ = squares / count;
    }

    /// 1: neighbours measured the same along the plane; 0: no more alike than any two samples.
    [[nodiscard]] double likeness(const Vec3& normal) const {
        std::vector<Profile> profiles;
        for (std::size_t h = 0; h < holes_.size(); ++h) {
            profiles.push_back(profile(holes_[h], values_[h], normal));
        }
        double squares = 0;
        double compared = 0;
        double all = 0;
        for (const auto& [a, b] : pairs_) {
            compare(profiles[a], profiles[b], squares, compared);
            all += static_cast<double>(profiles[a].size());
        }
        return compared > 0 && variance_ > 0
                   ? (1 - squares / (2 * variance_ * compared)) * compared / (compared + few_pairs * all)
                   : 0;
    }

  private:
    static void compare(const Profile& a, const Profile& b, double& squares, double& compared) {
        std::size_t k = 0;
        for (const auto& [height, value] : a) {
            while (k < b.size() && b[k].first < height) {
                ++k;
            }
            if (k == b.size() || (k == 0 && b[0].first > height)) {
                continue;
            }
            double other = b[k].second;
            if (k > 0) {
                const double t = (height - b[k - 1].first) / (b[k].first - b[k - 1].first);
                other = b[k - 1].second + t * (other - b[k - 1].second);
            }
            squares += (value - other) * (value - other);
            compared += 1;
        }
    }

    const std::vector<Hole>& holes_;
    const Pairs& pairs_;
    std::vector<std::vector<double>> values_;
    double variance_ = 0;
};

Vec3 unit(const Vec3& v) {
    return v / length(v);
}

Vec3 upwards(const Vec3& v) {
    return v.z < 0 ? -v : v;
}

std::vector<Vec3> half_sphere(double step) {
    std::vector<Vec3> out;
    for (double dip = 0; dip <= 90; dip += step) {
        const auto count = std::max(1, static_cast<int>(std::lround(360 * std::sin(dip * degree) / step)));
        for (int k = 0; k < count; ++k) {
            const double azimuth = 2 * std::numbers::pi * k / count;
            out.push_back({std::sin(dip * degree) * std::sin(azimuth), std::sin(dip * degree) * std::cos(azimuth),
                           std::cos(dip * degree)});
        }
    }
    return out;
}

/// The directions with the highest likeness, some steps apart.
std::vector<Vec3> peaks(const Logs& logs, const std::vector<Vec3>& directions, double step, std::size_t count) {
    std::vector<double> likeness(directions.size());
    tbb::parallel_for(std::size_t{0}, directions.size(),
                      [&](std::size_t i) { likeness[i] = logs.likeness(directions[i]); });
    std::vector<std::size_t> order(directions.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return likeness[a] > likeness[b]; });
    std::vector<Vec3> out;
    const double apart = std::cos(2.5 * step * degree);
    for (const std::size_t i : order) {
        const bool fresh = std::all_of(out.begin(), out.end(),
                                       [&](const Vec3& taken) { return std::abs(dot(taken, directions[i])) < apart; });
        if (fresh && out.size() < count) {
            out.push_back(directions[i]);
        }
    }
    return out;
}

std::vector<Vec3> around(const std::vector<Vec3>& peaks, double step) {
    std::vector<Vec3> out;
    for (const Vec3& n : peaks) {
        const Vec3 u = unit(cross(n, std::abs(n.x) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
        const Vec3 v = cross(n, u);
        for (int i = -2; i <= 2; ++i) {
            for (int j = -2; j <= 2; ++j) {
                out.push_back(upwards(unit(n + step * degree * 0.75 * (i * u + j * v))));
            }
        }
    }
    return out;
}

Anisotropy of_axes(const Vec3& first, const Vec3& second, double ratio2, double ratio3) {
    const Vec3 down = first.z > 0 ? -first : first;
    Anisotropy out;
    out.azimuth_deg = std::atan2(down.x, down.y) / degree;
    out.dip_deg = std::asin(std::clamp(-down.z, -1.0, 1.0)) / degree;
    const double a = out.azimuth_deg * degree;
    const double b = out.dip_deg * degree;
    const Vec3 level{-std::cos(a), std::sin(a), 0};
    const Vec3 third{std::sin(b) * std::sin(a), std::sin(b) * std::cos(a), std::cos(b)};
    out.roll_deg = std::atan2(dot(second, third), dot(second, level)) / degree;
    out.ratio2 = ratio2;
    out.ratio3 = ratio3;
    return out;
}

}  // namespace

std::vector<Vec3> planes_between_holes(const SampledValues& data, std::size_t count) {
    const auto holes = holes_of(data);
    if (holes.size() < 2) {
        return {};
    }
    double spacing = 0;
    const Pairs pairs = pairs_of(holes, spacing);
    std::vector<Vec3> best = half_sphere(first_step);
    for (double step = first_step; step >= last_step; step /= 2) {
        const Logs logs(holes, pairs, 0.5 * spacing * std::tan(step * degree));
        best = peaks(logs, step == first_step ? best : around(best, step), step, count);
    }
    return best;
}

Anisotropy anisotropy_of_slopes(const SampledValues& data) {
    const SiteTree tree(data.sites, data.boreholes);
    const SomeSites some(data.sites.size(), slopes_at);
    Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
    Eigen::Matrix<double, 6, 1> right = Eigen::Matrix<double, 6, 1>::Zero();
    std::vector<NearSite> near;
    for (std::uint32_t i = 0; i < data.sites.size(); ++i) {
        if (!some.contains(i)) {
            continue;
        }
        tree.neighbourhood(
            data.sites[i], {.max_points = 12, .per_borehole = 2}, [&](std::uint32_t j) { return j != i; }, near);
        for (const auto& [squared_distance, j, slot] : near) {
            const Vec3 u = (data.sites[j] - data.sites[i]) / std::sqrt(squared_distance);
            const double difference = data.values[j] - data.values[i];
            const Eigen::Matrix<double, 6, 1> form{u.x * u.x,     u.y * u.y,     u.z * u.z,
                                                   2 * u.x * u.y, 2 * u.x * u.z, 2 * u.y * u.z};
            normal += form * form.transpose();
            right += form * (difference * difference / squared_distance);
        }
    }
    normal.diagonal().array() += 1e-9 * normal.trace();
    const Eigen::Matrix<double, 6, 1> m = normal.ldlt().solve(right);
    Eigen::Matrix3d quadratic;
    quadratic << m[0], m[3], m[4], m[3], m[1], m[5], m[4], m[5], m[2];
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(quadratic);
    const Eigen::Vector3d values = axes.eigenvalues();
    if (!(values[2] > 0)) {
        return {};
    }
    const double least = std::max(values[0], steepest * steepest * values[2]);
    const auto ratio = [&](double value) { return std::clamp(std::sqrt(least / value), steepest, 1.0); };
    const auto axis = [&](int k) {
        const Eigen::Vector3d v = axes.eigenvectors().col(k);
        return Vec3{v.x(), v.y(), v.z()};
    };
    return of_axes(axis(0), axis(1), ratio(std::max(values[1], least)), ratio(values[2]));
}

Anisotropy flattened(const Vec3& normal, double ratio3) {
    const Vec3 n = upwards(normal);
    Anisotropy out;
    const double level = std::hypot(n.x, n.y);
    out.dip_deg = std::atan2(level, n.z) / degree;
    out.azimuth_deg = level > 0 ? std::atan2(n.x, n.y) / degree : 0;
    out.ratio3 = ratio3;
    return out;
}

}  // namespace terratet
