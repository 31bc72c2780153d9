// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The value of the nearest visible site; of several at the same distance, the one first by coordinates. O(log n).

#include "interp/anisotropy.hpp"
#include "interp/estimator/estimator.hpp"
#include "interp/sites/site_index.hpp"
#include "tess/barrier_query.hpp"
#include "tess/value_source.hpp"

namespace terratet {

class Nearest final : public Estimator {
  public:
    Nearest(std::vector<Vec3> sites, const BarrierQuery* barriers, const Anisotropy& anisotropy = {});

    void weights(std::span<const ValueQuery> queries, std::span<Weights> out) const override;

  private:
    std::vector<Vec3> sites_;
    SiteIndex index_;
};

}  // namespace terratet
