// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// How near the tessellation's field is to the estimator between the samples (guarantee T1).

#include <cstddef>

#include "tess/cells.hpp"
#include "tess/value_source.hpp"

namespace terratet {

struct AgreementCheck {
    std::size_t places = 0;          ///< looked at, outside gaps, where both have a value
    std::size_t places_excused = 0;  ///< of these, in cells that carry a reason other than smooth
    std::size_t beyond = 0;          ///< farther apart than the tolerance in some property, in cells without
    std::size_t excused = 0;         ///< likewise in cells with such a reason
};

/// At random places of the extent, the same ones every time. `mesh` and `cells` are the model's own.
AgreementCheck check_agreement(const Model& model, const TetMesh& mesh, const CellTable& cells,
                               const ValueSource& source, std::size_t places);

}  // namespace terratet
