// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

#include "tess/model/density_edition.hpp"
#include "tess/refine/box_faces.hpp"
#include "tess/refine/refine.hpp"
#include "tests/support.hpp"

using namespace terratet;
using testing::Random;

namespace {

const Box3 large_box{{0, 0, -7000}, {10000, 10000, 0}};

struct Task {
    std::vector<Vec3> points;
    Box3 box;
    double l_min = 5;
};

std::vector<Vec3> points_in(const Box3& box, int count, std::uint64_t seed) {
    Random random(seed);
    std::vector<Vec3> points;
    for (int i = 0; i < count; ++i) {
        points.push_back(random.in(box));
    }
    return points;
}

/// As by default: in plan by l_max, by half the data's diagonal at most, and here vertically, too.
Box3 padded(const std::vector<Vec3>& points, double l_max) {
    const Box3 data = bounding_box(points);
    return data.grown(std::min(l_max, data.diagonal() / 2));
}

/// Two columns of ten samples 3.2 km apart, in a box that grows with l_max.
Task two_holes(std::uint64_t seed, double l_max) {
    Task task;
    Random random(seed);
    for (const double x : {0.0, 3200 + random(-50, 50)}) {
        for (int k = 0; k < 10; ++k) {
            task.points.push_back({x, 0, -5.0 - 10 * k});
        }
    }
    task.box = padded(task.points, l_max);
    return task;
}

/// A ball of many samples and eight at 10 km.
Task cluster(std::uint64_t seed, double l_max) {
    Task task;
    task.l_min = 0.05;
    for (const Vec3& p : points_in({{-1, -1, -1}, {1, 1, 1}}, 1000, seed)) {
        if (squared_length(p) <= 1) {
            task.points.push_back(p);
        }
    }
    for (const int corner : {0, 1, 2, 3, 4, 5, 6, 7}) {
        task.points.push_back(
            {(corner & 1) != 0 ? 1e4 : -1e4, (corner & 2) != 0 ? 1e4 : -1e4, (corner & 4) != 0 ? 1e4 : -1e4});
    }
    task.box = padded(task.points, l_max);
    return task;
}

Task one_hole(std::uint64_t seed, double /*l_max*/) {
    Random random(seed);
    const double x = random(1000, 9000);
    const double y = random(1000, 9000);
    Task task{{}, large_box};
    for (int k = 0; k < 40; ++k) {
        task.points.push_back({x, y, -100.0 - 10 * k});
    }
    return task;
}

Task cluster_near_a_face(std::uint64_t seed, double /*l_max*/) {
    return {points_in({{3000, 4000, -26}, {3100, 4100, -6}}, 300, seed), large_box};
}

Task planar_cluster(std::uint64_t seed, double /*l_max*/) {
    return {points_in({{3000, 4000, -3000}, {3500, 4500, -3000}}, 400, seed), large_box};
}

Task samples_in_a_corner(std::uint64_t seed, double /*l_max*/) {
    return {points_in({{8, 8, -68}, {68, 68, -8}}, 200, seed), large_box};
}

Task samples_everywhere(std::uint64_t seed, double /*l_max*/) {
    return {points_in(large_box, 60, seed), large_box};
}

Task slab(std::uint64_t seed, double /*l_max*/) {
    const Box3 box{{0, 0, -500}, {10000, 10000, 0}};
    return {points_in(box, 60, seed), box};
}

/// How many vertices refinement inserts. Throws Error above `most`.
std::uint64_t inserted(const Task& task, double l_max, std::uint64_t most = 200000) {
    Criteria criteria;
    criteria.l_min = task.l_min;
    criteria.l_max = l_max;
    criteria.variation.resize(1);
    const std::vector<Barrier> no_faults;
    const BarrierQuery proximity(no_faults);
    Samples samples;
    samples.positions = task.points;
    std::vector<Vertex> vertices;
    std::vector<Vec3> kept;
    for (const std::uint32_t i : edit_density(samples, task.l_min, DensityMode::canonical, proximity).kept) {
        kept.push_back(task.points[i]);
        vertices.push_back({vertices.size(), task.points[i], Role::sample, static_cast<std::int32_t>(i), 0});
    }
    const Frame frame;
    for (const Vec3& p : face_grid(task.box, task.l_min, l_max, kept, frame)) {
        vertices.push_back({vertices.size(), p, Role::domain, -1, 0});
    }
    Tessellation tessellation;
    tessellation.insert(vertices);
    const auto ones = [](std::size_t count) { return std::vector<double>(count, 1); };
    VertexValues values{{ones(vertices.size())}, ones(vertices.size())};
    const ValueSource constant = [&](std::span<const ValueQuery> queries) {
        return ValueBatch{{ones(queries.size())}, ones(queries.size())};
    };
    const std::vector<Property> properties = {{"f", "", Scale::linear, Kind::continuous, {}}};
    RefineOptions options;
    options.max_vertices = most;
    return refine(tessellation, values, {task.box, task.box}, frame, proximity, criteria, properties, constant, options)
        .inserted;
}

struct Recipe {
    const char* name;
    Task (*make)(std::uint64_t seed, double l_max);
};

}  // namespace

TEST_CASE("Nothing is split for a place that no part of the box' boundary has in its ball") {
    const Box3 box{{0, 0, 0}, {10, 10, 10}};
    BoxFaces faces(box);
    for (const Vec3& p : face_grid(box, 0.1, 3.5, {}, {})) {  // five by five squares of 2 on each face
        faces.insert(p);
    }
    CHECK_FALSE(faces.split_for({5, 5, 5}));
    CHECK_FALSE(faces.split_for({5, 5, 1.5}));
    CHECK(faces.split_for({5, 5, 1.4}) == Vec3{5, 5, 0});  // a square's circle has a radius of √2
    CHECK(faces.split_for({5, 5.6, 8.9}) == Vec3{5, 5, 10});
    CHECK(faces.split_for({5.5, 4.6, -3}) == Vec3{5, 5, 0});
    CHECK(faces.split_for({0.6, 5, 0.6}) == Vec3{0, 5, 0});  // within 1 of the middle of an edge's part
    CHECK(faces.split_for({-2, 5.5, 12}) == Vec3{0, 5, 10});
    faces.insert({5, 5, 0});
    CHECK_FALSE(faces.split_for({5, 5, 1.01}));  // now of radius 1, about the sides' middles
    CHECK(faces.split_for({5, 4.2, 0.2}) == Vec3{5, 4, 0});
}

TEST_CASE("Splits of opposite faces that are coplanar but for rounding do not breed vertices") {
    for (const double apart : {3224.577, 3117.203, 3241.909, 3180.351, 3299.117, 3150.773}) {
        for (const double l_max : {1000.0, 1414.0, 2000.0, 4000.0}) {
            Task task;
            for (const double x : {0.0, apart}) {
                for (int k = 0; k < 10; ++k) {
                    task.points.push_back({x, 0, -5.1 * (5 + 10 * k)});
                }
            }
            task.box = {{-l_max, -l_max, -599.25}, {apart + l_max, l_max, 89.25}};
            INFO(apart << ", l_max " << l_max);
            std::uint64_t count = 0;
            CHECK_NOTHROW(count = inserted(task, l_max, 5000));
            CHECK(count < 1000);
        }
    }
}

TEST_CASE(
    "A longer l_max never makes more vertices: at twice the length at most 1.2 times as many, far from all data") {
    const auto [name, make] = GENERATE(values<Recipe>({{"two holes", two_holes},
                                                       {"a cluster and eight samples", cluster},
                                                       {"one hole", one_hole},
                                                       {"a cluster near a face", cluster_near_a_face},
                                                       {"a planar cluster", planar_cluster},
                                                       {"samples in a corner", samples_in_a_corner},
                                                       {"samples everywhere", samples_everywhere},
                                                       {"a slab", slab}}));
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        for (const double first : {1000.0, 1311.0}) {
            std::uint64_t before = 0;
            for (double l_max = first; l_max < 12000; l_max *= 2) {
                INFO(name << " " << seed << ": l_max " << l_max);
                const std::uint64_t now = inserted(make(seed, l_max), l_max);
                CHECK((before == 0 || static_cast<double>(now) <= 1.2 * static_cast<double>(before)));
                before = now;
            }
        }
    }
}
