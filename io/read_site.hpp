// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// All inputs of a model into one Site: one frame, one CRS, canonical order (docs/inputs.md).
///
/// CRS: each input's own (given with it, or in the file), else the general one; all are transformed to the target. With
/// no target, the first projected or local CRS among boreholes, samples, faults, surfaces is it; if all are geographic,
/// the UTM zone of the data's middle, noted. An input without any CRS is an InputError that names -s_srs.
///
/// Row order: the same records in any order give the same Site, but where records contradict each other (two collars of
/// one id, two stations at one depth, two values for one interval), of which the first in the file counts.

#include <cstddef>

#include "io/site_inputs.hpp"
#include "tess/diagnostics.hpp"
#include "tess/progress.hpp"
#include "tess/site.hpp"

namespace terratet {

/// Counts for the report and the summary.
struct ReadCounts {
    std::size_t boreholes = 0;
    std::size_t samples = 0;
    std::size_t faults = 0;
};

/// Reads everything. Boreholes come with their paths to the deepest log record or the length in the collar table; with
/// neither, to the last station. Samples without any value are left out. Dirty records go to `diagnostics`
/// and are skipped; throws InputError when an input cannot be used at all: missing, without CRS, without id or
/// coordinates, no numeric column, no usable row; UsageError when an option cannot be met: a column or property that is
/// in no table, a geographic target, logs without boreholes.
Site read_site(const SiteInputs& inputs, Diagnostics& diagnostics, ReadCounts& counts, const Progress& progress = {});
Site read_site(const SiteInputs& inputs, Diagnostics& diagnostics);

}  // namespace terratet
