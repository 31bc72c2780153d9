// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Values of vertices that are not refinement's: a sample's own (V1), the estimator's elsewhere and where a sample
/// lacks a property.

#include <cstdint>
#include <span>

#include "tess/model.hpp"
#include "tess/value_source.hpp"

namespace terratet {

/// Where a vertex' value is asked for.
ValueQuery query_of(const Vertex& vertex);

/// Of all vertices of the model, in step with them.
VertexValues measured_or_estimated(const Model& model, const ValueSource& source);

/// Sets those of some vertices only. \pre values are in step with `vertices`, whose owners are the model's.
void set_values(const Model& model, std::span<const Vertex> vertices, std::span<const std::uint32_t> which,
                const ValueSource& source, VertexValues& values);

}  // namespace terratet
