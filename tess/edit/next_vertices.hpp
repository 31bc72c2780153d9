// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Which vertices stay, leave and come when a model changes; all but what refinement makes of it.

#include <cstdint>
#include <utility>
#include <vector>

#include "tess/barrier_query.hpp"
#include "tess/model.hpp"
#include "tess/progress.hpp"

namespace terratet {

/// How many leave and come, by what they stand for.
struct VertexCounts {
    std::size_t samples_out = 0;
    std::size_t samples_in = 0;
    std::size_t seeds_out = 0;
    std::size_t seeds_in = 0;
    std::size_t inserted_out = 0;
    std::size_t outside_extent = 0;  ///< new samples beyond the extent
};

struct NextVertices {
    std::vector<std::uint64_t> out;                    ///< ids, ascending
    std::vector<Vertex> in;                            ///< ids ascend, above all of before
    std::vector<std::pair<std::size_t, Vertex>> next;  ///< those that stay with another owner: index in before
    std::vector<Box3> boxes;                           ///< where the rules for cells have changed
    VertexCounts counts;
};

/// `after` has everything but vertices. \pre Both are canonical; barriers are those of `after`.
NextVertices next_vertices(const Model& before, const Model& after, const BarrierQuery& barriers, const Poll& poll);

}  // namespace terratet
