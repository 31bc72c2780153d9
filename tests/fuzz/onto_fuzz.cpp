// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Any bytes as somebody's mesh: refused with an InputError, or nodes, cells and types in step. The first byte chooses
// the format.
#include <cpl_vsi.h>

#include <cstdint>
#include <cstdlib>

#include "io/onto/read_place_mesh.hpp"
#include "tess/error.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace terratet;
    if (size < 2) {
        return 0;
    }
    Source source;
    source.path = data[0] % 2 == 0 ? "/vsimem/fuzz.vtu" : "/vsimem/fuzz.msh";
    VSIFCloseL(VSIFileFromMemBuffer(source.path.c_str(), const_cast<GByte*>(data) + 1, size - 1, FALSE));
    try {
        const PlaceMesh mesh = read_place_mesh(source);
        if (mesh.cell_centers().size() != mesh.types.size()) {
            std::abort();
        }
    } catch (const InputError&) {
    }
    VSIUnlink(source.path.c_str());
    return 0;
}
