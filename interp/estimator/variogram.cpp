// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/estimator/variogram.hpp"

#include <array>
#include <cassert>
#include <cmath>

namespace terratet {
namespace {

constexpr std::array names{"spherical", "exponential", "gaussian", "matern"};

/// Closed forms of the usual smoothnesses are a hundred times faster than Bessel's function.
double matern(double nu, double t) {
    if (t < 1e-10) {
        return 1;
    }
    if (nu == 0.5) {
        return std::exp(-t);
    }
    if (nu == 1.5) {
        return (1 + t) * std::exp(-t);
    }
    if (nu == 2.5) {
        return (1 + t + t * t / 3) * std::exp(-t);
    }
    if (t > 700) {
        return 0;
    }
    return std::exp2(1 - nu) / std::tgamma(nu) * std::pow(t, nu) * std::cyl_bessel_k(nu, t);
}

}  // namespace

const char* to_string(VariogramFamily family) {
    return names[static_cast<std::size_t>(family)];
}

VariogramFamily variogram_family(const std::string& name) {
    std::size_t i = 0;
    while (i < names.size() && name != names[i]) {
        ++i;
    }
    assert(i < names.size());
    return static_cast<VariogramFamily>(i);
}

double Variogram::correlation(double h) const {
    const double t = h / range;
    switch (family) {
        case VariogramFamily::spherical:
            return t < 1 ? 1 - t * (1.5 - 0.5 * t * t) : 0;
        case VariogramFamily::exponential:
            return std::exp(-t);
        case VariogramFamily::gaussian:
            return std::exp(-t * t);
        case VariogramFamily::matern:
            return matern(nu, t);
    }
    return 0;
}

double Variogram::practical_range() const {
    if (family == VariogramFamily::spherical) {
        return range;
    }
    double lo = 0;
    double hi = range;
    while (correlation(hi) > 0.05) {
        hi *= 2;
    }
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (lo + hi);
        (correlation(middle) > 0.05 ? lo : hi) = middle;
    }
    return 0.5 * (lo + hi);
}

}  // namespace terratet
