// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Stated errors set right by experience. A method's own figure (kriging's variance, the local error of
/// local_error.hpp) knows where errors are larger; how large they are is told by boreholes that were left out: two
/// factors bring them within a standard deviation and within a half-width. Errors of real data have sharper peaks and
/// longer tails than normal ones, so that no one figure covers both 68 % and, 1.96 times, 95 %. The half-width covers
/// 95 %. The standard deviation is the figure that misses the two by equal parts, 6 percent above 68 counting as much
/// as 4 below 95: so some 68 to 72 % lie within it.
///
/// Proportional effect: where the estimate is high, errors are mostly larger. The stated figure is first scaled by the
/// estimated level, by what the errors in up to ten classes of it show (at least 100 samples and 5 boreholes each).
///
/// Few boreholes tell little of the next one. Factors are widened by Student's t of their number, and below 20 also by
/// taking a borehole yet unseen for the worst (hierarchical conformal prediction: Lee, Barber and Willett 2023,
/// arXiv:2306.06342), so that they cover at least what they say, with no bound above: from 10 boreholes down the
/// half-width is that of the worst error, and 1.96 standard deviations are no less.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace terratet {

/// An estimate and its error's two figures, in the property's scale; NaN: unknown.
struct StatedError {
    double deviation;   ///< 68 % of errors or some more lie within it
    double half_width;  ///< 95 %
};

struct Calibration {
    struct Level {
        double estimate;  ///< in the property's scale
        double relative;  ///< errors' size there over the usual one, above 0
    };

    double factor_sd = 1;
    double factor_95 = 1.96;
    std::vector<Level> levels{};  ///< by ascending estimate, straight lines between; empty: no effect of the level
    std::size_t boreholes = 0;    ///< that were left out; blocks of loose samples count as one each
    std::size_t samples = 0;      ///< whose errors were seen; 0: nothing is known, and the factors say nothing

    /// The size of errors at an estimate over the usual one; 1 without levels, the outermost level's beyond them.
    [[nodiscard]] double relative(double estimate) const;

    /// \param deviation  the method's own figure
    [[nodiscard]] StatedError stated(double estimate, double deviation) const;

    /// `uncertainty:sd=…:half_width=…:boreholes=…:samples=…[:levels=ESTIMATE/RELATIVE,…]`
    [[nodiscard]] std::string to_string() const;
};

/// Throws UsageError where the text is not to_string()'s or its numbers are out of range.
Calibration parse_calibration(const std::string& text);

/// What was said of a sample that was left out, and how far off it was.
struct JudgedError {
    double estimate;
    double error;
    double deviation;  ///< the method's own figure, learnt without the sample's borehole; NaN or 0: says nothing
};

/// O(n log n). The order of `judged` is of no effect. \param boreholes  that the samples are of
Calibration calibrate(std::span<const JudgedError> judged, std::size_t boreholes);

}  // namespace terratet
