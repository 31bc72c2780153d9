// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/run/grid_outputs.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <limits>

#include "interp/plan/uncertainty.hpp"
#include "io/source.hpp"
#include "io/voxels/grids/grid_source.hpp"
#include "io/voxels/grids/model_at_grid.hpp"
#include "io/voxels/write_voxels.hpp"
#include "tess/error.hpp"
#include "tools/options/text.hpp"
#include "tools/run/process.hpp"
#include "tools/run/progress_display.hpp"

namespace terratet::tools {
namespace {

/// A grid's table is its block model, and its tileset one of voxels.
std::vector<VoxelOutput> voxel_outputs(const std::vector<std::string>& texts, const ExportArguments& arguments) {
    ExportArguments of_grid = arguments;
    of_grid.voxels = true;
    std::vector<VoxelOutput> outputs;
    for (const std::string& text : texts) {
        const OutputRequest output = parse_output(text, of_grid);
        std::string format =
            output_format(output.path, output.format.empty() ? arguments.writers.format : output.format);
        format = format == "CSV" ? "BLOCKS" : format;
        if (output.path == "-" || !is_voxel_format(format)) {
            throw UsageError(fmt::format("{}: a grid becomes .vdb, .tif, .nc, .csv or a tileset (.json), not {}",
                                         output.path, format));
        }
        outputs.push_back({output.path, format});
    }
    if (arguments.voxel_size) {
        throw UsageError("--voxel-size: a grid keeps its own places; models are exported with other ones");
    }
    return outputs;
}

void write_all(const BrickSource& source, const VoxelGrid& grid, const std::vector<VoxelOutput>& outputs,
               const ExportArguments& arguments, const RunArguments& run, const Model& model) {
    ExportOptions options = writer_options(arguments, model);
    options.overwrite = run.overwrite;
    for (const VoxelOutput& output : outputs) {
        const VoxelPlan plan = plan_voxels(grid, output, options);
        const std::string line = fmt::format("{}: {} × {} × {} voxels, at most {}", plan.path, plan.voxels[0],
                                             plan.voxels[1], plan.voxels[2], byte_size(plan.bytes));
        if (arguments.dry_run) {
            write_to_standard_output(line + "\n");
        } else {
            spdlog::info("{:10}{}", "Voxels", line);
        }
    }
    if (arguments.dry_run) {
        return;
    }
    ProgressDisplay display(progress_style(run.progress, run.quiet), stderr);
    options.progress = display.callback();
    for (const OutputRecord& record : write_voxels(source, grid, outputs, options)) {
        spdlog::info("{:10}{} ({})", "Wrote", record.path, byte_size(record.bytes));
        if (!record.remark.empty()) {
            spdlog::info("{:10}{}", "", record.remark);
        }
    }
}

}  // namespace

void export_grid(const std::string& input, const std::vector<std::string>& texts, const ExportArguments& arguments,
                 const RunArguments& run) {
    const std::vector<VoxelOutput> outputs = voxel_outputs(texts, arguments);
    if (arguments.uncertainty) {
        throw UsageError("--uncertainty: a grid has the values that it has; models have deviations");
    }
    const auto source = read_grid(parse_source(input), "", outputs.front().path);
    write_all(*source, source->grid(), outputs, arguments, run, {});
}

void resample_onto(const ModelSnapshot& model, const std::string& onto, const std::vector<std::string>& texts,
                   const ExportArguments& arguments, const RunArguments& run) {
    const std::vector<VoxelOutput> outputs = voxel_outputs(texts, arguments);
    const auto places = read_grid(parse_source(onto), "", outputs.front().path);
    const ExportOptions options = writer_options(arguments, model.model());
    const ModelEstimator& estimator =
        has_derived_properties(model.model()) ? model.estimator_with_errors() : model.estimator();
    const ModelAtGrid source(model.model(), model.barriers(), estimator, places->grid(),
                             options.max_extrapolation.value_or(std::numeric_limits<double>::infinity()));
    write_all(source, source.grid(), outputs, arguments, run, model.model());
}

}  // namespace terratet::tools
