// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Any bytes as a mesh of each format: refused with an InputError, or surfaces whose indices and coordinates are in
// range. The first byte chooses the format.
#include <array>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "io/read/meshes/mesh_readers.hpp"
#include "tess/error.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace terratet;
    static constexpr std::array readers{read_obj, read_ply, read_stl, read_off, read_vtp, read_dxf, read_irap};
    if (size < 2) {
        return 0;
    }
    const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
    try {
        Diagnostics diagnostics;
        MeshBuilder mesh("fuzz", SurfaceKind::fault, diagnostics);
        readers[data[0] % readers.size()](bytes, mesh);
        for (const Surface& surface : mesh.finish("")) {
            for (const Vec3& p : surface.vertices) {
                if (!is_acceptable(p)) {
                    std::abort();
                }
            }
            for (const Triangle& t : surface.triangles) {
                for (const std::uint32_t corner : t) {
                    if (corner >= surface.vertices.size()) {
                        std::abort();
                    }
                }
            }
        }
    } catch (const InputError&) {
    }
    return 0;
}
