// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Estimates of a model's properties from its samples (all of them, dropped ones included), with what is known about
/// their quality. Properties measured at the same samples share one estimator, unless a variogram is fitted to each.

#include <atomic>
#include <cstdint>
#include <memory>
#include <set>
#include <span>
#include <vector>

#include "interp/estimator_plan.hpp"
#include "tess/barrier_query.hpp"
#include "tess/model.hpp"
#include "tess/value_source.hpp"

namespace terratet {

class ChangedPlaces;

struct EstimatorCounters {
    std::atomic<std::uint64_t> queries{0};
    std::atomic<std::uint64_t> fallbacks{0};
};

/// Where a standard deviation comes from.
enum class DeviationSource : std::uint8_t {
    none,             ///< a category (its entropy says it), or too few boreholes to leave one out
    kriging,          ///< the square root of the kriging variance, calibrated
    cross_validated,  ///< the local error of leaving boreholes out (local_error.hpp), calibrated
};

/// "none", "kriging", "cross-validated".
const char* to_string(DeviationSource source);

/// One property at each query, columns of equal length.
struct PropertyEstimates {
    std::vector<double> value;       ///< measured unit, or a class's index; NaN: no value
    std::vector<double> deviation;   ///< standard deviation in the property's scale (decades for log10); NaN: unknown
    std::vector<double> half_width;  ///< of the interval about the value that holds 95 %, in the property's scale
    std::vector<double> extrapolation;   ///< 0…1; 1 where there is no value
    std::vector<std::uint32_t> samples;  ///< how many samples have a weight; 0: no value
    DeviationSource deviation_source = DeviationSource::none;
    Calibration calibration;  ///< how deviation and half-width follow from the method's own figure

    /// Categories only. Weights summed by class, negative sums cut off, scaled to sum to 1; NaN without a value.
    std::vector<std::vector<double>> probability;  ///< [class][query]
    std::vector<double> entropy;                   ///< of the probabilities, in bits; 0: certain
};

struct ModelEstimatorOptions {
    bool uncertainty = false;      ///< prepares standard deviations: up to 20 further estimators
    std::size_t error_folds = 20;  ///< boreholes share so many folds
};

class ModelEstimator {
  public:
    /// Samples are at distinct positions (merge_coincident). Both `model` and `faults` must outlive this.
    /// What `plan` wants chosen (anisotropy=auto, the estimator auto) is chosen, what it leaves open is fitted to each
    /// property's samples, and with options.uncertainty the calibrations that it lacks are found (plan() tells).
    ModelEstimator(const Model& model, const BarrierQuery& barriers, const EstimatorPlan& plan,
                   std::shared_ptr<EstimatorCounters> counters = {}, const ModelEstimatorOptions& options = {});
    ~ModelEstimator();

    /// Values only, the refiner's way. In each property's measured unit; a category gets the class of the largest
    /// summed weight (ties: the smaller index). A query exactly on a sample returns its value. The extrapolation is the
    /// largest among the properties that have a value there, 1 where none has. Parallel (TBB); results do not depend on
    /// it, nor on the batch.
    [[nodiscard]] ValueBatch values(std::span<const ValueQuery> queries) const;

    /// Everything, one entry a property of the model; a property without samples has no values. Deviations are unknown
    /// unless options.uncertainty was set.
    [[nodiscard]] std::vector<PropertyEstimates> estimates(std::span<const ValueQuery> queries) const;

    /// Which of these places, estimated by `before`, may have other values here: of the model's next state, with the
    /// same barriers and properties. What both know of slopes is carried over. Called before anything is estimated
    /// here; all that is judged has been estimated by `before`, or judged the same since. The others have the same
    /// values, to the last bit. \param before_of  of each sample here its number in the model of `before`; −1: none
    class Changes;
    [[nodiscard]] std::shared_ptr<const Changes> changes_since(const ModelEstimator& before,
                                                               std::span<const std::int64_t> before_of) const;

    /// With everything fitted: what a model keeps, so that its estimator stays as it was.
    [[nodiscard]] const EstimatorPlan& plan() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Where values may differ.
class ModelEstimator::Changes {
  public:
    /// \param extrapolation  of each place, as it was estimated. In parallel.
    [[nodiscard]] std::vector<std::uint8_t> at(std::span<const ValueQuery> places,
                                               std::span<const double> extrapolation) const;

  private:
    friend class ModelEstimator;
    struct OfGroup {
        std::shared_ptr<const ChangedPlaces> places;
        double reach;  ///< the farthest of its columns'
    };
    const BarrierQuery* barriers_ = nullptr;
    bool everywhere_ = false;
    std::vector<OfGroup> groups_;
    std::set<Vec3> wide_;  ///< places whose values any change may change
};

}  // namespace terratet
