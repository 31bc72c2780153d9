// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a fault complex is mended with, and which of its triangles may be certified together.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "support.hpp"
#include "tess/barrier/complex/complex_mender.hpp"
#include "tess/base/compatible.hpp"

namespace terratet {
namespace {

constexpr double edge = 10;
constexpr int cells = 6;

/// Two sheets of cells × cells squares that meet along the y axis, the one so much above the plane z = 0 as the other
/// is below it.
SheetComplex open_book(double angle_deg) {
    SheetComplex complex;
    const auto number = [&](std::uint32_t sheet, int i, int j) {
        return static_cast<std::uint32_t>(i == 0 ? j : (cells + 1) * (1 + cells * static_cast<int>(sheet) + i - 1) + j);
    };
    complex.points.resize(static_cast<std::size_t>((cells + 1) * (1 + 2 * cells)));
    for (std::uint32_t sheet = 0; sheet < 2; ++sheet) {
        const double angle = (sheet == 0 ? 0.5 : -0.5) * angle_deg * std::numbers::pi / 180;
        for (int i = 0; i <= cells; ++i) {
            for (int j = 0; j <= cells; ++j) {
                complex.points[number(sheet, i, j)] = {edge * i * std::cos(angle), edge * j,
                                                       edge * i * std::sin(angle)};
            }
        }
        for (int i = 0; i < cells; ++i) {
            for (int j = 0; j < cells; ++j) {
                complex.triangles.push_back(
                    {number(sheet, i, j), number(sheet, i + 1, j), number(sheet, i + 1, j + 1)});
                complex.triangles.push_back(
                    {number(sheet, i, j), number(sheet, i + 1, j + 1), number(sheet, i, j + 1)});
                complex.sheet.insert(complex.sheet.end(), 2, sheet);
            }
        }
    }
    return complex;
}

/// At the book's back, but for its ends, where the rims hold the pages.
double sharpest(const SheetComplex& complex) {
    const EdgeTable edges(complex.triangles);
    double least = std::numbers::pi;
    for (const EdgeTable::Edge& e : edges.edges()) {
        const double along = 0.5 * (complex.points[e.a].y + complex.points[e.b].y);
        if (!is_smooth(complex, edges.triangles(e)) && edges.triangles(e).size() > 1 && along < edge * (cells - 1)) {
            least = std::min(least, wedge_angle(complex, edges.triangles(e), e.a, e.b));
        }
    }
    return least;
}

}  // namespace

TEST_CASE("Triangles that meet at less than ten degrees are turned apart, and bounds stay where they are") {
    const SheetComplex before = open_book(6);
    REQUIRE(sharpest(before) < least_wedge);
    const SizeField sizes(edge);
    const Patches numbering = patches(before, EdgeTable(before.triangles));
    for (const bool bound : {false, true}) {
        INFO("the first is " << (bound ? "a bound" : "a fault"));
        ComplexEditor editor(before, numbering, sizes, std::vector<char>{bound ? '\1' : '\0', '\0'});
        ComplexMender(editor).open_wedges();
        const SheetComplex after = editor.result();
        CHECK(sharpest(after) >= least_wedge);
        CHECK(sharpest(after) < 1.1 * least_wedge);
        REQUIRE(after.points.size() == before.points.size());
        std::array<double, 2> moved{};
        for (std::size_t t = 0; t < after.triangles.size(); ++t) {
            for (const std::uint32_t v : after.triangles[t]) {
                moved[after.sheet[t]] = std::max(moved[after.sheet[t]], distance(after.points[v], before.points[v]));
            }
        }
        CHECK(moved[0] < 0.1 * edge);
        CHECK(moved[1] < 0.1 * edge);
        CHECK((moved[0] == 0) == bound);
        CHECK(moved[1] > 0);
    }
}

TEST_CASE("Of things that exclude each other as many stay as get along, and none is left out for nothing") {
    std::vector<std::vector<std::uint32_t>> star(6);
    for (std::uint32_t leaf = 1; leaf < 6; ++leaf) {
        star[0].push_back(leaf);
        star[leaf].push_back(0);
    }
    CHECK(compatible(star) == std::vector<char>{0, 1, 1, 1, 1, 1});

    testing::Random random(2);
    for (int run = 0; run < 200; ++run) {
        const std::size_t count = 1 + random.below(60);
        std::vector<std::vector<std::uint32_t>> conflicts(count);
        for (std::size_t k = random.below(4 * count); k-- > 0;) {
            const auto a = static_cast<std::uint32_t>(random.below(count));
            const auto b = static_cast<std::uint32_t>(random.below(count));
            if (a != b) {
                conflicts[a].push_back(b);
                conflicts[b].push_back(a);
            }
        }
        const std::vector<char> there = compatible(conflicts);
        for (std::size_t i = 0; i < count; ++i) {
            const bool excluded =
                std::ranges::any_of(conflicts[i], [&](std::uint32_t other) { return there[other] != 0; });
            REQUIRE((there[i] != 0) == !excluded);
        }
    }
}

}  // namespace terratet
