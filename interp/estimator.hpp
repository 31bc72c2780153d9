// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Estimators: values at places from the original samples. Every method here is linear, so an estimator yields weights
/// over its sites and serves all properties measured at the same sites at once.
///
/// Specification syntax, as in gdal_grid: `NAME[:key=value]…`
///   nearest                                        the nearest visible sample
///   idw[:power=2][:radius=R][:max_points=12]       inverse distance weighting over the nearest visible samples
///   natural                                        Sibson's natural neighbours (natural_neighbour.hpp). Default
/// Faults are barriers: a sample counts only if the segment to it crosses no fault's sheet; weights are renormalised.
/// A place all of whose samples are hidden gets no value.

#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "tess/fault_proximity.hpp"
#include "tess/value_source.hpp"

namespace terratet {

struct EstimatorSpec {
    std::string name = "natural";
    std::map<std::string, std::string> options;

    /// With every option that has a default written out: what the model records.
    [[nodiscard]] std::string to_string() const;
};

/// Parses and checks names, options and ranges. Throws UsageError that lists what there is.
EstimatorSpec parse_estimator(const std::string& text);

struct SiteWeight {
    std::uint32_t site;
    double weight;
};

/// An estimate before values are put in. Weights sum to 1 within rounding, or there are none: no value here.
struct Weights {
    std::vector<SiteWeight> terms;
    double extrapolation = 0;  ///< share of the estimate that lies beyond the sites' reach, 0…1
    bool fallback = false;     ///< computed by a slower or simpler way than the method's own
    double variance = std::numeric_limits<double>::quiet_NaN();  ///< of the estimate's error in the scale's unit
                                                                 ///< squared; NaN where the method knows none
};

class Estimator {
  public:
    virtual ~Estimator() = default;

    /// Weights at each query, out[i] for queries[i]. Const, reentrant, and each result independent of the others.
    virtual void weights(std::span<const ValueQuery> queries, std::span<Weights> out) const = 0;

    /// Do its weights come with a variance of their own?
    [[nodiscard]] virtual bool has_variance() const { return false; }
};

/// \param sites     distinct positions, at least one
/// \param faults    barriers; must outlive the estimator; may be null
/// \param boreholes of each site its borehole, −1 for a loose one, for methods that limit how many of one borehole they
///                  take; empty: all loose
std::unique_ptr<Estimator> make_estimator(const EstimatorSpec& spec, std::vector<Vec3> sites,
                                          const FaultProximity* faults, std::vector<std::int32_t> boreholes = {});

}  // namespace terratet
