// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Numbers for people.

#include <cmath>

namespace terratet {

/// Short enough to type, and no smaller.
inline double rounded_up(double value) {
    const double digit = std::pow(10, std::floor(std::log10(value)) - 1);
    return digit * std::ceil(value / digit);
}

}  // namespace terratet
