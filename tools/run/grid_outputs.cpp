// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/run/grid_outputs.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "interp/plan/uncertainty.hpp"
#include "io/onto/read_place_mesh.hpp"
#include "io/onto/write_place_mesh.hpp"
#include "io/source.hpp"
#include "io/voxels/grids/grid_source.hpp"
#include "io/voxels/grids/model_at_grid.hpp"
#include "io/voxels/grids/model_at_places.hpp"
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
               const ExportArguments& arguments, const RunArguments& run, const Model& model, const Ranks* ranks) {
    ExportOptions options = writer_options(arguments, model);
    options.overwrite = run.overwrite;
    options.ranks = ranks;
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

/// The values at all places, batch by batch, so that it can be stopped.
ValueBatch values_at(const ModelAtPlaces& model, std::span<const Vec3> places, const Progress& progress, double from) {
    constexpr std::size_t batch = 65536;
    ValueBatch all = model.values({});
    for (std::size_t begin = 0; begin < places.size(); begin += batch) {
        const auto some = places.subspan(begin, std::min(batch, places.size() - begin));
        report_progress(progress, "estimate",
                        from + 0.5 * static_cast<double>(begin) / static_cast<double>(places.size()));
        ValueBatch found = model.values({some.begin(), some.end()});
        for (std::size_t p = 0; p < all.values.size(); ++p) {
            all.values[p].insert(all.values[p].end(), found.values[p].begin(), found.values[p].end());
        }
        all.extrapolation.insert(all.extrapolation.end(), found.extrapolation.begin(), found.extrapolation.end());
    }
    return all;
}

void resample_onto_mesh(const ModelSnapshot& model, const Source& onto, const std::vector<std::string>& texts,
                        const ExportArguments& arguments, const RunArguments& run) {
    std::vector<std::string> paths;
    for (const std::string& text : texts) {
        paths.push_back(parse_output(text, arguments).path);
        const std::string format = output_format(paths.back());
        if (paths.back() == "-" || (format != "VTU" && format != "CSV")) {
            throw UsageError(fmt::format("{}: a mesh with a model's values becomes .vtu or .csv", paths.back()));
        }
    }
    const PlaceMesh mesh = read_place_mesh(onto);
    ExportOptions options = writer_options(arguments, model.model());
    options.overwrite = run.overwrite;
    ProgressDisplay display(progress_style(run.progress, run.quiet), stderr);
    options.progress = display.callback();
    const ModelEstimator& estimator =
        has_derived_properties(model.model()) ? model.estimator_with_errors() : model.estimator();
    const ModelAtPlaces places(model.model(), model.barriers(), estimator, mesh.crs.wkt,
                               options.max_extrapolation.value_or(std::numeric_limits<double>::infinity()));
    const MeshValues values{values_at(places, mesh.points, options.progress, 0),
                            values_at(places, mesh.cell_centers(), options.progress, 0.5)};
    const auto without = std::ranges::count_if(values.nodes.extrapolation, [](double e) { return std::isnan(e); });
    spdlog::info("{:10}{} nodes, {} cells; {} nodes lie beyond the model and have no value", "Mesh",
                 grouped(mesh.points.size()), grouped(mesh.ends.size()), grouped(static_cast<std::uint64_t>(without)));
    for (const std::string& path : paths) {
        const OutputRecord record = write_place_mesh(mesh, values, model.model(), path, options);
        spdlog::info("{:10}{} ({})", "Wrote", record.path, byte_size(record.bytes));
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
    write_all(*source, source->grid(), outputs, arguments, run, {}, nullptr);  // reading is all there is to it
}

void resample_onto(const ModelSnapshot& model, const std::string& onto, const std::vector<std::string>& texts,
                   const ExportArguments& arguments, const RunArguments& run) {
    if (names_mesh(parse_source(onto).path)) {
        resample_onto_mesh(model, parse_source(onto), texts, arguments, run);
        return;
    }
    const std::vector<VoxelOutput> outputs = voxel_outputs(texts, arguments);
    const auto places = read_grid(parse_source(onto), "", outputs.front().path);
    const ExportOptions options = writer_options(arguments, model.model());
    const ModelEstimator& estimator =
        has_derived_properties(model.model()) ? model.estimator_with_errors() : model.estimator();
    const ModelAtGrid source(model.model(), model.barriers(), estimator, places->grid(),
                             options.max_extrapolation.value_or(std::numeric_limits<double>::infinity()));
    write_all(source, source.grid(), outputs, arguments, run, model.model(), run.ranks);
}

}  // namespace terratet::tools
