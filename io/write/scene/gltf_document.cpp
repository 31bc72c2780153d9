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
    Document(std::span<const ScenePart> parts, std::span<const PartFacts> facts, const Box3& box, const Model& model,
             bool compress)
        : compress_(compress), buffers_(compress, box), attributes_(attribute_names(model.properties)) {
        document_["asset"] = {{"version", "2.0"}, {"generator", "Terratet"}};
        document_["extensionsUsed"] = Json::array();
        document_["scene"] = 0;
        document_["scenes"] = Json::array({{{"nodes", Json::array()}}});
        for (const char* name : {"nodes", "meshes", "materials"}) {
            document_[name] = Json::array();
        }
        std::vector<PartFacts> rows;
        for (std::size_t p = 0; p < parts.size(); ++p) {
            if (!parts[p].triangles.empty()) {
                rows.push_back(facts[p]);
            }
        }
        if (!rows.empty()) {
            add_feature_table(document_, buffers_, rows);
        }
        for (std::size_t p = 0; p < parts.size(); ++p) {
            add(parts[p], facts[p]);
        }
    }

    /// Of all: places, corners, blocks and values.
    Json cells(const Scene& scene) {
        const SceneCells& cells = scene.cells;
        std::vector<float> places;
        for (const Vec3& p : cells.mesh.points) {
            const Vec3 at = scene.frame.position(p);
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
    Json intervals(const Model& model) {
        std::vector<std::uint32_t> hole;
        std::vector<float> depth;
        std::vector<float> length;
        std::vector<std::vector<double>> values(model.properties.size());
        for (std::size_t s = 0; s < model.samples.size(); ++s) {
            if (model.samples.borehole[s] >= 0) {
                hole.push_back(static_cast<std::uint32_t>(model.samples.borehole[s]));
                depth.push_back(static_cast<float>(model.samples.depth[s]));
                length.push_back(static_cast<float>(model.samples.length[s]));
                for (std::size_t p = 0; p < values.size(); ++p) {
                    values[p].push_back(p < model.samples.values.size() ? model.samples.values[p][s] : missing);
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

    /// \param extras  of the asset; may be empty
    GltfText finish(Json extras) {
        if (Json above = buffers_.placement(); !above.empty() && !top_.empty()) {
            above["name"] = "scene";
            above["children"] = std::move(top_);
            top_ = {document_["nodes"].size()};
            document_["nodes"].push_back(std::move(above));
        }
        document_["scenes"][0]["nodes"] = top_;
        if (!extras.empty()) {
            document_["asset"]["extras"] = std::move(extras);
        }
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
    void add(const ScenePart& part, const PartFacts& facts) {
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
            for (const auto& [name, number] : facts.numbers) {
                node["extras"][name] = number;
            }
        }
        top_.push_back(document_["nodes"].size());
        document_["nodes"].push_back(std::move(node));
    }

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
        if (part.triangles.empty()) {
            return;
        }
        primitive["attributes"]["_FEATURE_ID_0"] = buffers_.feature_ids(part.positions.size(), rows_++);
        primitive["extensions"]["EXT_mesh_features"]["featureIds"] =
            Json::array({{{"featureCount", 1}, {"attribute", 0}, {"propertyTable", 0}}});
        used_.insert("EXT_mesh_features");
    }

    bool compress_;
    GltfBuffers buffers_;
    std::vector<std::string> attributes_;
    Json document_;
    std::uint32_t rows_ = 0;  ///< of the property table, so far
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
    const std::vector<PartFacts> facts = part_facts(scene, model);
    std::vector<ScenePart> kept;
    std::vector<PartFacts> kept_facts;
    for (std::size_t p = 0; with_cells && p < scene.parts.size(); ++p) {
        const ScenePart::Kind kind = scene.parts[p].kind;
        if (kind != ScenePart::Kind::section && kind != ScenePart::Kind::isosurface && kind != ScenePart::Kind::block) {
            kept.push_back(scene.parts[p]);
            kept_facts.push_back(facts[p]);
        }
    }
    Document document(with_cells ? kept : scene.parts, with_cells ? kept_facts : facts, box_of(scene), model, compress);
    Json extras = gltf_extras(scene, model, attribute_names(model.properties));
    if (with_cells) {
        extras["cells"] = document.cells(scene);
        if (Json intervals = document.intervals(model); !intervals.is_null()) {
            extras["intervals"] = std::move(intervals);
        }
    }
    return document.finish(std::move(extras));
}

GltfText gltf_of_parts(std::span<const ScenePart> parts, std::span<const PartFacts> facts, const Box3& box,
                       const Model& model, bool compress) {
    return Document(parts, facts, box, model, compress).finish({});
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
