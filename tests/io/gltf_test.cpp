// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// That the Khronos validator accepts the files and three.js draws them is tested in tests/readers.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>

#include "grid_model.hpp"
#include "io/export.hpp"
#include "io/write/color_map.hpp"
#include "support.hpp"
#include "tess/error.hpp"

using namespace terratet;
using nlohmann::json;
using terratet::testing::GridModel;
using terratet::testing::TemporaryFolder;

namespace {

/// A GLB taken apart by the specification's container format.
struct Glb {
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

    [[nodiscard]] const json& primitive(const std::string& node_name) const {
        for (const json& node : document["nodes"]) {
            if (node["name"] == node_name) {
                return document["meshes"][node["mesh"].get<std::size_t>()]["primitives"][0];
            }
        }
        FAIL("no node " << node_name);
        return document;
    }

    template <class T>
    [[nodiscard]] std::vector<T> attribute(const std::string& node_name, const std::string& name) const {
        const json& primitive_of = primitive(node_name);
        const json& accessor = document["accessors"][primitive_of["attributes"][name].get<std::size_t>()];
        const json& view = document["bufferViews"][accessor["bufferView"].get<std::size_t>()];
        std::vector<T> values(view["byteLength"].get<std::size_t>() / sizeof(T));
        std::memcpy(values.data(), binary.data() + view.value("byteOffset", std::size_t{0}), values.size() * sizeof(T));
        return values;
    }

  private:
    static std::uint32_t word(const std::string& bytes, std::size_t at) {
        std::uint32_t value = 0;
        std::memcpy(&value, bytes.data() + at, 4);
        return value;
    }
};

Glb write(const GridModel& grid, const ExportOptions& options = {}) {
    const TemporaryFolder folder;
    write_gltf({grid.model, grid.mesh, grid.cells}, folder / "a.glb", options);
    return Glb(folder / "a.glb");
}

std::vector<std::string> node_names(const Glb& glb) {
    std::vector<std::string> names;
    for (const json& node : glb.document["nodes"]) {
        names.push_back(node["name"]);
    }
    return names;
}

}  // namespace

TEST_CASE("A scene names its nodes and says where in the world it is") {
    const GridModel grid;
    const Glb glb = write(grid);
    const std::vector<std::string> names = node_names(glb);
    CHECK(names.size() == 5);
    CHECK(names[0] == "domain boundary");
    CHECK(names[1].starts_with("region "));
    CHECK(names[2].starts_with("region "));
    CHECK(names[3] == "fault: BFZ \"100\"");
    CHECK(names[4] == "boreholes");

    const json& extras = glb.document["asset"]["extras"];
    CHECK(extras["crs"] == grid.model.frame.crs_wkt);
    const auto origin = extras["origin"].get<std::vector<double>>();
    // The domain's faces, moved back by what extras say, are the extent.
    Box3 box;
    const auto positions = glb.attribute<float>("domain boundary", "POSITION");
    for (std::size_t i = 0; i < positions.size(); i += 3) {
        box.extend({origin[0] + double(positions[i]), origin[1] - double(positions[i + 2]),
                    origin[2] + double(positions[i + 1])});
    }
    const Vec3 lo = grid.model.frame.to_world(grid.model.domain.extent.lo);
    const Vec3 hi = grid.model.frame.to_world(grid.model.domain.extent.hi);
    CHECK(distance(box.lo, lo) < 1e-4);
    CHECK(distance(box.hi, hi) < 1e-4);
}

TEST_CASE("The domain boundary is the closed surface of the extent, seen from within") {
    const GridModel grid;
    const Glb glb = write(grid);
    const auto p = glb.attribute<float>("domain boundary", "POSITION");
    const auto n = glb.attribute<float>("domain boundary", "NORMAL");
    const json& accessor = glb.document["accessors"][glb.primitive("domain boundary")["indices"].get<std::size_t>()];
    const json& view = glb.document["bufferViews"][accessor["bufferView"].get<std::size_t>()];
    std::vector<std::uint32_t> index(accessor["count"].get<std::size_t>());
    std::memcpy(index.data(), glb.binary.data() + view["byteOffset"].get<std::size_t>(), 4 * index.size());
    const auto at = [](const std::vector<float>& v, std::size_t i) {
        return Vec3{double(v[3 * i]), double(v[3 * i + 1]), double(v[3 * i + 2])};
    };
    double area = 0;
    double volume = 0;
    for (std::size_t t = 0; t < index.size(); t += 3) {
        const Vec3 a = at(p, index[t]), b = at(p, index[t + 1]), c = at(p, index[t + 2]);
        const Vec3 normal = cross(b - a, c - a);
        area += length(normal) / 2;
        volume += dot(a, cross(b, c)) / 6;
        REQUIRE(dot(normal, at(n, index[t])) > 0);  // normals on the side the triangle is seen from
    }
    CHECK(area == Approx(2 * (800 * 600 + 800 * 500 + 600 * 500)).epsilon(1e-6));
    CHECK(volume == Approx(-800.0 * 600 * 500).epsilon(1e-6));
}

TEST_CASE("Region walls lie on the fault's two sides, each with its own side's values") {
    const GridModel grid;
    const Glb glb = write(grid);
    std::set<bool> sides;
    for (const std::string& name : node_names(glb)) {
        if (!name.starts_with("region")) {
            continue;
        }
        const auto positions = glb.attribute<float>(name, "POSITION");
        const auto values = glb.attribute<float>(name, "_CONDUCTIVITY");
        const auto origin = glb.document["asset"]["extras"]["origin"].get<std::vector<double>>();
        const Vec3 shift = Vec3{origin[0], origin[1], origin[2]} - grid.model.frame.origin;
        const bool east = double(values[0]) > grid.conductivity({400, 300, -250}, false) * 8;
        sides.insert(east);
        for (std::size_t v = 0; v < values.size(); ++v) {
            const Vec3 p =
                Vec3{double(positions[3 * v]), -double(positions[3 * v + 2]), double(positions[3 * v + 1])} + shift;
            REQUIRE(p.x - grid.fault_x(p.z) == Approx(east ? grid.gap / 2 : -grid.gap / 2).margin(1e-3));
            REQUIRE(std::log10(double(values[v])) == Approx(std::log10(grid.conductivity(p, east))).margin(0.1));
        }
    }
    CHECK(sides.size() == 2);
}

TEST_CASE("Colours are the map's in linear light, grey where there is no value, which the attribute marks") {
    const GridModel grid;
    ExportOptions options;
    options.color_property = "temperature, mean";
    const Glb glb = write(grid, options);
    const json& extras = glb.document["asset"]["extras"];
    const auto nodata = extras["nodata"].get<double>();
    const auto range = extras["legend"]["range"].get<std::vector<double>>();
    CHECK(extras["legend"]["property"] == "temperature, mean");
    CHECK(extras["legend"]["unit"] == "°C");
    const auto values = glb.attribute<float>("domain boundary", "_TEMPERATURE__MEAN");
    const auto colors = glb.attribute<std::uint8_t>("domain boundary", "COLOR_0");
    REQUIRE(colors.size() == 4 * values.size());
    const ColorMap viridis = ColorMap::named("viridis");
    std::size_t missing_values = 0;
    for (std::size_t v = 0; v < values.size(); ++v) {
        const bool is_missing = double(values[v]) == nodata;
        missing_values += is_missing;
        const Color expected =
            is_missing ? missing_color : viridis.at((double(values[v]) - range[0]) / (range[1] - range[0]));
        const auto bytes = to_linear_rgba8(expected);
        for (std::size_t k = 0; k < 4; ++k) {
            REQUIRE(std::abs(int(colors[4 * v + k]) - int(bytes[k])) <= 1);
        }
    }
    CHECK(missing_values > 3);
    CHECK(to_linear_rgba8({0.5, 0, 1})[0] == 55);  // sRGB 0.5 is 0.2140 in linear light
}

TEST_CASE("Lengths in feet become metres") {
    GridModel grid;
    grid.model.frame.unit = "foot";
    grid.model.frame.metres_per_unit = 0.3048;
    const Glb glb = write(grid);
    const json& primitive = glb.primitive("domain boundary");
    const json& accessor = glb.document["accessors"][primitive["attributes"]["POSITION"].get<std::size_t>()];
    const auto lo = accessor["min"].get<std::vector<double>>();
    const auto hi = accessor["max"].get<std::vector<double>>();
    CHECK(hi[0] - lo[0] == Approx(800 * 0.3048));
    CHECK(hi[1] - lo[1] == Approx(500 * 0.3048));
    CHECK(hi[2] - lo[2] == Approx(600 * 0.3048));
    CHECK(glb.document["asset"]["extras"]["metres_per_unit"] == 0.3048);
}

TEST_CASE("Tubes follow the boreholes, closed at both ends") {
    const GridModel grid;
    const Glb glb = write(grid);
    const auto p = glb.attribute<float>("boreholes", "POSITION");
    const auto origin = glb.document["asset"]["extras"]["origin"].get<std::vector<double>>();
    const Vec3 shift = Vec3{origin[0], origin[1], origin[2]} - grid.model.frame.origin;
    double farthest = 0;
    double nearest = 1e9;
    for (std::size_t v = 0; v < p.size(); v += 3) {
        const Vec3 q = Vec3{double(p[v]), -double(p[v + 2]), double(p[v + 1])} + shift;
        double away = 1e9;
        for (const Borehole& hole : grid.model.boreholes) {
            for (std::size_t i = 0; i + 1 < hole.path.size(); ++i) {
                away = std::min(
                    away, distance(q, closest_point_on_triangle(q, hole.path[i], hole.path[i + 1], hole.path[i + 1])));
            }
        }
        farthest = std::max(farthest, away);
        nearest = std::min(nearest, away);
    }
    CHECK(nearest < 1e-3);  // the centres of the caps
    CHECK(farthest > 2);
    CHECK(farthest < 6);
}

TEST_CASE(".gltf is one file, its buffer within") {
    const GridModel grid;
    const TemporaryFolder folder;
    write_gltf({grid.model, grid.mesh, grid.cells}, folder / "a.gltf", {});
    std::ifstream file(folder / "a.gltf");
    const json document = json::parse(file);
    CHECK(document["buffers"][0]["uri"].get<std::string>().starts_with("data:application/octet-stream;base64,"));
    CHECK(std::distance(std::filesystem::directory_iterator(folder.path()), {}) == 1);
}

TEST_CASE("A property or colour map that does not exist is refused with those that do") {
    const GridModel grid;
    ExportOptions options;
    options.color_property = "gold";
    CHECK_THROWS_WITH(write(grid, options), Catch::Contains("gold") && Catch::Contains("conductivity"));
    options.color_property.clear();
    options.color_map = "rainbow";
    CHECK_THROWS_WITH(write(grid, options), Catch::Contains("rainbow") && Catch::Contains("cividis"));
}

TEST_CASE("A model without boreholes, faults or properties still makes a scene") {
    GridModel grid;
    grid.model.boreholes.clear();
    grid.model.barriers.clear();
    grid.model.properties.clear();
    grid.model.samples = {};
    grid.model.vertex_values.values.clear();
    for (Vertex& vertex : grid.model.vertices) {
        vertex.role = Role::inserted;
        vertex.owner = -1;
        vertex.side = 0;
    }
    grid.cells = describe_cells(grid.model, grid.mesh);
    CHECK(node_names(write(grid)) == std::vector<std::string>{"domain boundary"});
}
