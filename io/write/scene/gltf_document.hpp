// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// From the scene to a glTF 2.0 document: a node for each part, what it is made of in asset.extras, and which hole,
/// barrier or block it is by EXT_mesh_features and EXT_structural_metadata.

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "io/write/scene/gltf_buffers.hpp"
#include "io/write/scene/scene.hpp"

namespace terratet {

struct GltfText {
    GltfBuffers::Json document;
    std::string chunk;  ///< of buffer 0
};

/// \param with_cells for the page, which cuts them itself: the cells as well, in asset.extras.cells, and parts of the
/// kinds that it makes of them left out
GltfText gltf_document(const Scene& scene, const Model& model, bool compress, bool with_cells = false);

/// What is told of a part when it is picked.
struct PartFacts {
    std::vector<std::pair<std::string, std::string>> texts;
    std::vector<std::pair<std::string, double>> numbers;
};

/// In step with the scene's parts.
std::vector<PartFacts> part_facts(const Scene& scene, const Model& model);

/// Some parts of a scene, as a tile of it: without asset.extras. \param box of the whole scene: 16 bits an axis within
/// it are the same in all tiles
GltfText gltf_of_parts(std::span<const ScenePart> parts, std::span<const PartFacts> facts, const Box3& box,
                       const Model& model, bool compress);

/// The binary container.
std::string to_glb(const GltfText& text);
/// One JSON file with the buffer in it.
std::string to_gltf(GltfText text);

std::string base64(std::string_view bytes);

// ---- its pieces

/// _NAME of each property, in upper case ASCII, distinct.
std::vector<std::string> attribute_names(const std::vector<Property>& properties);
const char* scale_name(const Property& property);

/// Accessors may hold no NaN: this stands for a missing value, and asset.extras.nodata says so.
float gltf_nodata();
std::vector<float> gltf_floats(const std::vector<double>& values);

/// asset.extras: where in the world, of which properties, with which legend.
GltfBuffers::Json gltf_extras(const Scene& scene, const Model& model, const std::vector<std::string>& attributes);

/// The facts as the document's property table, a row a part: one table, since CesiumJS asks the first for whatever is
/// picked.
void add_feature_table(GltfBuffers::Json& document, GltfBuffers& buffers, std::span<const PartFacts> facts);

}  // namespace terratet
