// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// How far a property's field may be from the truth: as a share of the samples' range, or as they suggest.

#include <functional>
#include <span>
#include <vector>

#include "tess/model/retention.hpp"

namespace terratet {

/// `percent` of the range of the middle 90 % of the values, but at least a hundredth of that of the middle 99.8 %. 0
/// for a category or without two different values.
double tolerance_of_range(const Property& property, std::span<const double> values, double percent);

/// Half the standard deviation: the tolerance where none is asked for. 0 for a category or without two different
/// values.
double largest_tolerance(const Property& property, std::span<const double> values);

/// What retention makes of tolerances, one a property.
using Trial = std::function<Retention(std::span<const double> tolerance)>;

/// The gradient of the plane that the samples follow, in the property's scale; 0 where it explains less than half of
/// their variance, or for a category.
Vec3 common_trend(const Property& property, std::span<const Vec3> positions, std::span<const double> values);

/// With the largest tolerances, at most half the standard deviation and at least a quarter of the robust one (2 % of
/// the plain one), with which what is kept explains 97 % of each property's variance, and its richest hundredth within
/// 8 %: no more samples than that takes. Nothing is refined to find out.
Retention settle_retention(const Samples& samples, std::span<const Property> properties, const Trial& trial);

}  // namespace terratet
