// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Any bytes as a GOCAD file: refused with an InputError, or surfaces whose indices and coordinates are in range.
#include <cpl_vsi.h>

#include <cstdint>
#include <cstdlib>

#include "io/read/surfaces/read_surfaces.hpp"
#include "tess/error.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace terratet;
    Source source;
    source.path = "/vsimem/fuzz.ts";
    VSIFCloseL(VSIFileFromMemBuffer(source.path.c_str(), const_cast<GByte*>(data), size, FALSE));
    try {
        Diagnostics diagnostics;
        for (const Surface& surface : read_tsurf(source, SurfaceKind::fault, diagnostics).surfaces) {
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
    VSIUnlink(source.path.c_str());
    return 0;
}
