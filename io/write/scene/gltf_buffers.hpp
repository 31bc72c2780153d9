// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Numbers on their way into glTF's buffers. All accessors of one kind share a buffer view, so that a scene of hundreds
/// of nodes has a dozen views.

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "tess/geometry.hpp"

namespace terratet {

class GltfBuffers {
  public:
    using Json = nlohmann::ordered_json;

    /// With `compress`, buffer views are packed as EXT_meshopt_compression says, and positions are 16 bits an axis
    /// (KHR_mesh_quantization) within `box`, colours and normals 8.
    GltfBuffers(bool compress, const Box3& box);

    /// Each returns the accessor's index. `stream` tells views apart: equal names share one.
    int positions(const std::vector<Vec3>& positions);
    int normals(const std::vector<Vec3>& normals);
    int colors(const std::vector<std::uint8_t>& rgba);
    int scalars(const std::string& stream, const std::vector<float>& values);
    int feature_ids(std::size_t count, std::uint32_t id);
    int indices(const std::vector<std::uint32_t>& indices, bool triangles, std::size_t vertices);
    /// Of tubes: a list that begins as those before it shares their bytes.
    int tube_indices(const std::vector<std::uint32_t>& indices);
    /// As they are, whatever the compression: not for drawing. \param components 1 to 4
    int numbers(const std::string& stream, const std::vector<float>& values, std::size_t components);
    int integers(const std::string& stream, const std::vector<std::uint32_t>& values, std::size_t components);

    /// A view of its own, as property tables want; returns the view's index.
    int table_column(std::string_view bytes);

    /// What the node above all needs for positions to come out as they were: nothing, or translation and scale.
    [[nodiscard]] Json placement() const;

    /// Puts buffers, views and accessors into the document; returns the binary chunk.
    std::string finish(Json& document);

  private:
    struct Stream {
        std::string name;
        std::size_t stride = 0;
        int target = 0;  ///< 34962 vertices, 34963 indices, 0 neither
        enum class Mode : std::uint8_t { attributes, triangles, indices, plain } mode = Mode::attributes;
        bool octahedral = false;
        std::string bytes;
    };
    Stream& stream(const std::string& name, std::size_t stride, int target, Stream::Mode mode);
    template <class T>
    int accessor(Stream& stream, const std::vector<T>& data, std::size_t count, int component, const char* type);
    [[nodiscard]] std::string packed(const Stream& stream) const;

    bool compress_;
    Vec3 corner_;
    double step_ = 1;
    std::vector<Stream> streams_;
    std::map<std::string, std::size_t> stream_index_;
    Json accessors_ = Json::array();
    std::vector<std::uint32_t> tube_;           ///< the longest list so far
    std::map<std::size_t, int> tube_accessor_;  ///< by length
};

}  // namespace terratet
