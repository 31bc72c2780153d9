// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Changes of what was measured: the first half of an edit; change_model.hpp does the second. Places are local to the
/// site's frame. All throw UsageError for a name there is none of, and leave the site as it was.

#include <string>
#include <vector>

#include "tess/site.hpp"

namespace terratet {

/// Index of the borehole of that id.
std::size_t find_borehole(const Site& site, const std::string& id);

/// With its samples.
void remove_borehole(Site& site, const std::string& id);

/// With its path and samples, which keep their values. \param by  in frame-local lengths
void move_borehole(Site& site, const std::string& id, const Vec3& by);

/// A fault or a horizon; the ground and the domain's walls hold a model together and stay. Takes out all surfaces of
/// the name.
void remove_surface(Site& site, const std::string& name);

/// Those with a mark, in step with the samples. Boreholes stay, with or without samples.
void remove_samples(Site& site, const std::vector<bool>& marked);

/// Adds what another site holds: boreholes, samples, faults and horizons. Values go to the property of their name;
/// other properties are not taken, and named in the result. Classes that are new to a category are added to it. Throws
/// UsageError for a borehole or surface whose name there is already, or a value of the wrong kind.
/// \pre Both are in the same CRS and unit.
std::vector<std::string> add_site(Site& site, const Site& other);

}  // namespace terratet
