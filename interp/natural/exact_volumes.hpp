// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Shares in wider floats: what to fall back to when doubles do not suffice. Every way's cost is bounded: no number
/// grows with the length of a sum, and zones too large for a way go on to the next.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "interp/natural/cavity.hpp"
#include "interp/natural/weighting.hpp"

namespace terratet {

/// The share of each of the cavity's vertices in long doubles, held to 1e-12: of the radius of the home's sphere, and
/// of weights. False, and no shares, where that fails. About half a microsecond a cell and facet.
bool long_shares(const CompactDelaunay& mesh, const Cavity& cavity, const Vec3& q, Weighting weighting,
                 std::vector<double>& shares);

/// The same in floats of 113 bits; false, and no shares, where even those break Sibson's identity: |Σ wᵢpᵢ − q| above
/// 1e-15 distances to the nearest site, or a weight below −1e-15. Some ten microseconds a cell and facet.
bool wide_shares(const CompactDelaunay& mesh, const Cavity& cavity, const Vec3& q, Weighting weighting,
                 std::vector<double>& shares);

/// The same in floats of 512 bits, then of 4096: right up to the last rounding wherever coordinates are multiples of
/// 1e-60 of the largest. Milliseconds for a zone of twenty cells, at worst a tenth of a second.
bool precise_shares(const CompactDelaunay& mesh, const Cavity& cavity, const Vec3& q, Weighting weighting,
                    std::vector<double>& shares);

/// Which way shares were found.
enum class SharesFrom : std::uint8_t { long_doubles, wide, precise, laplace, barycentric };

/// The most cells and facets a zone may have for a way: a fifth of a second for the first two.
struct FallbackLimits {
    std::size_t long_doubles = 200'000;
    std::size_t wide = 20'000;
    std::size_t precise = 500;
    std::size_t laplace = 20'000;  ///< facets alone
};

/// Always shares: the first way within its limit that holds Sibson's identity of long doubles, wide floats, precise
/// floats, Laplace's weights in wide floats (no cells to sum, so that hardly anything cancels), and the barycentric
/// coordinates in the cavity's home. The latter two are simpler estimates, linear in what is linear too.
SharesFrom fallback_shares(const CompactDelaunay& mesh, const Cavity& cavity, const Vec3& q, Weighting weighting,
                           std::vector<double>& shares, const FallbackLimits& limits = {});

/// The barycentric coordinates of q in a cell, to the last rounding.
std::array<double, 4> exact_barycentric(const std::array<Vec3, 4>& corners, const Vec3& q);

}  // namespace terratet
