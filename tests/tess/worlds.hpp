// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Made-up sites for property tests: wells, faults, criteria, and the degenerate inputs that break meshers.

#include <vector>

#include "tess/build.hpp"
#include "tests/support.hpp"

namespace terratet::testing {

struct World {
    Site site;
    BuildOptions options;
    std::string description;
};

/// A world of a few hundred vertices in a box of 300 × 300 × 200 with a UTM-sized origin. Equal seeds give equal
/// worlds.
World random_world(std::uint64_t seed);

/// A planar rectangle as a fault, `dip_deg` from horizontal, triangulated at `spacing`.
Surface planar_fault(const std::string& name, const Vec3& center, double strike_deg, double dip_deg, double half_length,
                     double half_width, double spacing);

/// An analytic field in place of an estimator: deterministic, smooth but for a jump at z = −100.
ValueSourceFactory analytic_field();

/// Builds and keeps the report.
struct Built {
    Model model;
    BuildReport report;
};
Built build_world(const World& world);

}  // namespace terratet::testing
