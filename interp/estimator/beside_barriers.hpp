// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Places that lie exactly on a barrier see nothing. Samples and queries there count to one of its sides, the
/// + side where none is asked for (BarrierQuery::off_barriers).

#include <span>
#include <vector>

#include "tess/barrier_query.hpp"
#include "tess/value_source.hpp"

namespace terratet {

/// Each where it is seen from: a billionth of the spacing off the barrier that it lies on, all others where they are.
/// In parallel.
std::vector<ValueQuery> beside_barriers(std::span<const ValueQuery> queries, const BarrierQuery& barriers);

/// The same for distinct sites, which stay distinct: one whose new place is taken stays.
std::vector<Vec3> beside_barriers(std::vector<Vec3> sites, const BarrierQuery& barriers);

}  // namespace terratet
