// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// A .glb taken apart by the specification's container format, packed views included, for tests.

#include <meshoptimizer.h>
#include <catch2/catch.hpp>

#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tess/geometry.hpp"

namespace terratet::testing {

struct Glb {
    using json = nlohmann::json;
    json document;
    std::string binary;

    explicit Glb(const std::string& path) {
        std::ifstream file(path, std::ios::binary);
        const std::string bytes{std::istreambuf_iterator<char>(file), {}};
        REQUIRE(bytes.substr(0, 4) == "glTF");
        const std::size_t json_length = word(bytes, 12);
        REQUIRE(word(bytes, 8) == bytes.size());
        document = json::parse(bytes.substr(20, json_length));
        binary = bytes.substr(20 + json_length + 8);
    }

    [[nodiscard]] std::vector<std::string> names() const {
        std::vector<std::string> result;
        for (const json& node : document["nodes"]) {
            result.push_back(node["name"]);
        }
        return result;
    }

    [[nodiscard]] const json& node(const std::string& name) const {
        for (const json& node : document["nodes"]) {
            if (node["name"] == name) {
                return node;
            }
        }
        FAIL("no node " << name);
        return document;
    }
    [[nodiscard]] const json& primitive(const std::string& name) const {
        return document["meshes"][node(name)["mesh"].get<std::size_t>()]["primitives"][0];
    }
    [[nodiscard]] const json& material(const std::string& name) const {
        return document["materials"][primitive(name)["material"].get<std::size_t>()];
    }

    /// The bytes of a view, unpacked.
    [[nodiscard]] std::string view(std::size_t index) const {
        const json& view = document["bufferViews"][index];
        if (!view.contains("extensions")) {
            return binary.substr(view.value("byteOffset", std::size_t{0}), view["byteLength"].get<std::size_t>());
        }
        const json& packed = view["extensions"]["EXT_meshopt_compression"];
        const auto count = packed["count"].get<std::size_t>();
        const auto stride = packed["byteStride"].get<std::size_t>();
        const auto* from =
            reinterpret_cast<const unsigned char*>(binary.data()) + packed["byteOffset"].get<std::size_t>();
        const auto length = packed["byteLength"].get<std::size_t>();
        std::string out(count * stride, '\0');
        const std::string mode = packed["mode"];
        const int error = mode == "ATTRIBUTES"  ? meshopt_decodeVertexBuffer(out.data(), count, stride, from, length)
                          : mode == "TRIANGLES" ? meshopt_decodeIndexBuffer(out.data(), count, stride, from, length)
                                                : meshopt_decodeIndexSequence(out.data(), count, stride, from, length);
        REQUIRE(error == 0);
        return out;
    }

    template <class T>
    [[nodiscard]] std::vector<T> numbers(std::size_t accessor_index, std::size_t components) const {
        const json& accessor = document["accessors"][accessor_index];
        const auto index = accessor["bufferView"].get<std::size_t>();
        const std::string bytes = view(index);
        const std::size_t stride = document["bufferViews"][index].value("byteStride", components * sizeof(T));
        std::vector<T> values(accessor["count"].get<std::size_t>() * components);
        for (std::size_t i = 0; i < values.size(); ++i) {
            const std::size_t at =
                accessor.value("byteOffset", std::size_t{0}) + i / components * stride + i % components * sizeof(T);
            std::memcpy(&values[i], bytes.data() + at, sizeof(T));
        }
        return values;
    }
    template <class T>
    [[nodiscard]] std::vector<T> attribute(const std::string& name, const std::string& attribute,
                                           std::size_t components) const {
        return numbers<T>(primitive(name)["attributes"].at(attribute).get<std::size_t>(), components);
    }

    /// In metres, y up, quantization undone.
    [[nodiscard]] std::vector<Vec3> positions(const std::string& name) const {
        std::vector<Vec3> result;
        const bool packed = document.contains("extensionsRequired");
        std::vector<double> flat;
        if (packed) {
            for (const std::uint16_t step : attribute<std::uint16_t>(name, "POSITION", 3)) {
                flat.push_back(step);
            }
        } else {
            for (const float value : attribute<float>(name, "POSITION", 3)) {
                flat.push_back(static_cast<double>(value));
            }
        }
        double scale = 1;
        Vec3 shift;
        for (const json& node : document["nodes"]) {
            if (node.contains("children")) {
                scale = node["scale"][0];
                shift = {node["translation"][0], node["translation"][1], node["translation"][2]};
            }
        }
        for (std::size_t i = 0; i < flat.size(); i += 3) {
            result.push_back(scale * Vec3{flat[i], flat[i + 1], flat[i + 2]} + shift);
        }
        return result;
    }
    /// In true coordinates, for a scene in the grid's axes.
    [[nodiscard]] std::vector<Vec3> places(const std::string& name) const {
        const json& extras = document["asset"]["extras"];
        const double unit = extras["metres_per_unit"];
        std::vector<Vec3> result;
        for (const Vec3& p : positions(name)) {
            result.push_back(Vec3{extras["origin"][0], extras["origin"][1], extras["origin"][2]} +
                             Vec3{p.x, -p.z, p.y} / unit);
        }
        return result;
    }
    [[nodiscard]] std::vector<Triangle> triangles(const std::string& name) const {
        const std::size_t index = primitive(name)["indices"];
        std::vector<std::uint32_t> flat;
        if (document["accessors"][index]["componentType"] == 5123) {
            for (const std::uint16_t v : numbers<std::uint16_t>(index, 1)) {
                flat.push_back(v);
            }
        } else {
            flat = numbers<std::uint32_t>(index, 1);
        }
        std::vector<Triangle> result;
        for (std::size_t i = 0; i < flat.size(); i += 3) {
            result.push_back({flat[i], flat[i + 1], flat[i + 2]});
        }
        return result;
    }

  private:
    static std::uint32_t word(const std::string& bytes, std::size_t at) {
        std::uint32_t value = 0;
        std::memcpy(&value, bytes.data() + at, 4);
        return value;
    }
};

}  // namespace terratet::testing
