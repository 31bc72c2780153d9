// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/options/export_options.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "io/export.hpp"
#include "io/source.hpp"
#include "tess/error.hpp"
#include "tools/options/choice.hpp"

namespace terratet::tools {
namespace {

std::string upper(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::toupper(c); });
    return text;
}

bool as_flag(const std::string& key, const std::string& value) {
    return choose<bool>("-co " + key, upper(value),
                        {{"YES", true}, {"NO", false}, {"TRUE", true}, {"FALSE", false}, {"ON", true}, {"OFF", false}});
}

/// One length for all axes, or three.
Vec3 parse_voxel_size(const std::string& text, double metres_per_unit) {
    std::vector<double> sizes;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        try {
            sizes.push_back(parse_length(text.substr(begin, end - begin), metres_per_unit));
        } catch (const UsageError& error) {
            throw UsageError(fmt::format("--voxel-size: {}", error.what()));
        }
        if (!(sizes.back() > 0)) {
            throw UsageError(fmt::format("--voxel-size: '{}' is not above 0", text));
        }
        begin = end + 1;
    }
    if (sizes.size() == 1) {
        return {sizes[0], sizes[0], sizes[0]};
    }
    if (sizes.size() != 3) {
        throw UsageError(fmt::format("--voxel-size: one length or three are needed, and {} are given", sizes.size()));
    }
    return {sizes[0], sizes[1], sizes[2]};
}

FaultGap fault_gap(const ExportArguments& a) {
    return choose<FaultGap>("--fault-gap", a.fault_gap, {{"keep", FaultGap::keep}, {"collapse", FaultGap::collapse}});
}

VoxelValues voxel_values(const ExportArguments& a) {
    return choose<VoxelValues>("--values", a.values,
                               {{"linear", VoxelValues::linear}, {"estimator", VoxelValues::estimator}});
}

std::vector<double> parse_numbers(const std::string& option, const std::string& text, std::size_t count) {
    std::vector<double> numbers;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        const char* last = text.data() + end;
        double number = 0;
        const auto [stop, error] = std::from_chars(text.data() + begin, last, number);
        if (error != std::errc() || stop != last || !std::isfinite(number)) {
            throw UsageError(fmt::format("{}: '{}' is not a number", option, text.substr(begin, end - begin)));
        }
        numbers.push_back(number);
        begin = end + 1;
    }
    if (numbers.size() != count) {
        throw UsageError(
            fmt::format("{}: '{}' are {} numbers, and {} are needed", option, text, numbers.size(), count));
    }
    return numbers;
}

/// What scenes need and no model.
ExportOptions scene_options(const ExportArguments& a) {
    ExportOptions options;
    for (const std::string& section : a.sections) {
        options.sections.push_back(parse_section(section));
    }
    for (const std::string& iso : a.iso) {
        options.iso.push_back(parse_iso(iso));
    }
    if (!a.max_extrapolation.empty()) {
        options.max_extrapolation = parse_numbers("--max-extrapolation", a.max_extrapolation, 1)[0];
        if (!(*options.max_extrapolation >= 0 && *options.max_extrapolation <= 1)) {
            throw UsageError(fmt::format("--max-extrapolation: {} is not within 0 and 1", a.max_extrapolation));
        }
    }
    if (!a.size.empty()) {
        const std::vector<double> size = parse_numbers("--size", a.size, 2);
        for (std::size_t k = 0; k < 2; ++k) {
            if (!(size[k] >= 200 && size[k] <= 8000)) {
                throw UsageError(fmt::format("--size: '{}' is not within 200 and 8000 pixels", a.size));
            }
            options.picture_size[k] = static_cast<std::uint32_t>(size[k]);
        }
    }
    options.enu = !a.frame.empty() && choose<bool>("-co FRAME", upper(a.frame), {{"GRID", false}, {"ENU", true}});
    return options;
}

}  // namespace

OutputRequest parse_output(const std::string& text) {
    constexpr std::string_view key = ",of=";
    const std::size_t comma = text.rfind(key);
    if (comma == std::string::npos) {
        return {text};
    }
    const OutputRequest output{text.substr(0, comma), text.substr(comma + key.size())};
    if (output.path.empty() || output.format.empty()) {
        throw UsageError(fmt::format("'{}': is not OUTPUT,of=FORMAT", text));
    }
    return output;
}

OutputRequest parse_output(const std::string& text, const ExportArguments& arguments) {
    OutputRequest output = parse_output(text);
    const bool tileset = output.format.empty() && arguments.format.empty() && upper(output.path).ends_with(".JSON");
    if (tileset) {
        output.format = arguments.voxels ? "VOXELTILES" : "TILES";
    }
    return output;
}

std::vector<OptionGroup> export_options(ExportArguments& a) {
    return {
        {"Outputs (by extension: " + export_extensions() + ", .json)",
         {
             {{"of"},
              "FORMAT",
              "instead of the extension's: " + export_format_names() +
                  "; with it the output may be -, standard output; of one output among several: OUTPUT,of=FORMAT",
              &a.format},
             {{"voxels"}, "", "a tileset (tileset.json) of voxels, as of=VOXELTILES, not of the scene", &a.voxels},
             {{"tr", "voxel-size"},
              "LENGTH[,LENGTH,LENGTH]",
              "of voxels; by default about a 128th of the longest side",
              &a.voxel_size,
              3},
             {{"values"},
              "KIND",
              "of voxels: linear (default), the tessellation's field, or estimator, what all samples say at each "
              "centre",
              &a.values},
             {{"max-extrapolation"},
              "E",
              "voxels: no value where the extrapolation is above E, 0 to 1; scenes: grey there; by default all have "
              "one, "
              "and grey is where no sample reaches",
              &a.max_extrapolation},
             {{"dry-run"}, "", "only say what outputs of voxels would take", &a.dry_run},
             {{"allow-large"}, "", "write outputs of voxels above 2 GiB too", &a.allow_large},
             {{"margin"}, "", "VTU: all cells, uncut, of the box that reaches beyond the extent", &a.margin},
             {{"voronoi"},
              "",
              "VTU: the Voronoi cells of the vertices, polyhedra with volumes, instead of tetrahedra",
              &a.voronoi},
             {{"clip"}, "", "VTU: is what is done anyway, unless --margin", &a.clip},
             {{"fault-gap"},
              "HOW",
              "VTU, glTF: keep (default) the cells between a fault's two sheets, or collapse: both meet on the "
              "fault, its nodes split",
              &a.fault_gap},
             {{"compress"},
              "",
              "glTF: with meshopt, 16 bits an axis; VTU, GeoTIFF and netCDF are compressed unless -co COMPRESS=NO",
              &a.compress},
             {{"half"}, "", "VDB: 16-bit floats", &a.half},
             {{"local-origin"},
              "",
              "VDB: coordinates from the model's origin, for Blender and Houdini",
              &a.local_origin},
             {{"uncertainty"},
              "",
              "with each property's standard deviation, 95 % half-width, extrapolation and number of samples; of a "
              "category "
              "the classes' probabilities and entropy",
              &a.uncertainty},
             {{"color"}, "PROPERTY", "scenes: what to colour by; the first by default", &a.color},
             {{"color-map"}, "NAME", "scenes: viridis by default", &a.color_map},
             {{"section"},
              "WHERE",
              "scenes: a section x1,y1,x2,y2 (upright), z=V (level) or AZIMUTH,x,y; repeatable; by default two "
              "through the middle of the samples",
              &a.sections},
             {{"iso"},
              "PROPERTY=VALUE[,VALUE]",
              "scenes: isosurfaces; repeatable; by default at the quartiles of what is coloured",
              &a.iso},
             {{"size"}, "WIDTH,HEIGHT", "PNG: in pixels, 1600,1000 by default", &a.size},
             {{"co"},
              "KEY=VALUE",
              "the same as creation options: -co COMPRESS=NO; ALIGN=NO centres voxels on the extent, FIELDS=ALL gives "
              "GeoTIFF bands of extrapolation and region, VERSION=2.2 the older format of Gmsh, SPATIAL_INDEX=YES a "
              "model's layers R-trees, VERTICAL_SRS=EPSG:5773 tells tilesets what heights are above",
              &a.creation_options},
         }}};
}

ExportArguments with_creation_options(ExportArguments a) {
    for (const auto& text : a.creation_options) {
        const auto equals = text.find('=');
        const std::string key = upper(text.substr(0, equals));
        const std::string value = equals == std::string::npos ? "" : text.substr(equals + 1);
        if (value.empty()) {
            throw UsageError(fmt::format("-co: '{}' is not KEY=VALUE", text));
        }
        if (key == "CLIP") {
            a.clip = as_flag(key, value);
        } else if (key == "COMPRESS") {
            a.compress = as_flag(key, value);
            a.uncompressed = !a.compress;
        } else if (key == "MARGIN") {
            a.margin = as_flag(key, value);
        } else if (key == "VORONOI") {
            a.voronoi = as_flag(key, value);
        } else if (key == "HALF") {
            a.half = as_flag(key, value);
        } else if (key == "VERSION") {
            a.msh_version_2 = choose<bool>("-co VERSION", value, {{"4.1", false}, {"2.2", true}});
        } else if (key == "ALIGN") {
            a.centred = !as_flag(key, value);
        } else if (key == "FIELDS") {
            a.all_fields = choose<bool>("-co FIELDS", upper(value), {{"ALL", true}, {"PROPERTIES", false}});
        } else if (key == "VERTICAL_SRS") {
            a.vertical_srs = value;
        } else if (key == "LOCAL_ORIGIN") {
            a.local_origin = as_flag(key, value);
        } else if (key == "FAULT_GAP") {
            a.fault_gap = value;
            std::transform(a.fault_gap.begin(), a.fault_gap.end(), a.fault_gap.begin(),
                           [](unsigned char c) { return std::tolower(c); });
        } else if (key == "VOXEL_SIZE") {
            a.voxel_size = value;
        } else if (key == "COLOR") {
            a.color = value;
        } else if (key == "COLOR_MAP") {
            a.color_map = value;
        } else if (key == "SPATIAL_INDEX") {
            a.spatial_index = as_flag(key, value);
        } else if (key == "FRAME") {
            a.frame = value;
        } else {
            const std::vector<std::string> known{"ALIGN",    "CLIP",         "COLOR",   "COLOR_MAP",
                                                 "COMPRESS", "FAULT_GAP",    "FIELDS",  "FRAME",
                                                 "HALF",     "LOCAL_ORIGIN", "MARGIN",  "SPATIAL_INDEX",
                                                 "VERSION",  "VERTICAL_SRS", "VORONOI", "VOXEL_SIZE"};
            throw UsageError(fmt::format("-co: '{}' is not one of {}{}", key, listed(known), did_you_mean(key, known)));
        }
    }
    a.creation_options.clear();
    return a;
}

void check_export_arguments(const ExportArguments& arguments) {
    const ExportArguments a = with_creation_options(arguments);
    if (!a.voxel_size.empty()) {
        parse_voxel_size(a.voxel_size, 1.0);
    }
    fault_gap(a);
    scene_options(a);
    voxel_values(a);
}

ExportOptions writer_options(const ExportArguments& arguments, const Model& model) {
    const ExportArguments a = with_creation_options(arguments);
    ExportOptions options = scene_options(a);
    options.format = a.format;
    options.fault_gap = fault_gap(a);
    options.margin = a.margin;
    options.voronoi = a.voronoi;
    if (a.compress || a.uncompressed) {
        options.compress = a.compress;
    }
    options.voxel_values = voxel_values(a);
    options.allow_large = a.allow_large;
    options.half = a.half;
    options.msh_version_2 = a.msh_version_2;
    options.aligned = !a.centred;
    options.all_fields = a.all_fields;
    options.local_origin = a.local_origin;
    options.vertical_crs = a.vertical_srs;
    options.color_map = a.color_map;
    if (!a.voxel_size.empty()) {
        options.voxel_size = parse_voxel_size(a.voxel_size, model.frame.metres_per_unit);
    }
    if (!a.color.empty()) {
        std::vector<std::pair<std::string, int>> known;
        for (const auto& property : model.properties) {
            known.emplace_back(property.name, 0);
        }
        choose("--color", a.color, known);
        options.color_property = a.color;
    }
    return options;
}

}  // namespace terratet::tools
