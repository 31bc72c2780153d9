// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Models to store, and what is read back of them and of their files.

#include <ogrsf_frmts.h>

#include <bit>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "io/base/gdal_scope.hpp"
#include "io/model_store.hpp"
#include "random_model.hpp"
#include "support.hpp"

namespace terratet::testing {

inline const JournalEntry entry{1, "2026-01-02T03:04:05Z", "build", R"({"l_min": "2m"})"};

/// Equal to the last bit, but for the payload of NaNs.
inline bool same(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) || (std::isnan(a) && std::isnan(b));
}
inline bool same(const Vec3& a, const Vec3& b) {
    return same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z);
}
inline bool same(const Box3& a, const Box3& b) {
    return same(a.lo, b.lo) && same(a.hi, b.hi);
}
template <typename T>
bool same(const std::vector<T>& a, const std::vector<T>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const T& x, const T& y) {
        if constexpr (requires { same(x, y); }) {
            return same(x, y);
        } else {
            return x == y;
        }
    });
}

inline void check_same(const Model& a, const Model& b) {
    CHECK(a.frame == b.frame);
    CHECK(same(a.frame.origin, b.frame.origin));
    CHECK(a.properties == b.properties);
    REQUIRE(a.boreholes.size() == b.boreholes.size());
    for (std::size_t i = 0; i < a.boreholes.size(); ++i) {
        CHECK(a.boreholes[i].id == b.boreholes[i].id);
        CHECK(same(a.boreholes[i].collar, b.boreholes[i].collar));
        CHECK(same(a.boreholes[i].path, b.boreholes[i].path));
        CHECK(same(a.boreholes[i].path_depth, b.boreholes[i].path_depth));
    }
    CHECK(same(a.samples.positions, b.samples.positions));
    CHECK(a.samples.borehole == b.samples.borehole);
    CHECK(same(a.samples.depth, b.samples.depth));
    CHECK(same(a.samples.length, b.samples.length));
    REQUIRE(a.samples.values.size() == b.samples.values.size());
    CHECK(same(a.samples.values, b.samples.values));
    CHECK(a.samples.any_censored() == b.samples.any_censored());
    for (std::size_t p = 0; p < a.properties.size(); ++p) {
        for (std::size_t i = 0; i < a.samples.size(); ++i) {
            REQUIRE(a.samples.censoring(p, i) == b.samples.censoring(p, i));
        }
    }
    CHECK(a.surfaces == b.surfaces);
    CHECK(same(a.domain.extent, b.domain.extent));
    CHECK(same(a.domain.hull, b.domain.hull));
    CHECK(a.criteria == b.criteria);
    CHECK(a.density == b.density);
    CHECK(a.region_names == b.region_names);
    CHECK(same(a.barrier_options.spacing, b.barrier_options.spacing));
    CHECK(same(a.barrier_options.width, b.barrier_options.width));
    CHECK(same(a.barrier_options.snap, b.barrier_options.snap));
    CHECK(a.barrier_options.max_seeds == b.barrier_options.max_seeds);
    CHECK(a.barrier_options.mode == b.barrier_options.mode);
    CHECK(a.barriers == b.barriers);
    CHECK(a.vertices == b.vertices);
    CHECK(same(a.vertex_values.values, b.vertex_values.values));
    CHECK(same(a.vertex_values.extrapolation, b.vertex_values.extrapolation));
    CHECK(a.estimator == b.estimator);
}

inline std::string content(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

inline void put(const std::string& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}

inline std::size_t entries(const std::filesystem::path& folder) {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

/// An environment variable until the end of the scope.
class Environment {
  public:
    Environment(const char* name, const char* value) : name_(name) { setenv(name, value, 1); }
    ~Environment() { unsetenv(name_); }
    Environment(const Environment&) = delete;
    Environment& operator=(const Environment&) = delete;

  private:
    const char* name_;
};

/// Executes SQL as another program would.
inline void execute(const std::string& path, const std::string& sql) {
    const GdalScope quiet;
    GDALDataset* const dataset =
        GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_UPDATE, nullptr, nullptr, nullptr);
    REQUIRE(dataset);
    dataset->ReleaseResultSet(dataset->ExecuteSQL(sql.c_str(), nullptr, nullptr));
    INFO(sql << ": " << quiet.failure());
    CHECK_FALSE(quiet.failed());
    GDALClose(dataset);
}

inline std::string query(const std::string& path, const std::string& sql) {
    const GdalScope quiet;
    GDALDataset* const dataset = GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR, nullptr, nullptr, nullptr);
    REQUIRE(dataset);
    OGRLayer* const result = dataset->ExecuteSQL(sql.c_str(), nullptr, nullptr);
    REQUIRE(result);
    const OGRFeatureUniquePtr row{result->GetNextFeature()};
    REQUIRE(row);
    std::string text = row->GetFieldAsString(0);
    dataset->ReleaseResultSet(result);
    GDALClose(dataset);
    return text;
}

/// A model with a bit of everything, and plain names, for damaging it by SQL.
inline Model plain_model() {
    for (std::uint64_t seed = 1;; ++seed) {
        Model model = testing::random_model(seed);
        if (model.boreholes.size() > 2 && model.samples.size() > 10 && model.barriers.size() > 1 &&
            model.vertices.size() > 20 && model.vertices.front().role == Role::sample && !model.surfaces.empty() &&
            model.surfaces[0].triangles.size() > 2 && model.samples.borehole[0] >= 0 && !model.domain.extent.empty()) {
            model.properties = {{"Cu", "%", Scale::linear, Kind::continuous, {}},
                                {"rock", "", Scale::linear, Kind::categorical, {"gneiss", "granite"}}};
            model.criteria.variation.clear();
            for (std::size_t f = 0; f < model.barriers.size(); ++f) {
                model.barriers[f].name = "F" + std::to_string(f + 1);
            }
            for (auto* values : {&model.samples.values, &model.vertex_values.values}) {
                const std::size_t rows = values == &model.samples.values ? model.samples.size() : model.vertices.size();
                *values = {std::vector<double>(rows, 0.25), std::vector<double>(rows, 1)};
            }
            model.samples.censored.clear();
            model.samples.set_censoring(0, 2, Censoring::below);
            return model;
        }
    }
}

/// As plain_model, with many vertices.
inline Model large_model(std::size_t count) {
    Model model = plain_model();
    testing::Random random(5);
    std::uint64_t id = model.vertices.back().id;
    if (id > 1'000'000) {
        model.vertices.back().id = id = 1'000'000;
    }
    while (model.vertices.size() < count) {
        model.vertices.push_back({++id, model.frame.snapped({random(-500, 500), random(-500, 500), random(-500, 500)}),
                                  Role::inserted, -1, 0});
        model.vertex_values.values[0].push_back(random(0, 1));
        model.vertex_values.values[1].push_back(static_cast<double>(random.below(2)));
        model.vertex_values.extrapolation.push_back(random(0, 1));
    }
    return model;
}

}  // namespace terratet::testing
