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

/// Is a value what was measured, or only a bound of it ("<0.005", ">100")? Bounds are used as they are; that they are
/// bounds is carried along, also to what several values make: combine with |.
enum class Censoring : std::uint8_t {
    none = 0,
    below = 1,  ///< the truth lies at or below the value
    above = 2,  ///< at or above it
    both = 3,   ///< a mean of bounds of either kind: the truth may lie on either side
};

constexpr Censoring operator|(Censoring a, Censoring b) {
    return static_cast<Censoring>(static_cast<std::uint8_t>(a) | static_cast<std::uint8_t>(b));
}

/// "", "<", ">", "<>": as files hold it.
const char* to_string(Censoring censoring);

struct Samples {
    std::vector<Vec3> positions;         ///< frame-local
    std::vector<std::int32_t> borehole;  ///< index into Model::boreholes, or -1 for a loose sample
    std::vector<double> depth;           ///< measured depth along the borehole, in the frame's unit; NaN when loose
    std::vector<double> length;          ///< length of the log interval the value stands for; 0 for a point
    std::vector<std::vector<double>> values;       ///< [property][sample] in the measured unit; NaN: missing
    std::vector<std::vector<Censoring>> censored;  ///< [property][sample]; empty where no value at all is censored

    [[nodiscard]] Censoring censoring(std::size_t property, std::size_t sample) const {
        return censored.empty() ? Censoring::none : censored[property][sample];
    }
    /// How many values of a property are bounds.
    [[nodiscard]] std::size_t censored_count(std::size_t property) const;
    [[nodiscard]] bool any_censored() const;

    /// \pre all columns have their length
    void set_censoring(std::size_t property, std::size_t sample, Censoring censoring);

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
/// frequent class, then the smallest index, for a category) of those that have it, and censored as any of them is.
/// Keeps the first one's borehole and depth. O(n log n).
MergeReport merge_coincident(Samples& samples, const std::vector<struct Property>& properties);

}  // namespace terratet
