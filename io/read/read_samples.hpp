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

/// Samples as they are gathered, in the target CRS, true coordinates.
struct SampleRecord {
    Vec3 position;
    std::string hole;  ///< empty: loose
    double depth = missing;
    double length = 0;
    std::vector<double> values;         ///< by property; may be shorter than the catalogue, the rest is missing
    std::vector<Censoring> censored{};  ///< by property; may be shorter, the rest is not
};

/// An interval's values stand at its middle. Rejects records of holes without collar, without or with negative depths,
/// with FROM below TO, and intervals that overlap one above in the same hole and file. Records without any value are
/// left out (noted with their number). Deepens the holes. Throws InputError: no id or depth column, no usable row, no
/// property.
void read_log(const Table& table, Holes& holes, const Crs& target, const SiteInputs& inputs,
              PropertyCatalogue& catalogue, std::vector<SampleRecord>& samples, Diagnostics& diagnostics);

/// Samples that belong to no hole.
void read_loose_samples(const PlacedTable& placed, const SiteInputs& inputs, PropertyCatalogue& catalogue,
                        std::vector<SampleRecord>& samples, Diagnostics& diagnostics);

}  // namespace terratet
