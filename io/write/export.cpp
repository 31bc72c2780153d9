// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/export.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "tess/error.hpp"

namespace terratet {
namespace {

struct Format {
    const char* name;
    const char* extension;
    OutputRecord (*write)(const ModelView&, const std::string&, const ExportOptions&);
};

constexpr Format formats[] = {
    {"VTU", ".vtu", write_vtu},    {"GLTF", ".glb", write_gltf}, {"GLTF", ".gltf", write_gltf},
    {"HTML", ".html", write_html}, {"PNG", ".png", write_png},   {"VDB", ".vdb", write_vdb},
    {"CSV", ".csv", write_csv},
};

constexpr const char* choices =
    ".html, .png, .glb, .gltf, .vtu, .vdb and .csv, or `format` HTML, PNG, GLTF, VTU, VDB or CSV";

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
        throw UsageError("unknown output format '" + override_format + "'; there are " + choices);
    }
    const std::string extension = with_case(std::filesystem::path(path).extension().string(), std::tolower);
    for (const Format& format : formats) {
        if (extension == format.extension) {
            return format;
        }
    }
    throw UsageError("'" + path + "' does not tell its format by its extension; there are " + choices);
}

/// The nearest of 1, 2 and 5 times a power of ten, by ratio.
double rounded_1_2_5(double value) {
    const double decade = std::pow(10.0, std::floor(std::log10(value)));
    double best = decade;
    for (const double step : {2.0, 5.0, 10.0}) {
        if (std::abs(std::log(step * decade / value)) < std::abs(std::log(best / value))) {
            best = step * decade;
        }
    }
    return best;
}

}  // namespace

std::optional<Collapsing> collapsing(const Model& model, const std::string& format, FaultGap gap) {
    if (gap == FaultGap::collapse && !model.barriers.empty() && format != "VDB" && format != "CSV") {
        return Collapsing::all;
    }
    return has_bounds(model) ? std::optional(Collapsing::bounds) : std::nullopt;
}

OutputRecord export_model(const ModelView& view, const std::string& path, const ExportOptions& options) {
    return format_of(path, options.format).write(view, path, options);
}

OutputRecord export_model(const ModelSnapshot& model, const std::string& path, const ExportOptions& options) {
    const Format& format = format_of(path, options.format);
    if (const auto which = collapsing(model.model(), format.name, options.fault_gap)) {
        const CollapsedModel& collapsed = model.collapsed(*which);
        return format.write({collapsed.model, collapsed.mesh, collapsed.cells}, path, options);
    }
    return format.write({model.model(), model.mesh(), model.cells()}, path, options);
}

std::string output_format(const std::string& path, const std::string& override_format) {
    return format_of(path, override_format).name;
}

Vec3 resolved_voxel_size(const ModelView& view, const ExportOptions& options) {
    const Vec3 side = view.model.frame.to_world_size(view.model.domain.extent.size());
    const double longest = std::max({side.x, side.y, side.z}) / 128;
    const double flattened = std::max(1.0, view.model.frame.z_scale);  // thin voxels where the ground is stretched
    const Vec3 automatic{rounded_1_2_5(longest), rounded_1_2_5(longest), rounded_1_2_5(longest / flattened)};
    Vec3 size = options.voxel_size;
    for (int axis = 0; axis < 3; ++axis) {
        size[axis] = size[axis] == 0 ? automatic[axis] : size[axis];
    }
    return size;
}

}  // namespace terratet
