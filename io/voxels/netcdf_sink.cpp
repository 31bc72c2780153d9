// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// A netCDF-4 cube by the CF conventions 1.8, as ArcGIS takes voxel layers: regular axes that are dimension variables,
/// variables over (z, y, x), or over (time, z, y, x) where the model has times, no auxiliary coordinates, the
/// coordinate system in a grid-mapping variable.

#include <H5public.h>
#include <netcdf.h>

#include <charconv>
#include <cmath>
#include <cstring>
#include <map>
#include <numeric>

#include "io/base/gdal_scope.hpp"
#include "io/base/output_file.hpp"
#include "io/base/parse_number.hpp"
#include "io/base/time_steps.hpp"
#include "io/read/column_names.hpp"
#include "io/voxels/cf_grid_mapping.hpp"
#include "io/voxels/voxel_sink.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

constexpr float float_fill = -9999;
constexpr int int_fill = -1;
constexpr const char* own_variables[] = {"x", "y", "z", "crs", "time"};

/// A class's name as one word, for flag_meanings.
std::string word(const std::string& name) {
    std::string result;
    for (const char c : name) {
        const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || std::strchr("_-.+@", c) != nullptr;
        result += plain || static_cast<unsigned char>(c) >= 0x80 ? c : '_';
    }
    return result.empty() ? "_" : result;
}

/// As UDUNITS spells it.
std::string length_unit(const Frame& frame) {
    return frame.metres_per_unit == 1                                ? "m"
           : frame.metres_per_unit == 0.3048                         ? "ft"
           : std::abs(frame.metres_per_unit - 1200.0 / 3937) < 1e-12 ? "US_survey_foot"
                                                                     : frame.unit;
}

/// The values of one brick in the file's order, z slowest; one a field, empty where there is no value.
struct Piece final : BrickPiece {
    std::vector<std::vector<float>> numbers;
    std::vector<std::vector<int>> classes;
};

class NetcdfSink final : public VoxelSink {
  public:
    NetcdfSink(const VoxelGrid& grid, const std::string& path, const ExportOptions& options)
        : grid_(grid), path_(path), file_(path, options.overwrite) {
        file_.close();
        H5dont_atexit();  // nor at the end of the program
        check(nc_create(file_.temporary_path().c_str(), NC_CLOBBER | NC_NETCDF4, &id_));
        define(options.compress.value_or(true));
    }
    /// After a failed write HDF5 cannot close the file (it crashes): the file is left open, without a name.
    ~NetcdfSink() override {
        if (id_ >= 0 && !broken_) {
            nc_close(id_);
        }
    }
    NetcdfSink(const NetcdfSink&) = delete;
    NetcdfSink& operator=(const NetcdfSink&) = delete;

    [[nodiscard]] std::unique_ptr<BrickPiece> prepare(const Brick& brick) const override {
        auto piece = std::make_unique<Piece>();
        piece->numbers.resize(brick.values.size());
        piece->classes.resize(brick.values.size());
        for (std::size_t f = 0; f < brick.values.size(); ++f) {
            if (!brick.values[f].empty()) {
                if (grid_.layers[f].is_class()) {
                    reorder(brick, brick.values[f], int_fill, piece->classes[f]);
                } else {
                    reorder(brick, brick.values[f], float_fill, piece->numbers[f]);
                }
            }
        }
        return piece;
    }

    void put(const Brick& brick, std::unique_ptr<BrickPiece> made) override {
        const auto& piece = static_cast<const Piece&>(*made);
        std::array<std::size_t, 4> start{};  // the first for the time
        std::array<std::size_t, 4> count{1};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            start[1 + axis] = static_cast<std::size_t>(brick.lo[2 - axis]);
            count[1 + axis] = static_cast<std::size_t>(brick.size[2 - axis]);
        }
        for (std::size_t f = 0; f < places_.size(); ++f) {
            const Place& place = places_[f];
            start[0] = place.step;
            const std::size_t* const from = &start[place.timed ? 0 : 1];
            const std::size_t* const many = &count[place.timed ? 0 : 1];
            if (!piece.classes[f].empty()) {
                check(nc_put_vara_int(id_, place.variable, from, many, piece.classes[f].data()));
            } else if (!piece.numbers[f].empty()) {
                check(nc_put_vara_float(id_, place.variable, from, many, piece.numbers[f].data()));
            }
        }
    }

    void close() override {
        check(nc_sync(id_));  // fails quietly on a full disk, which closing does not
        check(nc_close(std::exchange(id_, -1)));
    }
    [[nodiscard]] OutputRecord commit() override { return {path_, file_.commit()}; }

  private:
    template <class T>
    static void reorder(const Brick& brick, const std::vector<float>& values, T fill, std::vector<T>& out) {
        out.reserve(static_cast<std::size_t>(brick.size[0]) * static_cast<std::size_t>(brick.size[1]) *
                    static_cast<std::size_t>(brick.size[2]));
        for (int k = 0; k < brick.size[2]; ++k) {
            for (int j = 0; j < brick.size[1]; ++j) {
                for (int i = 0; i < brick.size[0]; ++i) {
                    const float value = values[Brick::index(i, j, k)];
                    out.push_back(std::isnan(value) ? fill : static_cast<T>(value));
                }
            }
        }
    }

    void check(int status) {
        if (status != NC_NOERR) {
            broken_ = true;
            throw Error("cannot write " + path_ + ": netCDF says " + nc_strerror(status) +
                        "; is the disk full, or failing?");
        }
    }

    void text(int variable, const char* name, const std::string& value) {
        check(nc_put_att_text(id_, variable, name, value.size(), value.data()));
    }

    void define(bool compress) {
        text(NC_GLOBAL, "Conventions", "CF-1.8");
        text(NC_GLOBAL, "title", "Voxels of a Terratet model");
        const auto mapping = cf_grid_mapping(grid_.frame.crs_wkt);
        const int time = define_time();
        const std::array<int, 4> dimensions{time, axis('z', 2, mapping), axis('y', 1, mapping), axis('x', 0, mapping)};
        if (!mapping.empty()) {
            define_mapping(mapping);
        }
        define_variables(dimensions, !mapping.empty(), compress);
        check(nc_enddef(id_));
        if (time >= 0) {
            std::vector<double> clock;
            for (std::size_t step = 0; step < steps_.size(); ++step) {
                clock.push_back(clock_of(step));
            }
            check(nc_put_var_double(id_, time_, clock.data()));
        }
        for (int a = 0; a < 3; ++a) {
            std::vector<double> places(static_cast<std::size_t>(grid_.size[static_cast<std::size_t>(a)]));
            for (std::size_t i = 0; i < places.size(); ++i) {
                const auto n = static_cast<std::int64_t>(i);
                places[i] = grid_.center(n, n, n)[a];
            }
            check(nc_put_var_double(id_, axes_[static_cast<std::size_t>(a)], places.data()));
        }
    }

    /// Days where all steps are dates, else numbers as they are, and steps by their number where some are neither.
    [[nodiscard]] double clock_of(std::size_t step) const {
        if (dated_) {
            return *days_since_1970(steps_[step]);
        }
        const bool numbers =
            std::ranges::all_of(steps_, [](const auto& label) { return parse_number(label).has_value(); });
        return numbers ? *parse_number(steps_[step]) : static_cast<double>(step);
    }

    /// Returns the dimension; −1 where nothing changes with time.
    int define_time() {
        std::vector<Property> properties;
        for (const VoxelLayer& layer : grid_.layers) {
            properties.push_back(layer.property);
        }
        steps_ = time_steps(properties);
        if (steps_.empty()) {
            return -1;
        }
        dated_ = std::ranges::all_of(steps_, [](const auto& label) { return days_since_1970(label).has_value(); });
        int dimension = 0;
        check(nc_def_dim(id_, "time", steps_.size(), &dimension));
        check(nc_def_var(id_, "time", NC_DOUBLE, 1, &dimension, &time_));
        text(time_, "axis", "T");
        text(time_, "long_name", "time");
        if (dated_) {
            text(time_, "standard_name", "time");
            text(time_, "units", "days since 1970-01-01 00:00:00");
            text(time_, "calendar", "standard");
        }
        std::string labels;
        for (const std::string& label : steps_) {
            labels += (labels.empty() ? "" : ";") + label;
        }
        text(time_, "labels", labels);
        return dimension;
    }

    /// A variable a layer; one for all times of a property.
    void define_variables(const std::array<int, 4>& dimensions, bool mapped, bool compress) {
        std::vector<std::string> names;
        std::map<std::string, std::size_t> timed;
        std::vector<std::size_t> name_of;
        for (const VoxelLayer& layer : grid_.layers) {
            const std::string base = name_without_time(layer.property.name);
            const bool has_time = layer.role == VoxelLayer::Role::property && base != layer.property.name;
            if (!has_time || timed.emplace(base, names.size()).second) {
                names.push_back(has_time ? plain_name(base) : layer.plain_name);
            }
            name_of.push_back(has_time ? timed[base] : names.size() - 1);
        }
        names = distinct_names(std::move(names), own_variables);
        std::vector<int> variables(names.size(), -1);
        for (std::size_t f = 0; f < grid_.layers.size(); ++f) {
            const VoxelLayer& layer = grid_.layers[f];
            const std::string time =
                layer.role == VoxelLayer::Role::property ? time_of(layer.property.name) : std::string();
            int& variable = variables[name_of[f]];
            if (variable < 0) {
                variable = define_variable(layer, names[name_of[f]], dimensions, !time.empty(), mapped, compress);
            }
            const auto step = std::ranges::find(steps_, time) - steps_.begin();
            places_.push_back({variable, !time.empty(), time.empty() ? 0 : static_cast<std::size_t>(step)});
        }
    }

    /// Returns the dimension.
    int axis(char name, std::size_t number, const std::vector<CfAttribute>& mapping) {
        const std::string label(1, name);
        int dimension = 0;
        check(nc_def_dim(id_, label.c_str(), static_cast<std::size_t>(grid_.size[number]), &dimension));
        check(nc_def_var(id_, label.c_str(), NC_DOUBLE, 1, &dimension, &axes_[number]));
        const int variable = axes_[number];
        if (name == 'z') {
            text(variable, "standard_name", "altitude");
            text(variable, "positive", "up");
        } else if (!mapping.empty()) {
            text(variable, "standard_name", std::string("projection_") + name + "_coordinate");
        }
        text(variable, "long_name",
             name == 'x'   ? "easting of the voxels' centres"
             : name == 'y' ? "northing of the voxels' centres"
                           : "height of the voxels' centres");
        text(variable, "units", length_unit(grid_.frame));
        text(variable, "axis", std::string(1, static_cast<char>(std::toupper(name))));
        return dimension;
    }

    void define_mapping(const std::vector<CfAttribute>& mapping) {
        int variable = 0;
        check(nc_def_var(id_, "crs", NC_INT, 0, nullptr, &variable));
        for (const auto& [name, value] : mapping) {
            if (const auto* words = std::get_if<std::string>(&value)) {
                text(variable, name.c_str(), *words);
            } else if (const auto* one = std::get_if<double>(&value)) {
                check(nc_put_att_double(id_, variable, name.c_str(), NC_DOUBLE, 1, one));
            } else {
                const auto& several = std::get<std::vector<double>>(value);
                check(nc_put_att_double(id_, variable, name.c_str(), NC_DOUBLE, several.size(), several.data()));
            }
        }
    }

    int define_variable(const VoxelLayer& layer, const std::string& name, const std::array<int, 4>& dimensions,
                        bool timed, bool mapped, bool compress) {
        int variable = 0;
        check(nc_def_var(id_, name.c_str(), layer.is_class() ? NC_INT : NC_FLOAT, timed ? 4 : 3,
                         &dimensions[timed ? 0 : 1], &variable));
        std::array<std::size_t, 4> chunk{1};
        for (std::size_t a = 0; a < 3; ++a) {
            chunk[1 + a] = static_cast<std::size_t>(std::min<std::int64_t>(Brick::edge, grid_.size[2 - a]));
        }
        check(nc_def_var_chunking(id_, variable, NC_CHUNKED, &chunk[timed ? 0 : 1]));
        // A chunk is written whole and once: it need not be kept.
        check(nc_set_var_chunk_cache(id_, variable, 2 * Brick::edge * Brick::edge * Brick::edge * sizeof(float), 3, 1));
        if (compress) {
            check(nc_def_var_deflate(id_, variable, 1, 1, 1));
        }
        text(variable, "long_name", timed ? name_without_time(layer.property.name) : layer.property.name);
        if (layer.is_class()) {
            check(nc_put_att_int(id_, variable, "_FillValue", NC_INT, 1, &int_fill));
            define_classes(layer, variable);
        } else {
            check(nc_put_att_float(id_, variable, "_FillValue", NC_FLOAT, 1, &float_fill));
            text(variable, "units", layer.property.unit.empty() ? "1" : layer.property.unit);
            if (layer.is_log10()) {
                text(variable, "scale", "log10");
            }
        }
        if (mapped) {
            text(variable, "grid_mapping", "crs");
        }
        return variable;
    }

    void define_classes(const VoxelLayer& layer, int variable) {
        if (layer.property.classes.empty()) {
            return;
        }
        std::vector<int> values(layer.property.classes.size());
        std::iota(values.begin(), values.end(), 0);
        std::string meanings;
        for (const std::string& name : layer.property.classes) {
            meanings += (meanings.empty() ? "" : " ") + word(name);
        }
        check(nc_put_att_int(id_, variable, "flag_values", NC_INT, values.size(), values.data()));
        text(variable, "flag_meanings", meanings);
    }

    const VoxelGrid& grid_;
    std::string path_;
    OutputFile file_;
    int id_ = -1;
    bool broken_ = false;
    std::array<int, 3> axes_{};
    int time_ = -1;
    std::vector<std::string> steps_;  ///< labels; empty: nothing changes with time
    bool dated_ = false;
    struct Place {
        int variable = -1;
        bool timed = false;
        std::size_t step = 0;
    };
    std::vector<Place> places_;  ///< a layer each
};

}  // namespace

std::unique_ptr<VoxelSink> make_netcdf_sink(const VoxelGrid& grid, const std::string& path,
                                            const ExportOptions& options) {
    return std::make_unique<NetcdfSink>(grid, path, options);
}

}  // namespace terratet
