// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/accuracy.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "tess/barrier/query/own_side.hpp"
#include "tess/barrier_query.hpp"
#include "tess/error.hpp"
#include "tess/mesh/gap_cell.hpp"
#include "tess/mesh/mesh_walk.hpp"
#include "tess/value_source.hpp"
#include "tests/tess/worlds.hpp"

namespace terratet::testing {

namespace {

const Box3 extent{{0, 0, 0}, {1000, 1000, 500}};

/// Rows of wells, a little out of line, with a sample every two metres from top to bottom.
void drill(AnalyticSite& site, int wells) {
    site.site.properties = {parse_property("f")};
    Samples& samples = site.site.samples;
    samples.values.resize(1);
    Random random(3);
    const double apart = 1000.0 / wells;
    for (std::int32_t well = 0; well < wells * wells; ++well) {
        const double row = well / wells;  // NOLINT(bugprone-integer-division)
        const double column = well % wells;
        const double off = 0.2 * apart;
        const Vec3 collar{apart * (column + 0.5) + random(-off, off), apart * (row + 0.5) + random(-off, off),
                          extent.hi.z};
        Borehole borehole;
        borehole.id = "W" + std::to_string(1000 + well);
        borehole.collar = collar;
        for (double depth = 1; depth < extent.size().z; depth += 2) {
            const Vec3 p = collar - Vec3{0, 0, depth};
            borehole.path.push_back(p);
            borehole.path_depth.push_back(depth);
            samples.positions.push_back(p);
            samples.borehole.push_back(well);
            samples.depth.push_back(depth);
            samples.length.push_back(0);
            samples.values[0].push_back(site.field(p));
        }
        site.site.boreholes.push_back(std::move(borehole));
    }
}

AnalyticSite site_of(std::string name, std::function<double(const Vec3&)> field, double l_min,
                     VariationLimits variation, int wells) {
    AnalyticSite site{std::move(name), std::move(field), {}, {}};
    drill(site, wells);
    site.options.extent = extent;
    site.options.criteria.l_min = l_min;
    site.options.criteria.l_max = 200;
    site.options.criteria.variation = {variation};
    return site;
}

double squared(double x) {
    return x * x;
}

}  // namespace

AnalyticSite smooth_trend(double scale, int wells) {
    const auto field = [](const Vec3& p) {
        return std::sin(p.x / 300) * std::cos(p.y / 250) + p.z / 500;  // as wide as the site
    };
    return site_of("smooth trend", field, 12 * scale, {0, 0.1 * scale}, wells);
}

AnalyticSite thin_layer(double scale, int wells) {
    const double thickness = 6 * scale;
    const auto field = [thickness](const Vec3& p) {
        // Dips gently, is folded a little, and pinches out within the site.
        const double middle = 250 + 0.1 * (p.x - 500) + 25 * std::sin(p.y / 150);
        const double reach = (squared(p.x - 500) + squared(p.y - 500)) / squared(200);
        return std::exp(-squared((p.z - middle) / thickness) - squared(reach) * reach);
    };
    return site_of("thin layer", field, 3 * scale, {0.1, 0.2}, wells);
}

AnalyticSite raised_zone(double scale, int wells) {
    const Vec3 centre{500, 500, 250};
    const double dip_deg = 60;
    const double dip = dip_deg * std::numbers::pi / 180;
    const Vec3 normal{std::sin(dip), 0, std::cos(dip)};
    const double width = 10 * scale;
    const auto field = [=](const Vec3& p) {
        // The hanging wall is more damaged than the footwall: a jump at the fault, and a decay on either side.
        const double off = dot(p - centre, normal);
        return off >= 0 ? std::exp(-off / width) : 0.4 * std::exp(2 * off / width);
    };
    AnalyticSite site = site_of("raised zone along a fault", field, 5 * scale, {0.02, 0.2}, wells);
    site.site.surfaces = {planar_fault("F", centre, 0, dip_deg, 1000, 1000, 20)};
    return site;
}

MeshField adaptive(const AnalyticSite& site, BuildReport& report) {
    // A seed stands on its side of the fault, half the gap away: its place tells which formula holds.
    const ValueSourceFactory factory = [&site](const Model&, const BarrierQuery&) -> ValueSource {
        return [&site](std::span<const ValueQuery> queries) {
            ValueBatch batch{{std::vector<double>(queries.size())}, std::vector<double>(queries.size(), 0)};
            for (std::size_t i = 0; i < queries.size(); ++i) {
                batch.values[0][i] = site.field(queries[i].position);
            }
            return batch;
        };
    };
    return field_of(std::move(build(site.site, site.options, factory, report)->model));
}

MeshField field_of(const Model& model) {
    return {tessellate(model).mesh(), model.vertices, model.vertex_values.values[0], model.barriers};
}

std::vector<Vec3> nodes(const GridField& grid) {
    std::vector<Vec3> result;
    const Vec3 size = grid.box.size();
    for (int i = 0; i < grid.nodes[0]; ++i) {
        for (int j = 0; j < grid.nodes[1]; ++j) {
            for (int k = 0; k < grid.nodes[2]; ++k) {
                result.push_back(grid.box.lo + Vec3{size.x * i / (grid.nodes[0] - 1), size.y * j / (grid.nodes[1] - 1),
                                                    size.z * k / (grid.nodes[2] - 1)});
            }
        }
    }
    return result;
}

GridField uniform_grid(const AnalyticSite& site, std::size_t count) {
    GridField grid{site.options.extent, {}, {}};
    const Vec3 size = grid.box.size();
    const auto nodes_at = [&](double step) {
        std::array<int, 3> nodes{};
        for (int axis = 0; axis < 3; ++axis) {
            nodes[static_cast<std::size_t>(axis)] = static_cast<int>(std::round(size[axis] / step)) + 1;
        }
        return nodes;
    };
    const auto total = [](const std::array<int, 3>& n) { return double(n[0]) * n[1] * n[2]; };
    double step = std::cbrt(grid.box.volume() / static_cast<double>(count));
    while (total(nodes_at(step)) > static_cast<double>(count)) {
        step *= 1.001;
    }
    grid.nodes = nodes_at(step);
    for (const Vec3& p : nodes(grid)) {
        grid.values.push_back(site.field(p));
    }
    return grid;
}

MeshField uniform_mesh(const AnalyticSite& site, std::size_t count) {
    const Box3& box = site.options.extent;
    const Vec3 size = box.size();
    std::vector<Vec3> points;
    // Cubes of side a with a vertex at each corner and one in the middle: 2/a³ vertices.
    for (double a = std::cbrt(2 * box.volume() / static_cast<double>(count));; a *= 1.001) {
        std::array<int, 3> n{};
        for (int axis = 0; axis < 3; ++axis) {
            n[static_cast<std::size_t>(axis)] = std::max(1, static_cast<int>(std::round(size[axis] / a)));
        }
        if ((n[0] + 1.0) * (n[1] + 1) * (n[2] + 1) + double(n[0]) * n[1] * n[2] > static_cast<double>(count)) {
            continue;
        }
        const auto add = [&](double i, double j, double k) {
            points.push_back(box.lo + Vec3{size.x * i / n[0], size.y * j / n[1], size.z * k / n[2]});
        };
        for (int i = 0; i <= n[0]; ++i) {
            for (int j = 0; j <= n[1]; ++j) {
                for (int k = 0; k <= n[2]; ++k) {
                    add(i, j, k);
                    if (i < n[0] && j < n[1] && k < n[2]) {
                        add(i + 0.5, j + 0.5, k + 0.5);
                    }
                }
            }
        }
        break;
    }
    MeshField field;
    for (const Vec3& p : points) {
        field.vertices.push_back({field.vertices.size(), p, Role::inserted, -1, 0});
        field.values.push_back(site.field(p));
    }
    Tessellation tessellation;
    tessellation.insert(field.vertices);
    field.mesh = tessellation.mesh();
    return field;
}

std::vector<Vec3> probes(const Box3& box, std::size_t count) {
    constexpr double g = 1.2207440846057596;  // g⁴ = g + 1: what the golden ratio is in one dimension
    constexpr int columns = 64;
    struct Probe {
        std::array<int, 2> column;
        Vec3 p;
    };
    const Vec3 size = box.size();
    std::vector<Probe> order(count);
    for (std::size_t n = 0; n < count; ++n) {
        Vec3 unit;
        for (int axis = 0; axis < 3; ++axis) {
            unit[axis] = std::fmod(0.5 + static_cast<double>(n + 1) / std::pow(g, axis + 1), 1.0);
        }
        order[n] = {{static_cast<int>(columns * unit.x), static_cast<int>(columns * unit.y)},
                    box.lo + Vec3{unit.x * size.x, unit.y * size.y, unit.z * size.z}};
    }
    std::ranges::sort(order, {}, [](const Probe& probe) {  // up one column, down the next, to and fro
        const auto [i, j] = probe.column;
        const int along = i % 2 == 0 ? j : columns - j;
        return std::tuple(i, along, along % 2 == 0 ? probe.p.z : -probe.p.z);
    });
    std::vector<Vec3> places(count);
    std::ranges::transform(order, places.begin(), &Probe::p);
    return places;
}

std::vector<double> errors(const MeshField& field, const AnalyticSite& site, std::span<const Vec3> places) {
    MeshWalk walk(field.mesh);
    std::vector<std::int32_t> gap;
    for (const auto& cell : field.mesh.cells) {
        gap.push_back(gap_barrier(cell, field.vertices));
    }
    const BarrierQuery barriers(field.barriers);
    const OwnSide sides(field.mesh, gap, barriers);
    std::vector<double> result;
    for (const Vec3& p : places) {
        const auto position = walk.locate(p);
        if (!position) {
            throw Error("the mesh does not cover the extent");
        }
        const VertexWeights own = sides.at(position->cell, p, position->weights);
        double value = 0;
        for (std::size_t k = 0; k < 4; ++k) {
            value += own.weights[k] * field.values[own.vertices[k]];
        }
        result.push_back(value - site.field(p));
    }
    return result;
}

std::vector<double> errors(const GridField& field, const AnalyticSite& site, std::span<const Vec3> places) {
    std::vector<double> result;
    for (const Vec3& p : places) {
        std::array<std::size_t, 3> lo{};
        Vec3 t;
        for (int axis = 0; axis < 3; ++axis) {
            const int cells = field.nodes[static_cast<std::size_t>(axis)] - 1;
            const double at = (p[axis] - field.box.lo[axis]) / field.box.size()[axis] * cells;
            const int cell = std::clamp(static_cast<int>(at), 0, cells - 1);
            lo[static_cast<std::size_t>(axis)] = static_cast<std::size_t>(cell);
            t[axis] = at - cell;
        }
        double value = 0;
        for (std::size_t corner = 0; corner < 8; ++corner) {
            const std::array<std::size_t, 3> bit{corner & 1, corner >> 1 & 1, corner >> 2};
            double weight = 1;
            std::size_t index = 0;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const double up = t[static_cast<int>(axis)];
                weight *= bit[axis] == 1 ? up : 1 - up;
                index = index * static_cast<std::size_t>(field.nodes[axis]) + lo[axis] + bit[axis];
            }
            value += weight * field.values[index];
        }
        result.push_back(value - site.field(p));
    }
    return result;
}

std::vector<std::vector<Vec3>> section(const TetMesh& mesh, int axis, double at) {
    std::vector<std::vector<Vec3>> polygons;
    for (const auto& cell : mesh.cells) {
        std::vector<Vec3> below;
        std::vector<Vec3> above;
        for (const std::uint32_t vertex : cell) {
            (mesh.points[vertex][axis] < at ? below : above).push_back(mesh.points[vertex]);
        }
        if (below.empty() || above.empty()) {
            continue;
        }
        const auto meet = [&](const Vec3& a, const Vec3& b) {
            return a + (at - a[axis]) / (b[axis] - a[axis]) * (b - a);
        };
        std::vector<Vec3> polygon;
        for (std::size_t i = 0; i < below.size(); ++i) {
            // Every other time backwards, so that the four points of a two-to-two cell follow each other round.
            for (std::size_t j = 0; j < above.size(); ++j) {
                polygon.push_back(meet(below[i], above[i % 2 == 0 ? j : above.size() - 1 - j]));
            }
        }
        polygons.push_back(std::move(polygon));
    }
    return polygons;
}

double root_mean_square(std::span<const double> errors) {
    double sum = 0;
    for (const double error : errors) {
        sum += error * error;
    }
    return std::sqrt(sum / static_cast<double>(errors.size()));
}

}  // namespace terratet::testing
