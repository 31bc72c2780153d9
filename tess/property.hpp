// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// A property is a measured quantity: conductivity, grade, lithology. Values are always kept in the unit they were
/// measured in; scale() gives the number that differences, criteria and estimators work on.

#include <string>
#include <vector>

namespace terratet {

enum class Scale { linear, log10 };
enum class Kind { continuous, categorical };

struct Property {
    std::string name;
    std::string unit;  ///< as the user wrote it; empty when unknown
    Scale scale = Scale::linear;
    Kind kind = Kind::continuous;
    std::vector<std::string> classes;  ///< categorical only: the value i stands for classes[i]; sorted by name
    bool hard_horizons = false;  ///< horizons bar its estimation, as faults do: what lies above says nothing below

    friend bool operator==(const Property&, const Property&) = default;
};

/// The value in the property's scale: itself, or its decimal logarithm. NaN for a value that has none (NaN, or not
/// positive on the log10 scale). A category's index is returned as it is.
double to_scale(const Property& property, double value);

/// Inverse of to_scale.
double from_scale(const Property& property, double scaled);

/// |Δf| between two values in the property's scale; for a category 0 when equal and infinity otherwise. 0 when either
/// is missing, so that a missing value never calls for refinement (paper, 4.2 a).
double scaled_difference(const Property& property, double a, double b);

/// Parses `NAME[:log10][:categorical][:unit=U]`. Throws UsageError naming the unknown part.
Property parse_property(const std::string& text);

}  // namespace terratet
