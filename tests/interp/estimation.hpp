// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// What tests of estimation ask again and again.

#include <catch2/catch.hpp>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "interp/estimator/estimator.hpp"
#include "support.hpp"
#include "tess/barrier_query.hpp"
#include "tess/value_source.hpp"

namespace terratet::testing {

inline const BarrierQuery& no_faults() {
    static const BarrierQuery none{std::span<const Barrier>()};
    return none;
}

inline std::vector<ValueQuery> queries_at(const std::vector<Vec3>& places) {
    std::vector<ValueQuery> queries(places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
        queries[i].position = places[i];
    }
    return queries;
}

inline std::vector<Vec3> places_in(const Box3& box, std::size_t count, std::uint64_t seed) {
    Random random(seed);
    std::vector<Vec3> places(count);
    for (auto& p : places) {
        p = random.in(box);
    }
    return places;
}

inline std::vector<ValueQuery> queries_in(const Box3& box, std::size_t count, std::uint64_t seed) {
    return queries_at(places_in(box, count, seed));
}

inline std::vector<Weights> weights_at(const Estimator& estimator, const std::vector<Vec3>& places) {
    std::vector<Weights> out(places.size());
    estimator.weights(queries_at(places), out);
    return out;
}

inline bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

/// Rows of a file that gstat/reference.R made, cells as text, without the header.
inline std::vector<std::vector<std::string>> gstat_rows(const std::string& name) {
    std::ifstream file(source_dir() / "tests/interp/gstat" / name);
    REQUIRE(file);
    std::vector<std::vector<std::string>> rows;
    std::string line;
    std::getline(file, line);
    while (std::getline(file, line)) {
        std::istringstream cells(line);
        auto& row = rows.emplace_back();
        for (std::string cell; std::getline(cells, cell, ',');) {
            row.push_back(cell);
        }
    }
    return rows;
}

}  // namespace terratet::testing
