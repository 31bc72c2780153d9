// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// What stands between places of a view's model.

#include <optional>

#include "io/export_options.hpp"
#include "tess/barrier_query.hpp"

namespace terratet {

/// The view's own, or made here where it has none.
class ViewBarriers {
  public:
    explicit ViewBarriers(const ModelView& view) : given_(view.barriers) {
        if (given_ == nullptr) {
            made_ = model_proximity(view.model);
        }
    }
    const BarrierQuery& operator*() const { return given_ != nullptr ? *given_ : *made_; }

  private:
    const BarrierQuery* given_;
    std::optional<BarrierQuery> made_;
};

}  // namespace terratet
