// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// A finished model with one of everything, made by hand: what the writers' tests and the independent readers work on.
/// A box of Kuhn's tetrahedra, a dipping fault with a gap, two fault blocks with different values, a property with
/// holes in it, classes, a deviated borehole. All figures follow from the constants here.

#include <cmath>
#include <numbers>

#include "kuhn_mesh.hpp"
#include "tess/cells.hpp"
#include "tess/model.hpp"
#include "tess/property.hpp"

namespace terratet::testing {

struct GridModel {
    static constexpr Node boxes{9, 8, 6};  ///< the fifth column is the gap
    static constexpr int gap_column = 4;
    static constexpr double gap = 4;  ///< its width along x

    Model model;
    TetMesh mesh;
    CellTable cells;

    GridModel() {
        fill_site();
        mesh = kuhn_mesh(boxes, [this](const Node& n) { return place(n); });
        fill_vertices();
        cells = describe_cells(model, mesh);
    }

    /// Where the fault is at a depth: it dips east at 80°.
    [[nodiscard]] double fault_x(double z) const { return 380 - std::tan(10 * std::numbers::pi / 180) * z; }

    [[nodiscard]] double conductivity(const Vec3& p, bool east) const {
        return std::pow(10.0, (east ? -1.0 : -3.0) + 0.8 * std::sin(p.y / 150) + p.z / 400);
    }

  private:
    [[nodiscard]] Vec3 place(const Node& n) const {
        const Box3& hull = model.domain.hull;
        const double y = hull.lo.y + hull.size().y * n[1] / boxes[1];
        const double z = hull.lo.z + hull.size().z * n[2] / boxes[2];
        const double west = fault_x(z) - gap / 2;
        const double east = fault_x(z) + gap / 2;
        const double x = n[0] <= gap_column
                             ? hull.lo.x + (west - hull.lo.x) * n[0] / gap_column
                             : east + (hull.hi.x - east) * (n[0] - gap_column - 1) / (boxes[0] - gap_column - 1);
        return model.frame.snapped({x, y, z});
    }

    void fill_site() {
        model.frame.crs_name = "ETRS89 / TM35FIN(E,N)";
        model.frame.crs_wkt = "PROJCRS[\"ETRS89 / TM35FIN(E,N)\",ID[\"EPSG\",3067]]";
        model.frame.origin = {525312, 6791168, 0};
        model.domain.extent = {{0, 0, -500}, {800, 600, 0}};
        model.domain.hull = model.domain.extent.grown(60);
        model.criteria.l_min = 10;
        model.criteria.l_max = 200;
        model.properties.resize(3);
        model.properties[0].name = "conductivity";
        model.properties[0].unit = "S/m";
        model.properties[0].scale = Scale::log10;
        model.properties[1].name = "temperature, mean";
        model.properties[1].unit = "°C";
        model.properties[2].name = "lithology";
        model.properties[2].kind = Kind::categorical;
        model.properties[2].classes = {"gneiss", "granite", "schist"};
        model.samples.values.resize(3);
        for (int b = 0; b < 4; ++b) {
            Borehole hole;
            hole.id = "OL-KR" + std::to_string(b + 1);
            hole.collar = {b % 2 ? 640.0 : 200.0, b < 2 ? 170.0 : 430.0, 0};
            for (int i = 0; i <= 50; ++i) {
                const double depth = 8 * i;
                const Vec3 p = hole.collar + Vec3{0.0003 * b * depth * depth, 0.05 * depth, -depth};
                hole.path.push_back(p);
                hole.path_depth.push_back(depth);
                if (i >= 4) {
                    model.samples.positions.push_back(p);
                    model.samples.borehole.push_back(b);
                    model.samples.depth.push_back(depth);
                    model.samples.length.push_back(8);
                    const bool east = p.x > fault_x(p.z);
                    model.samples.values[0].push_back(conductivity(p, east));
                    model.samples.values[1].push_back(4 - p.z / 70);
                    model.samples.values[2].push_back(east ? 1 : p.z > -200 ? 0 : 2);
                }
            }
            model.boreholes.push_back(hole);
        }
        Barrier fault;
        fault.name = "BFZ \"100\"";
        fault.width = gap;
        fault.spacing = 42;
        fault.covering_radius = 30;
        fault.protection_radius = 31;
        constexpr int steps = 12;
        for (int i = 0; i <= steps; ++i) {
            for (int j = 0; j <= steps; ++j) {
                const double z = -500.0 + 500.0 * j / steps;
                fault.sheet.vertices.push_back({fault_x(z), 600.0 * i / steps, z});
            }
        }
        for (std::uint32_t i = 0; i < steps; ++i) {
            for (std::uint32_t j = 0; j < steps; ++j) {
                const std::uint32_t a = i * (steps + 1) + j;
                fault.sheet.triangles.push_back({a, a + steps + 1, a + steps + 2});
                fault.sheet.triangles.push_back({a, a + steps + 2, a + 1});
            }
        }
        model.barriers.push_back(fault);
    }

    void fill_vertices() {
        model.vertex_values.values.resize(3);
        for (std::size_t v = 0; v < mesh.points.size(); ++v) {
            const auto column = static_cast<int>(v) / ((boxes[1] + 1) * (boxes[2] + 1));
            const Vec3& p = mesh.points[v];
            Vertex vertex;
            vertex.id = 10 + v;
            vertex.position = p;
            if (column == gap_column || column == gap_column + 1) {
                vertex.role = Role::seed;
                vertex.owner = 0;
                vertex.side = column == gap_column ? std::int8_t{-1} : std::int8_t{1};
            } else if (v % 7 == 0) {
                vertex.role = Role::sample;
                vertex.owner = static_cast<std::int32_t>(v % model.samples.size());
            }
            model.vertices.push_back(vertex);
            const bool east = column > gap_column;
            auto& values = model.vertex_values.values;
            values[0].push_back(conductivity(p, east));
            values[1].push_back(p.x < 1 && p.z < -400 ? missing : 4 - p.z / 70);
            values[2].push_back(east ? 1 : p.z > -200 ? 0 : 2);
            model.vertex_values.extrapolation.push_back(p.z < -450 ? 0.25 : 0.0);
        }
    }
};

}  // namespace terratet::testing
