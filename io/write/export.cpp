// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/export.hpp"

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <utility>

#include "interp/plan/uncertainty.hpp"
#include "io/voxels/write_voxels.hpp"
#include "tess/base/words.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

struct Format {
    const char* name;
    const char* extension;
    OutputRecord (*write)(const ModelView&, const std::string&, const ExportOptions&);  ///< null: voxels
    bool usual = true;  ///< the extension: files are called so elsewhere, too
};

constexpr Format formats[] = {
    {"HTML", ".html", write_html},
    {"PNG", ".png", write_png},
    {"GLTF", ".glb", write_gltf},
    {"GLTF", ".gltf", write_gltf},
    {"VTU", ".vtu", write_vtu},
    {"VTM", ".vtm", write_vtm},
    {"PVD", ".pvd", write_pvd},
    {"MSH", ".msh", write_msh},
    {"UGE", ".uge", write_uge},
    {"UGI", ".ugi", write_ugi},
    {"OGS", ".ogs", write_ogs, false},
    {"SURFACES", ".ts", write_surfaces},
    {"SURFACES", ".obj", write_surfaces},
    {"VDB", ".vdb", nullptr},
    {"GTIFF", ".tif", nullptr},
    {"GTIFF", ".tiff", nullptr},
    {"COG", ".cog", nullptr, false},
    {"NETCDF", ".nc", nullptr},
    {"TILES", ".tiles", write_surface_tiles, false},
    {"CSV", ".csv", write_csv},
    {"BLOCKS", ".blocks", nullptr, false},
    {"VOXELTILES", ".voxeltiles", nullptr, false},
};

/// What `format` may be: each name, and each extension without its dot.
std::vector<std::string> format_words() {
    auto words = names_of(formats, &Format::name);
    const auto extensions = names_of(formats, [](const Format& format) { return format.extension + 1; });
    words.insert(words.end(), extensions.begin(), extensions.end());
    return words;
}

std::string choices() {
    return export_extensions() + " and .json, or `format` " + export_format_names();
}

std::string with_case(std::string text, int (*change)(int)) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [change](unsigned char c) { return static_cast<char>(change(c)); });
    return text;
}

const Format& format_of(const std::string& path, const std::string& override_format) {
    if (!override_format.empty()) {
        const std::string name = with_case(override_format, std::toupper);
        for (const Format& format : formats) {
            if (name == format.name || name == with_case(format.extension + 1, std::toupper)) {
                return format;
            }
        }
        throw UsageError("unknown output format '" + override_format + "'; there are " + choices() +
                         did_you_mean(override_format, format_words()));
    }
    const std::string extension = with_case(std::filesystem::path(path).extension().string(), std::tolower);
    for (const Format& format : formats) {
        if (extension == format.extension) {
            return format;
        }
    }
    throw UsageError("'" + path + "' does not tell its format by its extension; there are " + choices() +
                     did_you_mean(extension, names_of(formats, &Format::extension)));
}

}  // namespace

std::string export_extensions() {
    std::string names;
    for (const Format& format : formats) {
        if (format.usual) {
            names += (names.empty() ? "" : ", ") + std::string(format.extension);
        }
    }
    return names;
}

std::string export_format_names() {
    std::string names;
    std::string_view last;
    for (const Format& format : formats) {
        if (std::exchange(last, format.name) != format.name) {
            names += (names.empty() ? "" : ", ") + std::string(format.name);
        }
    }
    return names;
}

std::optional<Collapsing> collapsing(const Model& model, const std::string& format, const ExportOptions& options) {
    if (format == "UGE" || (options.voronoi && (format == "VTU" || format == "VTM" || format == "PVD"))) {
        return std::nullopt;
    }
    if (options.fault_gap == FaultGap::collapse && !model.barriers.empty() && format != "CSV" &&
        !is_voxel_format(format)) {
        return Collapsing::all;
    }
    return has_bounds(model) ? std::optional(Collapsing::bounds) : std::nullopt;
}

namespace {

/// What a format shows of a model.
ModelView view_of(const ModelSnapshot& model, const Format& format, const ExportOptions& options) {
    const ModelEstimator* estimator = nullptr;
    if (format.write == nullptr && options.voxel_values == VoxelValues::estimator) {
        estimator = has_derived_properties(model.model()) ? &model.estimator_with_errors() : &model.estimator();
    }
    if (const auto which = collapsing(model.model(), format.name, options)) {
        const CollapsedModel& collapsed = model.collapsed(*which, options.progress);
        return {collapsed.model, collapsed.mesh, collapsed.cells, estimator,
                &model.barriers()};  // its faults are the same
    }
    return {model.model(), model.mesh(), model.cells(), estimator, &model.barriers()};
}

OutputRecord write_one(const ModelView& view, const Format& format, const std::string& path,
                       const ExportOptions& options) {
    if (format.write == nullptr) {
        const VoxelOutput output{path, format.name};
        return write_voxels(view, {&output, 1}, options).front();
    }
    return format.write(view, path, options);
}

const std::string& format_name(const OutputRequest& output, const ExportOptions& options) {
    return output.format.empty() ? options.format : output.format;
}

}  // namespace

OutputRecord export_model(const ModelView& view, const std::string& path, const ExportOptions& options) {
    return write_one(view, format_of(path, options.format), path, options);
}

OutputRecord export_model(const ModelSnapshot& model, const std::string& path, const ExportOptions& options) {
    const Format& format = format_of(path, options.format);
    return write_one(view_of(model, format, options), format, path, options);
}

std::vector<OutputRecord> export_model(const ModelSnapshot& model, std::span<const OutputRequest> outputs,
                                       const ExportOptions& options) {
    std::vector<OutputRecord> records(outputs.size());
    std::vector<VoxelOutput> voxels;
    for (const OutputRequest& output : outputs) {
        const Format& format = format_of(output.path, format_name(output, options));
        if (format.write == nullptr) {
            voxels.push_back({output.path, format.name});
        }
    }
    std::vector<OutputRecord> of_voxels;
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        const Format& format = format_of(outputs[i].path, format_name(outputs[i], options));
        if (format.write != nullptr) {
            records[i] = format.write(view_of(model, format, options), outputs[i].path, options);
        } else if (of_voxels.empty()) {
            of_voxels = write_voxels(view_of(model, format, options), voxels, options);
        }
    }
    auto next = of_voxels.begin();
    for (OutputRecord& record : records) {
        if (record.path.empty()) {
            record = std::move(*next++);
        }
    }
    return records;
}

bool is_voxel_format(const std::string& format) {
    return format_of({}, format).write == nullptr;
}

std::vector<VoxelPlan> plan_voxels(const ModelView& view, std::span<const OutputRequest> outputs,
                                   const ExportOptions& options) {
    std::vector<VoxelPlan> plans;
    for (const OutputRequest& output : outputs) {
        const Format& format = format_of(output.path, format_name(output, options));
        if (format.write == nullptr) {
            plans.push_back(plan_voxels(view, VoxelOutput{output.path, format.name}, options));
        }
    }
    return plans;
}

std::string output_format(const std::string& path, const std::string& override_format) {
    return format_of(path, override_format).name;
}

}  // namespace terratet
