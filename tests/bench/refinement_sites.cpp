// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refinement_sites.hpp"

#include <cmath>
#include <numbers>

#include "io/read_site.hpp"
#include "tess/barrier_query.hpp"
#include "tess/model/density_edition.hpp"
#include "tests/support.hpp"
#include "tests/tess/worlds.hpp"

namespace terratet::bench {

namespace {

RefinementSite site_from(std::string name, const SiteInputs& inputs, double l_min) {
    RefinementSite result;
    result.name = std::move(name);
    Diagnostics diagnostics;
    ReadCounts counts;
    result.site = read_site(inputs, diagnostics, counts);
    result.options.criteria.l_min = l_min;
    result.options.criteria.l_max = 4 * l_min;
    return result;
}

}  // namespace

RefinementSite twin() {
    SiteInputs inputs;
    const auto file = [](const char* name) { return Source{testing::project_data("olkiluoto-twin") / name}; };
    inputs.boreholes = {file("collar.csv")};
    inputs.surveys = {file("survey.csv")};
    inputs.logs = {file("log.csv")};
    inputs.faults = {file("fracture.ts")};
    inputs.source_crs = "EPSG:3067";
    RefinementSite result = site_from("twin", inputs, 20);
    const Frame& frame = result.site.frame;
    result.options.extent = {frame.to_local({525130, 6791500, -990}), frame.to_local({525870, 6792500, 10})};
    return result;
}

RefinementSite made_up() {
    RefinementSite result;
    result.name = "200 wells";
    result.options.extent = {{0, 0, 0}, {740, 1000, 1000}};
    result.options.criteria.l_min = 15;
    result.options.criteria.l_max = 60;
    Site& site = result.site;
    site.properties = {parse_property("f")};
    Samples& samples = site.samples;
    samples.values.resize(1);
    testing::Random random(5);
    for (std::int32_t well = 0; well < 200; ++well) {
        Borehole borehole;
        borehole.id = "W" + std::to_string(1000 + well);
        borehole.collar = {random(30, 710), random(30, 970), 950};
        for (int i = 0; i < 50; ++i) {
            const double depth = 18.0 * i;
            borehole.path.push_back(borehole.collar +
                                    Vec3{3 * std::sin(0.1 * i) + random(0, 0.02), 2 * std::cos(0.13 * i), -depth});
            borehole.path_depth.push_back(depth);
            samples.positions.push_back(borehole.path.back());
            samples.borehole.push_back(well);
            samples.depth.push_back(depth);
            samples.length.push_back(0);
            samples.values[0].push_back(std::sin(0.1 * i));
        }
        site.boreholes.push_back(std::move(borehole));
    }
    for (int i = 0; i < 5; ++i) {
        const double dip_deg = 35 + 6 * i;
        const Vec3 centre{200.0 + 80 * i, 450.0 + 60 * i, 200.0 + 120 * i};
        site.surfaces.push_back(testing::planar_fault("F" + std::to_string(i), centre, 0, dip_deg, 300, 140,
                                                      result.options.criteria.l_min));
    }
    return result;
}

std::optional<RefinementSite> babbitt(double l_min) {
    const auto folder = testing::public_data("pygslib/doc/source/Tutorial_1/Babbitt");
    if (!folder) {
        return std::nullopt;
    }
    SiteInputs inputs;
    inputs.boreholes = {{(*folder / "collar_BABBITT.csv").string()}};
    inputs.surveys = {{(*folder / "survey_BABBITT.csv").string()}};
    inputs.logs = {{(*folder / "assay_BABBITT.csv").string()}};
    inputs.source_crs = "EPSG:26791";
    inputs.properties = {"CU"};
    RefinementSite result = site_from("Babbitt", inputs, l_min);
    const Vec3 centre = result.site.frame.to_local({2297200, 418500, 300});
    result.site.surfaces.push_back(testing::planar_fault("F", centre, 55, 60, 10000, 3000, l_min));
    Box3 data = bounding_box(result.site.samples.positions);
    result.options.extent = data.grown(result.options.criteria.l_max);
    return result;
}

PointsInBox bare_points(const RefinementSite& site) {
    PointsInBox result{site.options.extent, {}};
    Samples samples = site.site.samples;
    const auto add = [&](const Vec3& p) {
        samples.positions.push_back(p);
        samples.borehole.push_back(-1);
        samples.depth.push_back(missing);
        samples.length.push_back(0);
        for (auto& column : samples.values) {
            column.push_back(0);
        }
    };
    for (const Surface& surface : site.site.surfaces) {
        std::ranges::for_each(surface.vertices, add);
    }
    samples = selected(samples, canonical_order(samples));
    merge_coincident(samples, site.site.properties);
    const std::vector<Barrier> no_faults;
    const double l_min = 0.99 * site.options.criteria.l_min;  // surfaces' vertices stand l_min apart, but for rounding
    const Box3 inside = result.box.grown(-l_min);
    for (const auto i : edit_density(samples, l_min, DensityMode::canonical, BarrierQuery(no_faults)).kept) {
        if (inside.contains(samples.positions[i])) {
            result.points.push_back(samples.positions[i]);
        }
    }
    return result;
}

}  // namespace terratet::bench
