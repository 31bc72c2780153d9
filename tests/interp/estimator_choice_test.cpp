// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/plan/estimator_choice.hpp"

#include <tbb/global_control.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

#include "estimation.hpp"
#include "interp/model_estimator.hpp"
#include "interp/plan/likely_planes.hpp"
#include "random_field.hpp"
#include "tess/error.hpp"

using namespace terratet;
using namespace terratet::testing;

namespace {

using Truth = std::function<double(const Vec3&)>;

constexpr double degree = std::numbers::pi / 180;

Vec3 normal_of(double azimuth, double dip) {
    return {std::sin(dip * degree) * std::sin(azimuth * degree), std::sin(dip * degree) * std::cos(azimuth * degree),
            std::cos(dip * degree)};
}

/// Holes about `apart` from each other, tilted by up to `tilt` degrees, a sample a metre or so.
SampledValues holes(std::size_t across, double apart, double depth, double step, double tilt, std::uint64_t seed,
                    const Truth& truth) {
    Random random(seed);
    SampledValues out;
    for (std::size_t k = 0; k < across * across; ++k) {
        const Vec3 collar{apart * double(k % across) + apart * 0.2 * random(),
                          apart * double(k / across) + apart * 0.2 * random(), 0};
        const Vec3 way = -normal_of(360 * random(), tilt * random());
        for (double d = 0.5 * step; d < depth; d += step) {
            out.sites.push_back(collar + d * way);
            out.values.push_back(truth(out.sites.back()));
            out.boreholes.push_back(static_cast<std::int32_t>(k));
        }
    }
    return out;
}

/// 10 in a layer two metres thick that dips 3° to the east, about 0.1 elsewhere.
SampledValues seam(std::uint64_t seed = 3) {
    Random random(seed);
    return holes(4, 60, 80, 1, 0, seed, [&](const Vec3& p) {
        const double above = p.z + 40 + std::tan(3 * degree) * p.x;
        return std::abs(above) < 1 ? 10 : 0.1 + 0.02 * random();
    });
}

Model model_of(const SampledValues& data) {
    Model model;
    model.properties = {{"v", "", Scale::linear, data.kind, {}}};
    model.samples.positions = data.sites;
    model.samples.borehole = data.boreholes;
    model.samples.values = {data.values};
    return model;
}

EstimatorPlan open_plan(const std::string& spec) {
    return with_open_chosen(parse_estimator_plan(spec));
}

double mean_on_seam(const ModelEstimator& estimator) {
    Random random(5);
    std::vector<Vec3> places;
    for (int i = 0; i < 300; ++i) {
        const double x = 180 * random();
        places.push_back({x, 180 * random(), -40 - std::tan(3 * degree) * x});
    }
    const auto values = estimator.values(queries_at(places)).values[0];
    return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
}

/// Every fifth hole is asked for what the others say.
double held_out_rms(const SampledValues& all, const std::string& spec) {
    SampledValues known{{}, {}, {}, all.kind};
    std::vector<Vec3> places;
    std::vector<double> truth;
    for (std::size_t i = 0; i < all.sites.size(); ++i) {
        if (all.boreholes[i] % 5 == 2) {
            places.push_back(all.sites[i]);
            truth.push_back(all.values[i]);
        } else {
            known.sites.push_back(all.sites[i]);
            known.values.push_back(all.values[i]);
            known.boreholes.push_back(all.boreholes[i]);
        }
    }
    const Model model = model_of(known);
    const auto values = ModelEstimator(model, no_faults(), open_plan(spec)).values(queries_at(places)).values[0];
    double squares = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        squares += (values[i] - truth[i]) * (values[i] - truth[i]);
    }
    return std::sqrt(squares / double(values.size()));
}

}  // namespace

TEST_CASE("A thin dipping seam goes on from hole to hole, for each method, without a hand") {
    const Model model = model_of(seam());
    for (const std::string spec : {"natural", "idw", "kriging"}) {
        INFO(spec);
        CHECK(mean_on_seam(ModelEstimator(model, no_faults(), open_plan(spec))) > (spec == "idw" ? 7 : 9));
    }
    CHECK(mean_on_seam(ModelEstimator(model, no_faults(), open_plan("natural:anisotropy=none"))) < 3);
}

TEST_CASE("The plane along which holes resemble each other is found within a degree, whatever way they go") {
    struct Case {
        double azimuth, dip, tilt;
    };
    for (const auto& [azimuth, dip, tilt] : {Case{40, 12, 0}, {200, 30, 20}, {290, 5, 30}, {120, 50, 10}}) {
        const Vec3 normal = normal_of(azimuth, dip);
        Random random(9);
        std::vector<double> layers(400);
        for (double& v : layers) {
            v = random();
        }
        const auto data = holes(4, 50, 150, 1, tilt, 11, [&, n = normal](const Vec3& p) {
            return layers[static_cast<std::size_t>(std::floor(dot(n, p) / 4) + 200)];
        });
        const auto planes = planes_between_holes(data, 3);
        REQUIRE_FALSE(planes.empty());
        INFO(azimuth << " " << dip << " " << tilt);
        CHECK(std::acos(std::min(1.0, dot(planes.front(), normal))) / degree < 1);
        const Anisotropy told = flattened(planes.front(), 0.1);
        CHECK(std::remainder(told.azimuth_deg - azimuth, 360) == Approx(0).margin(6));
        CHECK(told.dip_deg == Approx(dip).margin(1));
    }
    CHECK(planes_between_holes({{{0, 0, 0}, {1, 0, 0}}, {1, 2}, {-1, -1}, Kind::continuous}, 3).empty());
}

TEST_CASE("Slopes of loose samples tell the three axes and how they relate") {
    const Anisotropy truth{30, 20, 25, 0.5, 0.2};
    const Metric metric(truth);
    const RandomField field(300, 300, 21);
    SampledValues data;
    Random random(22);
    for (int i = 0; i < 3000; ++i) {
        data.sites.push_back(random.in({{0, 0, 0}, {300, 300, 300}}));
        const Vec3 p = metric(data.sites.back());
        data.values.push_back(std::sin(p.x / 90) + std::sin(p.y / 90) + std::sin(p.z / 90));
        data.boreholes.push_back(-1);
    }
    const Anisotropy found = anisotropy_of_slopes(data);
    CHECK(found.ratio3 == Approx(0.2).epsilon(0.25));
    CHECK(found.ratio2 == Approx(0.5).epsilon(0.25));
    const Metric as_found(found);
    for (const Vec3& axis : {Vec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}, {1, -1, 0}}) {
        CHECK(length(as_found(axis)) == Approx(length(metric(axis))).epsilon(0.25));
    }
}

TEST_CASE("Where isotropy is right held-out holes are estimated no worse than 1 %") {
    double all = 0;
    for (const std::uint64_t seed : {31, 32, 33, 34}) {
        const auto data = holes(6, 60, 200, 8, 25, seed, RandomField(120, 120, seed));
        all += std::log(held_out_rms(data, "natural") / held_out_rms(data, "natural:anisotropy=none"));
    }
    CHECK(std::exp(all / 4) < 1.01);
}

TEST_CASE("R6: the choice depends neither on the order of samples, nor on boreholes' numbers, nor on threads") {
    const auto data = seam();
    std::vector<std::size_t> order(data.sites.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (const std::uint64_t seed : {0, 41, 42}) {
        const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, seed == 41 ? 1 : 4);
        Random random(seed);
        for (std::size_t i = order.size(); seed > 0 && i > 1; --i) {
            std::swap(order[i - 1], order[static_cast<std::size_t>(random() * double(i))]);
        }
        SampledValues other;
        for (const std::size_t i : order) {
            other.sites.push_back(data.sites[i]);
            other.values.push_back(data.values[i]);
            other.boreholes.push_back(seed > 0 ? 100 - data.boreholes[i] : data.boreholes[i]);
        }
        const auto straight = EstimatorChooser(data, nullptr).choose(parse_estimator("idw:anisotropy=auto"));
        const auto chosen = EstimatorChooser(other, nullptr).choose(parse_estimator("idw:anisotropy=auto"));
        CHECK(chosen.spec.to_string() == straight.spec.to_string());
        CHECK(chosen.choice.rms == straight.choice.rms);
        CHECK(chosen.choice.folds == 5);
    }
}

TEST_CASE("A choice is kept with the plan: the same bits again, and nothing is chosen a second time") {
    const Model model = model_of(seam());
    const ModelEstimator first(model, no_faults(), open_plan("natural"));
    const EstimatorPlan stored = parse_estimator_plan(first.plan().to_string());
    REQUIRE(stored.to_string() == first.plan().to_string());
    REQUIRE(stored.choices.at("v").folds == 5);
    CHECK(stored.choices.at("v").rms < 0.97 * stored.choices.at("v").rms_plain);
    CHECK(anisotropy_of(stored.of("v")).ratio3 < 0.1);
    CHECK_FALSE(is_to_be_chosen(stored.general));
    const auto queries = queries_in({{0, 0, -80}, {180, 180, 0}}, 300, 51);
    const ModelEstimator again(model, no_faults(), stored);
    CHECK(same_bits(first.values(queries).values[0], again.values(queries).values[0]));
    // Samples that would have it chosen otherwise, as after an edit.
    Model edited = model;
    for (double& v : edited.samples.values[0]) {
        v = std::sin(1e4 * v);
    }
    const ModelEstimator kept(edited, no_faults(), with_open_chosen(stored));
    CHECK(kept.plan().of("v").to_string() == stored.of("v").to_string());
}

TEST_CASE("An isotropic choice is kept with the plan, too, though other samples would have it otherwise") {
    const auto layered = seam();
    Model plain = model_of(layered);
    const RandomField field(80, 80, 52);
    for (std::size_t i = 0; i < layered.sites.size(); ++i) {
        plain.samples.values[0][i] = field(layered.sites[i]);
    }
    const EstimatorPlan stored =
        parse_estimator_plan(ModelEstimator(plain, no_faults(), open_plan("natural")).plan().to_string());
    REQUIRE(stored.choices.at("v").folds == 5);
    REQUIRE(anisotropy_of(stored.of("v")).isotropic());
    const Model edited = model_of(layered);
    REQUIRE_FALSE(anisotropy_of(ModelEstimator(edited, no_faults(), open_plan("natural")).plan().of("v")).isotropic());
    const ModelEstimator kept(edited, no_faults(), with_open_chosen(stored));
    CHECK(anisotropy_of(kept.plan().of("v")).isotropic());
    CHECK(kept.plan().choices.at("v").rms == stored.choices.at("v").rms);
}

TEST_CASE("Anisotropy that is given, or none, is left as it is") {
    for (const std::string spec :
         {"natural:anisotropy=none", "idw:ratio3=0.5", "kriging:azimuth=20", "linear:roll=3"}) {
        const EstimatorPlan plan = open_plan(spec);
        CHECK_FALSE(is_to_be_chosen(plan.general));
        CHECK(plan.general.as_given() == parse_estimator(spec).as_given());
    }
    CHECK(is_to_be_chosen(open_plan("natural").general));
    CHECK(is_to_be_chosen(open_plan("natural:anisotropy=auto").general));
    CHECK(is_to_be_chosen(open_plan("").general));
    for (const std::string bad :
         {"natural:anisotropy=some", "auto:ratio3=0.1", "natural\nchosen:rms=1 of v",
          "natural\nchosen:rms=1:plain=1:better=3:folds=2 of v", "natural\nchosen:rms=-1:plain=1:better=1:folds=2 of v",
          "natural\nchosen:rms=1:plain=1:better=1:folds=2:more=1 of v"}) {
        INFO(bad);
        CHECK_THROWS_AS(parse_estimator_plan(bad), UsageError);
    }
}

TEST_CASE("Each property has its own: one layered, one alike in all directions, and one with too few holes") {
    const auto layered = seam();
    Model model = model_of(layered);
    model.properties.push_back({"w", "", Scale::linear, Kind::continuous, {}});
    model.properties.push_back({"few", "", Scale::linear, Kind::continuous, {}});
    const RandomField field(80, 80, 61);
    model.samples.values.resize(3);
    for (std::size_t i = 0; i < layered.sites.size(); ++i) {
        model.samples.values[1].push_back(i % 4 == 0 ? field(layered.sites[i]) : missing);
        model.samples.values[2].push_back(layered.boreholes[i] < 2 ? 1.0 + double(i % 7) : missing);
    }
    const EstimatorPlan plan = ModelEstimator(model, no_faults(), open_plan("natural")).plan();
    CHECK(anisotropy_of(plan.of("v")).ratio3 < 0.1);
    CHECK(anisotropy_of(plan.of("w")).ratio3 > 0.3);
    CHECK(plan.of("few").as_given() == "natural");
    CHECK(plan.choices.at("few").folds == 0);
}

TEST_CASE("auto takes another method only where it wins") {
    const auto layered = EstimatorChooser(seam(), nullptr).choose(parse_estimator("auto"));
    double least = *layered.trials.front().rms;
    for (const auto& trial : layered.trials) {
        least = std::min(least, *trial.rms);
    }
    CHECK(layered.choice.rms == least);
    CHECK(layered.choice.rms < 0.97 * layered.choice.rms_plain);
    std::size_t tessellations = 0;
    for (const auto& trial : layered.trials) {
        tessellations += trial.spec.name == "natural" ? layered.choice.folds : 0;
    }
    CHECK(tessellations <= 20);
    const auto plane = holes(6, 60, 200, 8, 25, 73, [](const Vec3& p) { return 3 * p.x - p.y + 2 * p.z; });
    const auto linear = EstimatorChooser(plane, nullptr).choose(parse_estimator("auto:anisotropy=none"));
    CHECK(linear.trials.size() == 4);
    CHECK(std::ranges::none_of(linear.trials, [](const auto& t) { return t.spec.options.contains("ratio3"); }));
}

TEST_CASE("Layers of rock, a category, are followed along their dip") {
    auto data = holes(5, 60, 200, 2, 10, 81, [](const Vec3& p) {
        return double((int(std::floor(dot(normal_of(120, 35), p) / 12)) % 3 + 3) % 3);
    });
    data.kind = Kind::categorical;
    const auto chosen = EstimatorChooser(data, nullptr).choose(parse_estimator("natural:anisotropy=auto"));
    CHECK(chosen.choice.rms < 0.8 * chosen.choice.rms_plain);
    const Anisotropy told = anisotropy_of(chosen.spec);
    CHECK(std::abs(dot(normal_of(told.azimuth_deg, told.dip_deg), normal_of(120, 35))) > std::cos(3 * degree));
}

TEST_CASE("Of many samples those of the boreholes nearest the middle are looked at") {
    const auto all = holes(10, 60, 200, 0.5, 0, 91, [](const Vec3& p) { return p.x; });
    REQUIRE(all.sites.size() == 40000);
    const auto part = canonical_part(all, 20000);
    CHECK(part.sites.size() == 20000);
    const Box3 box = bounding_box(part.sites), whole = bounding_box(all.sites);
    CHECK(box.size().x < 0.9 * whole.size().x);
    CHECK(length(box.center() - whole.center()) < 60);
    CHECK(std::is_sorted(part.sites.begin(), part.sites.end()));
}
