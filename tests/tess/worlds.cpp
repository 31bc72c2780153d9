// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/tess/worlds.hpp"

#include <numbers>

namespace terratet::testing {

namespace {

double field(const Vec3& p) {
    return std::sin(p.x / 60) + p.y / 200 + (p.z > -100 ? 1 : 0);
}

/// The field's value, or its class.
double value_of(const Property& property, double value) {
    return property.kind != Kind::categorical ? value : std::isnan(value) ? missing : std::floor(value + 1);
}

void add(Site& site, const Vec3& p, std::int32_t borehole, double depth, double value) {
    Samples& samples = site.samples;
    samples.positions.push_back(site.frame.snapped(p));
    samples.borehole.push_back(borehole);
    samples.depth.push_back(depth);
    samples.length.push_back(0);
    samples.values[0].push_back(value_of(site.properties[0], value));
    samples.values[1].push_back(std::pow(10.0, -10 + value));
}

void add_wells(Site& site, Random& random, int wells) {
    Vec3 centre = random.in({{60, 60, 0}, {240, 240, 0}});
    for (std::int32_t well = 0; well < wells; ++well) {
        const bool clustered = random() < 0.3;  // a few metres from the one before
        centre = clustered ? centre + Vec3{random(-4, 4), random(-4, 4), 0} : random.in({{20, 20, 0}, {280, 280, 0}});
        Vec3 lean{random(-0.4, 0.4), random(-0.4, 0.4), -1};
        if (well > 0 && random() < 0.2) {  // drilled through the one before
            const auto& path = site.boreholes.back().path;
            const Vec3 towards = path[path.size() / 2] - centre;
            lean = towards / std::max(1.0, std::abs(towards.z));
            lean.z = -1;
        }
        Borehole borehole;
        borehole.id = "W" + std::to_string(well);
        borehole.collar = site.frame.snapped(centre);
        const int records = static_cast<int>(random(5, 60));
        for (int i = 0; i < records; ++i) {
            const Vec3 p = centre + 3.0 * i * lean;
            add(site, p, well, 3.0 * i, random() < 0.05 ? missing : field(p));
            borehole.path.push_back(site.samples.positions.back());
            borehole.path_depth.push_back(3.0 * i);
        }
        site.boreholes.push_back(borehole);
    }
}

std::string degenerate(Site& site, Random& random, std::uint64_t kind) {
    switch (kind) {
        case 0:
            return "no sample";
        case 1:
            add(site, {150, 150, -100}, -1, missing, 1);
            return "one sample";
        case 2:
            for (int i = 0; i < 30; ++i) {
                add(site, {150, 150, -5.0 * i}, -1, missing, i);
            }
            return "collinear samples";
        case 3:
            for (int i = 0; i < 100; ++i) {
                add(site, {30.0 * (i % 10), 30.0 * (i / 10), -100}, -1, missing,
                    i);  // NOLINT(bugprone-integer-division)
            }
            return "coplanar grid";
        case 4:
            for (int i = 0; i < 90; ++i) {
                add(site, {100.0 + 40 * (i % 3), 100, -30.0 * (i % 7)}, i % 2, 3.0 * (i % 7), i);
            }
            site.boreholes = {{"A", {100, 100, 0}, {{100, 100, 0}}, {0}}, {"B", {180, 100, 0}, {{180, 100, 0}}, {0}}};
            return "duplicate samples";
        case 5:
            for (int i = 0; i < 125; ++i) {
                add(site, {50.0 * (i % 5), 50.0 * (i / 5 % 5), -40.0 * (i / 25)}, -1, missing, i);  // NOLINT
            }
            return "cospherical grid";
        default:
            for (int i = 0; i < 20; ++i) {
                add(site, random.in({{0, 0, -200}, {300, 300, 0}}), -1, missing, missing);
            }
            return "no value at all";
    }
}

}  // namespace

Surface planar_fault(const std::string& name, const Vec3& center, double strike_deg, double dip_deg, double half_length,
                     double half_width, double spacing) {
    const double strike = strike_deg * std::numbers::pi / 180;
    const double dip = dip_deg * std::numbers::pi / 180;
    const Vec3 along{std::sin(strike), std::cos(strike), 0};
    const Vec3 down{std::cos(strike) * std::cos(dip), -std::sin(strike) * std::cos(dip), -std::sin(dip)};
    Surface surface;
    surface.name = name;
    const int rows = std::max(1, static_cast<int>(std::round(2 * half_width / spacing)));
    const int columns = std::max(1, static_cast<int>(std::round(2 * half_length / spacing)));
    for (int i = 0; i <= rows; ++i) {
        for (int j = 0; j <= columns; ++j) {
            surface.vertices.push_back(center + half_length * (2.0 * j / columns - 1) * along +
                                       half_width * (2.0 * i / rows - 1) * down);
        }
    }
    for (int i = 0; i < rows; ++i) {
        for (int j = 0; j < columns; ++j) {
            const auto a = static_cast<std::uint32_t>(i * (columns + 1) + j);
            const auto b = a + static_cast<std::uint32_t>(columns) + 1;
            surface.triangles.push_back({a, a + 1, b});
            surface.triangles.push_back({a + 1, b + 1, b});
        }
    }
    return surface;
}

World random_world(std::uint64_t seed) {
    Random random(seed * 7919 + 1);
    World world;
    Site& site = world.site;
    site.frame.crs_name = "made up";
    site.frame.origin = {525312, 6792192, 0};
    const bool classes = random() < 0.15;
    site.properties = {parse_property(classes ? "T:categorical" : "T"), parse_property("K:log10")};
    if (classes) {
        site.properties[0].classes = {"clay", "sand", "gravel", "till", "rock"};
    }
    site.samples.values.resize(2);
    BuildOptions& options = world.options;
    options.extent = {{0, 0, -200}, {300, 300, 0}};
    const std::uint64_t kind = seed % 10;
    if (kind == 9) {
        world.description = degenerate(site, random, seed / 10 % 7);
    } else {
        add_wells(site, random, static_cast<int>(random(1, 8)));
        world.description = "wells";
    }
    const double l_min = random(24, 50);
    options.criteria.l_min = l_min;
    options.criteria.l_max = l_min * (random() < 0.1 ? 1 : random(1.5, 6));
    options.criteria.radius_edge = random() < 0.2 ? 0 : random() < 0.1 ? 1 : random(1.1, 3);
    options.criteria.aspect = random() < 0.2 ? 0 : random() < 0.1 ? 3 : random(4, 12);
    options.criteria.dihedral_deg = random() < 0.2 ? random(0, 15) : 5;
    options.criteria.v_min = random() < 0.2 ? std::pow(random(0.1, 0.5) * l_min, 3) : 0;
    options.criteria.v_max = random() < 0.3 ? std::pow(random(l_min, 4 * l_min), 3) / 8 : 0;
    if (random() < 0.4) {
        options.criteria.variation = {{random() < 0.5 ? 0.05 : 0, random(0.2, 2)}, {0, random(0.2, 2)}};
    }
    options.density = random() < 0.2 ? DensityMode::paper : DensityMode::canonical;
    const int faults = kind < 5 ? static_cast<int>(kind % 3) : 0;
    for (int f = 0; f < faults; ++f) {
        const bool through = random() < 0.5;
        site.surfaces.push_back(planar_fault("F" + std::to_string(f), random.in({{80, 80, -150}, {220, 220, -50}}),
                                             random(0, 360), random(15, 90), through ? 400 : random(60, 140),
                                             through ? 400 : random(60, 100), l_min));
        world.description += through ? " + through-going fault" : " + half fault";
    }
    if (random() < 0.2 && site.samples.size() > 4) {
        options.extent = {};
        world.description += ", own extent";
    } else if (random() < 0.25) {
        for (int part = 0; part < 2; ++part) {  // the second may overlap the first, and both may be coarser
            const Vec3 corner = random.in({{0, 0, -200}, {200, 200, -100}});
            const Vec3 size = random.in({{20, 20, 20}, {80, 80, 80}});
            const double finer = random(0.5, 1.6) * l_min;
            options.criteria.overrides.push_back(
                {ResolutionOverride::Where::box, {corner, corner + size}, {}, finer, finer * random(1, 6)});
        }
        world.description += ", other resolutions";
    }
    world.description = "seed " + std::to_string(seed) + ": " + world.description;
    return world;
}

ValueSourceFactory analytic_field() {
    return [](const Model& model, const BarrierQuery&) -> ValueSource {
        return [properties = model.properties](std::span<const ValueQuery> queries) {
            ValueBatch batch{std::vector<std::vector<double>>(properties.size()),
                             std::vector<double>(queries.size(), 0)};
            for (const ValueQuery& query : queries) {
                for (std::size_t p = 0; p < properties.size(); ++p) {
                    batch.values[p].push_back(p == 0 ? value_of(properties[0], field(query.position))
                                                     : std::pow(10.0, -10 + field(query.position)));
                }
            }
            return batch;
        };
    };
}

Built build_world(const World& world) {
    Built built;
    built.model = std::move(build(world.site, world.options, analytic_field(), built.report)->model);
    return built;
}

}  // namespace terratet::testing
