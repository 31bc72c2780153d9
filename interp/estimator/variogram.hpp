// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Variogram models: γ(h) = nugget + sill·(1 − ρ(h / range)) for h > 0, γ(0) = 0, with h measured along the first axis
/// of the anisotropy. Formulas and parameters are gstat's (Pebesma 2004, Computers & Geosciences 30), so that numbers
/// can go from one program to the other:
///   spherical    ρ(t) = 1 − 1.5t + 0.5t³ for t < 1, else 0
///   exponential  ρ(t) = exp(−t): 95 % of the sill at 3 ranges
///   gaussian     ρ(t) = exp(−t²): 95 % of the sill at √3 ranges
///   matern       ρ(t) = 2^(1−ν)/Γ(ν)·t^ν·K_ν(t); ν = 0.5 is the exponential

#include <string>

#include "interp/anisotropy.hpp"

namespace terratet {

enum class VariogramFamily { spherical, exponential, gaussian, matern };

/// "spherical", …
const char* to_string(VariogramFamily family);
/// \pre one of the names
VariogramFamily variogram_family(const std::string& name);

struct Variogram {
    VariogramFamily family = VariogramFamily::spherical;
    double nu = 1.5;    ///< smoothness, matern only, above 0
    double nugget = 0;  ///< variance of what varies over no distance
    double sill = 1;    ///< variance of the rest ("partial sill")
    double range = 1;   ///< length, above 0
    Anisotropy anisotropy{};

    /// ρ at a distance h ≥ 0, 1 at 0.
    [[nodiscard]] double correlation(double h) const;

    /// γ at a distance h ≥ 0.
    [[nodiscard]] double operator()(double h) const { return h > 0 ? nugget + sill * (1 - correlation(h)) : 0; }

    /// The distance at which 95 % of the sill are reached; the range itself for the spherical.
    [[nodiscard]] double practical_range() const;
};

}  // namespace terratet
