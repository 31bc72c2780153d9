// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/write/tiles/surface_tiles.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>

#include "support.hpp"

using namespace terratet;

namespace {

/// Hills, coloured by another pattern than their heights.
ScenePart hills(int n, double height) {
    ScenePart part;
    part.kind = ScenePart::Kind::section;
    for (int i = 0; i <= n; ++i) {
        for (int j = 0; j <= n; ++j) {
            const double x = 1000.0 * i / n;
            const double y = 1000.0 * j / n;
            part.positions.push_back({x, height * std::sin(x / 90) * std::cos(y / 130), y});
            const double shade = 0.5 + 0.5 * std::sin(x / 60 + y / 200);
            part.colors.push_back({shade, 0.5, 1 - shade});
        }
    }
    const auto at = [n](int i, int j) { return static_cast<std::uint32_t>(i * (n + 1) + j); };
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            part.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            part.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    }
    return part;
}

ScenePart tube() {
    ScenePart part;
    part.kind = ScenePart::Kind::borehole;
    part.sides = 3;
    constexpr int rings = 60;
    for (int r = 0; r < rings; ++r) {
        const int at = std::clamp(r, 1, rings - 2);
        for (int k = 0; k < 3; ++k) {
            const double radius = r == at ? 4 : 0;
            part.positions.push_back(
                {500 + radius * std::cos(2.1 * k) + 0.05 * at * at, -10.0 * at, 500 + radius * std::sin(2.1 * k)});
            part.colors.push_back({at % 20 < 10 ? 1.0 : 0.0, 0.2, 0.2});
        }
    }
    for (std::uint32_t r = 1; r < rings; ++r) {
        for (std::uint32_t k = 0; k < 3; ++k) {
            const std::uint32_t next = (k + 1) % 3;
            part.triangles.push_back({3 * r - 3 + k, 3 * r - 3 + next, 3 * r + next});
            part.triangles.push_back({3 * r - 3 + k, 3 * r + next, 3 * r + k});
        }
    }
    return part;
}

void for_each(const SurfaceTile& tile, const std::function<void(const SurfaceTile&)>& visit) {
    visit(tile);
    for (const SurfaceTile& child : tile.children) {
        for_each(child, visit);
    }
}

/// Of one part, what the tiles without children show below.
std::vector<Triangle> full_below(const SurfaceTile& tile, std::uint32_t part) {
    std::vector<Triangle> result;
    for_each(tile, [&](const SurfaceTile& below) {
        for (const TilePart& p : below.parts) {
            if (below.children.empty() && p.part == part) {
                result.insert(result.end(), p.triangles.begin(), p.triangles.end());
            }
        }
    });
    return result;
}

using Edge = std::pair<std::uint32_t, std::uint32_t>;

std::set<Edge> border(const std::vector<Triangle>& triangles) {
    std::map<Edge, int> count;
    for (const Triangle& t : triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            ++count[std::minmax(t[k], t[(k + 1) % 3])];
        }
    }
    std::set<Edge> result;
    for (const auto& [edge, times] : count) {
        REQUIRE(times <= 2);
        if (times == 1) {
            result.insert(edge);
        }
    }
    return result;
}

double brute_distance(const Vec3& p, const ScenePart& part, const std::vector<Triangle>& triangles) {
    double least = 1e30;
    for (const auto& [a, b, c] : triangles) {
        const Vec3 near = closest_point_on_triangle(p, part.positions[a], part.positions[b], part.positions[c]);
        least = std::min(least, distance(p, near));
    }
    return least;
}

constexpr SurfaceTileOptions small{.most_triangles = 400, .coarsest = 60, .color_metres = 300};

}  // namespace

TEST_CASE("Tiles without children show each triangle once, and those above fewer with the same borders") {
    const std::vector<ScenePart> parts{hills(40, 60), tube()};
    const SurfaceTile top = surface_tiles(parts, small, {});
    auto all = full_below(top, 0);
    auto given = parts[0].triangles;
    std::ranges::sort(all);
    std::ranges::sort(given);
    CHECK(all == given);
    std::size_t levels = 0;
    for_each(top, [&](const SurfaceTile& tile) {
        for (const TilePart& part : tile.parts) {
            if (part.part == 0) {
                CHECK(border(part.triangles) == border(full_below(tile, 0)));
                CHECK((tile.children.empty() || part.triangles.size() < full_below(tile, 0).size() / 2));
            }
        }
        levels += tile.children.empty() ? 0 : 1;
    });
    CHECK(levels >= 4);
    CHECK(top.parts.size() == 2);
}

TEST_CASE("A tile says how far it is from the full surfaces, as brute force finds it") {
    const std::vector<ScenePart> parts{hills(24, 60)};
    const SurfaceTile top = surface_tiles(parts, small, {});
    for_each(top, [&](const SurfaceTile& tile) {
        if (tile.children.empty()) {
            CHECK(tile.deviation.distance == 0);
            return;
        }
        std::set<std::uint32_t> corners;
        double found = 0;
        for (const Triangle& t : full_below(tile, 0)) {
            corners.insert(t.begin(), t.end());
        }
        for (const std::uint32_t v : corners) {
            found = std::max(found, brute_distance(parts[0].positions[v], parts[0], tile.parts[0].triangles));
        }
        CHECK(found > 0);
        CHECK(tile.deviation.distance >= found - 1e-9);
        CHECK(tile.deviation.distance < 3 * found + 1);
        for (const SurfaceTile& child : tile.children) {
            CHECK(child.deviation.distance <= tile.deviation.distance);
            CHECK(child.box.lo.x >= tile.box.lo.x);
            CHECK(child.box.hi.z <= tile.box.hi.z);
        }
    });
}

TEST_CASE("A flat section keeps its colours, where a shape of one colour becomes plain") {
    std::vector<ScenePart> parts{hills(40, 0)};
    const SurfaceTile colored = surface_tiles(parts, small, {});
    CHECK(colored.deviation.distance < 1e-9);
    CHECK(colored.deviation.color > 0.001);
    CHECK(colored.deviation.color < 0.25);  // the map goes through some five hills and valleys
    parts[0].colors.clear();
    const SurfaceTile plain = surface_tiles(parts, small, {});
    CHECK(plain.deviation.color == 0);
    CHECK(plain.deviation.distance < 1e-9);
}

TEST_CASE("From afar a tube has fewer rings, closed as before, and keeps its sharp changes of colour longest") {
    const std::vector<ScenePart> parts{tube()};
    const SurfaceTile top = surface_tiles(parts, {.most_triangles = 200, .coarsest = 100, .color_metres = 300}, {});
    REQUIRE(top.children.size() == 1);
    const auto& rings = top.parts[0].rings;
    CHECK(rings.size() < 25);
    CHECK(rings.front() == 0);
    CHECK(rings.back() == 59);
    for (const std::uint32_t sharp : {9U, 10U, 19U, 20U}) {
        CHECK(std::ranges::count(rings, sharp) == 1);
    }
    const ScenePart drawn = shown(parts[0], top.parts[0]);
    CHECK(drawn.positions.size() == 3 * rings.size());
    CHECK(drawn.triangles.size() == 6 * (rings.size() - 1));
    CHECK(top.deviation.distance > 0);
    CHECK(top.deviation.distance < 10);
}
