// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// Writes the hand-made model in every format for the independent readers, with the figures they must find:
///
///   make_fixture FOLDER

#include <cstdio>
#include <fstream>

#include "grid_model.hpp"
#include "io/base/crs.hpp"
#include "io/export.hpp"

int main(int argc, char** argv) {
    using namespace terratet;
    if (argc != 2) {
        std::fprintf(stderr, "usage: make_fixture FOLDER\n");
        return 2;
    }
    const std::string folder = std::string(argv[1]) + "/";
    testing::GridModel grid;
    grid.model.frame.crs_wkt = parse_crs("EPSG:3067").wkt;
    const ModelView view{grid.model, grid.mesh, grid.cells};
    ExportOptions options;
    options.overwrite = true;
    options.voxel_size = {10, 10, 10};
    options.margin = true;
    options.all_fields = true;
    for (const char* name :
         {"model.vtu", "model.glb", "model.gltf", "model.vdb", "model.tif", "model.nc", "model.csv"}) {
        export_model(view, folder + name, options);
    }
    options.enu = true;
    export_model(view, folder + "globe.glb", options);
    options.enu = false;
    options.local_origin = true;
    export_model(view, folder + "local.vdb", options);
    options.compress = false;
    export_model(view, folder + "plain.vtu", options);
    options.compress = true;
    export_model(view, folder + "packed.glb", options);
    options.format = "BLOCKS";
    export_model(view, folder + "blocks.csv", options);
    options.format = "COG";
    export_model(view, folder + "cog.tif", options);
    options.format.clear();
    options.margin = false;
    options.compress = false;
    export_model(view, folder + "clipped.vtu", options);
    export_model(view, folder + "site.vtm", options);
    export_model(view, folder + "mesh41.msh", options);
    options.msh_version_2 = true;
    export_model(view, folder + "mesh22.msh", options);
    options.color_property = "lithology";
    export_model(view, folder + "classes.glb", options);

    const auto print_box = [](std::ofstream& out, const char* name, const Box3& box, const Frame& frame) {
        const Vec3 lo = frame.to_world(box.lo);
        const Vec3 hi = frame.to_world(box.hi);
        out << '"' << name << "\": [" << lo.x << ',' << hi.x << ',' << lo.y << ',' << hi.y << ',' << lo.z << ',' << hi.z
            << "]";
    };
    std::ofstream expected(folder + "expected.json");
    expected.precision(17);
    expected << "{\"points\": " << grid.mesh.points.size() << ", \"cells\": " << grid.mesh.cells.size() << ", ";
    print_box(expected, "hull", grid.model.domain.hull, grid.model.frame);
    expected << ", ";
    print_box(expected, "extent", grid.model.domain.extent, grid.model.frame);
    expected << "}\n";
    return expected.flush() ? 0 : 1;
}
