// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Where estimates from natural neighbours, Laplace's and linear in cells change when some sites come and go. An
/// estimate depends on
///   - the cells of its conflict zone and those next to them: what holds the place in the sphere of a cell that is not
///     in both tessellations, or of a neighbour of such, changes;
///   - slopes at its natural neighbours: what holds it in the sphere of a cell of a site whose slope may be another;
///   - the way to the nearest site: a site that comes or goes within that distance, or beyond a turn round barriers.
/// Rather too many places than too few: all others have the same values to the last bit.

#include <memory>

#include "interp/estimator/estimator.hpp"
#include "interp/natural/slopes.hpp"
#include "interp/sites/site_mesh.hpp"

namespace terratet {

struct SlopedSites {
    const SiteMesh& sites;
    const Slopes& slopes;
};

/// Null: anywhere, for the sites' box is another, or they are flat and tilted. Slopes are carried over. Barriers are
/// the same. All must outlive the result.
std::unique_ptr<const ChangedPlaces> changed_places(const SlopedSites& before, const SlopedSites& after,
                                                    const ExchangedSites& exchanged);

}  // namespace terratet
