// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// --tolerance: "P=T", "P=N%" of its samples' range, "N%" of each property's, or "auto".

#include <string>
#include <vector>

#include "tess/criteria.hpp"
#include "tess/site.hpp"

namespace terratet::tools {

/// Throws UsageError, for `option`, when there is none of that name.
std::vector<Property>::const_iterator find_property(const std::string& option, const std::string& name,
                                                    const std::vector<Property>& properties);

struct AskedTolerance {
    bool automatic = false;  ///< to be chosen from the samples
    std::string property{};  ///< empty: all
    double value = 0;
    bool percent = false;  ///< of the range of its samples
};

/// Throws UsageError for what is no tolerance.
AskedTolerance parse_tolerance(const std::string& text);

/// Throws UsageError for a property there is none of, and for a category.
void set_tolerances(const std::vector<AskedTolerance>& tolerances, const Site& site, Criteria& criteria);

}  // namespace terratet::tools
