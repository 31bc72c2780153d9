// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Re-verification of a stored model's guarantees, each from its definition, by brute force or exact predicates. What
/// speaks of a second run (D3, R6, R7) is that run. `terratet check` prints one line each.

#include <string>
#include <vector>

#include "tess/build.hpp"
#include "tess/progress.hpp"

namespace terratet {

struct Verdict {
    std::string guarantee;  ///< "D1", "R3", …
    bool holds = false;
    std::string statement;  ///< what is promised, one line
    std::string detail;     ///< figures; when it fails, the first offenders with their places
};

struct VerifyOptions {
    bool all = false;  ///< T1 of every cell, not at random places alone: as many estimates as the build made
};

/// A model with what follows from it.
struct VerifiedState {
    const Model& model;
    const BarrierQuery& barriers;
    Tessellation& tessellation;  ///< R7 refines it: it stays as it is where R7 holds
    const TetMesh& mesh;
    const CellTable& cells;
    const ValueSource& source;  ///< the model's own estimator; may be empty
};

/// D1 to D3, V1, T1, T2, F1, R1 to R7 and total volume = hull box volume. `factory` makes the model's own estimator: R6
/// builds the model again from its samples and surfaces in reversed order, and R7 tries the moves of the clean-up as
/// well where a variation criterion is in force, T1 asks for values at 20,000 places. Without it they say what they did
/// not do.
///
/// Takes as long as the build did: R6, which is a build, has four fifths of it (63,800 vertices, natural neighbour),
/// R5's empty spheres 5 %, R7 and R3 2 to 3 % each, all others together 2 %, and what they share, tessellation, cell
/// table and estimator, the rest.
///
/// `edited`: the model was changed since it was built (change_model.hpp). D3 and R6 then are not asked, as they speak
/// of building, and R7 is asked of insertion alone.
std::vector<Verdict> verify(const VerifiedState& state, const ValueSourceFactory& factory = {},
                            const Progress& progress = {}, bool edited = false, const VerifyOptions& options = {});

/// The same of a model alone: what follows from it is made here.
std::vector<Verdict> verify(const Model& model, const ValueSourceFactory& factory = {}, const Progress& progress = {},
                            bool edited = false, const VerifyOptions& options = {});

}  // namespace terratet
