// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/site/site_box.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_set>

namespace terratet {

namespace {

constexpr double far_off_metres = 1e5;
constexpr double times_the_others = 100;
constexpr double times_the_others_at_origin = 10;
constexpr double flat = 10;
constexpr double flat_when_scaled = 5;
constexpr double largest_scale = 1000;
constexpr double level = 1e-6;  ///< height over width

/// A hole or a loose sample: what goes astray as one.
struct Unit {
    Vec3 place;
    std::int32_t borehole;  ///< −1: a loose sample
    std::size_t sample;
    double distance = 0;
};

std::vector<Unit> units_of(const Site& site) {
    std::vector<Unit> units;
    units.reserve(site.boreholes.size() + static_cast<std::size_t>(std::ranges::count(site.samples.borehole, -1)));
    for (std::size_t i = 0; i < site.boreholes.size(); ++i) {
        units.push_back({site.boreholes[i].collar, static_cast<std::int32_t>(i), 0});
    }
    for (std::size_t i = 0; i < site.samples.size(); ++i) {
        if (site.samples.borehole[i] < 0) {
            units.push_back({site.samples.positions[i], -1, i});
        }
    }
    return units;
}

double median(std::vector<double> numbers) {
    const auto middle = numbers.begin() + static_cast<std::ptrdiff_t>((numbers.size() - 1) / 2);
    std::ranges::nth_element(numbers, middle);
    return *middle;
}

Vec3 middle_of(const std::vector<Unit>& units) {
    Vec3 middle;
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<double> numbers;
        numbers.reserve(units.size());
        for (const Unit& unit : units) {
            numbers.push_back(unit.place[axis]);
        }
        middle[axis] = median(std::move(numbers));
    }
    return middle;
}

/// Farthest first; ties by place.
std::vector<Unit> far_off(const Site& site, double metres_per_unit) {
    std::vector<Unit> units = units_of(site);
    if (units.size() < 3) {
        return {};
    }
    const Vec3 middle = middle_of(units);
    for (Unit& unit : units) {
        unit.distance = distance(unit.place, middle);
    }
    const auto farther = [](const Unit& a, const Unit& b) {
        return std::tie(b.distance, a.place, a.borehole) < std::tie(a.distance, b.place, b.borehole);
    };
    const std::size_t most = std::max<std::size_t>(1, units.size() / 4);
    std::ranges::nth_element(units, units.begin() + static_cast<std::ptrdiff_t>(most), farther);
    const double others = units[most].distance;
    const double least = std::max(far_off_metres / metres_per_unit, times_the_others_at_origin * others);
    const auto near = std::partition(units.begin(), units.begin() + static_cast<std::ptrdiff_t>(most),
                                     [&](const Unit& unit) { return unit.distance > least; });
    std::sort(units.begin(), near, farther);
    std::size_t count = 0;
    for (; count < most; ++count) {
        const Unit& unit = units[count];
        const Vec3 world = site.frame.to_world(unit.place);
        const bool at_origin = unit.borehole >= 0 && world.x == 0 && world.y == 0;
        const double limit = std::max(far_off_metres / metres_per_unit,
                                      (at_origin ? times_the_others_at_origin : times_the_others) * others);
        if (unit.distance <= limit) {
            break;
        }
    }
    units.resize(count);
    return units;
}

}  // namespace

SiteBox site_box(const Site& site, double metres_per_unit) {
    SiteBox result;
    std::unordered_set<std::int32_t> holes;
    std::unordered_set<std::size_t> samples;
    for (const Unit& unit : far_off(site, metres_per_unit)) {
        const bool hole = unit.borehole >= 0;
        result.far_off.push_back(
            {hole ? "hole '" + site.boreholes[static_cast<std::size_t>(unit.borehole)].id + "'" : "a sample",
             unit.place, unit.distance});
        if (hole) {
            holes.insert(unit.borehole);
        } else {
            samples.insert(unit.sample);
        }
    }
    for (std::size_t i = 0; i < site.samples.size(); ++i) {
        if (result.far_off.empty() || (!holes.contains(site.samples.borehole[i]) && !samples.contains(i))) {
            result.box.extend(site.samples.positions[i]);
        }
    }
    for (std::size_t i = 0; i < site.boreholes.size(); ++i) {
        if (!holes.contains(static_cast<std::int32_t>(i))) {
            for (const Vec3& p : site.boreholes[i].path) {
                result.box.extend(p);
            }
        }
    }
    return result;
}

double flatness(const Box3& box) {
    if (box.empty()) {
        return 0;
    }
    const Vec3 size = box.size();
    const double width = std::hypot(size.x, size.y) / std::sqrt(2.0);
    return size.z <= level * width ? 0 : width / size.z;
}

double suitable_z_scale(const Box3& box) {
    const double ratio = flatness(box);
    if (ratio <= flat) {
        return 1;
    }
    const double scale = std::min(largest_scale, ratio / flat_when_scaled);
    const double digits = std::pow(10, std::floor(std::log10(scale)) - 1);
    return digits >= 1 ? digits * std::round(scale / digits) : std::round(scale / digits) / std::round(1 / digits);
}

}  // namespace terratet
