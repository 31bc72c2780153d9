// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/lattice.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "tess/error.hpp"

using namespace terratet;

TEST_CASE(
    "An aligned lattice has its edges at multiples of the size on the map, and covers the box with none to spare") {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (int trial = 0; trial < 200; ++trial) {
        Frame frame;
        frame.origin = {525312, 6791168, -1024};
        frame.z_scale = trial % 2 == 0 ? 1 : 12.5;
        const Vec3 size{1 + 30 * uniform(random), 25, 0.1 * std::ceil(40 * uniform(random))};
        const Vec3 lo = frame.to_local({525000 + 900 * uniform(random), 6791000, -900 + 40 * uniform(random)});
        const Vec3 hi =
            frame.to_local({526000 + 900 * uniform(random), 6793000 + 33 * uniform(random), 30 * uniform(random)});
        const Lattice lattice = aligned_lattice({lo, hi}, frame, size);
        const Vec3 first = frame.to_world(lattice.origin);
        const Vec3 last = frame.to_world(lattice.center(lattice.size[0] - 1, lattice.size[1] - 1, lattice.size[2] - 1));
        for (int axis = 0; axis < 3; ++axis) {
            const double below = first[axis] - size[axis] / 2;
            const double above = last[axis] + size[axis] / 2;
            const double tolerance = 1e-8 * size[axis];
            CHECK(std::abs(below / size[axis] - std::round(below / size[axis])) < 1e-8);
            CHECK(below <= frame.to_world(lo)[axis] + tolerance);
            CHECK(above >= frame.to_world(hi)[axis] - tolerance);
            CHECK(below + size[axis] > frame.to_world(lo)[axis] - tolerance);
            CHECK(above - size[axis] < frame.to_world(hi)[axis] + tolerance);
        }
    }
    CHECK_THROWS_AS(aligned_lattice({{0, 0, 0}, {1, 1, 1}}, {}, {1e-12, 1, 1}), UsageError);
    CHECK_THROWS_AS(aligned_lattice(Box3{}, {}, {1, 1, 1}), UsageError);
}
