// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Variogram models from samples. Boreholes are dense along and sparse across, so the two are looked at apart: the
/// nugget and the short range come from pairs along the holes, sill and horizontal range from pairs across. Where those
/// have reached the sill at their shortest distance already they can't tell a range; that along the holes then holds in
/// all directions.

#include <optional>

#include "interp/anisotropy.hpp"
#include "interp/kriging/experimental_variogram.hpp"
#include "interp/estimator/variogram.hpp"
#include "tess/property.hpp"

namespace terratet {

/// What is given is kept, the rest is fitted.
struct VariogramRequest {
    VariogramFamily family = VariogramFamily::spherical;
    double nu = 1.5;
    std::optional<double> nugget{};
    std::optional<double> sill{};
    std::optional<double> range{};
    std::optional<double> ratio3{};  ///< vertical range over horizontal
    Anisotropy anisotropy{};         ///< its angles and ratio2; with any of them ratio3 is not fitted: 1 unless given
    bool categorical = false;
    bool robust = true;  ///< grades have outliers that swamp the classical variogram; of no effect for categories
    std::size_t most_samples = 5000;  ///< beyond, pairs of every second, third …; along holes at most 1000 of each
};

struct VariogramFit {
    Variogram variogram;
    std::vector<Lag> along;   ///< holes; empty without boreholes
    std::vector<Lag> across;  ///< pairs of different holes near the horizontal
    std::vector<Lag> all;     ///< whatever the direction
    bool apart = false;       ///< were the ranges along and across fitted apart?
};

/// \param values  in the property's scale, finite. Equal values, or a single one: no nugget, no sill, a range of the
///                samples' box. Never fails. About 0.5 s for 5000 samples or more.
VariogramFit fit_variogram(std::span<const Vec3> places, std::span<const double> values,
                           std::span<const std::int32_t> boreholes, const VariogramRequest& request);

/// Of the many fits where boreholes are left out.
constexpr std::size_t samples_of_fold_fit = 2000;

/// Weighted least squares with weights pairs/distance² (gstat's default): the best of all ranges, and for each of them
/// the best nugget and sill not below 0. \pre lags are not empty
Variogram fit_model(std::span<const Lag> lags, Variogram start, std::optional<double> nugget,
                    std::optional<double> sill, std::optional<double> range);

}  // namespace terratet
