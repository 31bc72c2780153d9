// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/model.hpp"

namespace terratet {

Tessellation tessellate(const Model& model) {
    Tessellation tessellation;
    tessellation.insert(model.vertices);
    return tessellation;
}

}  // namespace terratet
