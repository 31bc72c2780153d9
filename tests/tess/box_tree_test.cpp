// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/base/box_tree.hpp"

#include <catch2/catch.hpp>
#include <limits>
#include <set>

#include "support.hpp"

using namespace terratet;

namespace {

struct Sum {
    int items = 0;
};

BoxTree<Vec3, Sum> tree_of(std::vector<Vec3> points, std::uint32_t leaf_size) {
    return {std::move(points), leaf_size,
            [](auto& node, const Vec3& p) {
                node.box.extend(p);
                ++node.more.items;
            },
            [](const Vec3& p, int axis) { return p[axis]; }};
}

/// On a coarse grid, so that many share coordinates or are the same.
std::vector<Vec3> random_points(std::uint64_t seed, int count) {
    testing::Random random(seed);
    std::vector<Vec3> points;
    for (int i = 0; i < count; ++i) {
        const Vec3 p = random.in({{0, 0, 0}, {10, 4, 2}});
        points.push_back({std::floor(p.x), std::floor(p.y), std::floor(2 * p.z)});
    }
    return points;
}

}  // namespace

TEST_CASE("A tree of boxes finds all items that are wanted, and none besides, as a look at each does") {
    for (const int count : {0, 1, 2, 7, 300}) {
        for (const std::uint32_t leaf_size : {1U, 4U, 8U}) {
            const auto points = random_points(11, count);
            const auto tree = tree_of(points, leaf_size);
            CHECK(tree.items().size() == points.size());
            testing::Random random(12);
            for (int q = 0; q < 50; ++q) {
                const Vec3 lo = random.in({{0, 0, 0}, {10, 4, 4}});
                const Box3 box{lo, lo + Vec3{2, 2, 1}};
                std::multiset<std::array<double, 3>> found;
                const auto overlaps = [&](const auto& node) {
                    CHECK(node.more.items == static_cast<int>(node.end - node.begin));
                    return box.contains(node.box.clamped(box.lo));  // the point of the node nearest to a corner
                };
                const bool stopped = tree.any(overlaps, [&](const Vec3& p) {
                    if (box.contains(p)) {
                        found.insert({p.x, p.y, p.z});
                    }
                    return false;
                });
                std::multiset<std::array<double, 3>> expected;
                for (const Vec3& p : points) {
                    if (box.contains(p)) {
                        expected.insert({p.x, p.y, p.z});
                    }
                }
                CHECK_FALSE(stopped);
                CHECK(found == expected);
                CHECK(tree.any([](const auto&) { return true; }, [&](const Vec3& p) { return box.contains(p); }) ==
                      !expected.empty());
            }
        }
    }
}

TEST_CASE("Nearest first, a tree of boxes comes to the nearest item, and looks at few others") {
    const auto points = random_points(13, 2000);
    const auto tree = tree_of(points, 4);
    testing::Random random(14);
    std::size_t looked_at = 0;
    for (int q = 0; q < 200; ++q) {
        const Vec3 p = random.in({{-2, -2, -2}, {12, 6, 6}});
        double least = std::numeric_limits<double>::infinity();
        tree.near_first(
            p, [&](const auto&, double away) { return away < least; },
            [&](const Vec3& item) {
                ++looked_at;
                least = std::min(least, squared_distance(item, p));
            });
        double expected = std::numeric_limits<double>::infinity();
        for (const Vec3& item : points) {
            expected = std::min(expected, squared_distance(item, p));
        }
        CHECK(least == expected);
    }
    CHECK(looked_at < 200 * 100);
}
