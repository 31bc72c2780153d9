// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "tess/error.hpp"
#include "tools/options/command_line.hpp"
#include "tools/options/export_options.hpp"
#include "tools/options/model_options.hpp"
#include "tools/options/site_options.hpp"
#include "tools/options/values.hpp"
#include "tools/run/outputs.hpp"

using namespace terratet;
using namespace terratet::tools;
using Catch::Matchers::Contains;
using Catch::Matchers::Equals;

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

using Words = std::vector<std::string>;

ModelArguments model_arguments(const Words& words) {
    ModelArguments arguments;
    parse_arguments({"build", model_options(arguments), {}}, words);
    return arguments;
}

SiteInputs inputs_of(const Words& words) {
    SiteArguments arguments;
    parse_arguments({"build", site_options(arguments), {}}, words);
    return site_inputs(arguments, false);
}

ExportArguments export_arguments(const Words& words) {
    ExportArguments arguments;
    parse_arguments({"export", export_options(arguments), {}}, words);
    return arguments;
}

/// What is thrown; "accepted" for nothing.
std::string message(const Words& words) {
    try {
        check_model_arguments(model_arguments(words));
    } catch (const UsageError& error) {
        return error.what();
    }
    return "accepted";
}

}  // namespace

TEST_CASE("Lengths are read in the unit of the model, whatever unit they carry") {
    const BuildOptions options = build_options(
        model_arguments({"--lmin", "20", "--lmax", "30.48m", "--pad", "10ft", "--fault-spacing", "3.048m"}),
        site_in_feet());
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
    const Box3 extent =
        build_options(model_arguments({"--extent", "1000,2000,-100,1100,2100,0"}), site_in_feet()).extent;
    CHECK(extent.lo == Vec3{-24, -48, -100});
    CHECK(extent.hi == Vec3{76, 52, 0});
}

TEST_CASE("Limits on variation go to the property they name") {
    const auto variation =
        build_options(model_arguments({"--df-min", "K=0.1", "--df-max", "grade=2", "--df-max", "K=0.5"}),
                      site_in_feet())
            .criteria.variation;
    REQUIRE(variation.size() == 2);
    CHECK(variation[0] == VariationLimits{0.1, 0.5});
    CHECK(variation[1] == VariationLimits{0, 2});

    CHECK_THROWS_WITH(build_options(model_arguments({"--df-max", "gold=1"}), site_in_feet()),
                      Contains("no property 'gold'; there is K, grade"));
}

TEST_CASE("Contradictions and impossible numbers are refused before anything is read") {
    CHECK_THAT(message({"--lmin", "20", "--lmax", "10"}), !Contains("accepted"));
    CHECK_THAT(message({"--lmin", "-3"}), Contains("--lmin: '-3' is not above 0"));
    CHECK_THAT(message({"--lmin", "0"}), Contains("--lmin: '0' is not above 0"));
    CHECK_THAT(message({"--lmin", "nan"}), Contains("--lmin"));
    CHECK_THAT(message({"--lmax", "20 parsecs"}), Contains("--lmax"));
    CHECK_THAT(message({"--radius-edge", "0.2"}), !Contains("accepted"));
    CHECK_THAT(message({"--extent", "0,0,0,1,1"}), Contains("six numbers"));
    CHECK_THAT(message({"--extent", "0,0,0,1,1,0"}), Contains("no volume"));
    CHECK_THAT(message({"--extent", "0,0,0,1,1,inf"}), Contains("'inf' is not a number"));
    CHECK_THAT(message({"--extent", "0,0,0,1,1,1e12"}), Contains("beyond"));
    CHECK_THAT(message({"--extent", "0,0,0,1,1,1", "--pad", "3"}), Contains("--pad"));
    CHECK_THAT(message({"--pad", "-1"}), Contains("--pad: '-1' is below 0"));
    CHECK(message({"--pad", "0"}) == "accepted");
    CHECK_THAT(message({"--df-max", "K"}), Contains("--df-max: 'K' is not PROPERTY=NUMBER"));
    CHECK_THAT(message({"--df-min", "K=-1"}), Contains("below 0"));
    CHECK_THAT(message({"--density", "sparse"}), Contains("canonical, paper"));
    CHECK_THAT(message({"--fault-mode", "approximate"}), Contains("--fault-mode"));
    CHECK_THAT(message({"--fault-spacing", "20", "--fault-width", "30"}), Contains("--fault-width"));
    CHECK_THAT(message({"--estimator", "krigging"}), Contains("did you mean kriging?"));
    CHECK_THAT(message({"--max-vertices", "0"}), Contains("--max-vertices"));
    CHECK_THAT(message({"--tolerance", "auto", "--lmin", "3"}), Contains("--tolerance: auto goes"));
    CHECK_THROWS_AS(build_options(model_arguments({"--df-min", "K=2", "--df-max", "K=1"}), site_in_feet()), UsageError);
}

TEST_CASE("Lengths of which some have a unit are compared where the model's unit is known") {
    const Words words{"--lmin", "20", "--lmax", "10m", "--fault-spacing", "25ft", "--fault-width", "20"};
    CHECK(message(words) == "accepted");
    CHECK(build_options(model_arguments(words), site_in_feet()).criteria.l_max == Approx(32.8084));
    Site in_metres = site_in_feet();
    in_metres.frame.metres_per_unit = 1;
    CHECK_THROWS_AS(build_options(model_arguments(words), in_metres), UsageError);
}

TEST_CASE("What is in force by default is what the structs of options hold") {
    const ModelArguments model;
    CHECK(model.build.criteria == Criteria{});
    CHECK(model.estimator.name == EstimatorSpec{}.name);
    ModelArguments a;
    ExportArguments b;
    SiteArguments c;
    std::size_t words = 0;
    for (const auto& groups : {model_options(a), export_options(b), site_options(c)}) {
        for (const OptionGroup& group : groups) {
            for (const Option& option : group.options) {
                const auto* parsed = std::get_if<Parsed>(&option.target);
                if (parsed == nullptr || parsed->standard.empty()) {
                    continue;
                }
                INFO(option.names.front());
                ++words;
                CHECK_THAT(help_text(option), Contains(parsed->standard + " (default"));
                for (const std::string& word : parsed->words) {
                    CHECK_THAT(help_text(option), Contains(word));
                }
            }
        }
    }
    CHECK(words >= 11);
    a.build.criteria.aspect = 7.5;
    CHECK_THAT(help_text({{"aspect"}, "B", "flat", &a.build.criteria.aspect}), Equals("flat. Default 7.5"));
    a.build.density = DensityMode::paper;
    const Option density{{"density"},
                         "HOW",
                         "canonical or paper",
                         one_of(a.build.density, Choices<DensityMode>{{"canonical", DensityMode::canonical},
                                                                      {"paper", DensityMode::paper}})};
    CHECK_THAT(help_text(density), Equals("canonical or paper (default)"));
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
    const auto with = [&](const Words& words) {
        Words all{"--samples", "points.csv"};
        all.insert(all.end(), words.begin(), words.end());
        return inputs_of(all);
    };
    CHECK_THROWS_WITH(with({"--columns", "id"}), Contains("MEANING=COLUMN"));
    CHECK_THROWS_WITH(with({"--desurvey", "curvy"}), Contains("--desurvey"));
    CHECK_THROWS_WITH(with({"--azimuth", "magnetic:north"}), Contains("--azimuth"));
    CHECK_THROWS_WITH(with({"--composite", "0m"}), Contains("--composite: '0m' is not above 0"));
    CHECK_THROWS_AS(with({"--source-crs", "EPSG:99999999"}), UsageError);
    CHECK_THROWS_AS(with({"--property", "K:log7"}), UsageError);
    CHECK_THROWS_AS(with({"--depth-unit", "furlong"}), UsageError);
    const SiteInputs inputs = with({"--azimuth", "magnetic:-7.5", "--dip-convention", "inclination"});
    CHECK(inputs.declination_deg == -7.5);
    CHECK(inputs.azimuth == AzimuthReference::magnetic);
    CHECK(inputs.dip == DipConvention::inclination);
}

TEST_CASE("Creation options say the same as their named twins") {
    const auto merged =
        export_arguments({"-co", "COMPRESS=YES", "-co", "local_origin=true", "-co", "VOXEL_SIZE=5m", "-co", "COLOR=K",
                          "-co", "FAULT_GAP=COLLAPSE", "-co", "ALIGN=NO", "-co", "VERSION=2.2", "-co", "FRAME=enu"});
    CHECK(merged.compress);
    CHECK(merged.writers.local_origin);
    CHECK(merged.voxel_size.value()[2].text == "5m");
    CHECK(merged.writers.color_property == "K");
    CHECK(merged.writers.fault_gap == FaultGap::collapse);
    CHECK_FALSE(merged.writers.aligned);
    CHECK(merged.writers.msh_version_2);
    CHECK(merged.writers.enu);
    CHECK_THROWS_WITH(export_arguments({"-co", "COMPRES=YES"}), Contains("did you mean COMPRESS?"));
    CHECK_THROWS_AS(export_arguments({"-co", "COMPRESS=PERHAPS"}), UsageError);
    CHECK_THROWS_AS(export_arguments({"-co", "COMPRESS"}), UsageError);
}

TEST_CASE("Voxels are cubes or boxes, and the property to colour by must be there") {
    Model model;
    static_cast<Site&>(model) = site_in_feet();
    CHECK(writer_options(export_arguments({"-tr", "3.048m"}), model).voxel_size.z == Approx(10));
    CHECK(writer_options(export_arguments({"-tr", "10", "10", "5"}), model).voxel_size == Vec3{10, 10, 5});
    CHECK_THROWS_WITH(export_arguments({"-tr", "10,5"}), Contains("one length or three"));
    CHECK_THROWS_WITH(export_arguments({"-tr", "0"}), Contains("not above 0"));
    CHECK_THROWS_WITH(writer_options(export_arguments({"--color", "gold"}), model), Contains("K, grade"));
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
