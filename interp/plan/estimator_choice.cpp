// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/plan/estimator_choice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>
#include <utility>

#include "interp/base/number_text.hpp"
#include "interp/plan/kriging_drift.hpp"
#include "interp/plan/likely_planes.hpp"

namespace terratet {
namespace {

constexpr std::size_t samples_max = 20'000;
constexpr std::size_t samples_min = 50;
constexpr std::size_t folds_max = 5;
constexpr std::size_t folds_min = 3;
constexpr std::size_t targets_max = 2000;
constexpr std::size_t coarse_targets = 500;
constexpr std::size_t planes_kept = 3;
constexpr std::size_t shortlist_max = 3;
constexpr double gain_min = 0.03;
constexpr double sure = 3;  // standard deviations of the mean gain of a borehole
constexpr std::size_t boreholes_few = 8;
constexpr double quick_gain_min = 0.01;
constexpr std::array ratios{0.5, 0.2, 0.1, 0.05, 0.02};
constexpr std::array keys{"anisotropy", "azimuth", "dip", "roll", "ratio2", "ratio3"};

/// As a specification says it.
EstimatorSpec with_anisotropy(EstimatorSpec spec, const Anisotropy& a) {
    for (const char* key : keys) {
        spec.options.erase(key);
    }
    const auto angle = [&](const char* key, double degrees) {
        const double tenths = std::round(10 * std::remainder(degrees, 360.0)) / 10;
        if (tenths != 0) {
            spec.options[key] = shortest(tenths);
        }
    };
    if (!a.isotropic()) {
        angle("azimuth", a.azimuth_deg);
        angle("dip", a.dip_deg);
        angle("roll", a.roll_deg);
        if (a.ratio2 != 1) {
            spec.options["ratio2"] = shortest(rounded(a.ratio2, 2));
        }
        spec.options["ratio3"] = shortest(rounded(a.ratio3, 2));
    }
    return spec;
}

/// What planes are found from: of a category whether the class is the most frequent one.
SampledValues comparable(SampledValues data) {
    if (data.kind == Kind::categorical) {
        std::map<double, std::size_t> count;
        for (const double v : data.values) {
            ++count[v];
        }
        const double most = std::ranges::max_element(count, {}, [](const auto& entry) { return entry.second; })->first;
        for (double& v : data.values) {
            v = v == most ? 1 : 0;
        }
    }
    return data;
}

/// Tilted planes all around, besides the level one.
std::vector<Vec3> tilted() {
    constexpr double degree = std::numbers::pi / 180;
    std::vector<Vec3> out;
    for (const double dip : {15.0, 30.0, 45.0, 60.0, 75.0, 90.0}) {
        const int around = dip == 90 ? 4 : 8;
        for (int k = 0; k < around; ++k) {
            const double azimuth = k * 45 * degree;
            out.push_back({std::sin(dip * degree) * std::sin(azimuth), std::sin(dip * degree) * std::cos(azimuth),
                           dip == 90 ? 0 : std::cos(dip * degree)});
        }
    }
    return out;
}

/// Not by chance? Of few boreholes all folds must agree.
bool wins(const LeftOutScore& score, const LeftOutScore& base) {
    const std::size_t better = score.better_folds(base);
    return score.rms() < (1 - gain_min) * base.rms() && 3 * better > 2 * base.folds &&
           (base.squares.size() < boreholes_few ? better == base.folds : score.surely_better(base) > sure);
}

}  // namespace

bool leaves_anisotropy_open(const EstimatorSpec& spec) {
    return std::none_of(keys.begin(), keys.end(), [&](const char* key) { return spec.options.contains(key); });
}

bool is_to_be_chosen(const EstimatorSpec& spec) {
    const auto found = spec.options.find("anisotropy");
    return spec.name == "auto" || (found != spec.options.end() && found->second == "auto");
}

EstimatorSpec with_open_chosen(EstimatorSpec spec) {
    if (leaves_anisotropy_open(spec)) {
        spec.options["anisotropy"] = "auto";
    }
    return spec;
}

EstimatorPlan with_open_chosen(EstimatorPlan plan) {
    if (plan.traits.empty()) {
        plan.general = with_open_chosen(std::move(plan.general));
        for (auto& [property, spec] : plan.of_property) {
            spec = with_open_chosen(std::move(spec));
        }
    }
    return plan;
}

EstimatorSpec without_choice(EstimatorSpec spec) {
    if (spec.name == "auto") {
        spec.name = "natural";
    }
    if (is_to_be_chosen(spec)) {
        spec.options.erase("anisotropy");
    }
    return spec;
}

EstimatorChooser::EstimatorChooser(const SampledValues& data, const BarrierQuery* barriers)
    : scores_(canonical_part(data, samples_max), barriers, folds_max, targets_max), barriers_(barriers) {}

bool EstimatorChooser::can_tell() const {
    const auto& values = scores_.data().values;
    return values.size() >= samples_min && scores_.folds() >= folds_min &&
           std::any_of(values.begin(), values.end(), [&](double v) { return v != values.front(); });
}

const std::vector<EstimatorChooser::Candidate>& EstimatorChooser::candidates() {
    if (!candidates_.empty()) {
        return candidates_;
    }
    candidates_.push_back({{}, scores_.by_distance({}, targets_max).rms(), true});
    const SampledValues shown = comparable(scores_.data());
    std::vector<std::pair<double, Vec3>> coarse;
    for (const Vec3& normal : tilted()) {
        coarse.emplace_back(scores_.by_distance(flattened(normal, 0.1), coarse_targets).rms(), normal);
    }
    std::stable_sort(coarse.begin(), coarse.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<Vec3> normals{{0, 0, 1}};
    for (std::size_t k = 0; k < planes_kept; ++k) {
        normals.push_back(coarse[k].second);
    }
    const auto along = planes_between_holes(shown, planes_kept);
    normals.insert(normals.end(), along.begin(), along.end());
    std::vector<Anisotropy> all;
    if (const Anisotropy slopes = anisotropy_of_slopes(shown); !slopes.isotropic()) {
        all.push_back(slopes);
    }
    for (const Vec3& normal : normals) {
        for (const double ratio : ratios) {
            all.push_back(flattened(normal, ratio));
        }
    }
    for (const Anisotropy& one : all) {
        const EstimatorSpec as_said = with_anisotropy({"idw", {}}, one);
        candidates_.push_back(
            {anisotropy_of(as_said), scores_.by_distance(anisotropy_of(as_said), targets_max).rms(), false});
    }
    return candidates_;
}

/// The best by inverse distance, no plane twice as long as there are others.
std::vector<EstimatorChooser::Candidate> EstimatorChooser::shortlist(std::size_t count) {
    std::vector<Candidate> sorted(candidates().begin() + 1, candidates().end());
    std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.quick < b.quick; });
    std::erase_if(
        sorted, [&](const Candidate& one) { return !(one.quick < (1 - quick_gain_min) * candidates_.front().quick); });
    const auto plane = [](const Candidate& one) {
        return std::tuple(one.anisotropy.azimuth_deg, one.anisotropy.dip_deg, one.anisotropy.roll_deg);
    };
    std::vector<Candidate> out;
    for (const bool again : {false, true}) {
        for (const Candidate& one : sorted) {
            const bool known =
                std::any_of(out.begin(), out.end(), [&](const auto& o) { return plane(o) == plane(one); });
            const bool same = std::any_of(out.begin(), out.end(), [&](const auto& o) {
                return plane(o) == plane(one) && o.anisotropy.ratio3 == one.anisotropy.ratio3;
            });
            if (out.size() < count && (again ? !same : !known)) {
                out.push_back(one);
            }
        }
    }
    return out;
}

EstimatorSpec EstimatorChooser::with_drift(EstimatorSpec spec) const {
    const auto& data = scores_.data();
    if (needs_values(spec) && !spec.options.contains("drift") && data.kind == Kind::continuous) {
        spec.options["drift"] = better_drift(spec, data.sites, data.values, data.boreholes, barriers_);
    }
    return spec;
}

EstimatorTrial EstimatorChooser::trial(const EstimatorSpec& spec, double quick, const LeftOutScore* base,
                                       LeftOutScore& score) const {
    score = scores_.of(with_drift(spec));
    return {spec, quick, score.rms(), base != nullptr ? score.better_folds(*base) : 0};
}

void EstimatorChooser::try_anisotropies(const EstimatorSpec& method, std::size_t count, const LeftOutScore& base,
                                        ChosenEstimator& out, std::vector<LeftOutScore>& scores) {
    for (const Candidate& one : shortlist(count)) {
        out.trials.push_back(trial(with_anisotropy(method, one.anisotropy), one.quick, &base, scores.emplace_back()));
    }
}

/// The first unless another wins.
void EstimatorChooser::decide(const std::vector<LeftOutScore>& scores, ChosenEstimator& out) {
    std::size_t best = 0;
    const double base = *out.trials.front().rms;
    for (std::size_t k = 1; k < scores.size(); ++k) {
        if (*out.trials[k].rms < *out.trials[best].rms && wins(scores[k], scores.front())) {
            best = k;
        }
    }
    out.spec = out.trials[best].spec;
    out.choice = {*out.trials[best].rms, base, out.trials[best].better_folds, scores.front().folds};
}

ChosenEstimator EstimatorChooser::choose(const EstimatorSpec& asked) {
    ChosenEstimator out{without_choice(asked)};
    if (!can_tell()) {
        return out;
    }
    std::vector<LeftOutScore> scores;
    scores.reserve(32);  // the first is referred to
    const double plain = candidates().front().quick;
    if (asked.name != "auto" && shortlist(1).empty()) {
        out.choice.folds = scores_.folds();
        out.trials.push_back({out.spec, plain});
        return out;
    }
    out.trials.push_back(trial(out.spec, plain, nullptr, scores.emplace_back()));
    const LeftOutScore& base = scores.front();
    if (asked.name != "auto") {
        try_anisotropies(out.spec, shortlist_max, base, out, scores);
        decide(scores, out);
        return out;
    }
    std::vector<EstimatorSpec> methods{{"kriging", {}}, {"idw", {}}};
    if (scores_.data().kind == Kind::continuous) {
        methods.insert(methods.begin(), {"natural", {{"smooth", ""}}});
    }
    for (const EstimatorSpec& method : methods) {
        out.trials.push_back(trial(method, plain, &base, scores.emplace_back()));
    }
    if (!asked.options.contains("anisotropy") || is_to_be_chosen({"natural", asked.options})) {
        const bool smooth = methods.front().name == "natural" && *out.trials[1].rms < *out.trials[0].rms;
        try_anisotropies(smooth ? methods.front() : EstimatorSpec{}, 2, base, out, scores);
        try_anisotropies({"kriging", {}}, shortlist_max, base, out, scores);
        try_anisotropies({"idw", {}}, shortlist_max, base, out, scores);
    }
    decide(scores, out);
    return out;
}

}  // namespace terratet
