// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Models of every oddity a model file must survive. Geometrically meaningless; storage does not care.

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "support.hpp"
#include "tess/model.hpp"

namespace terratet::testing {

inline std::string odd_name(Random& random) {
    static const std::vector<std::string> names = {
        "id",
        "ID",
        "Id",
        "fid",
        "FID",
        "geom",
        "rowid",
        "depth",
        "Depth",
        "owner",
        "extrapolation",
        "K",
        "k",
        "Au (g/t)",
        "it's",
        "quo\"ted",
        "semi;colon",
        "tab\there",
        "line\nbreak",
        "back\\slash",
        "100%",
        "%s%n",
        "naïve",
        "日本語の断層の名前はとても長いので列の名前としては切り詰められる必要がある",
        " blanks ",
        "",
        "select",
        "null",
        "NULL",
        "a,b",
        "[x]",
        "{y}",
        "`z`",
        "--",
        "DROP TABLE samples",
        "property",
        "property_2",
        "id_2"};
    return names[random.below(names.size())];
}

inline double odd_number(Random& random) {
    switch (random.below(8)) {
        case 0:
            return missing;
        case 1:
            return static_cast<double>(random.below(1000));
        case 2:
            return random(-1, 1) * 1e300;
        case 3:
            return random(-1, 1) * 1e-300;
        case 4:
            return 0.1 * static_cast<double>(random.below(100));
        case 5:
            return -static_cast<double>(random.below(1ULL << 60));
        default:
            return random(-1e4, 1e4);
    }
}

struct RandomModel {
    Random random;
    Model model;
    Box3 box;

    Vec3 place() { return model.frame.snapped(random.in(box)); }

    Property property() {
        Property p;
        const auto taken = [&] {
            return p.name.empty() || std::any_of(model.properties.begin(), model.properties.end(),
                                                 [&](const Property& other) { return other.name == p.name; });
        };
        do {
            p.name = odd_name(random);
        } while (taken());
        p.unit = odd_name(random);
        p.kind = random.below(3) == 0 ? Kind::categorical : Kind::continuous;
        p.hard_horizons = p.name.size() % 2 == 0;
        p.scale = p.kind == Kind::continuous && random.below(2) ? Scale::log10 : Scale::linear;
        if (p.kind == Kind::categorical) {
            std::set<std::string> classes;
            while (classes.size() < 4) {
                classes.insert(odd_name(random));
            }
            p.classes.assign(classes.begin(), classes.end());
        }
        return p;
    }

    double value(const Property& p) {
        if (p.kind == Kind::continuous) {
            return odd_number(random);
        }
        return random.below(5) == 0 ? missing : static_cast<double>(random.below(p.classes.size()));
    }

    /// With unused and repeated vertices, and triangles that name one twice.
    Surface surface(SurfaceKind kind) {
        Surface s;
        s.name = odd_name(random);
        s.kind = kind;
        s.file = "/data/" + odd_name(random) + ".ts";
        for (std::uint64_t n = random.below(12); n > 0; --n) {
            s.vertices.push_back(s.vertices.empty() || random.below(4) ? place()
                                                                       : s.vertices[random.below(s.vertices.size())]);
        }
        for (std::uint64_t n = s.vertices.empty() ? 0 : random.below(12); n > 0; --n) {
            const auto corner = [&] { return static_cast<std::uint32_t>(random.below(s.vertices.size())); };
            s.triangles.push_back({corner(), corner(), corner()});
        }
        return s;
    }

    void add_boreholes() {
        std::set<std::string> ids;
        for (std::uint64_t n = random.below(6); n > 0; --n) {
            ids.insert(odd_name(random) + (random.below(2) ? std::to_string(random.below(100)) : ""));
        }
        for (const std::string& id : ids) {
            Borehole b{id, place(), {}, {}};
            for (std::uint64_t n = random.below(5); n > 0; --n) {
                b.path.push_back(place());
                b.path_depth.push_back(random(0, 1000));
            }
            std::sort(b.path_depth.begin(), b.path_depth.end());
            model.boreholes.push_back(b);
        }
    }

    void add_samples() {
        Samples& s = model.samples;
        s.values.resize(model.properties.size());
        for (std::uint64_t n = random.below(60); n > 0; --n) {
            const bool loose = model.boreholes.empty() || random.below(4) == 0;
            s.positions.push_back(place());
            s.borehole.push_back(loose ? -1 : static_cast<std::int32_t>(random.below(model.boreholes.size())));
            s.depth.push_back(loose ? missing : random(0, 1000));
            s.length.push_back(random.below(2) ? 0 : random(0, 3));
            for (std::size_t p = 0; p < model.properties.size(); ++p) {
                s.values[p].push_back(value(model.properties[p]));
            }
        }
        for (std::uint64_t n = random.below(3) * s.size() / 4; n > 0 && !s.values.empty(); --n) {
            s.set_censoring(random.below(s.values.size()), random.below(s.size()),
                            static_cast<Censoring>(random.below(4)));
        }
    }

    void add_faults() {
        for (std::uint64_t n = random.below(4); n > 0; --n) {
            Barrier f;
            f.name = odd_name(random);
            f.sheet = surface(SurfaceKind::fault);
            f.margin = surface(SurfaceKind::fault);
            for (std::uint64_t k = random.below(8); k > 0; --k) {
                f.seeds.push_back({place(), std::int8_t{1}});
                f.seeds.push_back({place(), std::int8_t{-1}});
            }
            f.spacing = random(1, 50);
            f.width = random(0.1, 5);
            f.covering_radius = random(1, 30);
            f.protection_radius = random(1, 30);
            model.barriers.push_back(f);
        }
    }

    void add_vertices() {
        std::uint64_t id = random.below(3);
        const auto add = [&](const Vec3& position, Role role, std::int32_t owner, std::int8_t side) {
            model.vertices.push_back({id, position, role, owner, side});
            id += 1 + random.below(5);
        };
        for (std::size_t i = 0; i < model.samples.size(); ++i) {
            if (random.below(2)) {
                add(model.samples.positions[i], Role::sample, static_cast<std::int32_t>(i), 0);
            }
        }
        for (std::size_t f = 0; f < model.barriers.size(); ++f) {
            const bool as_they_are = random.below(3) > 0;  // else seeds and vertices differ
            for (const Seed& seed : model.barriers[f].seeds) {
                if (as_they_are || random.below(2)) {
                    add(seed.position, Role::seed, static_cast<std::int32_t>(f), seed.side);
                }
            }
        }
        for (std::uint64_t n = random.below(40); n > 0; --n) {
            add(place(), random.below(2) ? Role::domain : Role::inserted, -1, 0);
        }
        if (random.below(4) == 0) {
            id = ~std::uint64_t{0} - 1000;  // beyond what a database's integers hold unsigned
            add(place(), Role::inserted, -1, 0);
        }
        model.vertex_values.values.resize(model.properties.size());
        for (std::size_t i = 0; i < model.vertices.size(); ++i) {
            model.vertex_values.extrapolation.push_back(random.below(2) ? 0 : random(0, 1));
            for (std::size_t p = 0; p < model.properties.size(); ++p) {
                model.vertex_values.values[p].push_back(value(model.properties[p]));
            }
        }
    }

    void add_recipe() {
        Criteria& c = model.criteria;
        c.l_min = random(0.1, 10);
        c.l_max = random(10, 100);
        c.radius_edge = random(1, 3);
        c.aspect = random(3, 20);
        c.v_max = random.below(2) ? 0 : random(0, 1e9);
        for (std::uint64_t n = random.below(2) * model.properties.size(); n > 0; --n) {
            c.variation.push_back({random(0, 1), random(1, 2)});
        }
        for (std::uint64_t n = random.below(3); n > 0; --n) {
            model.region_names.push_back({place(), odd_name(random)});
        }
        model.density = random.below(2) ? DensityMode::paper : DensityMode::canonical;
        model.barrier_options = {random(0, 10),
                                 random(0, 1),
                                 random(0, 5),
                                 random.below(1ULL << 63),
                                 random.below(2) == 0 ? SeedMode::paired : SeedMode::exact,
                                 random.below(2) == 0};
        for (Barrier& f : model.barriers) {
            f.refined = model.barrier_options.refine;
        }
        const auto box_round = [&](Box3 some) {
            for (int corners = 2; corners > 0; --corners) {
                some.extend(place());
            }
            return some;
        };
        const Box3 extent = box_round({});
        model.domain = {extent, box_round(extent), {}};
        for (std::uint64_t rings = random.below(3); rings > 0; --rings) {
            model.domain.outline.push_back({place(), place(), place()});
        }
        model.estimator = random.below(2) ? "idw:power=2:max_points=12" : "nearest\nidw:power=3 of it's";
    }
};

inline Model random_model(std::uint64_t seed) {
    RandomModel r{Random(seed), {}, {}};
    if (r.random.below(3) == 0) {
        r.box = {{-500, -500, -1000}, {500, 500, 100}};
    } else {
        r.box = {{524000, 6790000, -1000}, {525000, 6791000, 100}};
        r.model.frame.origin = choose_origin(r.box);
        r.box = {r.box.lo - r.model.frame.origin, r.box.hi - r.model.frame.origin};
        r.model.frame.crs_name = "EPSG:3067 ETRS89 / TM35FIN(E,N)";
        r.model.frame.crs_wkt =
            "ENGCRS[\"it's a \"\"local\"\" one\",EDATUM[\"naïve\"],CS[Cartesian,2],"
            "AXIS[\"(E)\",east,ORDER[1],LENGTHUNIT[\"metre\",1]],AXIS[\"(N)\",north,ORDER[2],LENGTHUNIT[\"metre\",1]]]";
    }
    r.model.frame.metres_per_unit = r.random.below(2) ? 1 : 1200.0 / 3937;
    r.model.frame.unit = r.random.below(2) ? "metre" : odd_name(r.random);
    for (std::uint64_t n = r.random.below(7); n > 0; --n) {
        r.model.properties.push_back(r.property());
    }
    r.add_boreholes();
    r.add_samples();
    for (std::uint64_t n = r.random.below(4); n > 0; --n) {
        r.model.surfaces.push_back(r.surface(static_cast<SurfaceKind>(r.random.below(4))));
    }
    r.add_faults();
    r.add_vertices();
    r.add_recipe();
    return std::move(r.model);
}

}  // namespace terratet::testing
