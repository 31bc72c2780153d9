// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/voxels/tiles/tile_content.hpp"

#include <meshoptimizer.h>

#include <bit>
#include <cstring>

namespace terratet {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t stride = 4;  // of bytes as well: glTF aligns vertex attributes
constexpr int voxels_mode = 2147483647;

void append(std::string& to, std::uint32_t number) {
    to.append(reinterpret_cast<const char*>(&number), sizeof number);
}

/// Calls `take` with the index of each sample of a z-fastest array, in the order of the file: x runs fastest; in a box
/// then z upwards and y southwards, as glTF's axes lie, in a region then y and z.
template <class Take>
void in_file_order(const std::array<int, 3>& count, bool region, const Take& take) {
    const auto [nx, ny, nz] = count;
    const auto row = [&](int j, int k) {
        for (int i = 0; i < nx; ++i) {
            take(static_cast<std::size_t>((i * ny + j) * nz + k));
        }
    };
    if (region) {
        for (int k = 0; k < nz; ++k) {
            for (int j = 0; j < ny; ++j) {
                row(j, k);
            }
        }
        return;
    }
    for (int j = ny - 1; j >= 0; --j) {
        for (int k = 0; k < nz; ++k) {
            row(j, k);
        }
    }
}

std::string samples(const TileProperty& property, const std::array<int, 3>& count, bool region,
                    const std::vector<float>& values) {
    std::string bytes(values.size() * stride, '\0');
    char* to = bytes.data();
    if (property.is_float()) {
        in_file_order(count, region, [&](std::size_t at) {
            std::memcpy(to, &values[at], sizeof(float));
            to += stride;
        });
    } else {
        in_file_order(count, region, [&](std::size_t at) {
            *to = static_cast<char>(static_cast<unsigned char>(values[at] + 0.5F));
            to += stride;
        });
    }
    return bytes;
}

std::string packed(const std::string& bytes) {
    const std::size_t count = bytes.size() / stride;
    std::string out(meshopt_encodeVertexBufferBound(count, stride), '\0');
    out.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(out.data()), out.size(), bytes.data(), count,
                                          stride));
    return out;
}

/// Buffers, views and accessors of all properties; returns the binary chunk.
std::string put_samples(const TileClass& tile_class, const TileShape& tile,
                        const std::vector<std::vector<float>>& values, Json& document) {
    const std::array<int, 3> count{tile.dimensions[0] + 2, tile.dimensions[1] + 2, tile.dimensions[2] + 2};
    std::string chunk;
    std::size_t unpacked = 0;
    for (std::size_t p = 0; p < tile_class.properties.size(); ++p) {
        const TileProperty& property = tile_class.properties[p];
        const std::string bytes = samples(property, count, tile.region, values[p]);
        Json view{{"buffer", tile.compress ? 1 : 0},
                  {"byteOffset", tile.compress ? unpacked : chunk.size()},
                  {"byteLength", bytes.size()},
                  {"byteStride", stride},
                  {"target", 34962}};
        if (tile.compress) {
            const std::string small = packed(bytes);
            view["extensions"]["EXT_meshopt_compression"] = {
                {"buffer", 0},          {"byteOffset", chunk.size()}, {"byteLength", small.size()},
                {"byteStride", stride}, {"count", values[p].size()},  {"mode", "ATTRIBUTES"}};
            unpacked += bytes.size();
            chunk += small;
            chunk.resize((chunk.size() + 3) / 4 * 4);
        } else {
            chunk += bytes;
        }
        document["bufferViews"].push_back(std::move(view));
        document["accessors"].push_back({{"bufferView", p},
                                         {"componentType", property.is_float() ? 5126 : 5121},
                                         {"count", values[p].size()},
                                         {"type", "SCALAR"}});
    }
    document["buffers"] = Json::array({{{"byteLength", chunk.size()}}});
    if (tile.compress) {
        document["buffers"].push_back(
            {{"byteLength", unpacked}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}});
    }
    return chunk;
}

}  // namespace

std::string voxel_glb(const TileClass& tile_class, const TileShape& tile, const Json& shape,
                      const std::vector<std::vector<float>>& values) {
    Json used{"EXT_primitive_voxels", "KHR_implicit_shapes", "EXT_structural_metadata"};
    Json required{"EXT_primitive_voxels", "KHR_implicit_shapes"};
    if (tile.region) {
        used.push_back("EXT_implicit_ellipsoid_region");
        required.push_back("EXT_implicit_ellipsoid_region");
    }
    if (tile.compress) {
        used.push_back("EXT_meshopt_compression");
        required.push_back("EXT_meshopt_compression");
    }
    Json attributes = Json::object();
    Json of_class = Json::object();
    for (std::size_t p = 0; p < tile_class.properties.size(); ++p) {
        attributes[tile_class.properties[p].attribute] = p;
        of_class[tile_class.properties[p].id] = {{"attribute", tile_class.properties[p].attribute}};
    }
    const auto [x, y, z] = tile.dimensions;
    const Json voxels{{"shape", 0},
                      {"dimensions", tile.region ? Json{x, y, z} : Json{x, z, y}},
                      {"padding", {{"before", {1, 1, 1}}, {"after", {1, 1, 1}}}}};
    Json document{
        {"asset", {{"version", "2.0"}, {"generator", "Terratet"}}},
        {"extensionsUsed", used},
        {"extensionsRequired", required},
        {"extensions",
         {{"KHR_implicit_shapes", {{"shapes", Json::array({shape})}}},
          {"EXT_structural_metadata",
           {{"schema", tile_class.schema()},
            {"propertyAttributes", Json::array({{{"class", "voxel"}, {"properties", of_class}}})}}}}},
        {"scene", 0},
        {"scenes", Json::array({{{"nodes", {0}}}})},
        {"nodes", Json::array({{{"mesh", 0}}})},
        {"meshes", Json::array({{{"primitives",
                                  Json::array({{{"mode", voxels_mode},
                                                {"attributes", attributes},
                                                {"extensions",
                                                 {{"EXT_primitive_voxels", voxels},
                                                  {"EXT_structural_metadata", {{"propertyAttributes", {0}}}}}}}})}}})}};
    const std::string chunk = put_samples(tile_class, tile, values, document);
    std::string text = document.dump(-1, ' ', false, Json::error_handler_t::replace);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string file = "glTF";
    append(file, 2);
    append(file, static_cast<std::uint32_t>(28 + text.size() + chunk.size()));
    append(file, static_cast<std::uint32_t>(text.size()));
    file += "JSON" + text;
    append(file, static_cast<std::uint32_t>(chunk.size()));
    file.append("BIN\0", 4);
    return file + chunk;
}

}  // namespace terratet
