// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// From the scene's parts to a glTF 2.0 document, by tinygltf.

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "io/read/column_names.hpp"
#include "io/write/scene.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

using tinygltf::Value;

/// Accessors may hold no NaN: this stands for a missing value, and asset.extras.nodata says so.
constexpr float nodata = std::numeric_limits<float>::lowest();

constexpr const char* extrapolation_attribute = "_EXTRAPOLATION";
constexpr const char* own_attributes[] = {"_BATCHID", "_FEATURE_ID_0", extrapolation_attribute};

/// glTF: an underscore, then upper case; kept to ASCII, as some viewers make variables of shaders of it.
std::vector<std::string> attribute_names(const std::vector<Property>& properties) {
    std::vector<std::string> names;
    for (const Property& property : properties) {
        std::string name = "_";
        for (const char c : property.name) {
            const bool lower = c >= 'a' && c <= 'z';
            const bool kept = (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
            name += lower ? static_cast<char>(c - 'a' + 'A') : kept ? c : '_';
        }
        names.push_back(name == "_" ? "_PROPERTY" : name);
    }
    return distinct_names(std::move(names), own_attributes);
}

const char* scale_name(const Property& property) {
    return property.kind == Kind::categorical ? "categorical" : property.scale == Scale::log10 ? "log10" : "linear";
}

Value object(Value::Object members) {
    return Value(std::move(members));
}
Value array(const std::vector<double>& numbers) {
    Value::Array values;
    for (const double number : numbers) {
        values.emplace_back(number);
    }
    return Value(std::move(values));
}

/// Enough to draw a legend without knowing the colour map.
Value legend(const Coloring& coloring) {
    const Property& property = coloring.property();
    Value::Object legend{{"property", Value(property.name)},
                         {"unit", Value(property.unit)},
                         {"scale", Value(std::string(scale_name(property)))}};
    Value::Array entries;
    if (coloring.categorical()) {
        for (std::size_t c = 0; c < property.classes.size(); ++c) {
            entries.push_back(object({{"name", Value(property.classes[c])}, {"color", Value(hex(class_color(c)))}}));
        }
        legend["classes"] = Value(entries);
    } else {
        constexpr int stops = 11;
        const double low = to_scale(property, coloring.low());
        const double high = to_scale(property, coloring.high());
        for (int i = 0; i < stops; ++i) {
            const double t = static_cast<double>(i) / (stops - 1);
            entries.push_back(object({{"value", Value(from_scale(property, low + t * (high - low)))},
                                      {"color", Value(hex(coloring.at_fraction(t)))}}));
        }
        legend["color_map"] = Value(coloring.map_name());
        legend["range"] = array({coloring.low(), coloring.high()});
        legend["stops"] = Value(entries);
    }
    legend["missing_color"] = Value(hex(missing_color));
    return Value(legend);
}

Value property_list(const std::vector<Property>& properties, const std::vector<std::string>& attributes) {
    Value::Array list;
    for (std::size_t p = 0; p < properties.size(); ++p) {
        Value::Object entry{{"name", Value(properties[p].name)},
                            {"attribute", Value(attributes[p])},
                            {"unit", Value(properties[p].unit)},
                            {"scale", Value(std::string(scale_name(properties[p])))}};
        if (properties[p].kind == Kind::categorical) {
            Value::Array classes;
            for (const std::string& name : properties[p].classes) {
                classes.emplace_back(name);
            }
            entry["classes"] = Value(classes);
        }
        list.push_back(object(std::move(entry)));
    }
    return Value(list);
}

class Document {
  public:
    explicit Document(std::vector<std::string> attributes) : attributes_(std::move(attributes)) {
        model_.buffers.resize(1);
        model_.scenes.resize(1);
        model_.defaultScene = 0;
        model_.asset.version = "2.0";
        model_.asset.generator = "Terratet";
    }

    tinygltf::Model& model() { return model_; }

    void add(const ScenePart& part, const Coloring& coloring) {
        tinygltf::Primitive primitive;
        primitive.mode = TINYGLTF_MODE_TRIANGLES;
        primitive.attributes["POSITION"] = add_vectors(part.positions, true);
        primitive.attributes["NORMAL"] = add_vectors(part.normals, false);
        const bool colored = part.colored && coloring.has_property() && !part.values.empty();
        if (colored) {
            primitive.attributes["COLOR_0"] = add_colors(part.values[coloring.index()], coloring);
        }
        for (std::size_t p = 0; p < part.values.size(); ++p) {
            primitive.attributes[p < attributes_.size() ? attributes_[p] : extrapolation_attribute] =
                add_scalars(part.values[p]);
        }
        primitive.indices = add_indices(part.triangles);
        primitive.material = add_material(part, colored);
        tinygltf::Mesh mesh;
        mesh.name = part.name;
        mesh.primitives.push_back(std::move(primitive));
        tinygltf::Node node;
        node.name = part.name;
        node.mesh = static_cast<int>(model_.meshes.size());
        model_.meshes.push_back(std::move(mesh));
        model_.scenes[0].nodes.push_back(static_cast<int>(model_.nodes.size()));
        model_.nodes.push_back(std::move(node));
    }

  private:
    template <class T>
    int add_accessor(const std::vector<T>& data, int components, int component_type, int type, int target) {
        auto& bytes = model_.buffers[0].data;
        tinygltf::BufferView view;
        view.buffer = 0;
        view.byteOffset = bytes.size();
        view.byteLength = data.size() * sizeof(T);
        view.target = target;
        const auto* begin = reinterpret_cast<const unsigned char*>(data.data());
        bytes.insert(bytes.end(), begin, begin + view.byteLength);
        bytes.resize((bytes.size() + 3) / 4 * 4);
        tinygltf::Accessor accessor;
        accessor.bufferView = static_cast<int>(model_.bufferViews.size());
        accessor.componentType = component_type;
        accessor.type = type;
        accessor.count = data.size() / static_cast<std::size_t>(components);
        model_.bufferViews.push_back(std::move(view));
        model_.accessors.push_back(std::move(accessor));
        return static_cast<int>(model_.accessors.size()) - 1;
    }

    int add_vectors(const std::vector<Vec3>& vectors, bool with_bounds) {
        std::vector<float> data;
        std::vector<double> least(3, std::numeric_limits<double>::infinity());
        std::vector<double> most(3, -std::numeric_limits<double>::infinity());
        for (const Vec3& v : vectors) {
            for (int axis = 0; axis < 3; ++axis) {
                const auto k = static_cast<std::size_t>(axis);
                data.push_back(static_cast<float>(v[axis]));
                least[k] = std::min(least[k], static_cast<double>(data.back()));
                most[k] = std::max(most[k], static_cast<double>(data.back()));
            }
        }
        const int index =
            add_accessor(data, 3, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, TINYGLTF_TARGET_ARRAY_BUFFER);
        if (with_bounds) {
            model_.accessors.back().minValues = least;
            model_.accessors.back().maxValues = most;
        }
        return index;
    }

    int add_colors(const std::vector<double>& values, const Coloring& coloring) {
        std::vector<std::uint8_t> data;
        for (const double value : values) {
            const auto rgba = to_linear_rgba8(coloring.at(value));
            data.insert(data.end(), rgba.begin(), rgba.end());
        }
        const int index = add_accessor(data, 4, TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE, TINYGLTF_TYPE_VEC4,
                                       TINYGLTF_TARGET_ARRAY_BUFFER);
        model_.accessors.back().normalized = true;
        return index;
    }

    int add_scalars(const std::vector<double>& values) {
        constexpr double largest = std::numeric_limits<float>::max();
        std::vector<float> data;
        for (const double value : values) {
            data.push_back(std::isnan(value) ? nodata : static_cast<float>(std::clamp(value, -largest, largest)));
        }
        return add_accessor(data, 1, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_SCALAR, TINYGLTF_TARGET_ARRAY_BUFFER);
    }

    int add_indices(const std::vector<Triangle>& triangles) {
        std::vector<std::uint32_t> data;
        for (const Triangle& triangle : triangles) {
            data.insert(data.end(), triangle.begin(), triangle.end());
        }
        return add_accessor(data, 1, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR,
                            TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    }

    int add_material(const ScenePart& part, bool colored) {
        tinygltf::Material material;
        material.name = part.name;
        const Color base = colored ? Color{1, 1, 1} : part.color;
        material.pbrMetallicRoughness.baseColorFactor = {to_linear(base.r), to_linear(base.g), to_linear(base.b),
                                                         part.opacity};
        material.pbrMetallicRoughness.metallicFactor = 0;
        material.pbrMetallicRoughness.roughnessFactor = 0.9;
        material.doubleSided = part.double_sided;
        material.alphaMode = part.opacity < 1 ? "BLEND" : "OPAQUE";
        if (!part.lit) {
            material.extensions["KHR_materials_unlit"] = Value(Value::Object());
            auto& used = model_.extensionsUsed;
            if (used.empty()) {
                used.emplace_back("KHR_materials_unlit");
            }
        }
        model_.materials.push_back(std::move(material));
        return static_cast<int>(model_.materials.size()) - 1;
    }

    std::vector<std::string> attributes_;
    tinygltf::Model model_;
};

Value extras(const Model& model, const Coloring& coloring, const SceneFrame& frame,
             const std::vector<std::string>& attributes) {
    const Vec3& origin = frame.origin();
    Value::Object extras{
        {"crs", Value(model.frame.crs_wkt)},
        {"crs_name", Value(model.frame.crs_name)},
        {"length_unit", Value(model.frame.unit)},
        {"metres_per_unit", Value(model.frame.metres_per_unit)},
        {"origin", array({origin.x, origin.y, origin.z})},
        {"axes", Value(std::string("metres from the origin: x east, y up, z south; true coordinates are origin + "
                                   "(x, -z, y) / metres_per_unit"))},
        {"properties", property_list(model.properties, attributes)},
        {"nodata", Value(static_cast<double>(nodata))}};
    if (coloring.has_property()) {
        extras["legend"] = legend(coloring);
    }
    return object(std::move(extras));
}

}  // namespace

std::string to_gltf(const std::vector<ScenePart>& parts, const Model& model, const Coloring& coloring,
                    const SceneFrame& frame, bool binary) {
    const std::vector<std::string> attributes = attribute_names(model.properties);
    Document document(attributes);
    for (const ScenePart& part : parts) {
        document.add(part, coloring);
    }
    document.model().asset.extras = extras(model, coloring, frame, attributes);
    std::ostringstream stream;
    if (!tinygltf::TinyGLTF().WriteGltfSceneToStream(&document.model(), stream, false, binary)) {
        throw Error("the scene could not be put into glTF");
    }
    return std::move(stream).str();
}

}  // namespace terratet
