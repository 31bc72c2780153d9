// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Logs along holes and loose samples.

#include <string>
#include <vector>

#include "io/read/read_boreholes.hpp"
#include "io/read/read_values.hpp"

namespace terratet {

/// An interval's values stand at its middle. Rejects records of holes without collar, without or with negative depths,
/// with FROM below TO, and intervals that overlap one above in the same hole and file. Records without any value are
/// left out (noted with their number). Deepens the holes. Throws InputError: no id or depth column, no usable row, no
/// property. Samples grow in the target CRS, true coordinates; their boreholes count in the order of `holes`. Gives up
/// the table's text.
void read_log(Table& table, Holes& holes, const Crs& target, const SiteInputs& inputs, PropertyCatalogue& catalogue,
              Samples& samples, Diagnostics& diagnostics);

/// Samples that belong to no hole. Gives up the table's text and points.
void read_loose_samples(PlacedTable& placed, const SiteInputs& inputs, PropertyCatalogue& catalogue, Samples& samples,
                        Diagnostics& diagnostics);

}  // namespace terratet
