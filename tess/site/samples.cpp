// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/samples.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <numeric>

#include "tess/property.hpp"

namespace terratet {

namespace {

/// Total order on doubles with NaN last, so that sorting never depends on where NaNs started.
int compare(double a, double b) {
    if (std::isnan(a) || std::isnan(b)) {
        return static_cast<int>(std::isnan(a)) - static_cast<int>(std::isnan(b));
    }
    return a < b ? -1 : (a > b ? 1 : 0);
}

int compare(const Vec3& a, const Vec3& b) {
    for (int axis = 0; axis < 3; ++axis) {
        if (const int order = compare(a[axis], b[axis])) {
            return order;
        }
    }
    return 0;
}

int compare_values(const Samples& samples, std::uint32_t a, std::uint32_t b) {
    for (const auto& column : samples.values) {
        if (const int order = compare(column[a], column[b])) {
            return order;
        }
    }
    for (const auto& column : samples.censored) {
        if (column[a] != column[b]) {
            return column[a] < column[b] ? -1 : 1;
        }
    }
    return compare(samples.length[a], samples.length[b]);
}

double mean(const Property& property, const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values) {
        sum += to_scale(property, value);
    }
    return from_scale(property, sum / static_cast<double>(values.size()));
}

double most_frequent(const std::vector<double>& values) {
    std::map<double, int> counts;
    for (const double value : values) {
        ++counts[value];
    }
    return std::ranges::max_element(counts, {}, [](const auto& entry) { return entry.second; })->first;
}

/// The one value that stands for a group of coincident samples; NaN when none of them has it.
double merged_value(const Property& property, const std::vector<double>& column, std::span<const std::uint32_t> group) {
    std::vector<double> present;
    for (const std::uint32_t i : group) {
        if (!std::isnan(to_scale(property, column[i]))) {
            present.push_back(column[i]);
        }
    }
    if (present.empty()) {
        return missing;
    }
    if (std::ranges::all_of(present, [&](double value) { return value == present.front(); })) {
        return present.front();  // not through a logarithm and back: V1 promises the measured value
    }
    return property.kind == Kind::categorical ? most_frequent(present) : mean(property, present);
}

/// That of what stands for the group.
Censoring merged_censoring(const Samples& samples, std::size_t p, std::span<const std::uint32_t> group) {
    Censoring merged = Censoring::none;
    for (const std::uint32_t i : group) {
        merged = merged | samples.censoring(p, i);
    }
    return merged;
}

}  // namespace

const char* to_string(Censoring censoring) {
    constexpr const char* names[] = {"", "<", ">", "<>"};
    return names[static_cast<std::size_t>(censoring)];
}

std::size_t Samples::censored_count(std::size_t property) const {
    if (censored.empty()) {
        return 0;
    }
    const auto& column = censored[property];
    return column.size() - static_cast<std::size_t>(std::ranges::count(column, Censoring::none));
}

bool Samples::any_censored() const {
    for (std::size_t p = 0; p < censored.size(); ++p) {
        if (censored_count(p) > 0) {
            return true;
        }
    }
    return false;
}

void Samples::set_censoring(std::size_t property, std::size_t sample, Censoring censoring) {
    if (censored.empty()) {
        if (censoring == Censoring::none) {
            return;
        }
        censored.assign(values.size(), std::vector<Censoring>(size(), Censoring::none));
    }
    censored[property][sample] = censoring;
}

namespace {

/// Whole numbers in the order of doubles; NaN last, zeros alike.
std::uint64_t in_order(double value) {
    constexpr std::uint64_t sign = std::uint64_t{1} << 63U;
    const auto bits = std::bit_cast<std::uint64_t>(value + 0.0);
    return std::isnan(value) ? ~std::uint64_t{0} : (bits & sign) != 0 ? ~bits : bits | sign;
}

int compare_samples(const Samples& samples, std::uint32_t a, std::uint32_t b) {
    const auto owner_a = static_cast<std::uint32_t>(samples.borehole[a]);  // −1, loose, becomes the largest
    const auto owner_b = static_cast<std::uint32_t>(samples.borehole[b]);
    if (owner_a != owner_b) {
        return owner_a < owner_b ? -1 : 1;
    }
    if (const int depth = compare(samples.depth[a], samples.depth[b])) {
        return depth;
    }
    const int place = compare(samples.positions[a], samples.positions[b]);
    return place != 0 ? place : compare_values(samples, a, b);
}

/// What settles most comparisons, side by side in memory.
struct OrderKey {
    std::uint32_t owner;
    std::uint32_t index;
    std::uint64_t place;
    std::uint64_t beside;
};

}  // namespace

std::vector<std::uint32_t> canonical_order(const Samples& samples) {
    std::vector<std::uint32_t> order(samples.size());
    std::iota(order.begin(), order.end(), 0U);
    const auto before = [&](std::uint32_t a, std::uint32_t b) { return compare_samples(samples, a, b) < 0; };
    if (std::ranges::is_sorted(order, before)) {
        return order;
    }
    const bool no_depth = std::ranges::all_of(
        order, [&](std::uint32_t i) { return samples.borehole[i] >= 0 || std::isnan(samples.depth[i]); });
    std::vector<OrderKey> keys(samples.size());
    for (const std::uint32_t i : order) {
        const Vec3& place = samples.positions[i];
        const bool by_place = no_depth && samples.borehole[i] < 0;
        keys[i] = {static_cast<std::uint32_t>(samples.borehole[i]), i, in_order(by_place ? place.x : samples.depth[i]),
                   in_order(by_place ? place.y : place.x)};
    }
    std::ranges::sort(keys, [&](const OrderKey& a, const OrderKey& b) {
        if (a.owner != b.owner) {
            return a.owner < b.owner;
        }
        if (a.place != b.place) {
            return a.place < b.place;
        }
        return a.beside != b.beside ? a.beside < b.beside : before(a.index, b.index);
    });
    std::ranges::transform(keys, order.begin(), &OrderKey::index);
    return order;
}

Samples selected(const Samples& samples, const std::vector<std::uint32_t>& order) {
    const auto pick = [&](const auto& column) {
        std::decay_t<decltype(column)> result;
        result.reserve(order.size());
        for (const std::uint32_t i : order) {
            result.push_back(column[i]);
        }
        return result;
    };
    Samples result{pick(samples.positions), pick(samples.borehole), pick(samples.depth), pick(samples.length), {}, {}};
    for (const auto& column : samples.values) {
        result.values.push_back(pick(column));
    }
    for (const auto& column : samples.censored) {
        result.censored.push_back(pick(column));
    }
    if (!result.any_censored()) {
        result.censored.clear();
    }
    return result;
}

MergeReport merge_coincident(Samples& samples, const std::vector<Property>& properties) {
    std::vector<std::uint32_t> order(samples.size());
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::stable_sort(order, [&](std::uint32_t a, std::uint32_t b) {
        return compare(samples.positions[a], samples.positions[b]) < 0;
    });
    std::vector<std::uint32_t> survivors;
    for (std::size_t begin = 0; begin < order.size();) {
        std::size_t end = begin + 1;
        while (end < order.size() && samples.positions[order[end]] == samples.positions[order[begin]]) {
            ++end;
        }
        const std::span group(order.data() + begin, end - begin);
        if (group.size() > 1) {
            for (std::size_t p = 0; p < samples.values.size(); ++p) {
                samples.values[p][group.front()] = merged_value(properties[p], samples.values[p], group);
                samples.set_censoring(p, group.front(), merged_censoring(samples, p, group));
            }
        }
        survivors.push_back(group.front());
        begin = end;
    }
    const MergeReport report{samples.size() - survivors.size()};
    if (report.merged > 0) {
        std::ranges::sort(survivors);
        samples = selected(samples, survivors);
    }
    return report;
}

}  // namespace terratet
