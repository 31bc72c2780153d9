// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/write/clip.hpp"
#include "io/write/scene/scene_cells.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <set>

#include "grid_model.hpp"
#include "kuhn_mesh.hpp"
#include "support.hpp"

using namespace terratet;
using terratet::testing::GridModel;
using terratet::testing::kuhn_mesh;
using terratet::testing::Node;
using terratet::testing::Random;

namespace {

double volume_of(const ClippedMesh& mesh, std::size_t cell) {
    const auto& [a, b, c, d] = mesh.cells[cell];
    const auto& p = mesh.points;
    return dot(cross(p[b] - p[a], p[c] - p[a]), p[d] - p[a]) / 6;
}

/// A Delaunay tessellation of random points in a box, with the extent somewhere inside it.
struct RandomModel {
    Model model;
    TetMesh mesh;
    CellTable cells;

    RandomModel(std::uint64_t seed, const Box3& extent) {
        Random random(seed);
        model.domain.hull = {{-10, -20, -5}, {110, 120, 60}};
        model.domain.extent = extent;
        const Vec3 side = model.domain.hull.size();
        for (int corner = 0; corner < 8; ++corner) {
            add(model.domain.hull.lo + Vec3{corner & 1 ? side.x : 0, corner & 2 ? side.y : 0, corner & 4 ? side.z : 0});
        }
        for (int i = 0; i < 400; ++i) {
            add(random.in(model.domain.hull));
        }
        // Vertices exactly on the extent's planes, edges and corners too.
        add(extent.lo);
        add({extent.lo.x, extent.hi.y, extent.center().z});
        add({extent.center().x, extent.center().y, extent.hi.z});
        model.properties.resize(1);
        model.properties[0].name = "f";
        model.vertex_values.values.resize(1);
        for (const Vertex& vertex : model.vertices) {
            model.vertex_values.values[0].push_back(linear(vertex.position));
            model.vertex_values.extrapolation.push_back(0);
        }
        mesh = tessellate(model).mesh();
        cells = describe_cells(model, mesh);
    }
    static double linear(const Vec3& p) { return 3 + 0.1 * p.x - 0.2 * p.y + 0.05 * p.z; }

  private:
    void add(const Vec3& p) { model.vertices.push_back({model.vertices.size(), p, Role::inserted, -1, 0}); }
};

/// A lattice of 10 m in a box of 100 m, all of it free to move, and an extent inside it.
struct LatticeModel {
    Model model;
    TetMesh mesh;
    CellTable cells;

    explicit LatticeModel(const Box3& extent) {
        model.domain.extent = extent;
        model.domain.hull = {{0, 0, 0}, {100, 100, 100}};
        model.criteria.l_min = 8;
        mesh = kuhn_mesh({10, 10, 10}, [](const Node& n) { return Vec3{10.0 * n[0], 10.0 * n[1], 10.0 * n[2]}; });
        model.properties.resize(1);
        model.vertex_values.values.resize(1);
        for (std::size_t v = 0; v < mesh.points.size(); ++v) {
            model.vertices.push_back({v, mesh.points[v], Role::inserted, -1, 0});
            model.vertex_values.values[0].push_back(RandomModel::linear(mesh.points[v]));
            model.vertex_values.extrapolation.push_back(0);
        }
        cells = describe_cells(model, mesh);
    }
    [[nodiscard]] ModelView view() const { return {model, mesh, cells}; }
};

}  // namespace

TEST_CASE("Clipped cells fill the extent exactly, conform, and carry linear values on") {
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
        const Box3 extent{{0, 0, 0}, {100, 100, 50.0 + static_cast<double>(seed)}};
        const RandomModel random(seed, extent);
        const ClippedMesh mesh = clip_to_extent({random.model, random.mesh, random.cells});

        double volume = 0;
        std::map<std::array<std::uint32_t, 3>, int> facets;
        for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
            REQUIRE(volume_of(mesh, c) > 0);
            volume += volume_of(mesh, c);
            for (std::size_t k = 0; k < 4; ++k) {
                std::array<std::uint32_t, 3> facet;
                for (std::size_t i = 0; i < 3; ++i) {
                    facet[i] = mesh.cells[c][(k + i + 1) % 4];
                }
                std::sort(facet.begin(), facet.end());
                ++facets[facet];
            }
        }
        CHECK(volume == Approx(extent.volume()).epsilon(1e-9));

        std::size_t open = 0;
        for (const auto& [facet, sides] : facets) {
            REQUIRE(sides <= 2);
            if (sides == 1) {
                bool on_a_face = false;
                for (int axis = 0; axis < 3; ++axis) {
                    for (const double face : {extent.lo[axis], extent.hi[axis]}) {
                        on_a_face |= std::all_of(facet.begin(), facet.end(), [&](std::uint32_t v) {
                            return std::abs(mesh.points[v][axis] - face) < 1e-9;
                        });
                    }
                }
                open += on_a_face ? 0 : 1;
            }
        }
        CHECK(open == 0);

        const std::vector<double> values = mesh.values(random.model, 0);
        for (std::size_t i = 0; i < mesh.points.size(); ++i) {
            REQUIRE(values[i] == Approx(RandomModel::linear(mesh.points[i])).margin(1e-11));
            REQUIRE(extent.grown(1e-9).contains(mesh.points[i]));
        }
    }
}

TEST_CASE("An extent that is the hull cuts nothing") {
    GridModel grid;
    grid.model.domain.extent = grid.model.domain.hull;
    grid.cells = describe_cells(grid.model, grid.mesh);
    const ClippedMesh mesh = clip_to_extent({grid.model, grid.mesh, grid.cells});
    CHECK(mesh.cuts.empty());
    CHECK(mesh.cells == grid.mesh.cells);
    CHECK(mesh.region == grid.cells.region);
}

TEST_CASE("What is connected within the extent is one region, also through cells whose centroid is outside") {
    const GridModel grid;
    const ClippedMesh mesh = clip_to_extent({grid.model, grid.mesh, grid.cells});
    std::set<std::int32_t> west;
    std::set<std::int32_t> east;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
        if (grid.cells.barrier[mesh.parent[c]] >= 0) {
            CHECK(mesh.region[c] == -1);
            continue;
        }
        Vec3 center;
        for (const std::uint32_t v : mesh.cells[c]) {
            center = center + 0.25 * mesh.points[v];
        }
        (center.x < grid.fault_x(center.z) ? west : east).insert(mesh.region[c]);
    }
    CHECK(west.size() == 1);
    CHECK(east.size() == 1);
    CHECK(west != east);
    CHECK(*west.begin() >= 0);
    CHECK(*east.begin() >= 0);
}

TEST_CASE("Cuts across a fault take the nearer end's value, and classes never mix") {
    const GridModel grid;
    const ClippedMesh mesh = clip_to_extent({grid.model, grid.mesh, grid.cells});
    REQUIRE(mesh.cuts.size() > 100);
    const auto conductivity = mesh.values(grid.model, 0);
    const auto lithology = mesh.values(grid.model, 2);
    std::size_t between = 0;
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
        const Vec3& p = mesh.points[i];
        // The blocks differ by two decades; along an edge log10 is linear but for the sine.
        const auto is_of = [&](bool east) {
            return std::abs(std::log10(conductivity[i]) - std::log10(grid.conductivity(p, east))) < 0.4 &&
                   (lithology[i] == 1) == east;
        };
        REQUIRE((lithology[i] == 0 || lithology[i] == 1 || lithology[i] == 2));
        if (std::abs(p.x - grid.fault_x(p.z)) < grid.gap / 2 - 1e-6) {
            REQUIRE((is_of(false) || is_of(true)));  // between the walls: one or the other
            ++between;
        } else {
            REQUIRE(is_of(p.x > grid.fault_x(p.z)));
        }
    }
    CHECK(between > 10);
}

TEST_CASE("However near to vertices the extent passes, no clipped cell is sharp and no edge short") {
    for (const double off : {1e-7, 1e-3, 0.4, 2.0, 5.0, 8.0, 9.7, 9.9999}) {
        const LatticeModel lattice({{10 + off, 20 + off, 10 + off / 2}, {90 - off, 80 - off / 3, 90 - off}});
        const ClippedMesh mesh = clip_to_extent(lattice.view());
        const ClippedShapes shapes = clipped_shapes(lattice.view(), mesh);
        INFO("planes " << off << " from vertices");
        CHECK(shapes.dihedral_min_deg > 10);
        CHECK(shapes.dihedral_p1_deg > 15);
        CHECK(shapes.edge_min > 0.1 * lattice.model.criteria.l_min);
        CHECK(shapes.below_10_deg + shapes.short_edges == 0);
        double volume = 0;
        for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
            REQUIRE(volume_of(mesh, c) > 0);
            volume += volume_of(mesh, c);
        }
        CHECK(volume == Approx(lattice.model.domain.extent.volume()).epsilon(1e-12));
        const std::vector<double> values = mesh.values(lattice.model, 0);
        for (std::size_t i = 0; i < mesh.points.size(); ++i) {
            REQUIRE(values[i] == Approx(RandomModel::linear(mesh.points[i])).margin(1e-11));
        }
    }
}

TEST_CASE(
    "V1: a clipped mesh keeps each sample of the extent in its place, and counts the cells that this makes sharp") {
    LatticeModel lattice({{9.99, 5, 5}, {95, 95, 95}});  // samples a centimetre from a face
    std::set<std::size_t> kept;
    for (std::size_t v = 0; v < lattice.mesh.points.size(); ++v) {
        const Vec3& p = lattice.mesh.points[v];
        if (p.x == 10 && std::fmod(p.y, 30) == 0 && std::fmod(p.z, 30) == 0) {
            lattice.model.vertices[v].role = Role::sample;
            if (lattice.model.domain.extent.contains(lattice.mesh.points[v])) {
                kept.insert(v);
            }
        }
    }
    const ClippedMesh mesh = clip_to_extent(lattice.view());
    std::set<std::size_t> there;
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
        if (kept.contains(mesh.place[i])) {
            CHECK(mesh.points[i] == lattice.mesh.points[mesh.place[i]]);
            there.insert(mesh.place[i]);
        }
    }
    CHECK(there == kept);
    const ClippedShapes shapes = clipped_shapes(lattice.view(), mesh);
    CHECK(shapes.at_sample > 0);
    CHECK(shapes.below_10_deg + shapes.short_edges >= shapes.at_sample + shapes.other);
    CHECK(shapes.other < 20);  // climbing from the worst cell does not always find the way
}

TEST_CASE("A clipped mesh mixes no values across a fault that passes beyond the extent") {
    LatticeModel lattice({{5, 5, 5}, {73, 95, 95}});
    Barrier wall;
    wall.spacing = 10;
    wall.width = 2.5;
    wall.sheet.vertices = {{75, -10, -10}, {75, 110, -10}, {75, 110, 110}, {75, -10, 110}};
    wall.sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
    lattice.model.barriers.push_back(wall);
    for (std::size_t v = 0; v < lattice.mesh.points.size(); ++v) {
        lattice.model.vertex_values.values[0][v] = lattice.mesh.points[v].x < 75 ? 1 : 10;
    }
    const ClippedMesh mesh = clip_to_extent(lattice.view());
    for (const double value : mesh.values(lattice.model, 0)) {
        REQUIRE(value == 1);
    }
}

TEST_CASE("A scene is drawn from the cells that a clipped file has, none of them sharp") {
    const LatticeModel lattice({{10.4, 20.4, 10.2}, {89.6, 79.9, 89.6}});
    const SceneCells scene = scene_cells(lattice.view());
    CHECK(scene.mesh.cells == clip_to_extent(lattice.view()).cells);
    CHECK(clipped_shapes(lattice.view(), scene.mesh).below_10_deg == 0);
}
