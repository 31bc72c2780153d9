// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// From a site to a model: density edition, faults, hull box, refinement, values (paper, figure 11). The one path that
/// the command line, tests and benchmarks take.

#include <functional>
#include <memory>
#include <optional>

#include "tess/barrier_query.hpp"
#include "tess/build_options.hpp"
#include "tess/cells.hpp"
#include "tess/progress.hpp"
#include "tess/value_source.hpp"

namespace terratet {

/// A model with what is made of it on the way. The barriers look at the model, so it stays where it is.
struct TessellatedModel {
    Model model;
    std::optional<BarrierQuery> barriers;  ///< model_proximity(model)
    std::optional<Tessellation> tessellation;
    TetMesh mesh;
    CellTable cells;
};

/// Makes the estimator once samples are merged and faults are prepared: it sees the site's samples and the faults'
/// sheets, in frame-local coordinates; both stay where they are, in the model that is returned.
using ValueSourceFactory = std::function<ValueSource(const Model& model, const BarrierQuery& barriers)>;

/// Builds. Throws InputError when the site has no sample and no extent is given (nothing to build), Error when a bound
/// is exceeded, UsageError when the criteria ask for more than refine.max_vertices, before any is made, when the point
/// that names a region lies in none, or two of them in the same. The result does not depend on the order of the site's
/// rows (R6).
std::unique_ptr<TessellatedModel> build(Site site, const BuildOptions& options, const ValueSourceFactory& factory,
                                        BuildReport& report, const Progress& progress = {});

/// What the model was built with, so that its site builds the same again. \pre The model outlives it.
BuildOptions options_of(const Model& model);

}  // namespace terratet
