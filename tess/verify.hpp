// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Re-verification of a stored model's guarantees, each from its definition, by brute force or exact predicates,
/// sharing no code path with what established them. `terratet check` prints one line each.

#include <string>
#include <vector>

#include "tess/model.hpp"
#include "tess/progress.hpp"
#include "tess/value_source.hpp"

namespace terratet {

struct Verdict {
    std::string guarantee;  ///< "D1", "R3", …
    bool holds = false;
    std::string statement;  ///< what is promised, one line
    std::string detail;     ///< figures; when it fails, the first offenders with their places
};

/// D1, D2, V1, F1, R1 to R5, R7 and total volume = hull box volume. (D3 and R6 speak of two runs; tests hold them.)
/// With the model's own estimator as `source`, R7 tries the moves of the clean-up as well where a variation criterion
/// is in force; without, it says that it did not.
std::vector<Verdict> verify(const Model& model, const ValueSource& source = {}, const Progress& progress = {});

}  // namespace terratet
