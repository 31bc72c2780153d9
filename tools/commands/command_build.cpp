// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <chrono>

#include "tools/commands/run_build.hpp"
#include "tools/options/command.hpp"

namespace terratet::tools {
namespace {

class Build final : public Command {
  public:
    Syntax syntax() override {
        Syntax syntax{"build", site_options(build_.site), {}};
        append(syntax, model_options(build_.model));
        append(syntax, {{"Output",
                         {{{"o", "output"}, "MODEL.gpkg", "the model: a GeoPackage, or PG:… for PostGIS", &output_},
                          {{"uncertainty"},
                           "",
                           "keep each property's standard deviation, 95 % half-width, extrapolation and number of "
                           "samples with the "
                           "vertices; of a category the classes' probabilities and entropy",
                           &build_.exporting.uncertainty},
                          {{"co"},
                           "KEY=VALUE",
                           "SPATIAL_INDEX=YES gives the model's layers R-trees, which other programs like and which "
                           "take longer than all other writing",
                           creation_options(build_.exporting)}}}});
        append(syntax, run_options(build_.run));
        return syntax;
    }

    int run(const std::vector<Given>& given) override {
        if (output_.empty()) {
            throw UsageError("no output: give -o MODEL.gpkg");
        }
        if (!names_model(output_)) {
            throw UsageError("-o: '" + output_ + "' is not a .gpkg file; 'terratet convert' writes other formats");
        }
        build_.outputs = {output_};
        return run_build("build", build_, given);
    }

  private:
    BuildArguments build_;
    std::string output_;
};

}  // namespace

CommandEntry build_command() {
    return {"build",
            "samples and faults into a model",
            "[inputs and options] -o MODEL.gpkg",
            "Reads boreholes, loose samples and faults, tessellates the ground between them, refines until every cell "
            "meets "
            "the criteria or says why it cannot, and keeps the result as a GeoPackage.",
            {"terratet build --boreholes collar.csv --survey survey.csv --log log.csv \\",
             "  --faults fault.ts --property K:log10:unit=m/s -s_srs EPSG:3067 \\",
             "  --lmin 20m --lmax 80m -o site.gpkg", "terratet build --config recipe.toml --lmin 10m -o finer.gpkg"},
            [] { return std::make_unique<Build>(); }};
}

}  // namespace terratet::tools
