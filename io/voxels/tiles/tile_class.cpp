// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/voxels/tiles/tile_class.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include "io/base/lower_case.hpp"

namespace terratet {
namespace {

using Json = nlohmann::ordered_json;

/// Words of GLSL ES 1.00 and 3.00, reserved ones and functions among them, in lower case or not as they are there.
constexpr const char* glsl_words =
    " abs acos acosh active all any asin asinh asm atan atanh atomic_uint attribute bool break bvec2 bvec3 bvec4 case "
    "cast ceil centroid clamp class coherent common const continue cos cosh cross default degrees determinant dFdx "
    "dFdy "
    "discard distance do dot double else enum equal exp exp2 extern external faceforward false filter fixed flat float "
    "floor for fract fwidth fvec2 fvec3 fvec4 goto greaterThan greaterThanEqual half highp hvec2 hvec3 hvec4 if "
    "image1D "
    "image2D image3D in inline inout input int interface inverse inversesqrt invariant isinf isnan isampler2D "
    "isampler3D ivec2 ivec3 ivec4 layout length lessThan lessThanEqual log log2 long lowp main mat2 mat2x2 mat2x3 "
    "mat2x4 mat3 mat3x2 mat3x3 mat3x4 mat4 mat4x2 mat4x3 mat4x4 matrixCompMult max mediump min mix mod modf namespace "
    "noinline noperspective normalize not notEqual out outerProduct output partition patch pow precision public "
    "radians readonly reflect refract resource restrict return round roundEven sample sampler1D sampler2D "
    "sampler2DShadow sampler3D samplerCube short sign sin sinh sizeof smooth smoothstep sqrt static step struct "
    "subroutine superp switch tan tanh template texelFetch texture texture2D textureGrad textureLod textureSize this "
    "transpose trunc typedef uint uniform union unsigned usampler2D usampler3D using uvec2 uvec3 uvec4 varying vec2 "
    "vec3 vec4 void volatile while writeonly true ";

std::string distinct(std::string wanted, const std::vector<TileProperty>& properties) {
    const auto taken = [&](const std::string& id) {
        return std::ranges::any_of(properties, [&](const TileProperty& property) {
            return lower_case(property.id) == lower_case(id);  // attributes are in upper case
        });
    };
    std::string id = wanted;
    for (int n = 2; taken(id); ++n) {
        id = wanted + "_" + std::to_string(n);
    }
    return id;
}

void add(TileProperty property, std::vector<TileProperty>& to) {
    property.id = distinct(shader_name(property.id), to);
    property.attribute = "_" + property.id;
    std::ranges::transform(property.attribute, property.attribute.begin(),
                           [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    to.push_back(std::move(property));
}

TileProperty number_of(const VoxelLayer& layer, std::size_t field, double low, double high) {
    TileProperty property;
    property.id = layer.plain_name + (layer.is_log10() ? "_log10" : "");
    property.name = layer.property.name;
    property.description = layer.is_log10() ? "decimal logarithm of " + layer.property.name : layer.property.name;
    property.description += layer.property.unit.empty() ? "" : ", in " + layer.property.unit;
    property.field = field;
    property.low = low;
    property.high = high;
    return property;
}

TileProperty mask_of(const std::string& id, const std::string& what, std::size_t field) {
    TileProperty property;
    property.id = id;
    property.name = id;
    property.description = "share of a voxel where " + what + ", 0 to 255: there is something to draw from 128";
    property.content = TileProperty::Content::mask;
    property.field = field;
    property.high = 255;
    return property;
}

TileProperty class_of(const VoxelLayer& layer, std::size_t field) {
    TileProperty property;
    property.id = layer.plain_name;
    property.name = layer.property.name;
    const std::size_t count = layer.property.classes.size();
    for (std::size_t c = 0; c < count; ++c) {
        property.description += (c == 0 ? "" : "; ") + std::to_string(c) + " " + layer.property.classes[c];
    }
    property.content = count > 256 ? TileProperty::Content::number : TileProperty::Content::class_number;
    property.field = field;
    property.high = count == 0 ? 0 : static_cast<double>(count - 1);
    return property;
}

}  // namespace

std::string shader_name(const std::string& name) {
    const bool reserved = name.starts_with("gl_") || name.starts_with("czm_") || name.front() == '_' ||
                          std::string(glsl_words).find(" " + name + " ") != std::string::npos;
    return reserved ? "p_" + name.substr(name.front() == '_' ? 1 : 0) : name;
}

double shader_number(double value) {
    if (!std::isfinite(value)) {
        return 0;
    }
    for (int step = 0; step < 8; ++step) {
        const double magnitude = std::abs(value);
        char text[32];
        const std::string shortest(text,
                                   std::to_chars(text, text + sizeof text, value, std::chars_format::scientific).ptr);
        const bool exponent = magnitude != 0 && (magnitude < 1e-6 || magnitude >= 1e21);
        if (!exponent || shortest.find('.') != std::string::npos) {
            return value;
        }
        value *= 1 + 1e-12;
    }
    return value;
}

std::vector<TileClass> tile_classes(const std::vector<VoxelLayer>& layers, std::size_t mask_field,
                                    const std::vector<bool>& own_mask, const std::vector<double>& low,
                                    const std::vector<double>& high) {
    std::vector<TileClass> classes;
    std::vector<TileProperty> numbers;
    std::vector<TileProperty> masks;
    const TileProperty mask = mask_of("mask", "there is a value", mask_field);
    const auto finish_numbers = [&] {
        TileClass made{classes.empty() ? "" : "more_" + std::to_string(classes.size() + 1), {}};
        for (auto* list : {&numbers, &masks}) {
            for (TileProperty& property : *list) {
                add(std::move(property), made.properties);
            }
            list->clear();
        }
        add(mask, made.properties);
        classes.push_back(std::move(made));
    };
    for (std::size_t f = 0; f < layers.size(); ++f) {
        if (layers[f].is_class()) {
            continue;
        }
        const std::size_t needed = own_mask[f] ? 2 : 1;
        if (numbers.size() + masks.size() + needed + 1 > most_tile_properties) {
            finish_numbers();
        }
        numbers.push_back(number_of(layers[f], f, low[f], high[f]));
        if (own_mask[f]) {
            masks.push_back(mask_of(layers[f].plain_name + "_mask", layers[f].property.name + " has a value", f));
        }
    }
    finish_numbers();
    for (std::size_t f = 0; f < layers.size(); ++f) {
        if (layers[f].is_class()) {
            TileClass made{layers[f].plain_name, {}};
            add(class_of(layers[f], f), made.properties);
            add(mask_of("mask", layers[f].property.name + " is known", f), made.properties);
            classes.push_back(std::move(made));
        }
    }
    return classes;
}

Json TileClass::schema() const {
    Json of_properties = Json::object();
    for (const TileProperty& property : properties) {
        of_properties[property.id] = {{"name", property.name},
                                      {"description", property.description},
                                      {"type", "SCALAR"},
                                      {"componentType", property.is_float() ? "FLOAT32" : "UINT8"}};
    }
    return {{"id", "terratet"}, {"classes", {{"voxel", {{"properties", of_properties}}}}}};
}

Json TileClass::statistics() const {
    Json of_properties = Json::object();
    for (const TileProperty& property : properties) {
        const bool any = property.low <= property.high;
        of_properties[property.id] = {{"min", any ? shader_number(property.low) : 0},
                                      {"max", any ? shader_number(property.high) : 0}};
    }
    return {{"classes", {{"voxel", {{"properties", of_properties}}}}}};
}

}  // namespace terratet
