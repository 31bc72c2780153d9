// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// That VTK reads the files is tested in tests/readers.
#include <catch2/catch.hpp>
#include <cstring>
#include <fstream>
#include <iterator>

#include "grid_model.hpp"
#include "io/export.hpp"
#include "support.hpp"

using namespace terratet;
using terratet::testing::GridModel;
using terratet::testing::TemporaryFolder;

TEST_CASE("VTU holds true coordinates bit for bit, little more than its arrays, and escapes names") {
    GridModel grid;
    grid.model.properties[1].name = "a<b&\"c\"";
    grid.model.properties[2].name = "role";
    const ModelView view{grid.model, grid.mesh, grid.cells};
    const TemporaryFolder folder;
    ExportOptions options;
    options.margin = true;
    options.compress = false;
    write_vtu(view, folder / "a.vtu", options);
    std::ifstream file(folder / "a.vtu", std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(file), {}};

    CHECK(text.find("Name=\"a&lt;b&amp;&quot;c&quot;\"") != std::string::npos);
    CHECK(text.find("Name=\"role_2\"") != std::string::npos);  // role is the writer's own
    CHECK(text.find("header_type=\"UInt64\"") != std::string::npos);
    const std::size_t appended = text.find("<AppendedData encoding=\"raw\">\n_");
    REQUIRE(appended != std::string::npos);
    const char* data = text.data() + appended + std::strlen("<AppendedData encoding=\"raw\">\n_");
    std::uint64_t length = 0;
    std::memcpy(&length, data, sizeof length);
    REQUIRE(length == 24 * grid.mesh.points.size());
    for (std::size_t v = 0; v < grid.mesh.points.size(); ++v) {
        Vec3 p;
        std::memcpy(&p, data + 8 + 24 * v, 24);
        REQUIRE(p == grid.model.frame.to_world(grid.mesh.points[v]));
    }
}
