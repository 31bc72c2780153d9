// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surfaces as bad as files bring them, and worse: whatever is wrong with one, it is used or refused with a reason.
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <set>

#include "tests/tess/fault_cases.hpp"

namespace terratet {
namespace {

using testing::cylinder;
using testing::gridded;
using testing::wavy;

const Box3 extent{{0, 0, 0}, {400, 400, 400}};
constexpr double spacing = 20;

Surface damaged(std::uint64_t kind, testing::Random& random) {
    Surface surface = kind % 3 == 0   ? wavy()
                      : kind % 3 == 1 ? cylinder(300)
                                      : gridded("flat", 12, 12, [](double u, double v) {
                                            return Vec3{500 * u - 50, 500 * v - 50, 150 + 100 * u};
                                        });
    auto& vertices = surface.vertices;
    auto& triangles = surface.triangles;
    const auto any_vertex = [&] { return static_cast<std::uint32_t>(random.below(vertices.size())); };
    const std::uint64_t damages = 1 + random.below(6);
    bool broken_corner = false;
    for (std::uint64_t d = 0; d < damages; ++d) {
        switch (random.below(12)) {
            case 0:  // holes
                for (std::size_t k = triangles.size(); k-- > 0;) {
                    if (random() < 0.1) {
                        triangles.erase(triangles.begin() + static_cast<std::ptrdiff_t>(k));
                    }
                }
                break;
            case 1:  // doubled
                triangles.insert(triangles.end(), triangles.begin(),
                                 triangles.begin() + static_cast<std::ptrdiff_t>(triangles.size() / 3));
                break;
            case 2:  // flipped
                for (Triangle& t : triangles) {
                    if (random() < 0.3) {
                        std::swap(t[0], t[1]);
                    }
                }
                break;
            case 3:  // shaken
                for (Vec3& p : vertices) {
                    p = p + random.in({{-2, -2, -2}, {2, 2, 2}});
                }
                break;
            case 4:  // one corner far away
                vertices[any_vertex()] = random.in({{-1e9, -1e9, -1e9}, {1e9, 1e9, 1e9}});
                break;
            case 5:  // a coordinate that is no number
                vertices[any_vertex()].z = random() < 0.5 ? std::nan("") : std::numeric_limits<double>::infinity();
                break;
            case 6:  // needles
                for (int k = 0; k < 20; ++k) {
                    const Triangle t = triangles[random.below(triangles.size())];
                    vertices[t[0]] = vertices[t[1]] + random(0, 1e-3) * (vertices[t[2]] - vertices[t[1]]);
                }
                break;
            case 7:  // triangles between anything
                for (int k = 0; k < 10; ++k) {
                    triangles.push_back({any_vertex(), any_vertex(), any_vertex()});
                }
                break;
            case 8:  // a corner that does not exist
                broken_corner = true;
                break;
            case 9:  // one triangle
                triangles.resize(1 + random.below(3));
                break;
            case 10:  // all corners apart
                for (Triangle& t : triangles) {
                    for (std::uint32_t& v : t) {
                        vertices.push_back(vertices[v]);
                        v = static_cast<std::uint32_t>(vertices.size() - 1);
                    }
                }
                break;
            default:  // far too small, or far too large
                const double scale = random() < 0.5 ? 1e-5 : 1e5;
                for (Vec3& p : vertices) {
                    p = Vec3{200, 200, 200} + scale * (p - Vec3{200, 200, 200});
                }
        }
        if (triangles.empty()) {
            break;
        }
    }
    if (broken_corner && !triangles.empty()) {
        triangles[random.below(triangles.size())][0] = 4000000000U;
    }
    return surface;
}

/// Every fourth together with a sound one that crosses it. Of the runs only some, or all.
void use_or_refuse_damaged(int runs, const std::set<int>& only = {}) {
    testing::Random random(31);
    std::map<bool, int> outcome;
    std::size_t crossing = 0;
    for (int run = 0; run < runs; ++run) {
        std::vector<Surface> surfaces = {damaged(static_cast<std::uint64_t>(run), random)};
        if (run % 4 == 3) {
            surfaces.push_back(testing::dipping("sound", {200, 200, 200}, 30, 60, 300, 300));
        }
        if (!only.empty() && !only.contains(run)) {
            continue;
        }
        INFO("run " << run);
        BarrierOptions options;
        options.spacing = run % 5 == 0 ? 200 : 40;
        options.mode = run % 7 == 6 ? SeedMode::exact : SeedMode::paired;
        const BarrierPreparation preparation = prepare_barriers(surfaces, extent, {}, spacing, options);
        testing::check_promises(surfaces, preparation, extent, spacing, options);
        for (const BarrierAccount& account : preparation.accounts) {
            if (account.name != "sound") {
                ++outcome[account.used];
            }
        }
        if (!preparation.barriers.empty()) {
            const Box3 around = extent.grown(hull_margin(options, spacing));
            const auto counted = testing::count_crossings(preparation.barriers, around, 1000, 1, 7);
            crossing += counted.crossing;
        }
    }
    CHECK(crossing == 0);
    CHECK((!only.empty() || outcome[true] > runs / 5));
    CHECK((!only.empty() || outcome[false] > runs / 5));
}

}  // namespace

TEST_CASE("F4: two hundred damaged surfaces are used or refused, never worse") {
    use_or_refuse_damaged(200);
}

TEST_CASE("F1: no edge slips past a rim, between layers of one sheet, or over triangles far larger than the spacing") {
    use_or_refuse_damaged(900, {272, 299, 888});
}

TEST_CASE("F4: a thousand damaged surfaces are used or refused, never worse", "[.][long]") {
    use_or_refuse_damaged(1000);
}

}  // namespace terratet
