// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// That OpenVDB's Python module reads the files, and the values in them, is tested in tests/readers.
#include <catch2/catch.hpp>
#include <fstream>
#include <iterator>

#include "grid_model.hpp"
#include "io/export.hpp"
#include "io/voxels/vdb_identity.hpp"
#include "support.hpp"
#include "tess/error.hpp"

using namespace terratet;
using terratet::testing::GridModel;
using terratet::testing::TemporaryFolder;

namespace {

std::string bytes_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

constexpr std::size_t uuid_begin = 21;
constexpr std::size_t uuid_length = 36;

}  // namespace

TEST_CASE("A VDB file's identity follows from its content: equal files have equal ones, others not") {
    GridModel grid;
    const TemporaryFolder folder;
    ExportOptions options;
    options.voxel_size = {25, 25, 25};
    export_model(ModelView{grid.model, grid.mesh, grid.cells}, folder / "a.vdb", options);
    export_model(ModelView{grid.model, grid.mesh, grid.cells}, folder / "b.vdb", options);
    grid.model.vertex_values.values[0][300] *= 1.001;
    export_model(ModelView{grid.model, grid.mesh, grid.cells}, folder / "c.vdb", options);
    const std::string a = bytes_of(folder / "a.vdb");
    const std::string c = bytes_of(folder / "c.vdb");
    CHECK((a == bytes_of(folder / "b.vdb")));
    const std::string uuid = a.substr(uuid_begin, uuid_length);
    CHECK(uuid[14] == '8');  // version: the maker's own
    CHECK(uuid != c.substr(uuid_begin, uuid_length));
    make_vdb_identity_reproducible(folder / "a.vdb", "a.vdb");
    CHECK((bytes_of(folder / "a.vdb") == a));
}

TEST_CASE("What does not begin as a VDB file is left alone") {
    const TemporaryFolder folder;
    const std::string text(200, 'x');
    std::ofstream(folder / "a.vdb") << text;
    CHECK_THROWS_AS(make_vdb_identity_reproducible(folder / "a.vdb", "a.vdb"), Error);
    std::ofstream(folder / "b.vdb") << "short";
    CHECK_THROWS_AS(make_vdb_identity_reproducible(folder / "b.vdb", "b.vdb"), Error);
    CHECK(bytes_of(folder / "a.vdb") == text);
}

TEST_CASE("A lattice too large to write is refused with a voxel size that fits, and leaves nothing") {
    const GridModel grid;
    const TemporaryFolder folder;
    ExportOptions options;
    options.voxel_size = {0.01, 0.01, 0.01};
    CHECK_THROWS_AS(export_model(ModelView{grid.model, grid.mesh, grid.cells}, folder / "a.vdb", options), UsageError);
    CHECK(std::filesystem::is_empty(folder.path()));
}
