// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/commands/run_build.hpp"
#include "tools/options/command.hpp"

namespace terratet::tools {
namespace {

class Convert final : public Command {
  public:
    Syntax syntax() override {
        Syntax syntax{"convert", site_options(build_.site), {"OUTPUT", 1, 1000, &build_.outputs}};
        append(syntax, model_options(build_.model));
        append(syntax, export_options(build_.exporting));
        append(syntax, run_options(build_.run));
        return syntax;
    }

    int run(const std::vector<Given>& given) override { return run_build("convert", build_, given); }

  private:
    BuildArguments build_;
};

}  // namespace

CommandEntry convert_command() {
    return {"convert",
            "build and export in one go",
            "[inputs and options] OUTPUT…",
            "Builds a model and writes it in one or several formats, each by its extension; an output .gpkg keeps the "
            "model.",
            {"terratet convert --samples assays.gpkg --lmin 5m ore.vtu ore.glb ore.vdb",
             "terratet convert --boreholes collar.csv --log log.csv -s_srs EPSG:3067 \\",
             "  -t_srs EPSG:3067 --lmin 20m -tr 5 model.gpkg voxels.vdb"},
            [] { return std::make_unique<Convert>(); }};
}

}  // namespace terratet::tools
