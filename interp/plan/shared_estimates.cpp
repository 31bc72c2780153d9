// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/plan/shared_estimates.hpp"

#include <algorithm>

#include "interp/estimator/query_order.hpp"
#include "interp/ranks/bytes.hpp"

namespace terratet {
namespace {

constexpr std::size_t run_length = 256;  ///< places: near each other, and many runs a rank
constexpr std::size_t worth_sending = 4 * run_length;

/// Calls visit(name of column) with every column that has a row a query.
template <class Estimates, class Visit>
void for_each_column(Estimates& of_property, const Visit& visit) {
    visit(of_property.value);
    visit(of_property.deviation);
    visit(of_property.half_width);
    visit(of_property.extrapolation);
    visit(of_property.samples);
    visit(of_property.entropy);
    for (auto& of_class : of_property.probability) {
        visit(of_class);
    }
}

std::string packed(const std::vector<PropertyEstimates>& all) {
    ByteWriter out;
    for (const PropertyEstimates& of_property : all) {
        for_each_column(of_property, [&](const auto& column) { out.put(column); });
    }
    return out.take();
}

/// Rows of a part into their places among all.
template <class T>
void scatter(const std::vector<T>& part, std::span<const std::uint32_t> rows, std::vector<T>& column) {
    for (std::size_t i = 0; i < part.size(); ++i) {
        column[rows[i]] = part[i];
    }
}

void unpack(std::string_view bytes, std::span<const std::uint32_t> rows, std::vector<PropertyEstimates>& all) {
    ByteReader in(bytes);
    for (PropertyEstimates& of_property : all) {
        for_each_column(of_property, [&]<class T>(std::vector<T>& column) { scatter(in.list<T>(), rows, column); });
    }
}

/// Room for all rows, as the estimator fills it: what it leaves empty stays so.
std::vector<PropertyEstimates> room_for(std::size_t rows, std::vector<PropertyEstimates> like, std::size_t like_rows) {
    for (PropertyEstimates& of_property : like) {
        for_each_column(of_property, [&](auto& column) {
            if (column.size() == like_rows) {
                column.assign(rows, {});
            }
        });
    }
    return like;
}

}  // namespace

std::vector<PropertyEstimates> shared_estimates(const ModelEstimator& estimator, std::span<const ValueQuery> queries,
                                                const Ranks& ranks) {
    if (ranks.count() == 1 || queries.size() < worth_sending) {
        return estimator.estimates(queries);
    }
    const std::vector<std::uint32_t> order = spatial_order(queries);
    const auto count = static_cast<std::size_t>(ranks.count());
    std::vector<std::vector<std::uint32_t>> rows(count);
    std::vector<std::vector<ValueQuery>> parts(count);
    for (std::size_t i = 0; i < order.size(); ++i) {
        const std::size_t rank = i / run_length % count;
        rows[rank].push_back(order[i]);
        parts[rank].push_back(queries[order[i]]);
    }
    ByteWriter out;
    for (const auto& part : parts) {
        out.put(part);
    }
    static_cast<void>(ranks.broadcast(out.take()));
    const std::vector<PropertyEstimates> own = estimator.estimates(parts[0]);
    std::vector<PropertyEstimates> all = room_for(queries.size(), own, parts[0].size());
    unpack(packed(own), rows[0], all);
    for (std::size_t rank = 1; rank < count; ++rank) {
        unpack(ranks.receive(static_cast<int>(rank)), rows[rank], all);
    }
    return all;
}

void serve_estimates(const ModelEstimator& estimator, const Ranks& ranks) {
    for (std::string message = ranks.broadcast(); !message.empty(); message = ranks.broadcast()) {
        ByteReader in(message);
        std::vector<ValueQuery> part;
        for (int rank = 0; rank <= ranks.rank(); ++rank) {
            part = in.list<ValueQuery>();
        }
        ranks.send(packed(estimator.estimates(part)));
    }
}

void end_serving(const Ranks& ranks) {
    static_cast<void>(ranks.broadcast());
}

}  // namespace terratet
