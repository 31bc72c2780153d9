// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Which samples a tolerance keeps (DESIGN §4.1): the local l_min that density edition needs so that what lies between
/// kept samples, linear along a hole or in the loose ones' own tessellation, is within the tolerance of those dropped.

#include <span>
#include <vector>

#include "tess/model/resolution.hpp"
#include "tess/progress.hpp"
#include "tess/property.hpp"
#include "tess/samples.hpp"

namespace terratet {

/// How well what is kept would represent all samples of a property.
struct Agreement {
    double r2 = 1;             ///< share of the variance explained; 1 where there is none
    double richest_ratio = 1;  ///< mean at the richest hundredth of the samples, over their own mean
};

struct Retention {
    std::vector<FinePlace> fine;       ///< for Criteria::fine
    std::vector<Agreement> agreement;  ///< one a property; of those without tolerance as new
};

/// In rounds: all places where the field misses a dropped sample get half the l_min they have, until none is missed or
/// l_min is down to half the distance to the next sample, or `floor`. Does not depend on the order of the input (D3).
/// \param tolerance  in the property's scale, by property; 0: none.
/// \param candidates  the samples that may be kept (unprotected()), in canonical order.
/// \param resolution  its fine places are replaced on the way. O(n log n) a round, some ten rounds.
Retention retain(const Samples& samples, std::span<const Property> properties, std::span<const double> tolerance,
                 std::span<const std::uint32_t> candidates, ResolutionField& resolution, double floor,
                 const Poll& poll = {});

}  // namespace terratet
