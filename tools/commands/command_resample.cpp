// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/ranks/ranks.hpp"
#include "io/onto/read_place_mesh.hpp"
#include "io/source.hpp"
#include "tess/error.hpp"
#include "tools/options/command.hpp"
#include "tools/run/grid_outputs.hpp"
#include "tools/run/open_model.hpp"
#include "tools/run/outputs.hpp"
#include "tools/run/process.hpp"

namespace terratet::tools {
namespace {

class Resample final : public Command {
  public:
    Syntax syntax() override {
        Syntax syntax{"resample", export_options(exporting_), {"MODEL.gpkg and OUTPUT", 2, 1000, &paths_}};
        append(syntax, {{"Grid",
                         {{{"onto"},
                           "GRID",
                           "whose places are taken: voxels' centres of a .tif or .nc cube, .vdb, or a regular table "
                           "with columns x, y, z; nodes and cells of a mesh, .vtu or .msh, which becomes .vtu or "
                           ".csv; in any coordinate system (GRID,srs=EPSG:…)",
                           &onto_}}},
                        {"Model", {accept_edited_option(accept_edited_)}}});
        append(syntax, run_options(run_));
        return syntax;
    }

    bool share_among(const Ranks& ranks) override {
        run_.ranks = &ranks;
        return true;
    }

    int run(const std::vector<Given>&) override {
        if (onto_.empty()) {
            throw UsageError("--onto: name the grid whose places are wanted");
        }
        const std::string& input = paths_.front();
        const std::vector<std::string> outputs(paths_.begin() + 1, paths_.end());
        exporting_.voxels = true;
        const bool writes = run_.ranks == nullptr || run_.ranks->is_root();
        if (writes) {
            check_outputs(outputs, {input, onto_}, exporting_, run_);
        }
        start_together(run_.ranks);
        if (!writes && (names_mesh(parse_source(onto_).path) || exporting_.dry_run)) {
            return exit_done;  // what is shared are voxels
        }
        const ThreadLimit threads(run_.threads);
        LiveModel live = open_model(input, accept_edited_);
        if (exporting_.uncertainty) {
            live.add_uncertainty();
        }
        resample_onto(*live.snapshot(), onto_, outputs, exporting_, run_);
        return exit_done;
    }

  private:
    ExportArguments exporting_;
    RunArguments run_;
    std::vector<std::string> paths_;
    std::string onto_;
    bool accept_edited_ = false;
};

}  // namespace

CommandEntry resample_command() {
    return {
        "resample",
        "a model's values at the places of your own grid",
        "MODEL.gpkg --onto GRID OUTPUT…",
        "Writes what `query value` says at the centres of a grid's voxels, in a grid's formats, or at the nodes and "
        "the cells' centres of a mesh.",
        {"terratet resample site.gpkg --onto heads.nc values.nc",
         "terratet resample site.gpkg --onto feflow.vtu values.vtu",
         "terratet resample --uncertainty site.gpkg "
         "--onto blocks.csv estimated.csv"},
        [] { return std::make_unique<Resample>(); }};
}

}  // namespace terratet::tools
