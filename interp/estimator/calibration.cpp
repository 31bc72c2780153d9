// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/calibration.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "interp/base/number_text.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

constexpr double share_68 = 0.6827;
constexpr double share_95 = 0.95;
constexpr double normal_95 = 1.96;
constexpr std::size_t enough_boreholes = 20;
constexpr std::size_t levels_max = 10;
constexpr std::size_t samples_a_level = 100;
constexpr std::size_t boreholes_a_level = 5;
constexpr double relative_max = 20;  // and not below its inverse
constexpr double factor_max = 1e12;
constexpr int digits = 5;  // of what is kept
const std::string heading = "uncertainty";

/// Student's t over the normal's quantile, for 68 and for 95 %, by degrees of freedom from 1.
constexpr std::array<double, 20> widened_68 = {1.837, 1.321, 1.197, 1.142, 1.111, 1.091, 1.077, 1.067, 1.059, 1.053,
                                               1.048, 1.043, 1.040, 1.037, 1.034, 1.032, 1.030, 1.029, 1.027, 1.026};
constexpr std::array<double, 20> widened_95 = {6.483, 2.195, 1.624, 1.417, 1.312, 1.248, 1.206, 1.177, 1.154, 1.137,
                                               1.123, 1.112, 1.102, 1.094, 1.087, 1.082, 1.076, 1.072, 1.068, 1.064};

double widened(const std::array<double, 20>& table, double normal, std::size_t boreholes) {
    const std::size_t freedom = std::max<std::size_t>(boreholes, 2) - 1;
    return freedom <= table.size() ? table[freedom - 1]
                                   : 1 + (normal * normal + 1) / (4 * static_cast<double>(freedom));
}

/// The smallest that is no less than a share of all. \pre ascending, not empty
double quantile(const std::vector<double>& ascending, double share) {
    const auto n = static_cast<double>(ascending.size());
    const double rank = std::clamp(std::ceil(share * n), 1.0, n);
    return ascending[static_cast<std::size_t>(rank) - 1];
}

double ratio(const JudgedError& one) {
    return std::abs(one.error) / one.deviation;
}

std::vector<double> ratios_of(std::span<const JudgedError> judged) {
    std::vector<double> ratios(judged.size());
    std::transform(judged.begin(), judged.end(), ratios.begin(), ratio);
    std::sort(ratios.begin(), ratios.end());
    return ratios;
}

/// By how many percent a factor's cover is above what is wanted of it at one and at 1.96, weighed 1/6 and 1/4.
double excess(const std::vector<double>& ratios, double factor, double one, double two) {
    const auto covered = [&](double limit) {
        const auto end = std::upper_bound(ratios.begin(), ratios.end(), limit);
        return static_cast<double>(end - ratios.begin()) / static_cast<double>(ratios.size());
    };
    return (covered(factor) - one) / 0.06 + (covered(normal_95 * factor) - two) / 0.04;
}

/// The factor that misses both by equal parts: between the one that is right for the first and that for the second.
double balanced(const std::vector<double>& ratios, double one, double two) {
    const double for_one = quantile(ratios, one);
    const double for_two = quantile(ratios, two) / normal_95;
    double below = std::min(for_one, for_two);
    double above = std::max(for_one, for_two);
    for (int i = 0; i < 60 && above > below; ++i) {
        const double middle = 0.5 * (below + above);
        (excess(ratios, middle, one, two) < 0 ? below : above) = middle;
    }
    return above;
}

/// \param judged  by ascending estimate
std::vector<Calibration::Level> levels_of(std::span<const JudgedError> judged, std::size_t boreholes) {
    const std::size_t count = std::min({judged.size() / samples_a_level, boreholes / boreholes_a_level, levels_max});
    const double usual = judged.empty() ? 0 : quantile(ratios_of(judged), share_68);
    std::vector<Calibration::Level> levels;
    if (count < 2 || usual <= 0) {
        return levels;
    }
    for (std::size_t k = 0; k < count; ++k) {
        const std::size_t begin = k * judged.size() / count;
        const auto part = judged.subspan(begin, (k + 1) * judged.size() / count - begin);
        const double estimate = rounded(part[part.size() / 2].estimate, 8);
        const double relative = std::clamp(quantile(ratios_of(part), share_68) / usual, 1 / relative_max, relative_max);
        if (levels.empty() || estimate > levels.back().estimate) {
            levels.push_back({estimate, rounded(relative, digits)});
        }
    }
    return levels;
}

double in_range(const std::string& text, double lowest, double highest) {
    const auto value = number_in(text);
    if (!value || *value < lowest || *value > highest) {
        throw UsageError("'" + text + "' is no number that a calibration may have");
    }
    return *value;
}

std::vector<Calibration::Level> parse_levels(const std::string& text) {
    std::vector<Calibration::Level> levels;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        const std::string pair = text.substr(begin, end - begin);
        const std::size_t slash = std::min(pair.find('/'), pair.size());
        const double estimate = in_range(pair.substr(0, slash), -1e300, 1e300);
        const double relative =
            in_range(pair.substr(std::min(slash + 1, pair.size())), 0.9 / relative_max, 1.1 * relative_max);
        if (levels.size() >= levels_max || (!levels.empty() && estimate <= levels.back().estimate)) {
            throw UsageError("the levels '" + text + "' are too many or do not ascend");
        }
        levels.push_back({estimate, relative});
        begin = end + 1;
    }
    return levels;
}

}  // namespace

double Calibration::relative(double estimate) const {
    if (levels.empty()) {
        return 1;
    }
    const auto above = std::upper_bound(levels.begin(), levels.end(), estimate,
                                        [](double value, const Level& level) { return value < level.estimate; });
    if (above == levels.begin() || above == levels.end()) {
        return above == levels.end() ? levels.back().relative : levels.front().relative;
    }
    const Level& below = *std::prev(above);
    const double t = (estimate - below.estimate) / (above->estimate - below.estimate);
    return below.relative + t * (above->relative - below.relative);
}

StatedError Calibration::stated(double estimate, double deviation) const {
    const double here = relative(estimate) * deviation;
    return {factor_sd * here, factor_95 * here};
}

std::string Calibration::to_string() const {
    std::string text = heading + ":sd=" + shortest(factor_sd) + ":half_width=" + shortest(factor_95) +
                       ":boreholes=" + std::to_string(boreholes) + ":samples=" + std::to_string(samples);
    for (const auto& [estimate, relative] : levels) {
        text +=
            (&estimate == &levels.front().estimate ? ":levels=" : ",") + shortest(estimate) + "/" + shortest(relative);
    }
    return text;
}

Calibration parse_calibration(const std::string& text) {
    Calibration out;
    std::size_t at = std::min(text.find(':'), text.size());
    if (text.substr(0, at) != heading) {
        throw UsageError("'" + text + "' is no calibration");
    }
    while (at < text.size()) {
        const std::size_t end = std::min(text.find(':', at + 1), text.size());
        const std::string part = text.substr(at + 1, end - at - 1);
        const std::size_t equals = std::min(part.find('='), part.size());
        const std::string key = part.substr(0, equals);
        const std::string value = part.substr(std::min(equals + 1, part.size()));
        if (key == "sd") {
            out.factor_sd = in_range(value, 0, factor_max);
        } else if (key == "half_width") {
            out.factor_95 = in_range(value, 0, factor_max);
        } else if (key == "boreholes") {
            out.boreholes = static_cast<std::size_t>(in_range(value, 0, 1e15));
        } else if (key == "samples") {
            out.samples = static_cast<std::size_t>(in_range(value, 0, 1e15));
        } else if (key == "levels") {
            out.levels = parse_levels(value);
        } else {
            throw UsageError("a calibration has no '" + key + "'");
        }
        at = end;
    }
    return out;
}

Calibration calibrate(std::span<const JudgedError> judged, std::size_t boreholes) {
    std::vector<JudgedError> telling;
    std::copy_if(judged.begin(), judged.end(), std::back_inserter(telling), [](const JudgedError& one) {
        return std::isfinite(one.estimate) && one.deviation > 0 && ratio(one) <= factor_max;
    });
    Calibration out;
    out.boreholes = boreholes;
    out.samples = telling.size();
    if (telling.empty()) {
        return out;
    }
    std::sort(telling.begin(), telling.end(), [](const JudgedError& a, const JudgedError& b) {
        return a.estimate != b.estimate ? a.estimate < b.estimate : ratio(a) < ratio(b);
    });
    out.levels = levels_of(telling, boreholes);
    for (JudgedError& one : telling) {
        one.deviation *= out.relative(one.estimate);
    }
    // How much of a borehole yet unseen: all of it from half of enough down.
    const double unseen = std::clamp(2 - 2 * static_cast<double>(boreholes) / enough_boreholes, 0.0, 1.0);
    const auto ratios = ratios_of(telling);
    const double one = share_68 * (1 + unseen / static_cast<double>(std::max<std::size_t>(boreholes, 1)));
    const double two = share_95 + unseen * (1 - share_95);
    out.factor_sd = balanced(ratios, std::min(one, 1.0), two) * widened(widened_68, 1, boreholes);
    out.factor_95 = quantile(ratios, two) * widened(widened_95, normal_95, boreholes);
    out.factor_sd += unseen * std::max(out.factor_95 / normal_95 - out.factor_sd, 0.0);
    out.factor_sd = rounded(std::min(out.factor_sd, factor_max), digits);
    out.factor_95 = rounded(std::min(out.factor_95, factor_max), digits);
    return out;
}

}  // namespace terratet
