// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Estimators: values at places from the original samples. Every method here is linear, so an estimator yields weights
/// over its sites and serves all properties measured at the same sites at once.
///
/// Specification syntax, as in gdal_grid: `NAME[:key=value]…`; estimator_catalogue.hpp lists names and options.
/// Faults are barriers: a sample counts only if the segment to it crosses no fault's sheet; weights are renormalised.
/// A place all of whose samples are hidden gets no value.

#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "interp/anisotropy.hpp"
#include "interp/calibration.hpp"
#include "tess/fault_proximity.hpp"
#include "tess/property.hpp"
#include "tess/value_source.hpp"

namespace terratet {

struct EstimatorSpec {
    std::string name = "natural";
    std::map<std::string, std::string> options;

    /// With every option that has a default written out: what the model records.
    [[nodiscard]] std::string to_string() const;

    /// With the options that were given alone.
    [[nodiscard]] std::string as_given() const;
};

/// Parses and checks names, options and ranges. Throws UsageError that lists what there is.
EstimatorSpec parse_estimator(const std::string& text);

/// What is known of a property from all of its samples.
struct ColumnTraits {
    double lowest = 0;  ///< of the values, in the scale
    double highest = 0;
    double reach = 0;  ///< reach_of (extrapolation.hpp)
};

/// The estimators of a model's properties: one for all, but for those that have their own. Text: a specification, and
/// on further lines `SPEC of PROPERTY`, `samples:lowest=…:highest=…:reach=… of PROPERTY`, and how far errors were found
/// to go, as `CALIBRATION of PROPERTY`.
struct EstimatorPlan {
    EstimatorSpec general;
    std::map<std::string, EstimatorSpec> of_property;
    std::map<std::string, ColumnTraits> traits{};       ///< of properties; missing: found from the samples
    std::map<std::string, Calibration> calibrations{};  ///< of properties; missing: found when errors are asked for

    EstimatorPlan() = default;
    EstimatorPlan(EstimatorSpec spec) : general(std::move(spec)) {}  // NOLINT: one for all is the usual plan

    [[nodiscard]] const EstimatorSpec& of(const std::string& property) const;
    [[nodiscard]] std::string to_string() const;
};

/// Of an empty text the default: natural neighbour for all. Throws UsageError as parse_estimator does, also for traits
/// or a calibration that no samples can have.
EstimatorPlan parse_estimator_plan(const std::string& text);

struct SiteWeight {
    std::uint32_t site;
    double weight;
};

/// An estimate before values are put in. Weights sum to 1 within rounding, or there are none: no value here.
/// Lengths are in the coordinates of the method's anisotropy.
struct Weights {
    std::vector<SiteWeight> terms;
    double beyond = 0;  ///< what sites have no part in, 0…1: the ghosts' share, kriging's weight of the mean
    double hidden = 0;  ///< share that ghosts and sites behind faults had before the rest was scaled to sum to 1
    Vec3 lever{};       ///< from the terms' weighted centroid to the query, of a method that makes up for it by
                        ///< slopes (Estimator::slopes); 0 where nothing is hidden
    std::vector<SiteWeight> slope_terms;  ///< whose slopes count along the lever; empty: the terms
    double distance = std::numeric_limits<double>::infinity();  ///< the shortest way to a site (ways_round.hpp)
    bool fallback = false;  ///< computed by a slower or simpler way than the method's own
    double variance = std::numeric_limits<double>::quiet_NaN();  ///< of the estimate's error in the scale's unit
                                                                 ///< squared; NaN where the method knows none

    /// As new, but for the lists' memory.
    void clear() {
        terms.clear();
        slope_terms.clear();
        *this = Weights{.terms = std::move(terms), .slope_terms = std::move(slope_terms)};
    }
};

class Slopes;

class Estimator {
  public:
    virtual ~Estimator() = default;

    /// Weights at each query, out[i] for queries[i]. Const, reentrant, and each result independent of the others.
    virtual void weights(std::span<const ValueQuery> queries, std::span<Weights> out) const = 0;

    /// Of values at its sites, a span for each column, what lies along the lever: slopes.hpp. Null for a method whose
    /// weights have none. The estimator and the values must outlive it.
    [[nodiscard]] virtual std::shared_ptr<const Slopes> slopes(std::vector<std::span<const double>> columns) const;

    /// Do its weights come with a variance of their own?
    [[nodiscard]] virtual bool has_variance() const { return false; }
};

/// \pre `spec` lacks nothing (needs_values)
/// \param sites     distinct positions, at least one
/// \param faults    barriers; must outlive the estimator; may be null
/// \param boreholes of each site its borehole, −1 for a loose one, for methods that limit how many of one borehole they
///                  take; empty: all loose
std::unique_ptr<Estimator> make_estimator(const EstimatorSpec& spec, std::vector<Vec3> sites,
                                          const FaultProximity* faults, std::vector<std::int32_t> boreholes = {});

/// Its options azimuth, dip, roll, ratio2 and ratio3.
Anisotropy anisotropy_of(const EstimatorSpec& spec);

/// The distance over which its variogram's samples tell something (Variogram::practical_range); none without one.
/// \pre `spec` lacks nothing
std::optional<double> range_of(const EstimatorSpec& spec);

/// Does it leave a variogram's parameters to be fitted?
bool needs_values(const EstimatorSpec& spec);

/// With what it leaves open fitted to values in the property's scale (variogram_fit.hpp, kriging_drift.hpp); as it is
/// when no parameter of the variogram is open.
/// \param faults  barriers; may be null
EstimatorSpec fitted_estimator(const EstimatorSpec& spec, std::span<const Vec3> sites, std::span<const double> values,
                               std::span<const std::int32_t> boreholes, Kind kind = Kind::continuous,
                               const FaultProximity* faults = nullptr, std::size_t most_samples = 5000);

}  // namespace terratet
