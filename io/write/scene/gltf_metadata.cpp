// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// What a scene in glTF says about itself.

#include <algorithm>
#include <cstring>
#include <limits>

#include "io/read/column_names.hpp"
#include "io/write/scene/gltf_document.hpp"

namespace terratet {
namespace {

using Json = GltfBuffers::Json;

constexpr const char* own_attributes[] = {"_BATCHID", "_FEATURE_ID_0", "_EXTRAPOLATION", "_DEPTH"};

/// Enough to draw a legend without knowing the colour map.
Json legend(const Coloring& coloring) {
    const Property& property = coloring.property();
    Json legend{{"property", property.name}, {"unit", property.unit}, {"scale", scale_name(property)}};
    if (coloring.categorical()) {
        legend["classes"] = Json::array();
        for (std::size_t c = 0; c < property.classes.size(); ++c) {
            legend["classes"].push_back({{"name", property.classes[c]}, {"color", hex(class_color(c))}});
        }
    } else {
        constexpr int stops = 11;
        legend["color_map"] = coloring.map_name();
        legend["range"] = {coloring.low(), coloring.high()};
        legend["stops"] = Json::array();
        const auto [low, high] = coloring.range();
        for (int i = 0; i < stops; ++i) {
            const double t = static_cast<double>(i) / (stops - 1);
            legend["stops"].push_back(
                {{"value", from_scale(property, low + t * (high - low))}, {"color", hex(coloring.at_fraction(t))}});
        }
        legend["ticks"] = Json::array();
        for (const LegendTick& tick : legend_ticks(property, coloring.range())) {
            legend["ticks"].push_back({{"value", tick.value}, {"label", tick.label}});
        }
    }
    legend["missing_color"] = hex(missing_color);
    return legend;
}

template <class T>
std::string bytes_of(const std::vector<T>& values) {
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

template <class T>
const T* fact(const std::vector<std::pair<std::string, T>>& facts, const std::string& name) {
    const auto found = std::find_if(facts.begin(), facts.end(), [&](const auto& entry) { return entry.first == name; });
    return found == facts.end() ? nullptr : &found->second;
}

Json text_column(GltfBuffers& buffers, std::span<const PartFacts> rows, const std::string& name) {
    std::string text;
    std::vector<std::uint32_t> offsets{0};
    for (const PartFacts& row : rows) {
        if (const std::string* own = fact(row.texts, name)) {
            text += *own;
        }
        offsets.push_back(static_cast<std::uint32_t>(text.size()));
    }
    if (text.empty()) {
        text = " ";  // no view may be empty
    }
    return {{"values", buffers.table_column(text)}, {"stringOffsets", buffers.table_column(bytes_of(offsets))}};
}

Json number_column(GltfBuffers& buffers, std::span<const PartFacts> rows, const std::string& name) {
    std::vector<double> values;
    for (const PartFacts& row : rows) {
        const double* own = fact(row.numbers, name);
        values.push_back(own != nullptr ? *own : missing);
    }
    return {{"values", buffers.table_column(bytes_of(gltf_floats(values)))}};
}

void tell(PartFacts& facts, const Borehole& hole, std::size_t intervals, const Frame& frame) {
    const Vec3 collar = frame.to_world(hole.collar);
    facts.texts.emplace_back("id", hole.id);
    facts.numbers = {{"collar_x", collar.x},
                     {"collar_y", collar.y},
                     {"collar_z", collar.z},
                     {"length", hole.path_depth.empty() ? 0 : hole.path_depth.back()},
                     {"intervals", static_cast<double>(intervals)}};
}

void tell(PartFacts& facts, const Barrier& barrier, const Frame& frame) {
    Surface surface;
    for (const Vec3& p : barrier.sheet.vertices) {
        surface.vertices.push_back(frame.to_world(p));
    }
    surface.triangles = barrier.sheet.triangles;
    const SurfaceStatistics known = statistics(surface);
    facts.numbers = {{"area", known.area}, {"dip", known.dip_mean_deg}, {"dip_direction", known.dip_direction_deg}};
}

/// "section: E-W" is the section "E-W".
PartFacts kind_and_name(const ScenePart& part) {
    const std::string& whole = part.name;
    const std::size_t colon = whole.find(": ");
    if (part.kind == ScenePart::Kind::block) {
        return {{{"kind", "block"}, {"name", whole}}, {}};
    }
    if (colon == std::string::npos) {
        return {{{"kind", whole}, {"name", whole}}, {}};
    }
    return {{{"kind", whole.substr(0, colon)}, {"name", whole.substr(colon + 2)}}, {}};
}

}  // namespace

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

float gltf_nodata() {
    return std::numeric_limits<float>::lowest();
}

std::vector<float> gltf_floats(const std::vector<double>& values) {
    constexpr double largest = std::numeric_limits<float>::max();
    std::vector<float> data;
    data.reserve(values.size());
    for (const double value : values) {
        data.push_back(std::isnan(value) ? gltf_nodata() : static_cast<float>(std::clamp(value, -largest, largest)));
    }
    return data;
}

Json gltf_extras(const Scene& scene, const Model& model, const std::vector<std::string>& attributes) {
    const SceneFrame& frame = scene.frame;
    const Vec3& origin = frame.origin();
    Json extras{{"crs", model.frame.crs_wkt},
                {"crs_name", model.frame.crs_name},
                {"length_unit", model.frame.unit},
                {"metres_per_unit", model.frame.metres_per_unit},
                {"origin", {origin.x, origin.y, origin.z}}};
    if (frame.axes() == SceneFrame::Axes::grid) {
        extras["axes"] =
            "metres from the origin: x east, y up, z south; true coordinates are origin + (x, -z, y) / metres_per_unit";
    } else {
        extras["axes"] =
            "metres from the origin on the globe: x east, y up, z south; earth-centred: enu_to_ecef times (x, -z, y, "
            "1)";
    }
    if (const auto& globe = frame.globe()) {
        extras["lon"] = globe->longitude_deg;
        extras["lat"] = globe->latitude_deg;
        extras["height"] = globe->height;
        extras["enu_to_ecef"] = globe->enu_to_ecef;
        extras["convergence"] = globe->convergence_deg;
    }
    extras["properties"] = Json::array();
    for (std::size_t p = 0; p < model.properties.size(); ++p) {
        const Property& property = model.properties[p];
        Json entry{{"name", property.name},
                   {"attribute", attributes[p]},
                   {"unit", property.unit},
                   {"scale", scale_name(property)}};
        if (property.kind == Kind::categorical) {
            entry["classes"] = property.classes;
        }
        extras["properties"].push_back(std::move(entry));
    }
    extras["nodata"] = gltf_nodata();
    if (scene.coloring.has_property()) {
        extras["legend"] = legend(scene.coloring);
    }
    return extras;
}

std::vector<PartFacts> part_facts(const Scene& scene, const Model& model) {
    std::vector<std::size_t> intervals(model.boreholes.size(), 0);
    for (const std::int32_t hole : model.samples.borehole) {
        if (hole >= 0) {
            ++intervals[static_cast<std::size_t>(hole)];
        }
    }
    std::vector<PartFacts> result;
    for (const ScenePart& part : scene.parts) {
        PartFacts facts = kind_and_name(part);
        const auto which = static_cast<std::size_t>(part.feature);
        if (part.kind == ScenePart::Kind::borehole) {
            tell(facts, model.boreholes[which], intervals[which], model.frame);
        } else if (part.kind == ScenePart::Kind::barrier) {
            tell(facts, model.barriers[which], model.frame);
        } else if (part.kind == ScenePart::Kind::block) {
            facts.numbers = {{"volume", scene.block_volume[which]}};
        } else if (part.kind == ScenePart::Kind::isosurface) {
            facts.texts.emplace_back("property", part.property);
            facts.numbers = {{"value", part.level}};
        }
        result.push_back(std::move(facts));
    }
    return result;
}

void add_feature_table(Json& document, GltfBuffers& buffers, std::span<const PartFacts> facts) {
    Json of_class = Json::object();
    Json columns = Json::object();
    for (const PartFacts& row : facts) {
        for (const auto& [name, text] : row.texts) {
            if (!of_class.contains(name)) {
                of_class[name] = {{"type", "STRING"}, {"noData", ""}};
                columns[name] = text_column(buffers, facts, name);
            }
        }
        for (const auto& [name, number] : row.numbers) {
            if (!of_class.contains(name)) {
                of_class[name] = {{"type", "SCALAR"}, {"componentType", "FLOAT32"}, {"noData", gltf_nodata()}};
                columns[name] = number_column(buffers, facts, name);
            }
        }
    }
    // No property attributes (depth and values at a borehole's vertices): CesiumJS 1.145 stops drawing unless every
    // primitive of the file has all of them. They are attributes of the vertices all the same.
    document["extensions"]["EXT_structural_metadata"] = {
        {"schema", {{"id", "terratet"}, {"classes", {{"feature", {{"properties", of_class}}}}}}},
        {"propertyTables", Json::array({{{"class", "feature"}, {"count", facts.size()}, {"properties", columns}}})}};
}

}  // namespace terratet
