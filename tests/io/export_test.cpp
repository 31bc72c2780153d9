// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/export.hpp"

#include <tbb/global_control.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "grid_model.hpp"
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

const char* const every_format[] = {"a.vtu", "a.glb", "a.gltf", "a.html",   "a.png", "a.vdb", "a.csv",
                                    "a.msh", "a.tif", "a.nc",   "a.blocks", "a.cog", "a.ts",  "a.obj"};

}  // namespace

TEST_CASE("A path's extension tells the format, unless a format is given") {
    CHECK(output_format("out/model.VTU") == "VTU");
    CHECK(output_format("model.glb") == "GLTF");
    CHECK(output_format("model.gltf") == "GLTF");
    CHECK(output_format("scene.HTML") == "HTML");
    CHECK(output_format("model.bin", "png") == "PNG");
    CHECK(output_format("model.txt", "csv") == "CSV");
    CHECK(output_format("model.bin", "glb") == "GLTF");
    CHECK_THROWS_AS(output_format("model.shp"), UsageError);
    CHECK_THROWS_AS(output_format("model"), UsageError);
    CHECK_THROWS_WITH(output_format("model.vtu", "SHP"), Catch::Contains(".vdb") && Catch::Contains("SHP"));
}

TEST_CASE("The default voxel size is a round 128th of the longest side") {
    const GridModel grid;
    const ModelView view{grid.model, grid.mesh, grid.cells};  // 800 × 600 × 500
    CHECK(resolved_voxel_size(view, {}) == Vec3{5, 5, 5});
    ExportOptions options;
    options.voxel_size = {0, 0, 2.5};
    CHECK(resolved_voxel_size(view, options) == Vec3{5, 5, 2.5});
}

TEST_CASE("R6: every format comes out with the same bytes each time, at any number of threads") {
    const GridModel grid;
    const ModelView view{grid.model, grid.mesh, grid.cells};
    const TemporaryFolder folder;
    ExportOptions options;
    options.overwrite = true;
    options.voxel_size = {6, 6, 6};
    for (const bool margin : {false, true}) {
        options.margin = margin;
        for (const char* name : every_format) {
            std::vector<std::string> versions;
            for (const std::size_t threads : {1, 2, 5}) {
                const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
                const OutputRecord record = export_model(view, folder / name, options);
                versions.push_back(bytes_of(folder / name));
                CHECK(record.path == folder / name);
                CHECK(record.bytes == versions.back().size());
            }
            INFO(name);
            CHECK(versions[0].size() > 1000);
            CHECK((versions[0] == versions[1]));  // not to print binary
            CHECK((versions[0] == versions[2]));
        }
    }
}

TEST_CASE("An existing output is kept unless overwriting is asked for, and a cancelled one leaves nothing") {
    const GridModel grid;
    const ModelView view{grid.model, grid.mesh, grid.cells};
    for (const char* name : every_format) {
        const TemporaryFolder folder;
        INFO(name);
        std::ofstream(folder / name) << "mine";
        CHECK_THROWS_AS(export_model(view, folder / name, {}), Error);
        CHECK(bytes_of(folder / name) == "mine");

        std::filesystem::remove(folder / name);
        ExportOptions options;
        options.voxel_size = {20, 20, 20};
        options.progress = [](std::string_view, double) { return false; };
        if (std::string(name) != "a.csv") {  // too small a table to report anything
            CHECK_THROWS_AS(export_model(view, folder / name, options), Cancelled);
            CHECK(std::filesystem::is_empty(folder.path()));
        }
        CHECK_THROWS_AS(export_model(view, folder / ("missing/" + std::string(name)), {}), Error);
    }
}
