// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/edit/given_values.hpp"

#include <algorithm>
#include <cmath>

namespace terratet {

ValueQuery query_of(const Vertex& vertex) {
    return {vertex.position, vertex.role == Role::seed ? vertex.owner : -1, vertex.side};
}

namespace {

/// Is there nothing to estimate?
bool is_complete(const Model& model, const Vertex& vertex) {
    return vertex.role == Role::sample && std::ranges::none_of(model.samples.values, [&](const auto& column) {
               return std::isnan(column[static_cast<std::size_t>(vertex.owner)]);
           });
}

/// Puts what was measured at a sample in the place of what was estimated there.
void prefer_measured(const Model& model, const Vertex& vertex, std::size_t i, VertexValues& values) {
    if (vertex.role != Role::sample) {
        return;
    }
    bool complete = true;
    for (std::size_t property = 0; property < model.properties.size(); ++property) {
        const double measured = model.samples.values[property][static_cast<std::size_t>(vertex.owner)];
        complete = complete && !std::isnan(measured);
        if (!std::isnan(measured)) {
            values.values[property][i] = measured;
        }
    }
    if (complete) {
        values.extrapolation[i] = 0;
    }
}

}  // namespace

VertexValues measured_or_estimated(const Model& model, const ValueSource& source) {
    std::vector<ValueQuery> queries;
    for (const Vertex& vertex : model.vertices) {
        queries.push_back(query_of(vertex));
    }
    ValueBatch batch = source(queries);
    VertexValues values{std::move(batch.values), std::move(batch.extrapolation)};
    for (std::size_t i = 0; i < model.vertices.size(); ++i) {
        prefer_measured(model, model.vertices[i], i, values);
    }
    return values;
}

void set_values(const Model& model, std::span<const Vertex> vertices, std::span<const std::uint32_t> which,
                const ValueSource& source, VertexValues& values) {
    std::vector<ValueQuery> queries;
    std::vector<std::uint32_t> asked;
    for (const std::uint32_t i : which) {
        if (!is_complete(model, vertices[i])) {
            queries.push_back(query_of(vertices[i]));
            asked.push_back(i);
        }
    }
    const ValueBatch batch = source(queries);
    for (std::size_t k = 0; k < asked.size(); ++k) {
        for (std::size_t property = 0; property < values.values.size(); ++property) {
            values.values[property][asked[k]] = batch.values[property][k];
        }
        values.extrapolation[asked[k]] = batch.extrapolation[k];
    }
    for (const std::uint32_t i : which) {
        prefer_measured(model, vertices[i], i, values);
    }
}

}  // namespace terratet
