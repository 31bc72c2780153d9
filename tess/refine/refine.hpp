// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Refinement itself (refinement.hpp: options, report, guarantees).

#include <span>

#include "tess/barrier_query.hpp"
#include "tess/criteria.hpp"
#include "tess/domain.hpp"
#include "tess/frame.hpp"
#include "tess/property.hpp"
#include "tess/refine/touched.hpp"
#include "tess/refinement.hpp"
#include "tess/samples.hpp"
#include "tess/tessellation.hpp"
#include "tess/value_source.hpp"

namespace terratet {

/// Refines in place and appends the new vertices' values. Values come at once where a variation criterion needs them,
/// otherwise in one batch at the end. About 100 k insertions a second on one core.
/// \param dropped  samples that are no vertices: with a tolerance a cell has to meet those in it, too.
/// \pre values are in step with the tessellation; criteria are valid; all vertices lie in domain.hull, whose faces are
///      gridded (face_grid).
RefineReport refine(Tessellation& tessellation, VertexValues& values, const Domain& domain, const Frame& frame,
                    const BarrierQuery& barriers, const Criteria& criteria, std::span<const Property> properties,
                    const ValueSource& source, const RefineOptions& options = {}, const Samples& dropped = {});

/// The same where something has changed only: other cells are judged as they were, so they would be left as they are.
/// Slivers are mended by the ordinary sweeps. Besides a walk over the vertices the work is local.
RefineReport refine_around(const Touched& touched, Tessellation& tessellation, VertexValues& values,
                           const Domain& domain, const Frame& frame, const BarrierQuery& barriers,
                           const Criteria& criteria, std::span<const Property> properties, const ValueSource& source,
                           const RefineOptions& options = {});

}  // namespace terratet
