// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/estimator/query_order.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>

#include "interp/base/morton.hpp"

namespace terratet {
namespace {

constexpr std::size_t small_batch = 64;  // below it a task costs more than it saves
constexpr std::size_t run_length = 128;

}  // namespace

std::vector<std::uint32_t> spatial_order(std::span<const ValueQuery> queries) {
    Box3 box;
    for (const auto& query : queries) {
        box.extend(query.position);
    }
    const MortonCode code(box);
    // Index and as much of the code as there is room for in one word: half the memory to move, one comparison.
    const int index_bits = std::bit_width(queries.size());
    std::vector<std::uint64_t> keys(queries.size());
    for (std::size_t i = 0; i < keys.size(); ++i) {
        keys[i] = (code(queries[i].position) << 1 >> index_bits << index_bits) | i;
    }
    tbb::parallel_sort(keys.begin(), keys.end());
    std::vector<std::uint32_t> order(keys.size());
    const std::uint64_t index_mask = (std::uint64_t{1} << index_bits) - 1;
    std::transform(keys.begin(), keys.end(), order.begin(),
                   [&](std::uint64_t key) { return static_cast<std::uint32_t>(key & index_mask); });
    return order;
}

void in_spatial_order(std::span<const ValueQuery> queries,
                      const std::function<void(std::span<const std::uint32_t>)>& work) {
    if (queries.size() < small_batch) {
        std::array<std::uint32_t, small_batch> as_given;
        std::iota(as_given.begin(), as_given.end(), 0u);
        work(std::span(as_given).first(queries.size()));
        return;
    }
    const auto order = spatial_order(queries);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, order.size(), run_length),
                      [&](const auto& range) { work(std::span(order).subspan(range.begin(), range.size())); });
}

void in_spatial_order(std::span<const ValueQuery> queries, std::span<Weights> out,
                      const std::function<void(std::span<const std::uint32_t>)>& work) {
    in_spatial_order(queries, [&](std::span<const std::uint32_t> run) {
        for (const std::uint32_t i : run) {
            __builtin_prefetch(&queries[i]);
            __builtin_prefetch(out[i].terms.data(), 1);
        }
        work(run);
    });
}

}  // namespace terratet
