// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The guarantees of a tolerance on a stored model: T1 between samples, T2 at them.

#include <string>

#include "tess/cells.hpp"
#include "tess/value_source.hpp"

namespace terratet {

struct ToleranceFinding {
    bool holds = true;
    std::string detail;
};

/// T1, at 20,000 random places. Without a source it says that it was not tried.
ToleranceFinding verify_between_samples(const Model& model, const TetMesh& mesh, const CellTable& cells,
                                        const ValueSource& source);

/// T2. `mesh`, `cells` and `barriers` are the model's own.
ToleranceFinding verify_samples(const Model& model, const TetMesh& mesh, const CellTable& cells,
                                const BarrierQuery& barriers);

}  // namespace terratet
