// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/calibration.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "support.hpp"
#include "tess/error.hpp"

using namespace terratet;
using namespace terratet::testing;

namespace {

/// Errors of a sharp peak and long tails (Laplace's), `size` times what is stated.
std::vector<JudgedError> laplace_errors(std::size_t count, double size, std::uint64_t seed) {
    Random random(seed);
    std::vector<JudgedError> judged;
    for (std::size_t i = 0; i < count; ++i) {
        const double stated = random(0.5, 2);
        const double magnitude = -std::log(1 - random()) * size * stated;
        judged.push_back({random(0, 10), random() < 0.5 ? magnitude : -magnitude, stated});
    }
    return judged;
}

struct Cover {
    double one = 0, two = 0, half_width = 0;
};

Cover cover(const std::vector<JudgedError>& judged, const Calibration& calibration) {
    Cover c;
    for (const auto& j : judged) {
        const auto [deviation, half_width] = calibration.stated(j.estimate, j.deviation);
        c.one += std::abs(j.error) <= deviation ? 1 : 0;
        c.two += std::abs(j.error) <= 1.96 * deviation ? 1 : 0;
        c.half_width += std::abs(j.error) <= half_width ? 1 : 0;
    }
    const auto n = static_cast<double>(judged.size());
    return {c.one / n, c.two / n, c.half_width / n};
}

}  // namespace

TEST_CASE(
    "The half-width covers 95 %, the deviation misses 68 and 95 by equal parts where no figure is right for both") {
    for (const double size : {0.2, 1.0, 7.0}) {
        const auto calibration = calibrate(laplace_errors(20'000, size, 91), 400);
        const Cover c = cover(laplace_errors(20'000, size, 92), calibration);
        INFO(size << ": " << c.one << " " << c.two << " " << c.half_width);
        CHECK(c.half_width == Approx(0.95).margin(0.01));
        CHECK(c.one >= 0.68);
        CHECK(c.two <= 0.95);
        CHECK((c.one - 0.6827) / 6 == Approx((0.95 - c.two) / 4).margin(0.003));
    }
}

TEST_CASE("Errors that grow with the estimate are stated so, at the tenth estimated highest as among all") {
    const auto proportional = [](std::uint64_t seed) {
        auto judged = laplace_errors(10'000, 1, seed);
        for (auto& j : judged) {
            j.error *= j.estimate / 5;
        }
        return judged;
    };
    const auto calibration = calibrate(proportional(93), 100);
    CHECK(calibration.levels.size() == 10);
    auto highest = proportional(94);
    std::erase_if(highest, [](const JudgedError& j) { return j.estimate < 9; });
    const Cover c = cover(highest, calibration);
    INFO(c.one << " " << c.half_width);
    CHECK(c.one == Approx(0.71).margin(0.05));
    CHECK(c.half_width == Approx(0.95).margin(0.03));
    CHECK(calibration.relative(-100) == calibration.levels.front().relative);
    CHECK(calibration.relative(100) == calibration.levels.back().relative);
    // Too few boreholes to tell levels apart.
    CHECK(calibrate(proportional(93), 9).levels.empty());
}

TEST_CASE("The fewer boreholes, the wider: from ten down the half-width is beyond the worst error seen") {
    const auto judged = laplace_errors(1'000, 1, 95);
    double worst = 0;
    for (const auto& j : judged) {
        worst = std::max(worst, std::abs(j.error) / j.deviation);
    }
    Calibration fewer = calibrate(judged, 2);
    CHECK(fewer.factor_95 > 6 * worst);
    for (const std::size_t boreholes : {3, 5, 10, 15, 20, 100}) {
        const Calibration calibration = calibrate(judged, boreholes);
        INFO(boreholes);
        CHECK(calibration.factor_95 < fewer.factor_95);
        CHECK(calibration.factor_sd < fewer.factor_sd);
        CHECK((boreholes > 10 || calibration.factor_95 > worst));
        CHECK((boreholes > 10 || 1.96 * calibration.factor_sd >= (1 - 1e-4) * calibration.factor_95));
        fewer = calibration;
    }
}

TEST_CASE("What says nothing does not count, and nothing at all leaves the method's own figure") {
    auto judged = laplace_errors(500, 1, 96);
    const auto without = calibrate(judged, 30).to_string();
    judged.push_back({std::nan(""), 1, 1});
    judged.push_back({1, std::nan(""), 1});
    judged.push_back({1, 5, 0});
    judged.push_back({1, 5, std::nan("")});
    judged.push_back({1, 5, 1e-310});
    std::reverse(judged.begin(), judged.end());
    CHECK(calibrate(judged, 30).to_string() == without);
    const Calibration none = calibrate({}, 0);
    CHECK(none.samples == 0);
    CHECK(none.stated(3, 2).deviation == 2);
    CHECK(none.stated(3, 2).half_width == Approx(2 * 1.96));
}

TEST_CASE("A calibration is read as it was written, and text that is none is refused") {
    const auto judged = laplace_errors(3'000, 0.3, 97);
    for (const std::size_t boreholes : {1, 8, 300}) {
        const Calibration written = calibrate(judged, boreholes);
        const Calibration read = parse_calibration(written.to_string());
        CHECK(read.to_string() == written.to_string());
        CHECK(read.factor_sd == written.factor_sd);
        CHECK(read.levels.size() == written.levels.size());
        CHECK(read.relative(4.321) == written.relative(4.321));
    }
    for (const std::string text :
         {"", "natural", "uncertainty:sd=nan", "uncertainty:sd=-1", "uncertainty:sd=inf", "uncertainty:sd",
          "uncertainty:half_width=1e999", "uncertainty:sd=1e13", "uncertainty:other=1", "uncertainty:samples=-3",
          "uncertainty:levels=1", "uncertainty:levels=1/0", "uncertainty:levels=1/1,1/2", "uncertainty:levels=2/1,1/2",
          "uncertainty:levels=", "uncertainty:levels=0/1,1/1,2/1,3/1,4/1,5/1,6/1,7/1,8/1,9/1,10/1"}) {
        INFO(text);
        CHECK_THROWS_AS(parse_calibration(text), UsageError);
    }
}
