// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/plan/composite.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>

namespace terratet {
namespace {

constexpr double covered_min = 0.5;  // of a composite's length
constexpr double rounding = 1e-9;    // of a composite's length: depths are sums of rounded numbers

/// What the intervals contribute to one property of one composite.
struct Share {
    double covered = 0;
    double sum = 0;                      ///< of lengths times values, in the property's scale
    std::map<double, double> length_of;  ///< category: by class
    bool single = true;                  ///< all values so far are equal …
    double first = missing;              ///< … to this one, as measured
    Censoring censoring = Censoring::none;

    void add(const Property& property, double value, Censoring censored, double length) {
        const double scaled = to_scale(property, value);
        if (std::isnan(scaled)) {
            return;
        }
        single = single && (covered == 0 || value == first);
        first = value;
        censoring = censoring | censored;
        covered += length;
        if (property.kind == Kind::categorical) {
            length_of[value] += length;
        } else {
            sum += length * scaled;
        }
    }

    [[nodiscard]] double value(const Property& property) const {
        if (single) {
            return first;  // as measured, not by way of its logarithm
        }
        if (property.kind == Kind::categorical) {
            return std::ranges::max_element(length_of, {}, [](const auto& entry) { return entry.second; })->first;
        }
        return from_scale(property, sum / covered);
    }
};

/// On the polyline; straight on beyond its ends.
Vec3 at_depth(const Borehole& hole, double depth) {
    if (hole.path.size() < 2) {
        return hole.path.empty() ? hole.collar : hole.path.front();
    }
    const auto above = std::ranges::upper_bound(hole.path_depth, depth);
    const auto k = static_cast<std::size_t>(
        std::clamp<std::ptrdiff_t>(above - hole.path_depth.begin(), 1, std::ssize(hole.path_depth) - 1));
    const double t = (depth - hole.path_depth[k - 1]) / (hole.path_depth[k] - hole.path_depth[k - 1]);
    return hole.path[k - 1] + t * (hole.path[k] - hole.path[k - 1]);
}

bool is_interval(const Samples& samples, std::size_t i) {
    return samples.borehole[i] >= 0 && samples.length[i] > 0 && !std::isnan(samples.depth[i]);
}

/// Appends one sample.
void append(Samples& samples, const Vec3& position, std::int32_t hole, double depth, double length,
            const std::vector<double>& values, const std::vector<Censoring>& censored) {
    samples.positions.push_back(position);
    samples.borehole.push_back(hole);
    samples.depth.push_back(depth);
    samples.length.push_back(length);
    for (std::size_t p = 0; p < values.size(); ++p) {
        samples.values[p].push_back(values[p]);
        samples.censored[p].push_back(censored[p]);
    }
}

using Shares = std::vector<Share>;  ///< one a property

/// The composites of one hole by their number.
std::map<std::int64_t, Shares> shares_of(const Site& site, const std::vector<std::uint32_t>& intervals, double length) {
    std::map<std::int64_t, Shares> composites;
    for (const std::uint32_t i : intervals) {
        const double from = site.samples.depth[i] - 0.5 * site.samples.length[i];
        const double to = from + site.samples.length[i];
        for (auto k = static_cast<std::int64_t>(std::floor(from / length)); static_cast<double>(k) * length < to; ++k) {
            const double begin = static_cast<double>(k) * length;
            const double shared = std::min(to, begin + length) - std::max(from, begin);
            if (shared <= rounding * length) {
                continue;
            }
            auto& shares = composites[k];
            shares.resize(site.properties.size());
            for (std::size_t p = 0; p < site.properties.size(); ++p) {
                shares[p].add(site.properties[p], site.samples.values[p][i], site.samples.censoring(p, i), shared);
            }
        }
    }
    return composites;
}

void append_composites(const Site& site, std::int32_t hole, const std::vector<std::uint32_t>& intervals, double length,
                       Samples& out, CompositeReport& report) {
    double deepest = 0;
    for (const std::uint32_t i : intervals) {
        deepest = std::max(deepest, site.samples.depth[i] + 0.5 * site.samples.length[i]);
    }
    for (const auto& [k, shares] : shares_of(site, intervals, length)) {
        const double begin = static_cast<double>(k) * length;
        const double whole = std::min(begin + length, deepest) - begin;
        std::vector<double> values;
        std::vector<Censoring> censored;
        bool any = false;
        for (std::size_t p = 0; p < shares.size(); ++p) {
            const bool enough = shares[p].covered >= covered_min * whole - rounding * length;
            const bool has_value = enough && shares[p].covered > 0;
            values.push_back(has_value ? shares[p].value(site.properties[p]) : missing);
            censored.push_back(has_value ? shares[p].censoring : Censoring::none);
            any = any || !std::isnan(values.back());
            report.dropped += !enough && shares[p].covered > 0 ? 1 : 0;
        }
        if (any) {
            const double middle = begin + 0.5 * whole;
            const Vec3 place = at_depth(site.boreholes[static_cast<std::size_t>(hole)], middle);
            append(out, site.frame.snapped(place), hole, middle, whole, values, censored);
            ++report.composites;
        }
    }
}

}  // namespace

CompositeReport composite(Site& site, double length) {
    assert(length > 0);
    CompositeReport report;
    Samples out;
    out.values.resize(site.properties.size());
    out.censored.resize(site.properties.size());
    std::map<std::int32_t, std::vector<std::uint32_t>> intervals;
    for (std::uint32_t i = 0; i < site.samples.size(); ++i) {
        if (is_interval(site.samples, i)) {
            intervals[site.samples.borehole[i]].push_back(i);
            ++report.intervals;
            continue;
        }
        std::vector<double> values;
        std::vector<Censoring> censored;
        for (std::size_t p = 0; p < site.properties.size(); ++p) {
            values.push_back(site.samples.values[p][i]);
            censored.push_back(site.samples.censoring(p, i));
        }
        append(out, site.samples.positions[i], site.samples.borehole[i], site.samples.depth[i], site.samples.length[i],
               values, censored);
    }
    for (const auto& [hole, of_hole] : intervals) {
        append_composites(site, hole, of_hole, length, out, report);
    }
    site.samples = selected(out, canonical_order(out));
    return report;
}

}  // namespace terratet
