// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Which estimator, in words. As in gdal_grid: `NAME[:key=value]…`; estimator_catalogue.hpp lists names and options.

#include <map>
#include <optional>
#include <string>

#include "interp/anisotropy.hpp"

namespace terratet {

struct EstimatorSpec {
    std::string name = "natural";
    std::map<std::string, std::string> options;

    /// With every option that has a default written out: what the model records.
    [[nodiscard]] std::string to_string() const;

    /// With the options that were given alone.
    [[nodiscard]] std::string as_given() const;

    /// The number of an option as given; none where it is not.
    [[nodiscard]] std::optional<double> given(const std::string& key) const;

    /// The same, else its default; 0 for an option that the method does not have.
    [[nodiscard]] double number(const std::string& key) const;
};

/// Parses and checks names, options and ranges. Throws UsageError that lists what there is.
EstimatorSpec parse_estimator(const std::string& text);

/// Its options azimuth, dip, roll, ratio2 and ratio3.
Anisotropy anisotropy_of(const EstimatorSpec& spec);

/// Does it leave a variogram's parameters to be fitted?
bool needs_values(const EstimatorSpec& spec);

}  // namespace terratet
