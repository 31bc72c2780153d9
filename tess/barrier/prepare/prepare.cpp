// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/barrier/prepare/prepare.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "tess/barrier/prepare/preparer.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

double requested_spacing(const BarrierOptions& options, double l_min) {
    return options.spacing > 0 ? options.spacing : l_min;
}

void validate(const BarrierOptions& options, double l_min) {
    const double spacing = requested_spacing(options, l_min);
    for (const double length : {options.spacing, options.width, options.snap}) {
        if (!(length >= 0) || !std::isfinite(length)) {
            throw UsageError("fault spacing, width and snap must be positive lengths, or 0 for their defaults");
        }
    }
    if (!(options.width <= spacing)) {
        throw UsageError("fault width " + short_text(options.width) + " exceeds the fault spacing " +
                         short_text(spacing) +
                         ": the seeds of a pair must be nearer to each other than to the next pair; lower "
                         "`barriers.width`");
    }
    if (options.refine && options.mode != SeedMode::paired) {
        throw UsageError(
            "`barriers.refine` needs `barriers.mode` paired: triangles of unequal size are hard to certify");
    }
    if (!(options.snap <= 0.5 * spacing)) {
        throw UsageError("fault snap " + short_text(options.snap) + " exceeds half the fault spacing " +
                         short_text(spacing) +
                         ": rims would move farther than triangles are long; lower `barriers.snap`");
    }
}

}  // namespace

std::string short_text(double value) {
    std::array<char, 32> buffer{};
    std::snprintf(buffer.data(), buffer.size(), "%.6g", value);
    return buffer.data();
}

BarrierScale::BarrierScale(const BarrierOptions& options, double l_min)
    : spacing(requested_spacing(options, l_min)),
      width(options.width > 0 ? options.width : spacing / 4),
      snap(options.snap > 0 ? options.snap : spacing / 20),
      protection(1.1 * std::sqrt(0.5 * spacing * spacing + 0.25 * width * width)),
      margin(1.15 * protection),
      reach(protection + spacing),
      hull(reach + spacing) {}

double hull_margin(const BarrierOptions& options, double l_min) {
    return BarrierScale(options, l_min).hull;
}

double separating_spacing(const std::vector<Surface>& surfaces, const Box3& extent, const Frame& frame, double l_min,
                          const BarrierOptions& options, const Progress& progress) {
    validate(options, l_min);
    return BarrierPreparer(surfaces, extent, frame, BarrierScale(options, l_min), options, progress, {})
        .separating_spacing();
}

BarrierPreparation prepare_barriers(const std::vector<Surface>& surfaces, const Box3& extent, const Frame& frame,
                                    double l_min, const BarrierOptions& options, const Progress& progress,
                                    std::span<const Vec3> samples) {
    validate(options, l_min);
    return BarrierPreparer(surfaces, extent, frame, BarrierScale(options, l_min), options, progress, samples).run();
}

}  // namespace terratet
