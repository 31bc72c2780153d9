// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "tess/error.hpp"
#include "tools/options/export_options.hpp"
#include "tools/options/model_options.hpp"
#include "tools/options/site_options.hpp"
#include "tools/run/outputs.hpp"

using namespace terratet;
using namespace terratet::tools;
using Catch::Matchers::Contains;

namespace {

/// A site in feet whose properties are K (log10) and grade.
Site site_in_feet() {
    Site site;
    site.frame.metres_per_unit = 0.3048;
    site.frame.origin = {1024, 2048, 0};
    site.properties = {{"K", "m/s", Scale::log10, Kind::continuous, {}},
                       {"grade", "", Scale::linear, Kind::continuous, {}}};
    return site;
}

}  // namespace

TEST_CASE("Lengths are read in the unit of the model, whatever unit they carry") {
    ModelArguments arguments;
    arguments.l_min = "20";
    arguments.l_max = "30.48m";
    arguments.pad = "10ft";
    arguments.fault_spacing = "3.048m";
    const BuildOptions options = build_options(arguments, site_in_feet());
    CHECK(options.criteria.l_min == 20);
    CHECK(options.criteria.l_max == Approx(100));
    CHECK(options.pad == Approx(10));
    CHECK(options.barriers.spacing == Approx(10));
}

TEST_CASE("What is not given is left to the floor below") {
    const BuildOptions options = build_options({}, site_in_feet());
    CHECK(options.criteria == Criteria{});
    CHECK(options.default_tolerance);
    CHECK(options.pad < 0);
    CHECK(options.extent.empty());
    CHECK(options.barriers.spacing == 0);
    CHECK(options.barriers.width == 0);
    CHECK(options.estimator.starts_with("natural"));
    CHECK_NOTHROW(check_model_arguments({}));
}

TEST_CASE("The extent is given in true coordinates and used in local ones") {
    ModelArguments arguments;
    arguments.extent = "1000,2000,-100,1100,2100,0";
    const Box3 extent = build_options(arguments, site_in_feet()).extent;
    CHECK(extent.lo == Vec3{-24, -48, -100});
    CHECK(extent.hi == Vec3{76, 52, 0});
}

TEST_CASE("Limits on variation go to the property they name") {
    ModelArguments arguments;
    arguments.df_min = {"K=0.1"};
    arguments.df_max = {"grade=2", "K=0.5"};
    const auto variation = build_options(arguments, site_in_feet()).criteria.variation;
    REQUIRE(variation.size() == 2);
    CHECK(variation[0] == VariationLimits{0.1, 0.5});
    CHECK(variation[1] == VariationLimits{0, 2});

    arguments.df_max = {"gold=1"};
    CHECK_THROWS_WITH(build_options(arguments, site_in_feet()), Contains("no property 'gold'; there is K, grade"));
}

TEST_CASE("Contradictions and impossible numbers are refused before anything is read") {
    const auto message = [](auto change) {
        ModelArguments arguments;
        change(arguments);
        try {
            check_model_arguments(arguments);
        } catch (const UsageError& error) {
            return std::string(error.what());
        }
        return std::string("accepted");
    };
    CHECK_THAT(message([](auto& a) { a.l_min = "20", a.l_max = "10"; }), !Contains("accepted"));
    CHECK_THAT(message([](auto& a) { a.l_min = "-3"; }), Contains("--lmin"));
    CHECK_THAT(message([](auto& a) { a.l_min = "nan"; }), Contains("--lmin"));
    CHECK_THAT(message([](auto& a) { a.l_max = "20 parsecs"; }), Contains("--lmax"));
    CHECK_THAT(message([](auto& a) { a.radius_edge = 0.2; }), !Contains("accepted"));
    CHECK_THAT(message([](auto& a) { a.extent = "0,0,0,1,1"; }), Contains("six numbers"));
    CHECK_THAT(message([](auto& a) { a.extent = "0,0,0,1,1,0"; }), Contains("no volume"));
    CHECK_THAT(message([](auto& a) { a.extent = "0,0,0,1,1,inf"; }), Contains("'inf' is not a number"));
    CHECK_THAT(message([](auto& a) { a.extent = "0,0,0,1,1,1e12"; }), Contains("beyond"));
    CHECK_THAT(message([](auto& a) { a.extent = "0,0,0,1,1,1", a.pad = "3"; }), Contains("--pad"));
    CHECK_THAT(message([](auto& a) { a.df_max = {"K"}; }), Contains("--df-max: 'K' is not PROPERTY=NUMBER"));
    CHECK_THAT(message([](auto& a) { a.df_min = {"K=-1"}; }), Contains("below 0"));
    CHECK_THAT(message([](auto& a) { a.density = "sparse"; }), Contains("canonical, paper"));
    CHECK_THAT(message([](auto& a) { a.fault_mode = "approximate"; }), Contains("--fault-mode"));
    CHECK_THAT(message([](auto& a) { a.fault_spacing = "20", a.fault_width = "30"; }), Contains("--fault-width"));
    CHECK_THAT(message([](auto& a) { a.estimator = "krigging"; }), !Contains("accepted"));
    CHECK_THAT(message([](auto& a) { a.max_vertices = 0; }), Contains("--max-vertices"));

    ModelArguments arguments;
    arguments.df_min = {"K=2"};
    arguments.df_max = {"K=1"};
    CHECK_THROWS_AS(build_options(arguments, site_in_feet()), UsageError);
}

TEST_CASE("Inputs keep their kind, and layer, where and sql are for a single one") {
    SiteArguments arguments;
    arguments.samples = {"points.csv"};
    arguments.where = "grade > 0";
    arguments.open_options = {"SEPARATOR=TAB"};
    const SiteInputs inputs = site_inputs(arguments, false);
    REQUIRE(inputs.samples.size() == 1);
    CHECK(inputs.samples[0].path == "points.csv");
    CHECK(inputs.samples[0].where == "grade > 0");
    CHECK(inputs.samples[0].open_options == std::vector<std::string>{"SEPARATOR=TAB"});

    arguments.faults = {"fault.ts"};
    CHECK_THROWS_WITH(site_inputs(arguments, false), Contains("--where is for a single input"));
}

TEST_CASE("Inputs that cannot make a model are refused") {
    CHECK_THROWS_WITH(site_inputs({}, false), Contains("no input"));
    SiteArguments logs_only;
    logs_only.logs = {"log.csv"};
    CHECK_THROWS_WITH(site_inputs(logs_only, false), Contains("--boreholes"));
    SiteArguments arguments;
    arguments.samples = {"points.csv"};
    const auto with = [&](auto change) {
        SiteArguments changed = arguments;
        change(changed);
        return site_inputs(changed, false);
    };
    CHECK_THROWS_WITH(with([](auto& a) { a.columns = {"id"}; }), Contains("MEANING=COLUMN"));
    CHECK_THROWS_WITH(with([](auto& a) { a.desurvey = "curvy"; }), Contains("--desurvey"));
    CHECK_THROWS_WITH(with([](auto& a) { a.azimuth = "magnetic:north"; }), Contains("--azimuth"));
    CHECK_THROWS_AS(with([](auto& a) { a.source_crs = "EPSG:99999999"; }), UsageError);
    CHECK_THROWS_AS(with([](auto& a) { a.properties = {"K:log7"}; }), UsageError);
    CHECK_THROWS_AS(with([](auto& a) { a.depth_unit = "furlong"; }), UsageError);
    const SiteInputs inputs = with([](auto& a) { a.azimuth = "magnetic:-7.5", a.dip_convention = "inclination"; });
    CHECK(inputs.declination_deg == -7.5);
    CHECK(inputs.azimuth == AzimuthReference::magnetic);
    CHECK(inputs.dip == DipConvention::inclination);
}

TEST_CASE("Creation options say the same as their named twins") {
    ExportArguments arguments;
    arguments.creation_options = {"COMPRESS=YES", "local_origin=true", "VOXEL_SIZE=5m", "COLOR=K"};
    const ExportArguments merged = with_creation_options(arguments);
    CHECK(merged.compress);
    CHECK(merged.local_origin);
    CHECK(merged.voxel_size == "5m");
    CHECK(merged.color == "K");
    arguments.creation_options = {"COMPRES=YES"};
    CHECK_THROWS_WITH(with_creation_options(arguments), Contains("COMPRESS"));
    arguments.creation_options = {"COMPRESS=PERHAPS"};
    CHECK_THROWS_AS(with_creation_options(arguments), UsageError);
}

TEST_CASE("Voxels are cubes or boxes, and the property to colour by must be there") {
    Model model;
    static_cast<Site&>(model) = site_in_feet();
    ExportArguments arguments;
    arguments.voxel_size = "3.048m";
    CHECK(writer_options(arguments, model).voxel_size.z == Approx(10));
    arguments.voxel_size = "10,10,5";
    CHECK(writer_options(arguments, model).voxel_size == Vec3{10, 10, 5});
    arguments.voxel_size = "10,5";
    CHECK_THROWS_WITH(writer_options(arguments, model), Contains("one length or three"));
    arguments.voxel_size = "0";
    CHECK_THROWS_WITH(check_export_arguments(arguments), Contains("not above 0"));
    arguments.voxel_size.clear();
    arguments.color = "gold";
    CHECK_THROWS_WITH(writer_options(arguments, model), Contains("K, grade"));
}

TEST_CASE("The journal keeps what decides about the result and nothing else") {
    setenv("SOURCE_DATE_EPOCH", "86400", 1);
    const JournalEntry entry = journal_entry(
        "build", {{"Resolution", "lmin", {"20m"}}, {run_group, "threads", {"2"}}, {"Inputs", "log", {"a", "b"}}});
    unsetenv("SOURCE_DATE_EPOCH");
    CHECK(entry.time == "1970-01-02T00:00:00Z");
    CHECK(entry.command == "build");
    CHECK(entry.arguments == R"({"lmin":["20m"],"log":["a","b"]})");
}
