// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <ogr_spatialref.h>

#include <cstring>
#include <filesystem>
#include <map>
#include <memory>
#include <set>

#include "glb.hpp"
#include "grid_model.hpp"
#include "io/base/crs.hpp"
#include "io/export.hpp"
#include "io/style/color_map.hpp"
#include "support.hpp"
#include "tess/error.hpp"

using namespace terratet;
using namespace terratet::testing;
using json = nlohmann::json;

namespace {

Glb write(const GridModel& grid, const ExportOptions& options = {}) {
    const TemporaryFolder folder;
    write_gltf({grid.model, grid.mesh, grid.cells}, folder / "a.glb", options);
    return Glb(folder / "a.glb");
}

double area(const Glb& glb, const std::string& name) {
    const auto p = glb.places(name);
    double sum = 0;
    for (const auto& [a, b, c] : glb.triangles(name)) {
        sum += length(cross(p[b] - p[a], p[c] - p[a])) / 2;
    }
    return sum;
}

std::string named(const Glb& glb, const std::string& beginning) {
    for (const std::string& name : glb.names()) {
        if (name.starts_with(beginning)) {
            return name;
        }
    }
    FAIL("nothing begins with " << beginning);
    return {};
}

}  // namespace

TEST_CASE("A scene has a node for each section, isosurface, block, fault and borehole, and says where it is") {
    const GridModel grid;
    const Glb glb = write(grid);
    const auto has = [&](const std::string& beginning) {
        const std::vector<std::string> names = glb.names();
        return std::count_if(names.begin(), names.end(),
                             [&](const std::string& name) { return name.starts_with(beginning); });
    };
    CHECK(has("section: E-W y=") == 1);
    CHECK(has("section: N-S x=") == 1);
    CHECK(has("isosurface: conductivity=") == 3);
    CHECK(has("region ") == 2);
    CHECK(has("fault: BFZ \"100\"") == 1);
    CHECK(has("borehole: OL-KR") == 4);
    CHECK(has("extent") == 1);
    CHECK(glb.document["asset"]["extras"]["crs"] == grid.model.frame.crs_wkt);

    Box3 box;
    for (const Vec3& p : glb.places("extent")) {
        box.extend(p);
    }
    CHECK(distance(box.lo, grid.model.frame.to_world(grid.model.domain.extent.lo)) < 1e-4);
    CHECK(distance(box.hi, grid.model.frame.to_world(grid.model.domain.extent.hi)) < 1e-4);
}

TEST_CASE("A section lies in its plane and covers it within the extent, but for the gap of the fault") {
    const GridModel grid;
    ExportOptions options;
    options.sections = {parse_section("z=-250"), parse_section("90,525512,6791468"),
                        parse_section("525412,6791268,525412,6791468")};
    const Glb glb = write(grid, options);
    CHECK(area(glb, "section: z=-250") == Approx(600.0 * (800 - GridModel::gap)).epsilon(1e-4));
    for (const Vec3& p : glb.places("section: z=-250")) {
        REQUIRE(p.z == Approx(-250).margin(1e-3));
    }
    CHECK(area(glb, "section: 90,525512,6791468") == Approx(500.0 * (800 - GridModel::gap)).epsilon(1e-4));
    const std::string curtain = "section: 525412,6791268,525412,6791468";  // ends where its line does
    CHECK(area(glb, curtain) == Approx(200.0 * 500).epsilon(1e-4));
    for (const Vec3& p : glb.places(curtain)) {
        REQUIRE(p.x == Approx(525412).margin(1e-3));
        REQUIRE(p.y >= 6791268 - 1e-3);
        REQUIRE(p.y <= 6791468 + 1e-3);
    }
    options.sections = {parse_section("z=100")};
    CHECK_THROWS_WITH(write(grid, options), Catch::Contains("does not meet"));
}

TEST_CASE("Sections are told from text, or refused with what there is") {
    CHECK(parse_section("z=-12.5").point.z == -12.5);
    CHECK(parse_section("0,5,6").normal.x == Approx(1));  // runs north, looks east
    CHECK(parse_section("0,0,10,0").ends.has_value());
    for (const char* text : {"", "z=", "z=a", "1,2", "1,2,3,4,5", "1,1,1,1", "nan,2,3"}) {
        CHECK_THROWS_AS(parse_section(text), UsageError);
    }
    CHECK(parse_iso("a=b=1,2").property == "a=b");
    for (const char* text : {"", "CU", "CU=", "=1", "CU=x"}) {
        CHECK_THROWS_AS(parse_iso(text), UsageError);
    }
}

TEST_CASE("Values on the two sides of a fault do not run into each other on a section") {
    const GridModel grid;
    ExportOptions options;
    options.sections = {parse_section("z=-250")};
    const Glb glb = write(grid, options);
    const auto places = glb.places("section: z=-250");
    const auto values = glb.attribute<float>("section: z=-250", "_CONDUCTIVITY", 1);
    REQUIRE(values.size() == places.size());
    for (std::size_t v = 0; v < values.size(); ++v) {
        const Vec3 p = grid.model.frame.to_local(places[v]);
        const bool east = p.x > grid.fault_x(p.z);
        REQUIRE(std::log10(double(values[v])) == Approx(std::log10(grid.conductivity(p, east))).margin(0.15));
    }
}

TEST_CASE("An isosurface lies where its value is; those asked for are drawn, those of no use refused") {
    const GridModel grid;
    ExportOptions options;
    options.iso = {parse_iso("temperature, mean=8")};
    const Glb glb = write(grid, options);
    const std::string name = named(glb, "isosurface: temperature, mean=8");
    for (const Vec3& p : glb.places(name)) {
        REQUIRE(p.z == Approx(-280).margin(1e-3));  // 4 − z / 70
    }
    CHECK(glb.document["asset"]["extras"]["legend"]["property"] == "conductivity");
    for (const char* iso : {"gold=1", "lithology=1", "conductivity=-1"}) {
        options.iso = {parse_iso(iso)};
        CHECK_THROWS_AS(write(grid, options), UsageError);
    }
}

TEST_CASE("Beyond the extrapolation asked for sections are grey, to the line, and isosurfaces end") {
    const GridModel grid;  // 0.25 at the lowest layer of vertices, 0 elsewhere
    ExportOptions options;
    options.sections = {parse_section("525512,6791200,525512,6791700")};
    options.max_extrapolation = 0.125;
    const std::string name = "section: 525512,6791200,525512,6791700";
    const Glb glb = write(grid, options);
    const auto colors = glb.attribute<std::uint8_t>(name, "COLOR_0", 4);
    const auto far = glb.attribute<float>(name, "_EXTRAPOLATION", 1);
    const auto grey = to_linear_rgba8({0.80, 0.81, 0.83});
    std::size_t greyed = 0;
    for (std::size_t v = 0; v < far.size(); ++v) {
        const bool is_grey =
            std::abs(int(colors[4 * v]) - grey[0]) <= 1 && std::abs(int(colors[4 * v + 1]) - grey[1]) <= 1;
        greyed += is_grey;
        REQUIRE((is_grey ? double(far[v]) >= 0.125 - 1e-6 : double(far[v]) <= 0.125 + 1e-6));
    }
    CHECK(greyed > 5);
    CHECK(area(glb, name) == Approx(500 * 500).epsilon(1e-4));
    const std::string iso = named(glb, "isosurface");
    CHECK(area(glb, iso) <= area(write(grid), iso));
}

TEST_CASE("A class fills what is nearest to its vertices, in its own colour") {
    const GridModel grid;
    ExportOptions options;
    options.color_property = "lithology";
    options.sections = {parse_section("525512,6791200,525512,6791700")};
    const std::string name = "section: 525512,6791200,525512,6791700";
    const Glb glb = write(grid, options);
    const auto colors = glb.attribute<std::uint8_t>(name, "COLOR_0", 4);
    const auto places = glb.places(name);
    const auto values = glb.attribute<float>(name, "_LITHOLOGY", 1);
    std::set<int> classes;
    for (const auto& triangle : glb.triangles(name)) {
        const std::size_t c = triangle[0];
        classes.insert(static_cast<int>(values[c]));
        for (const std::uint32_t v : triangle) {  // one colour throughout
            REQUIRE(values[v] == values[c]);
            const auto expected = to_linear_rgba8(class_color(static_cast<std::size_t>(values[v])));
            REQUIRE(std::equal(expected.begin(), expected.end(), colors.begin() + 4 * v));
            // The classes change between layers of vertices 103 m apart, half-way between them at most.
            const double z = places[v].z;
            REQUIRE((values[v] == 0 ? z > -260 : z < -140));
        }
    }
    CHECK(classes == std::set<int>{0, 2});
    CHECK(area(glb, name) == Approx(500 * 500).epsilon(1e-4));
}

TEST_CASE("Blocks are closed, their volumes beside them") {
    const GridModel grid;
    const Glb glb = write(grid);
    double sum = 0;
    for (const std::string& name : {std::string("region 0"), std::string("region 1")}) {
        const auto p = glb.places(name);
        double volume = 0;
        for (const auto& [a, b, c] : glb.triangles(name)) {
            volume += dot(p[a] - p[0], cross(p[b] - p[0], p[c] - p[0])) / 6;
        }
        CHECK(volume == Approx(glb.node(name)["extras"]["volume"].get<double>()).epsilon(1e-4));
        sum += volume;
    }
    CHECK(sum == Approx(600.0 * 500 * (800 - GridModel::gap)).epsilon(1e-4));
}

TEST_CASE("Colours are the map's in linear light, grey where there is no value, which the attribute marks") {
    const GridModel grid;
    ExportOptions options;
    options.color_property = "temperature, mean";
    options.sections = {parse_section("525312.5,6791200,525312.5,6791700")};
    const std::string name = "section: 525312.5,6791200,525312.5,6791700";
    const Glb glb = write(grid, options);
    const json& extras = glb.document["asset"]["extras"];
    const auto nodata = extras["nodata"].get<double>();
    const auto range = extras["legend"]["range"].get<std::vector<double>>();
    CHECK(extras["legend"]["property"] == "temperature, mean");
    CHECK(extras["legend"]["unit"] == "°C");
    CHECK(extras["legend"]["ticks"].size() >= 3);
    const auto values = glb.attribute<float>(name, "_TEMPERATURE__MEAN", 1);
    const auto colors = glb.attribute<std::uint8_t>(name, "COLOR_0", 4);
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
    Box3 box;
    for (const Vec3& p : glb.positions("extent")) {
        box.extend(p);
    }
    CHECK(distance(box.size(), Vec3{800, 500, 600} * 0.3048) < 1e-3);
    CHECK(glb.document["asset"]["extras"]["metres_per_unit"] == 0.3048);
}

TEST_CASE("Tubes follow the boreholes, closed, and tell hole and depth") {
    const GridModel grid;
    for (const bool compress : {false, true}) {
        ExportOptions options;
        options.compress = compress;
        const Glb glb = write(grid, options);
        const json& table = glb.document["extensions"]["EXT_structural_metadata"]["propertyTables"][0];
        const std::string ids = glb.view(table["properties"]["id"]["values"].get<std::size_t>());
        CHECK(ids == "OL-KR1OL-KR2OL-KR3OL-KR4");
        for (std::size_t b = 0; b < grid.model.boreholes.size(); ++b) {
            const Borehole& hole = grid.model.boreholes[b];
            const std::string name = "borehole: " + hole.id;
            const std::uint16_t row = glb.attribute<std::uint16_t>(name, "_FEATURE_ID_0", 1)[0];
            const std::string offsets = glb.view(table["properties"]["id"]["stringOffsets"].get<std::size_t>());
            std::uint32_t begin = 0;
            std::memcpy(&begin, offsets.data() + 4 * std::size_t{row}, 4);
            CHECK(ids.substr(begin, hole.id.size()) == hole.id);
            const auto depth = glb.attribute<float>(name, "_DEPTH", 1);
            const auto places = glb.places(name);
            double farthest = 0;
            double nearest = 1e9;
            for (std::size_t v = 0; v < places.size(); ++v) {
                const Vec3 p = grid.model.frame.to_local(places[v]);
                double away = 1e9;
                double along = 0;
                for (std::size_t i = 0; i + 1 < hole.path.size(); ++i) {
                    const Vec3 on = closest_point_on_triangle(p, hole.path[i], hole.path[i + 1], hole.path[i + 1]);
                    if (distance(p, on) < away) {
                        away = distance(p, on);
                        along = hole.path_depth[i] + distance(hole.path[i], on);
                    }
                }
                farthest = std::max(farthest, away);
                nearest = std::min(nearest, away);
                REQUIRE(double(depth[v]) == Approx(along).margin(2));
            }
            CHECK(nearest < 0.1);  // the middles of the lids
            CHECK(farthest > 2);
            CHECK(farthest < 6);
            // Closed: what is within has the volume of a prism round the path, and each edge its twin.
            std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
            for (const auto& [x, y, z] : glb.triangles(name)) {
                ++edges[{x, y}], ++edges[{y, z}], ++edges[{z, x}];
            }
            std::size_t open = 0;
            for (const auto& [edge, times] : edges) {
                const bool lid = places[edge.first] == places[edge.second];
                open += !lid && !edges.contains({edge.second, edge.first}) ? 1 : 0;
            }
            CHECK(open == 0);
        }
    }
}

TEST_CASE("Packed scenes are those that are not, to the step of their 16 bits") {
    const GridModel grid;
    ExportOptions options;
    const Glb plain = write(grid, options);
    options.compress = true;
    const Glb packed = write(grid, options);
    CHECK(packed.binary.size() < 0.5 * static_cast<double>(plain.binary.size()));
    CHECK(packed.document["extensionsRequired"] == json::array({"EXT_meshopt_compression", "KHR_mesh_quantization"}));
    for (const std::string& name : plain.names()) {
        const auto a = plain.positions(name);
        const auto b = packed.positions(name);
        REQUIRE(a.size() == b.size());
        for (std::size_t v = 0; v < a.size(); ++v) {
            REQUIRE(distance(a[v], b[v]) < 900.0 / 65535);
        }
        if (name.starts_with("section")) {
            CHECK(plain.attribute<float>(name, "_CONDUCTIVITY", 1) ==
                  packed.attribute<float>(name, "_CONDUCTIVITY", 1));
            CHECK(plain.triangles(name).size() == packed.triangles(name).size());
        }
    }
}

TEST_CASE("With axes of the globe every place is where PROJ has it, wide models too") {
    GridModel grid;
    grid.model.frame.crs_wkt = parse_crs("EPSG:3067").wkt;
    grid.model.frame.origin = {590000, 7600000, 0};  // far from the central meridian, 11.8 km each way
    grid.model.domain.extent = {{-11800, -11800, -500}, {11800, 11800, 0}};
    ExportOptions options;
    options.enu = true;
    options.sections = {parse_section("z=-250")};
    const Glb glb = write(grid, options);
    const json& extras = glb.document["asset"]["extras"];
    const auto m = extras["enu_to_ecef"].get<std::vector<double>>();
    REQUIRE(m.size() == 16);
    std::vector<Vec3> corners;
    for (int i = 0; i < 8; ++i) {
        const Box3& e = grid.model.domain.extent;
        corners.push_back(grid.model.frame.to_world(
            {(i & 1) != 0 ? e.hi.x : e.lo.x, (i & 2) != 0 ? e.hi.y : e.lo.y, (i & 4) != 0 ? e.hi.z : e.lo.z}));
    }
    // By PROJ in two steps: in plan to longitude and latitude, with the height to earth-centred coordinates.
    const auto transformed = [](int from, int to, Vec3& p) {
        OGRSpatialReference source;
        OGRSpatialReference target;
        source.importFromEPSG(from);
        target.importFromEPSG(to);
        source.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
        target.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
        const std::unique_ptr<OGRCoordinateTransformation> by(OGRCreateCoordinateTransformation(&source, &target));
        REQUIRE(by->Transform(1, &p.x, &p.y, &p.z));
    };
    for (Vec3& corner : corners) {
        const double height = corner.z;
        transformed(3067, 4326, corner);
        corner.z = height;
        transformed(4979, 4978, corner);
    }
    const auto positions = glb.positions("extent");
    double apart = 0;
    for (const Vec3& corner : corners) {
        double nearest = 1e9;
        for (const Vec3& p : positions) {
            const Vec3 enu{p.x, -p.z, p.y};
            const Vec3 ecef{m[0] * enu.x + m[4] * enu.y + m[8] * enu.z + m[12],
                            m[1] * enu.x + m[5] * enu.y + m[9] * enu.z + m[13],
                            m[2] * enu.x + m[6] * enu.y + m[10] * enu.z + m[14]};
            nearest = std::min(nearest, distance(ecef, corner));
        }
        apart = std::max(apart, nearest);
    }
    CHECK(apart < 0.01);                               // what single precision leaves at 17 km
    CHECK(extras["convergence"].get<double>() > 1.5);  // east of the central meridian grid north is east of true north
    options.enu = false;
    CHECK(write(grid, options).document["asset"]["extras"]["lat"].get<double>() == Approx(68.5).margin(0.2));
    grid.model.frame.crs_wkt.clear();
    options.enu = true;
    CHECK_THROWS_AS(write(grid, options), UsageError);
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

TEST_CASE("A model without boreholes, faults or properties still makes a scene; with faults alone its blocks show") {
    GridModel grid;
    grid.model.boreholes.clear();
    grid.model.properties.clear();
    grid.model.samples = {};
    grid.model.vertex_values.values.clear();
    const Glb blocks = write(grid);
    const auto colors = blocks.attribute<std::uint8_t>(named(blocks, "section: E-W"), "COLOR_0", 4);
    std::set<std::vector<std::uint8_t>> different;
    for (std::size_t v = 0; v < colors.size(); v += 4) {
        different.insert(
            {colors.begin() + static_cast<std::ptrdiff_t>(v), colors.begin() + static_cast<std::ptrdiff_t>(v) + 4});
    }
    CHECK(different.size() == 2);

    grid.model.barriers.clear();
    for (Vertex& vertex : grid.model.vertices) {
        vertex.role = Role::inserted;
        vertex.owner = -1;
        vertex.side = 0;
    }
    grid.cells = describe_cells(grid.model, grid.mesh);
    CHECK(write(grid).names().size() == 3);  // two sections and the frame
}
