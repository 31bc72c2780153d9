// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// That a browser shows the page, offline and right, is tested in tests/tools/test_scene.py.
#include <cairo.h>
#include <catch2/catch.hpp>

#include <cstring>
#include <fstream>
#include <map>

#include "grid_model.hpp"
#include "io/base/crs.hpp"
#include "io/export.hpp"
#include "io/style/property_title.hpp"
#include "io/write/scene/camera.hpp"
#include "io/write/scene/coloring.hpp"
#include "io/write/scene/raster.hpp"
#include "support.hpp"

using namespace terratet;
using namespace terratet::testing;

namespace {

std::string bytes_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// What Cairo reads from a PNG: how often each colour is there.
std::map<std::uint32_t, std::size_t> colors_of(const std::string& path, int& width, int& height) {
    cairo_surface_t* surface = cairo_image_surface_create_from_png(path.c_str());
    REQUIRE(cairo_surface_status(surface) == CAIRO_STATUS_SUCCESS);
    width = cairo_image_surface_get_width(surface);
    height = cairo_image_surface_get_height(surface);
    const unsigned char* data = cairo_image_surface_get_data(surface);
    const int stride = cairo_image_surface_get_stride(surface);
    std::map<std::uint32_t, std::size_t> colors;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            std::uint32_t pixel = 0;
            std::memcpy(&pixel, data + std::ptrdiff_t{y} * stride + 4 * x, 4);
            ++colors[pixel & 0xFFFFFF];
        }
    }
    cairo_surface_destroy(surface);
    return colors;
}

RasterCorner corner(double x, double y, double z, const Color& color) {
    return {{x, y, z}, color};
}

}  // namespace

TEST_CASE("Of two triangles the nearer one is seen, whichever is drawn first, and glass lets it through") {
    const Color red{1, 0, 0};
    const Color blue{0, 0, 1};
    const auto square = [&](Raster& raster, double z, const Color& color, double opacity) {
        raster.triangle({corner(0, 0, z, color), corner(8, 0, z, color), corner(8, 8, z, color)}, opacity);
        raster.triangle({corner(0, 0, z, color), corner(8, 8, z, color), corner(0, 8, z, color)}, opacity);
    };
    for (const bool near_first : {true, false}) {
        Raster raster(8, 8, {1, 1, 1});
        square(raster, near_first ? 2 : 1, near_first ? red : blue, 1);
        square(raster, near_first ? 1 : 2, near_first ? blue : red, 1);
        for (const std::uint32_t pixel : raster.shrunk(1)) {
            REQUIRE(pixel == 0xFFFF0000);
        }
    }
    Raster raster(8, 8, {1, 1, 1});
    square(raster, 1, blue, 1);
    square(raster, 2, red, 0.5);
    CHECK(raster.shrunk(2).front() == 0xFF800080);
    square(raster, 0.5, {0, 1, 0}, 0.5);  // behind
    CHECK(raster.shrunk(2).front() == 0xFF800080);
}

TEST_CASE("Triangles that share edges cover each pixel, and colours are straight in space, not on the picture") {
    Raster fan(64, 64, {0, 0, 0});
    const Color white{1, 1, 1};
    Random random(4);
    const Vec3 middle{random(20, 40), random(20, 40), 1};
    const std::array<std::pair<double, double>, 4> round{{{0, 0}, {64, 0}, {64, 64}, {0, 64}}};
    for (std::size_t k = 0; k < 4; ++k) {
        const auto [ax, ay] = round[k];
        const auto [bx, by] = round[(k + 1) % 4];
        fan.triangle({corner(middle.x, middle.y, 1, white), corner(ax, ay, 1, white), corner(bx, by, 1, white)});
    }
    for (const std::uint32_t pixel : fan.shrunk(1)) {
        REQUIRE(pixel == 0xFFFFFFFF);
    }
    // From a place one away to one four away: half-way on the picture is a fifth of the way in space.
    Raster ramp(100, 2, {0, 0, 0});
    const Color black{0, 0, 0};
    ramp.triangle({corner(0, -50, 1, black), corner(100, -50, 0.25, white), corner(0, 50, 1, black)});
    ramp.triangle({corner(100, -50, 0.25, white), corner(100, 50, 0.25, white), corner(0, 50, 1, black)});
    CHECK((ramp.shrunk(1)[50] & 0xFF) == Approx(255 * 0.2).margin(4));
}

TEST_CASE("A camera puts the whole box into its area, the nearer corners lower, north away from an eye in the south") {
    const Box3 box{{-100, -20, -300}, {200, 50, 100}};
    const PictureArea area{50, 40, 500, 300};
    for (const double stretch : {1.0, 5.0}) {
        const Camera camera(box, stretch, 200, 25, area);
        Box3 seen;
        for (int i = 0; i < 8; ++i) {
            seen.extend(camera.onto_picture(Camera::box_corner(box, i)));
        }
        CHECK(seen.lo.x >= area.left - 1e-9);
        CHECK(seen.hi.x <= area.left + area.width + 1e-9);
        CHECK(seen.lo.y >= area.top - 1e-9);
        CHECK(seen.hi.y <= area.top + area.height + 1e-9);
        const Vec3 south = camera.onto_picture({0, 0, 50});
        const Vec3 north = camera.onto_picture({0, 0, -50});
        CHECK(south.y > north.y);
        CHECK(south.z > north.z);
        CHECK(camera.onto_picture({50, 0, 0}).x > camera.onto_picture({-50, 0, 0}).x);  // east is right
    }
}

TEST_CASE("A picture has its size, the legend's colours, and the scene in them") {
    const GridModel grid;
    const TemporaryFolder folder;
    ExportOptions options;
    options.picture_size = {640, 400};
    options.color_property = "lithology";
    write_png({grid.model, grid.mesh, grid.cells}, folder / "a.png", options);
    int width = 0;
    int height = 0;
    const auto colors = colors_of(folder / "a.png", width, height);
    CHECK(width == 640);
    CHECK(height == 400);
    for (const std::size_t c : {0, 1, 2}) {  // sections are not shaded: much of each class's own colour
        const std::uint32_t rgb = static_cast<std::uint32_t>(std::stoul(hex(class_color(c)).substr(1), nullptr, 16));
        INFO(c);
        REQUIRE(colors.contains(rgb));
        CHECK(colors.at(rgb) > 300);
    }
    options.title = "another title";
    write_png({grid.model, grid.mesh, grid.cells}, folder / "b.png", options);
    CHECK(bytes_of(folder / "a.png") != bytes_of(folder / "b.png"));
}

TEST_CASE("A title says the unit once, also where the column's header says it already") {
    const auto title = [](const std::string& name, const std::string& unit) {
        return property_title({name, unit, Scale::linear, Kind::continuous, {}});
    };
    CHECK(title("CU", "%") == "CU [%]");
    CHECK(title("As (ug/L)", "ug/L") == "As (ug/L)");
    CHECK(title("K [m/s]", "m/s") == "K [m/s]");
    CHECK(title("K (field)", "m/s") == "K (field) [m/s]");
    CHECK(title("pH", "") == "pH");
}

TEST_CASE("Legend ticks are round numbers within the range, decades for log10") {
    Property linear;
    const auto labels = [](const Property& property, const ColorRange& range) {
        std::string all;
        for (const LegendTick& tick : legend_ticks(property, range)) {
            all += (all.empty() ? "" : " ") + tick.label;
        }
        return all;
    };
    CHECK(labels(linear, {0, 1}) == "0 0.2 0.4 0.6 0.8 1");
    CHECK(labels(linear, {-30, 29}) == "\u221230 \u221220 \u221210 0 10 20");
    CHECK(labels(linear, {5, 5}) == "5");
    Property decades;
    decades.scale = Scale::log10;
    CHECK(labels(decades, {-12, -8}) == "1e-12 1e-11 1e-10 1e-9 1e-8");
    CHECK(labels(decades, {0, 2}) == "1 2 5 10 20 50 100");
    for (const LegendTick& tick : legend_ticks(decades, {-3.2, 1.7})) {
        CHECK(tick.fraction == Approx((std::log10(tick.value) + 3.2) / 4.9));
    }
    CHECK(number_text(1234567) == "1.235e6");
    CHECK(number_text(6791600, 9) == "6791600");
    CHECK(number_text(-0.00012) == "\u22121.2e-4");
}

TEST_CASE("A page says property, unit, ticks, coordinate system and holes in its text, whatever their names hold") {
    GridModel grid;
    grid.model.frame.crs_wkt = parse_crs("EPSG:3067").wkt;
    grid.model.boreholes[1].id = "<script>alert(1)</script> & \"x\"";
    grid.model.properties[0].name = "conductivity </script>";
    const TemporaryFolder folder;
    ExportOptions options;
    options.made_by = "Terratet 9: some command";
    write_html({grid.model, grid.mesh, grid.cells}, folder / "My site.html", options);
    const std::string page = bytes_of(folder / "My site.html");
    const std::string text = page.substr(0, page.find("<script"));  // before any script
    CHECK(text.find("<title>My site</title>") != std::string::npos);
    CHECK(text.find("class=\"legend\"") != std::string::npos);
    CHECK(text.find("conductivity &lt;/script&gt; [S/m]") != std::string::npos);
    CHECK(text.find("<li>0.01</li>") != std::string::npos);
    CHECK(text.find("EPSG:3067 ETRS89 / TM35FIN(E,N), unit metre") != std::string::npos);
    CHECK(text.find("<li>OL-KR1</li>") != std::string::npos);
    CHECK(text.find("<li>&lt;script&gt;alert(1)&lt;/script&gt; &amp; &quot;x&quot;</li>") != std::string::npos);
    CHECK(text.find("Terratet 9: some command") != std::string::npos);
    CHECK(text.find("Content-Security-Policy\" content=\"default-src 'none'") != std::string::npos);
    CHECK(page.find("alert(1)</script>") == std::string::npos);
    CHECK(page.find("@@") == std::string::npos);
    CHECK(page.find("http://") == page.find("http://www.w3.org"));  // names of namespaces, and nothing to fetch
    CHECK(page.size() < 2'000'000);
}
