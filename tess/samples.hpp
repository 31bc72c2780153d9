// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Samples: positions with measured values. Columns are parallel arrays of equal length.

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "tess/geometry.hpp"

namespace terratet {

inline constexpr double missing = std::numeric_limits<double>::quiet_NaN();

struct Samples {
    std::vector<Vec3> positions;         ///< frame-local
    std::vector<std::int32_t> borehole;  ///< index into Model::boreholes, or -1 for a loose sample
    std::vector<double> depth;           ///< measured depth along the borehole, in the frame's unit; NaN when loose
    std::vector<double> length;          ///< length of the log interval the value stands for; 0 for a point
    std::vector<std::vector<double>> values;  ///< [property][sample] in the measured unit; NaN: missing

    [[nodiscard]] std::size_t size() const { return positions.size(); }
};

/// The canonical order of samples: by borehole then depth, loose ones last by coordinates, ties by coordinates and then
/// values. Everything that depends on an order uses this one, so that no result depends on the order of rows in a file
/// (guarantees D3, R6). Returns a permutation of 0…n-1.
/// \pre Boreholes themselves are in canonical order (sorted by id).
std::vector<std::uint32_t> canonical_order(const Samples& samples);

/// The same samples in the order given by `order`, which may leave some out.
Samples selected(const Samples& samples, const std::vector<std::uint32_t>& order);

struct MergeReport {
    std::size_t merged = 0;  ///< samples that were folded into another at the same position
};

/// Folds samples at bit-identical positions into one, each property the mean (of log10 for the log10 scale; the most
/// frequent class, then the smallest index, for a category) of those that have it. Keeps the first one's borehole and
/// depth. O(n log n).
MergeReport merge_coincident(Samples& samples, const std::vector<struct Property>& properties);

}  // namespace terratet
