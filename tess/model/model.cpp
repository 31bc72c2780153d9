// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/model.hpp"

#include "tess/barrier/query/estimation_barriers.hpp"

namespace terratet {

Tessellation tessellate(const Model& model) {
    Tessellation tessellation;
    tessellation.insert(model.vertices);
    return tessellation;
}

BarrierQuery model_proximity(const Model& model) {
    return BarrierQuery(model.barriers, estimation_barriers(model, model.domain, model.barriers));
}

}  // namespace terratet
