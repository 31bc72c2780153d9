// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/refine/beyond_limit.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "tess/base/rounding.hpp"

namespace terratet {

UsageError refinement_beyond(std::uint64_t max_vertices, std::size_t others, double l_min, double bound) {
    const auto limit = static_cast<double>(max_vertices);
    const double room = std::max(limit / 2, limit - static_cast<double>(others));
    std::ostringstream text;
    text.precision(3);
    text << "the criteria ask for more than `max_vertices` " << max_vertices
         << " (by default what fits into memory), as refinement shows: a longer `l_max` or an `l_min` of "
         << rounded_up(l_min * std::cbrt(std::max(1.0, bound / room)))
         << " (with an `l_max` of at least four times that) may fit, or a smaller `extent`";
    return UsageError(text.str());
}

}  // namespace terratet
