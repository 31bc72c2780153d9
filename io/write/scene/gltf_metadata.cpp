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

/// Columns of one property table, filled row by row.
class Table {
  public:
    Table(std::string name, std::size_t rows) : name_(std::move(name)), rows_(rows) {}

    template <class Get>
    void strings(const std::string& name, GltfBuffers& buffers, Get&& get) {
        std::string text;
        std::vector<std::uint32_t> offsets{0};
        for (std::size_t row = 0; row < rows_; ++row) {
            text += get(row);
            offsets.push_back(static_cast<std::uint32_t>(text.size()));
        }
        if (text.empty()) {
            text = " ";  // no view may be empty
        }
        class_[name] = {{"type", "STRING"}};
        columns_[name] = {{"values", buffers.table_column(text)},
                          {"stringOffsets", buffers.table_column(bytes_of(offsets))}};
    }
    template <class Get>
    void numbers(const std::string& name, GltfBuffers& buffers, Get&& get) {
        std::vector<float> values;
        for (std::size_t row = 0; row < rows_; ++row) {
            values.push_back(static_cast<float>(get(row)));
        }
        class_[name] = {{"type", "SCALAR"}, {"componentType", "FLOAT32"}};
        columns_[name] = {{"values", buffers.table_column(bytes_of(values))}};
    }
    int finish(Json& metadata) {
        metadata["schema"]["classes"][name_] = {{"properties", class_}};
        metadata["propertyTables"].push_back({{"class", name_}, {"count", rows_}, {"properties", columns_}});
        return static_cast<int>(metadata["propertyTables"].size()) - 1;
    }

  private:
    template <class T>
    static std::string bytes_of(const std::vector<T>& values) {
        return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
    }
    std::string name_;
    std::size_t rows_;
    Json class_ = Json::object();
    Json columns_ = Json::object();
};

int hole_table(Json& metadata, GltfBuffers& buffers, const Model& model) {
    Table table("borehole", model.boreholes.size());
    const auto collar = [&](std::size_t b) { return model.frame.to_world(model.boreholes[b].collar); };
    table.strings("id", buffers, [&](std::size_t b) { return model.boreholes[b].id; });
    table.numbers("collar_x", buffers, [&](std::size_t b) { return collar(b).x; });
    table.numbers("collar_y", buffers, [&](std::size_t b) { return collar(b).y; });
    table.numbers("collar_z", buffers, [&](std::size_t b) { return collar(b).z; });
    table.numbers("length", buffers, [&](std::size_t b) {
        const auto& depths = model.boreholes[b].path_depth;
        return depths.empty() ? 0 : depths.back();
    });
    std::vector<std::size_t> intervals(model.boreholes.size(), 0);
    for (const std::int32_t hole : model.samples.borehole) {
        if (hole >= 0) {
            ++intervals[static_cast<std::size_t>(hole)];
        }
    }
    table.numbers("intervals", buffers, [&](std::size_t b) { return static_cast<double>(intervals[b]); });
    return table.finish(metadata);
}

int barrier_table(Json& metadata, GltfBuffers& buffers, const Model& model) {
    Table table("barrier", model.barriers.size());
    std::vector<SurfaceStatistics> known;
    for (const Barrier& barrier : model.barriers) {
        Surface surface;
        for (const Vec3& p : barrier.sheet.vertices) {
            surface.vertices.push_back(model.frame.to_world(p));
        }
        surface.triangles = barrier.sheet.triangles;
        known.push_back(statistics(surface));
    }
    table.strings("name", buffers, [&](std::size_t b) { return model.barriers[b].name; });
    table.strings("kind", buffers, [&](std::size_t b) { return std::string(to_string(model.barriers[b].sheet.kind)); });
    table.numbers("area", buffers, [&](std::size_t b) { return known[b].area; });
    table.numbers("dip", buffers, [&](std::size_t b) { return known[b].dip_mean_deg; });
    table.numbers("dip_direction", buffers, [&](std::size_t b) { return known[b].dip_direction_deg; });
    return table.finish(metadata);
}

int block_table(Json& metadata, GltfBuffers& buffers, const Scene& scene) {
    Table table("block", scene.block_volume.size());
    table.strings("name", buffers, [&](std::size_t b) { return scene.cells.region_names[b]; });
    table.numbers("volume", buffers, [&](std::size_t b) { return scene.block_volume[b]; });
    return table.finish(metadata);
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

FeatureTables add_feature_tables(Json& document, GltfBuffers& buffers, const Scene& scene, const Model& model) {
    const auto has = [&](ScenePart::Kind kind) {
        return std::any_of(scene.parts.begin(), scene.parts.end(),
                           [&](const ScenePart& part) { return part.kind == kind; });
    };
    Json metadata{{"schema", {{"id", "terratet"}, {"classes", Json::object()}}}};
    FeatureTables tables;
    if (has(ScenePart::Kind::borehole)) {
        tables.holes = hole_table(metadata, buffers, model);
    }
    if (has(ScenePart::Kind::barrier)) {
        tables.barriers = barrier_table(metadata, buffers, model);
    }
    if (has(ScenePart::Kind::block)) {
        tables.blocks = block_table(metadata, buffers, scene);
    }
    // No property attributes (depth and values at a borehole's vertices): CesiumJS 1.145 stops drawing unless every
    // primitive of the file has all of them. They are attributes of the vertices all the same.
    if (!metadata["schema"]["classes"].empty()) {
        document["extensions"]["EXT_structural_metadata"] = std::move(metadata);
    }
    return tables;
}

}  // namespace terratet
