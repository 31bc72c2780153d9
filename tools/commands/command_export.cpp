// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <spdlog/spdlog.h>

#include "interp/ranks/ranks.hpp"
#include "io/base/lower_case.hpp"
#include "io/source.hpp"
#include "io/voxels/grids/grid_source.hpp"
#include "tess/error.hpp"
#include "tools/commands/run_build.hpp"
#include "tools/options/command.hpp"
#include "tools/report/report.hpp"
#include "tools/run/grid_outputs.hpp"
#include "tools/run/open_model.hpp"
#include "tools/run/outputs.hpp"
#include "tools/run/pipeline.hpp"
#include "tools/run/process.hpp"
#include "tools/run/progress_display.hpp"

namespace terratet::tools {
namespace {

class Export final : public Command {
  public:
    Syntax syntax() override {
        Syntax syntax{"export", export_options(exporting_), {"MODEL.gpkg and OUTPUT", 2, 1000, &paths_}};
        append(syntax, {{"Model", {accept_edited_option(accept_edited_)}}});
        append(syntax, run_options(run_));
        return syntax;
    }

    bool share_among(const Ranks& ranks) override {
        run_.ranks = &ranks;
        return true;
    }

    int run(const std::vector<Given>&) override {
        const Stopwatch total;
        const std::string& input = paths_.front();
        std::vector<std::string> outputs(paths_.begin() + 1, paths_.end());
        for (auto& output : outputs) {
            if (names_model(output) && lower_case(exporting_.writers.format) == "surfaces") {
                output += ",of=SURFACES";  // a GeoPackage, but of no model
            } else if (names_model(output)) {
                throw UsageError(output + ": is a model; export writes other formats");
            }
        }
        const bool is_grid = names_grid(parse_source(input).path);
        exporting_.voxels = exporting_.voxels || is_grid;
        const bool writes = run_.ranks == nullptr || run_.ranks->is_root();
        if (writes) {
            check_outputs(outputs, {input}, exporting_, run_);
        }
        start_together(run_.ranks);
        if (!writes && (is_grid || !any_voxels(outputs, exporting_))) {
            return exit_done;
        }
        const ThreadLimit threads(run_.threads);
        if (is_grid) {
            if (!run_.report.empty()) {
                throw UsageError("--report: tells of models, and " + input + " is a grid");
            }
            export_grid(input, outputs, exporting_, run_);
            return exit_done;
        }
        LiveModel live = open_model(input, accept_edited_);
        if (exporting_.uncertainty) {
            live.add_uncertainty();
        }
        RunRecord record;
        record.model = live.snapshot();
        if (say_plan(*record.model, outputs, exporting_)) {
            return exit_done;
        }
        const Stopwatch writing;
        static_cast<void>(record.model->cells());  // needs the tessellation
        record.model->release_memory();
        {
            ProgressDisplay display(progress_style(run_.progress, run_.quiet), stderr);
            record.written = write_outputs(*record.model, outputs, exporting_, run_, {}, display.callback());
        }
        if (!writes) {
            return exit_done;
        }
        record.write_seconds = writing.seconds();
        record.total_seconds = total.seconds();
        write_report(record, run_);
        spdlog::info("{}", summary_text(record));
        return exit_done;
    }

  private:
    ExportArguments exporting_;
    RunArguments run_;
    std::vector<std::string> paths_;
    bool accept_edited_ = false;
};

}  // namespace

CommandEntry export_command() {
    return {"export",
            "a model into meshes, scenes and voxels",
            "MODEL.gpkg|GRID OUTPUT…",
            "Writes a model in one or several formats, each by its extension; or a grid (.tif, .nc, .vdb, a regular "
            "table) in "
            "others of voxels.",
            {"terratet export site.gpkg site.vtu site.glb", "terratet export -tr 5m site.gpkg site.vdb",
             "terratet export cube.nc cube.vdb", "terratet export --clip --fault-gap collapse site.gpkg elements.vtu"},
            [] { return std::make_unique<Export>(); }};
}

}  // namespace terratet::tools
