// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// How fine faults are drawn where that is left to be chosen (BuildOptions::separate_faults). L_min does for most
/// sites; where faults are large and samples few, seeds at L_min would be most of the model, and say nothing that
/// coarser ones do not.

#include "tess/build_options.hpp"
#include "tess/progress.hpp"

namespace terratet {

/// prepare_boundary() (boundary.hpp) with the coarsest fault spacing that costs nothing. That is L_min, unless faults
/// and horizons would take more than 5,000 seeds and more than ten to a sample. Then it is what takes that many, at
/// most L_max/√2, with finer triangles where samples come near (paired mode); or two thirds of that, and so on: the
/// first at which no surface is refused, each is followed within l_min/8 (19 of 20 places; all within l_min/2), no more
/// than one sample in fifty leaves that would stay at L_min, and half the seeds at least are saved. Ground and a
/// domain's walls bound the model: with them, and with a spacing, width or snap that is given, it is as asked for. What
/// is chosen goes to model.barrier_options, for edits to keep.
void prepare_boundary_at_default_spacing(const BuildOptions& options, Model& model, BuildReport& report,
                                         const Progress& progress);

}  // namespace terratet
