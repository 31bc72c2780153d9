// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The same comparison as in accuracy.hpp as a user meets it: nobody has a formula, every value comes from the samples
/// by an estimator.

#include <memory>

#include "interp/plan/model_source.hpp"
#include "tess/barrier_query.hpp"
#include "tess/value_source.hpp"
#include "tests/accuracy.hpp"

namespace terratet::testing {

/// A site built with an estimator's values, which it goes on giving.
class EstimatedSite {
  public:
    explicit EstimatedSite(const AnalyticSite& site, const std::string& estimator = "natural");

    [[nodiscard]] const Model& model() const { return *model_; }
    [[nodiscard]] std::vector<double> estimates(std::span<const Vec3> places) const;

    /// The rivals with the estimator's values in place of the formula's.
    [[nodiscard]] GridField estimated(GridField grid) const;
    [[nodiscard]] MeshField estimated(MeshField mesh) const;

  private:
    std::unique_ptr<Model> model_;
    std::unique_ptr<BarrierQuery> faults_;
    ValueSource source_;
};

}  // namespace terratet::testing
