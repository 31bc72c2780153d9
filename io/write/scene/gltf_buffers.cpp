// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/write/scene/gltf_buffers.hpp"

#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace terratet {
namespace {

constexpr int vertex_target = 34962;
constexpr int index_target = 34963;
constexpr int byte_type = 5120;
constexpr int unsigned_byte = 5121;
constexpr int unsigned_short = 5123;
constexpr int unsigned_int = 5125;
constexpr int float_type = 5126;
constexpr double most_steps = 65535;

void align(std::string& bytes) {
    bytes.resize((bytes.size() + 3) / 4 * 4);
}

const char* mode_name(int mode) {
    constexpr const char* names[] = {"ATTRIBUTES", "TRIANGLES", "INDICES"};
    return names[mode];
}

template <class Encode>
std::string encoded(std::size_t bound, Encode&& encode) {
    std::string out(bound, '\0');
    out.resize(encode(reinterpret_cast<unsigned char*>(out.data()), out.size()));
    return out;
}

template <class T>
std::vector<unsigned int> widened(const std::string& bytes) {
    std::vector<T> values(bytes.size() / sizeof(T));
    std::memcpy(values.data(), bytes.data(), bytes.size());
    return {values.begin(), values.end()};
}

}  // namespace

GltfBuffers::GltfBuffers(bool compress, const Box3& box) : compress_(compress), corner_(box.empty() ? Vec3{} : box.lo) {
    const Vec3 size = box.empty() ? Vec3{1, 1, 1} : box.size();
    step_ = std::max({size.x, size.y, size.z, 1e-9}) / most_steps;
    meshopt_encodeVertexVersion(0);  // what the glTF extension reads
    meshopt_encodeIndexVersion(1);
}

GltfBuffers::Stream& GltfBuffers::stream(const std::string& name, std::size_t stride, int target, Stream::Mode mode) {
    const auto [entry, fresh] = stream_index_.try_emplace(name, streams_.size());
    if (fresh) {
        streams_.push_back({name, stride, target, mode, false, {}});
    }
    return streams_[entry->second];
}

template <class T>
int GltfBuffers::accessor(Stream& stream, const std::vector<T>& data, std::size_t count, int component,
                          const char* type) {
    accessors_.push_back({{"bufferView", stream_index_.at(stream.name)},
                          {"byteOffset", stream.bytes.size()},
                          {"componentType", component},
                          {"count", count},
                          {"type", type}});
    stream.bytes.append(reinterpret_cast<const char*>(data.data()), data.size() * sizeof(T));
    return static_cast<int>(accessors_.size()) - 1;
}

int GltfBuffers::positions(const std::vector<Vec3>& positions) {
    std::vector<float> plain;
    std::vector<std::uint16_t> steps;
    std::array<double, 3> least;
    std::array<double, 3> most;
    least.fill(std::numeric_limits<double>::infinity());
    most.fill(-std::numeric_limits<double>::infinity());
    for (const Vec3& p : positions) {
        for (int axis = 0; axis < 3; ++axis) {
            const auto k = static_cast<std::size_t>(axis);
            const double step = std::clamp(std::round((p[axis] - corner_[axis]) / step_), 0.0, most_steps);
            const double stored = compress_ ? step : static_cast<double>(static_cast<float>(p[axis]));
            least[k] = std::min(least[k], stored);
            most[k] = std::max(most[k], stored);
            compress_ ? steps.push_back(static_cast<std::uint16_t>(step)) : plain.push_back(static_cast<float>(stored));
        }
        if (compress_) {
            steps.push_back(0);
        }
    }
    Stream& to = stream("positions", compress_ ? 8 : 12, vertex_target, Stream::Mode::attributes);
    const int index = compress_ ? accessor(to, steps, positions.size(), unsigned_short, "VEC3")
                                : accessor(to, plain, positions.size(), float_type, "VEC3");
    accessors_.back()["min"] = least;
    accessors_.back()["max"] = most;
    return index;
}

int GltfBuffers::normals(const std::vector<Vec3>& normals) {
    std::vector<float> plain;
    for (const Vec3& n : normals) {
        plain.insert(plain.end(), {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)});
        if (compress_) {
            plain.push_back(0);
        }
    }
    Stream& to = stream("normals", compress_ ? 4 : 12, vertex_target, Stream::Mode::attributes);
    if (!compress_) {
        return accessor(to, plain, normals.size(), float_type, "VEC3");
    }
    to.octahedral = true;
    std::vector<std::int8_t> packed(4 * normals.size());
    meshopt_encodeFilterOct(packed.data(), normals.size(), 4, 8, plain.data());
    const int index = accessor(to, packed, normals.size(), byte_type, "VEC3");
    accessors_.back()["normalized"] = true;
    return index;
}

int GltfBuffers::colors(const std::vector<std::uint8_t>& rgba) {
    const int index = accessor(stream("colors", 4, vertex_target, Stream::Mode::attributes), rgba, rgba.size() / 4,
                               unsigned_byte, "VEC4");
    accessors_.back()["normalized"] = true;
    return index;
}

int GltfBuffers::scalars(const std::string& stream_name, const std::vector<float>& values) {
    return accessor(stream(stream_name, 4, vertex_target, Stream::Mode::attributes), values, values.size(), float_type,
                    "SCALAR");
}

int GltfBuffers::feature_ids(std::size_t count, std::uint32_t id) {
    std::vector<std::uint16_t> ids(2 * count, 0);  // vertices begin at multiples of four bytes
    for (std::size_t v = 0; v < count; ++v) {
        ids[2 * v] = static_cast<std::uint16_t>(id);
    }
    return accessor(stream("feature ids", 4, vertex_target, Stream::Mode::attributes), ids, count, unsigned_short,
                    "SCALAR");
}

int GltfBuffers::indices(const std::vector<std::uint32_t>& indices, bool triangles, std::size_t vertices) {
    const auto mode = triangles ? Stream::Mode::triangles : Stream::Mode::indices;
    if (vertices < 65535) {
        const std::vector<std::uint16_t> narrow(indices.begin(), indices.end());
        Stream& to = stream(triangles ? "triangles" : "lines", 2, index_target, mode);
        return accessor(to, narrow, indices.size(), unsigned_short, "SCALAR");
    }
    Stream& to = stream(triangles ? "wide triangles" : "wide lines", 4, index_target, mode);
    return accessor(to, indices, indices.size(), unsigned_int, "SCALAR");
}

int GltfBuffers::tube_indices(const std::vector<std::uint32_t>& indices) {
    const std::size_t shared = std::min(indices.size(), tube_.size());
    if (!std::equal(indices.begin(), indices.begin() + static_cast<std::ptrdiff_t>(shared), tube_.begin())) {
        return this->indices(indices, true, std::numeric_limits<std::size_t>::max());
    }
    Stream& to = stream("tube triangles", 4, index_target, Stream::Mode::triangles);
    if (shared < indices.size()) {
        to.bytes.append(reinterpret_cast<const char*>(indices.data() + shared), 4 * (indices.size() - shared));
        tube_ = indices;
    }
    const auto [entry, fresh] = tube_accessor_.try_emplace(indices.size(), static_cast<int>(accessors_.size()));
    if (fresh) {
        accessors_.push_back({{"bufferView", stream_index_.at(to.name)},
                              {"componentType", unsigned_int},
                              {"count", indices.size()},
                              {"type", "SCALAR"}});
    }
    return entry->second;
}

int GltfBuffers::numbers(const std::string& stream_name, const std::vector<float>& values, std::size_t components) {
    constexpr const char* types[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
    return accessor(stream(stream_name, 4 * components, 0, Stream::Mode::attributes), values,
                    values.size() / components, float_type, types[components - 1]);
}

int GltfBuffers::integers(const std::string& stream_name, const std::vector<std::uint32_t>& values,
                          std::size_t components) {
    constexpr const char* types[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
    return accessor(stream(stream_name, 4 * components, 0, Stream::Mode::attributes), values,
                    values.size() / components, unsigned_int, types[components - 1]);
}

int GltfBuffers::table_column(std::string_view bytes) {
    const std::string name = "column " + std::to_string(streams_.size());
    stream(name, 1, 0, Stream::Mode::plain).bytes = bytes;
    return static_cast<int>(streams_.size()) - 1;
}

GltfBuffers::Json GltfBuffers::placement() const {
    Json node = Json::object();
    if (compress_) {
        node["translation"] = {corner_.x, corner_.y, corner_.z};
        node["scale"] = {step_, step_, step_};
    }
    return node;
}

std::string GltfBuffers::packed(const Stream& stream) const {
    const std::size_t count = stream.bytes.size() / stream.stride;
    if (stream.mode == Stream::Mode::attributes) {
        return encoded(meshopt_encodeVertexBufferBound(count, stream.stride),
                       [&](unsigned char* out, std::size_t size) {
                           return meshopt_encodeVertexBuffer(out, size, stream.bytes.data(), count, stream.stride);
                       });
    }
    const std::vector<unsigned int> indices =
        stream.stride == 2 ? widened<std::uint16_t>(stream.bytes) : widened<std::uint32_t>(stream.bytes);
    const std::size_t vertices = indices.empty() ? 0 : *std::max_element(indices.begin(), indices.end()) + 1;
    if (stream.mode == Stream::Mode::triangles) {
        return encoded(meshopt_encodeIndexBufferBound(count, vertices), [&](unsigned char* out, std::size_t size) {
            return meshopt_encodeIndexBuffer(out, size, indices.data(), count);
        });
    }
    return encoded(meshopt_encodeIndexSequenceBound(count, vertices), [&](unsigned char* out, std::size_t size) {
        return meshopt_encodeIndexSequence(out, size, indices.data(), count);
    });
}

std::string GltfBuffers::finish(Json& document) {
    std::string chunk;
    std::size_t unpacked = 0;  // offset in the buffer that is not there, of what the packed views hold
    Json views = Json::array();
    for (const Stream& stream : streams_) {
        const bool pack = compress_ && stream.mode != Stream::Mode::plain;
        Json view{{"buffer", pack ? 1 : 0},
                  {"byteOffset", pack ? unpacked : chunk.size()},
                  {"byteLength", stream.bytes.size()}};
        if (stream.target == vertex_target) {
            view["byteStride"] = stream.stride;
        }
        if (stream.target != 0) {
            view["target"] = stream.target;
        }
        const std::string bytes = pack ? packed(stream) : stream.bytes;
        if (pack) {
            Json extension{{"buffer", 0},
                           {"byteOffset", chunk.size()},
                           {"byteLength", bytes.size()},
                           {"byteStride", stream.stride},
                           {"count", stream.bytes.size() / stream.stride},
                           {"mode", mode_name(static_cast<int>(stream.mode))}};
            if (stream.octahedral) {
                extension["filter"] = "OCTAHEDRAL";
            }
            view["extensions"]["EXT_meshopt_compression"] = std::move(extension);
            unpacked = (unpacked + stream.bytes.size() + 3) / 4 * 4;
        }
        chunk += bytes;
        align(chunk);
        views.push_back(std::move(view));
    }
    document["buffers"] = Json::array({{{"byteLength", chunk.size()}}});
    if (compress_) {
        document["buffers"].push_back(
            {{"byteLength", unpacked}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}});
    }
    document["bufferViews"] = std::move(views);
    document["accessors"] = std::move(accessors_);
    return chunk;
}

}  // namespace terratet
