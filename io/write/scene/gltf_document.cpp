// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/write/scene/gltf_document.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace terratet {
namespace {

using Json = GltfBuffers::Json;

Box3 box_of(const Scene& scene) {
    Box3 box;
    for (const ScenePart& part : scene.parts) {
        for (const Vec3& p : part.positions) {
            box.extend(p);
        }
    }
    return box;
}

class Document {
  public:
    Document(const Scene& scene, const Model& model, bool compress)
        : scene_(scene),
          model_(model),
          compress_(compress),
          buffers_(compress, box_of(scene)),
          attributes_(attribute_names(model.properties)) {
        document_["asset"] = {{"version", "2.0"}, {"generator", "Terratet"}};
        document_["extensionsUsed"] = Json::array();
        document_["scene"] = 0;
        document_["scenes"] = Json::array({{{"nodes", Json::array()}}});
        for (const char* name : {"nodes", "meshes", "materials"}) {
            document_[name] = Json::array();
        }
        tables_ = add_feature_tables(document_, buffers_, scene, model);
    }

    void add(const ScenePart& part) {
        Json primitive{{"attributes", {{"POSITION", buffers_.positions(part.positions)}}}};
        Json& attributes = primitive["attributes"];
        if (!part.normals.empty()) {
            attributes["NORMAL"] = buffers_.normals(part.normals);
        }
        if (!part.colors.empty()) {
            attributes["COLOR_0"] = buffers_.colors(colors_of(part));
        }
        const bool of_all = part.kind == ScenePart::Kind::section || part.kind == ScenePart::Kind::borehole;
        for (std::size_t p = 0; of_all && p < part.values.size(); ++p) {
            attributes[attributes_[p]] = buffers_.scalars(attributes_[p], gltf_floats(part.values[p]));
        }
        if (of_all && !part.extrapolation.empty()) {
            attributes["_EXTRAPOLATION"] = buffers_.scalars("_EXTRAPOLATION", gltf_floats(part.extrapolation));
        }
        if (!part.depth.empty()) {
            attributes["_DEPTH"] = buffers_.scalars("_DEPTH", gltf_floats(part.depth));
        }
        primitive["indices"] = indices_of(part);
        primitive["material"] = material(part);
        if (part.triangles.empty()) {
            primitive["mode"] = 1;
        }
        add_feature(primitive, part);
        document_["meshes"].push_back({{"primitives", Json::array({std::move(primitive)})}});
        Json node{{"name", part.name}, {"mesh", document_["meshes"].size() - 1}};
        if (part.kind == ScenePart::Kind::block) {
            node["extras"] = {{"volume", scene_.block_volume[static_cast<std::size_t>(part.feature)]}};
        }
        top_.push_back(document_["nodes"].size());
        document_["nodes"].push_back(std::move(node));
    }

    /// Of all: places, corners, blocks and values.
    Json cells() {
        const SceneCells& cells = scene_.cells;
        std::vector<float> places;
        for (const Vec3& p : cells.mesh.points) {
            const Vec3 at = scene_.frame.position(p);
            places.insert(places.end(), {static_cast<float>(at.x), static_cast<float>(at.y), static_cast<float>(at.z)});
        }
        std::vector<std::uint32_t> corners;
        std::vector<std::uint32_t> region;
        for (std::size_t c = 0; c < cells.mesh.cells.size(); ++c) {
            if (cells.in_gap[c] == 0) {
                const auto& v = cells.mesh.cells[c];
                corners.insert(corners.end(), v.begin(), v.end());
                region.push_back(static_cast<std::uint32_t>(std::max(cells.mesh.region[c], -1) + 1));
            }
        }
        Json entry{{"points", buffers_.numbers("cell points", places, 3)},
                   {"corners", buffers_.integers("cell corners", corners, 4)},
                   {"region", buffers_.integers("cell regions", region, 1)},
                   {"extrapolation", buffers_.numbers("cell extrapolation", gltf_floats(cells.extrapolation), 1)},
                   {"values", Json::array()}};
        for (std::size_t p = 0; p < cells.values.size(); ++p) {
            entry["values"].push_back(
                buffers_.numbers("cell values " + std::to_string(p), gltf_floats(cells.values[p]), 1));
        }
        return entry;
    }

    /// Of all samples in boreholes: a strip log each.
    Json intervals() {
        std::vector<std::uint32_t> hole;
        std::vector<float> depth;
        std::vector<float> length;
        std::vector<std::vector<double>> values(model_.properties.size());
        for (std::size_t s = 0; s < model_.samples.size(); ++s) {
            if (model_.samples.borehole[s] >= 0) {
                hole.push_back(static_cast<std::uint32_t>(model_.samples.borehole[s]));
                depth.push_back(static_cast<float>(model_.samples.depth[s]));
                length.push_back(static_cast<float>(model_.samples.length[s]));
                for (std::size_t p = 0; p < values.size(); ++p) {
                    values[p].push_back(p < model_.samples.values.size() ? model_.samples.values[p][s] : missing);
                }
            }
        }
        if (hole.empty()) {
            return {};
        }
        Json entry{{"hole", buffers_.integers("interval holes", hole, 1)},
                   {"depth", buffers_.numbers("interval depths", depth, 1)},
                   {"length", buffers_.numbers("interval lengths", length, 1)},
                   {"values", Json::array()}};
        for (std::size_t p = 0; p < values.size(); ++p) {
            entry["values"].push_back(
                buffers_.numbers("interval values " + std::to_string(p), gltf_floats(values[p]), 1));
        }
        return entry;
    }

    GltfText finish(Json more) {
        if (Json above = buffers_.placement(); !above.empty() && !top_.empty()) {
            above["name"] = "scene";
            above["children"] = std::move(top_);
            top_ = {document_["nodes"].size()};
            document_["nodes"].push_back(std::move(above));
        }
        document_["scenes"][0]["nodes"] = top_;
        document_["asset"]["extras"] = gltf_extras(scene_, model_, attributes_);
        document_["asset"]["extras"].update(more);
        GltfText text;
        text.chunk = buffers_.finish(document_);
        if (document_.contains("extensions")) {
            used_.insert("EXT_structural_metadata");
        }
        if (compress_) {
            used_.insert({"EXT_meshopt_compression", "KHR_mesh_quantization"});
            document_["extensionsRequired"] = {"EXT_meshopt_compression", "KHR_mesh_quantization"};
        }
        document_["extensionsUsed"] = used_;
        if (used_.empty()) {
            document_.erase("extensionsUsed");
        }
        text.document = std::move(document_);
        return text;
    }

  private:
    static std::vector<std::uint8_t> colors_of(const ScenePart& part) {
        std::vector<std::uint8_t> data;
        for (const Color& color : part.colors) {
            const auto rgba = to_linear_rgba8(color);
            data.insert(data.end(), rgba.begin(), rgba.end());
        }
        return data;
    }

    int indices_of(const ScenePart& part) {
        std::vector<std::uint32_t> data;
        for (const Triangle& triangle : part.triangles) {
            data.insert(data.end(), triangle.begin(), triangle.end());
        }
        for (const auto& line : part.lines) {
            data.insert(data.end(), line.begin(), line.end());
        }
        return part.kind == ScenePart::Kind::borehole
                   ? buffers_.tube_indices(data)
                   : buffers_.indices(data, !part.triangles.empty(), part.positions.size());
    }

    /// Equal ones are shared.
    std::size_t material(const ScenePart& part) {
        const Color base = part.colors.empty() ? part.color : Color{1, 1, 1};
        Json material{{"pbrMetallicRoughness",
                       {{"baseColorFactor", {to_linear(base.r), to_linear(base.g), to_linear(base.b), part.opacity}},
                        {"metallicFactor", 0},
                        {"roughnessFactor", 0.9}}}};
        if (part.opacity < 1) {
            material["alphaMode"] = "BLEND";
        }
        if (part.kind != ScenePart::Kind::borehole) {  // those are closed
            material["doubleSided"] = true;
        }
        if (part.normals.empty()) {
            material["extensions"]["KHR_materials_unlit"] = Json::object();
            used_.insert("KHR_materials_unlit");
        }
        Json& all = document_["materials"];
        const auto found = std::find(all.begin(), all.end(), material);
        if (found != all.end()) {
            return static_cast<std::size_t>(found - all.begin());
        }
        all.push_back(std::move(material));
        return all.size() - 1;
    }

    void add_feature(Json& primitive, const ScenePart& part) {
        const int table = part.kind == ScenePart::Kind::borehole  ? tables_.holes
                          : part.kind == ScenePart::Kind::barrier ? tables_.barriers
                          : part.kind == ScenePart::Kind::block   ? tables_.blocks
                                                                  : -1;
        if (table < 0 || part.feature < 0) {
            return;
        }
        primitive["attributes"]["_FEATURE_ID_0"] =
            buffers_.feature_ids(part.positions.size(), static_cast<std::uint32_t>(part.feature));
        primitive["extensions"]["EXT_mesh_features"]["featureIds"] =
            Json::array({{{"featureCount", 1}, {"attribute", 0}, {"propertyTable", table}}});
        used_.insert("EXT_mesh_features");
    }

    const Scene& scene_;
    const Model& model_;
    bool compress_;
    GltfBuffers buffers_;
    std::vector<std::string> attributes_;
    Json document_;
    FeatureTables tables_;
    std::set<std::string> used_;
    std::vector<std::size_t> top_;  ///< nodes that no other holds
};

void append_word(std::string& bytes, std::size_t value) {
    for (int shift = 0; shift < 32; shift += 8) {
        bytes += static_cast<char>(value >> shift & 0xFF);
    }
}

std::string dumped(const Json& document) {
    return document.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

GltfText gltf_document(const Scene& scene, const Model& model, bool compress, bool with_cells) {
    Document document(scene, model, compress);
    for (const ScenePart& part : scene.parts) {
        const bool cut = part.kind == ScenePart::Kind::section || part.kind == ScenePart::Kind::isosurface ||
                         part.kind == ScenePart::Kind::block;
        if (!with_cells || !cut) {
            document.add(part);
        }
    }
    Json more = Json::object();
    if (with_cells) {
        more["cells"] = document.cells();
        if (Json intervals = document.intervals(); !intervals.is_null()) {
            more["intervals"] = std::move(intervals);
        }
    }
    return document.finish(std::move(more));
}

std::string to_glb(const GltfText& text) {
    std::string json = dumped(text.document);
    json.resize((json.size() + 3) / 4 * 4, ' ');
    std::string glb = "glTF";
    append_word(glb, 2);
    append_word(glb, 12 + 8 + json.size() + 8 + text.chunk.size());
    append_word(glb, json.size());
    glb += "JSON";
    glb += json;
    append_word(glb, text.chunk.size());
    glb += std::string_view("BIN\0", 4);
    return glb += text.chunk;
}

std::string to_gltf(GltfText text) {
    text.document["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64(text.chunk);
    return dumped(text.document);
}

std::string base64(std::string_view bytes) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t word = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            word = word << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
        }
        for (std::size_t k = 0; k < 4; ++k) {
            text += i + k <= bytes.size() ? digits[word >> (18 - 6 * k) & 63] : '=';
        }
    }
    return text;
}

}  // namespace terratet
