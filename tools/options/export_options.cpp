// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/options/export_options.hpp"

#include <algorithm>
#include <cctype>
#include <functional>
#include <map>

#include <fmt/format.h>

#include "io/base/lower_case.hpp"
#include "io/export.hpp"
#include "io/style/color_map.hpp"
#include "tess/error.hpp"
#include "tools/options/tolerance_option.hpp"
#include "tools/options/values.hpp"

namespace terratet::tools {
namespace {

std::string upper(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::toupper(c); });
    return text;
}

const Choices<bool>& flags() {
    static const Choices<bool> words{{"YES", true},    {"NO", false}, {"TRUE", true},
                                     {"FALSE", false}, {"ON", true},  {"OFF", false}};
    return words;
}

/// One length for all axes, or three.
VoxelSize parse_voxel_size(const std::string& text) {
    std::vector<Length> sizes;
    for (const std::string& part : split(text, ',')) {
        sizes.push_back(parse_positive_length(part));
    }
    if (sizes.size() == 1) {
        return {sizes[0], sizes[0], sizes[0]};
    }
    if (sizes.size() != 3) {
        throw UsageError(fmt::format("one length or three are needed, and {} are given", sizes.size()));
    }
    return {sizes[0], sizes[1], sizes[2]};
}

double parse_extrapolation(const std::string& text) {
    const double limit = parse_numbers(text, 1, 1)[0];
    if (!(limit >= 0 && limit <= 1)) {
        throw UsageError(fmt::format("{} is not within 0 and 1", text));
    }
    return limit;
}

std::array<std::uint32_t, 2> parse_picture_size(const std::string& text) {
    const std::vector<double> size = parse_numbers(text, 2, 2);
    if (std::ranges::any_of(size, [](double pixels) { return !(pixels >= 200 && pixels <= 8000); })) {
        throw UsageError(fmt::format("'{}' is not within 200 and 8000 pixels", text));
    }
    return {static_cast<std::uint32_t>(size[0]), static_cast<std::uint32_t>(size[1])};
}

std::string checked_color_map(const std::string& name) {
    ColorMap::named(name);
    return name;
}

const Choices<FaultGap>& fault_gaps() {
    static const Choices<FaultGap> words{{"keep", FaultGap::keep}, {"collapse", FaultGap::collapse}};
    return words;
}

/// What each creation option does with its value.
std::map<std::string, std::function<void(const std::string&)>> creation_keys(ExportArguments& a) {
    const auto flag = [](bool& target, bool when_yes = true) {
        return [&target, when_yes](const std::string& value) { target = choose(upper(value), flags()) == when_yes; };
    };
    ExportOptions& writers = a.writers;
    return {
        {"CLIP", flag(a.clip)},
        {"COMPRESS",
         [&a](const std::string& value) {
             a.compress = choose(upper(value), flags());
             a.uncompressed = !a.compress;
         }},
        {"MARGIN", flag(writers.margin)},
        {"VORONOI", flag(writers.voronoi)},
        {"HALF", flag(writers.half)},
        {"VERSION",
         [&](const std::string& value) {
             writers.msh_version_2 = choose<bool>(value, {{"4.1", false}, {"2.2", true}});
         }},
        {"ALIGN", flag(writers.aligned)},
        {"FIELDS",
         [&](const std::string& value) {
             writers.all_fields = choose<bool>(upper(value), {{"ALL", true}, {"PROPERTIES", false}});
         }},
        {"VERTICAL_SRS", [&](const std::string& value) { writers.vertical_crs = value; }},
        {"LOCAL_ORIGIN", flag(writers.local_origin)},
        {"FAULT_GAP", [&](const std::string& value) { writers.fault_gap = choose(lower_case(value), fault_gaps()); }},
        {"VOXEL_SIZE", [&a](const std::string& value) { a.voxel_size = parse_voxel_size(value); }},
        {"COLOR", [&](const std::string& value) { writers.color_property = value; }},
        {"COLOR_MAP", [&](const std::string& value) { writers.color_map = checked_color_map(value); }},
        {"SPATIAL_INDEX", flag(a.spatial_index)},
        {"FRAME",
         [&](const std::string& value) {
             writers.enu = choose<bool>(upper(value), {{"GRID", false}, {"ENU", true}});
         }},
    };
}

Parsed color_map_value(std::string& target) {
    Parsed value = single(target, checked_color_map);
    value.words = ColorMap::names();
    value.standard = target;
    return value;
}

Parsed format_value(std::string& target) {
    Parsed value = single(target, [](const std::string& text) { return text; });  // judged with the output's name
    std::string names = export_format_names();
    std::erase(names, ' ');
    value.words = split(names, ',');
    return value;
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
    const bool tileset =
        output.format.empty() && arguments.writers.format.empty() && upper(output.path).ends_with(".JSON");
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
              format_value(a.writers.format)},
             {{"voxels"}, "", "a tileset (tileset.json) of voxels, as of=VOXELTILES, not of the scene", &a.voxels},
             {{"tr", "voxel-size"},
              "LENGTH[,LENGTH,LENGTH]",
              "of voxels; by default about a 128th of the longest side",
              single(a.voxel_size, parse_voxel_size),
              3},
             {{"values"},
              "KIND",
              "of voxels: linear, the tessellation's field, or estimator, what all samples say at each "
              "centre",
              one_of(a.writers.voxel_values, {{"linear", VoxelValues::linear}, {"estimator", VoxelValues::estimator}})},
             {{"max-extrapolation"},
              "E",
              "voxels: no value where the extrapolation is above E, 0 to 1; scenes: grey there; by default all have "
              "one, "
              "and grey is where no sample reaches",
              single(a.writers.max_extrapolation, parse_extrapolation)},
             {{"dry-run"}, "", "only say what outputs of voxels would take", &a.dry_run},
             {{"allow-large"}, "", "write outputs of voxels above 2 GiB too", &a.writers.allow_large},
             {{"margin"}, "", "VTU: all cells, uncut, of the box that reaches beyond the extent", &a.writers.margin},
             {{"voronoi"},
              "",
              "VTU: the Voronoi cells of the vertices, polyhedra with volumes, instead of tetrahedra",
              &a.writers.voronoi},
             {{"clip"}, "", "VTU: is what is done anyway, unless --margin", &a.clip},
             {{"fault-gap"},
              "HOW",
              "VTU, glTF: keep the cells between a fault's two sheets, or collapse: both meet on the "
              "fault, its nodes split",
              one_of(a.writers.fault_gap, fault_gaps())},
             {{"compress"},
              "",
              "glTF: with meshopt, 16 bits an axis; VTU, GeoTIFF and netCDF are compressed unless -co COMPRESS=NO",
              &a.compress},
             {{"half"}, "", "VDB: 16-bit floats", &a.writers.half},
             {{"local-origin"},
              "",
              "VDB: coordinates from the model's origin, for Blender and Houdini",
              &a.writers.local_origin},
             {{"uncertainty"},
              "",
              "with each property's standard deviation, 95 % half-width, extrapolation and number of samples; of a "
              "category "
              "the classes' probabilities and entropy",
              &a.uncertainty},
             {{"color"}, "PROPERTY", "scenes: what to colour by; the first by default", &a.writers.color_property},
             {{"color-map"}, "NAME", "scenes: " + listed(ColorMap::names()), color_map_value(a.writers.color_map)},
             {{"section"},
              "WHERE",
              "scenes: a section x1,y1,x2,y2 (upright), z=V (level) or AZIMUTH,x,y; repeatable; by default two "
              "through the middle of the samples",
              each(a.writers.sections, parse_section)},
             {{"iso"},
              "PROPERTY=VALUE[,VALUE]",
              "scenes: isosurfaces; repeatable; by default at the quartiles of what is coloured",
              each(a.writers.iso, parse_iso)},
             {{"size"},
              "WIDTH,HEIGHT",
              fmt::format("PNG: in pixels, {},{} by default", a.writers.picture_size[0], a.writers.picture_size[1]),
              single(a.writers.picture_size, parse_picture_size)},
             {{"co"},
              "KEY=VALUE",
              "the same as creation options: -co COMPRESS=NO; ALIGN=NO centres voxels on the extent, FIELDS=ALL gives "
              "GeoTIFF bands of extrapolation and region, VERSION=2.2 the older format of Gmsh, SPATIAL_INDEX=YES a "
              "model's layers R-trees, VERTICAL_SRS=EPSG:5773 tells tilesets what heights are above",
              creation_options(a)},
         }}};
}

Parsed creation_options(ExportArguments& a) {
    const auto take = [&a](const std::string& text) {
        const auto equals = text.find('=');
        const std::string key = upper(text.substr(0, equals));
        if (equals == std::string::npos || equals + 1 == text.size()) {
            throw UsageError(fmt::format("'{}' is not KEY=VALUE", text));
        }
        const auto keys = creation_keys(a);
        const auto found = keys.find(key);
        if (found == keys.end()) {
            const auto known = names_of(keys, [](const auto& entry) { return entry.first; });
            throw UsageError(fmt::format("'{}' is not one of {}{}", key, listed(known), did_you_mean(key, known)));
        }
        named(key, [&] { found->second(text.substr(equals + 1)); });
    };
    return {.take = take, .repeatable = true};
}

ExportOptions writer_options(const ExportArguments& a, const Model& model) {
    ExportOptions options = a.writers;
    if (a.compress || a.uncompressed) {
        options.compress = a.compress;
    }
    if (a.voxel_size) {
        const double unit = model.frame.metres_per_unit;
        const VoxelSize& size = *a.voxel_size;
        options.voxel_size = {size[0].in(unit), size[1].in(unit), size[2].in(unit)};
    }
    if (!options.color_property.empty()) {
        find_property("--color", options.color_property, model.properties);
    }
    return options;
}

}  // namespace terratet::tools
