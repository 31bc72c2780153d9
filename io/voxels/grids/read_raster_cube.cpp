// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// Cubes as GDAL sees them: bands are slices. Heights are what netCDF's third dimension says, a band's metadata Z, or a
/// number after `z=` in its description.

#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <optional>
#include <sstream>

#include "io/base/gdal_dataset.hpp"
#include "io/base/gdal_drivers.hpp"
#include "io/base/gdal_scope.hpp"
#include "io/base/parse_number.hpp"
#include "io/base/time_steps.hpp"
#include "io/voxels/grids/grid_source.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

struct Slice {
    double z = 0;
    GDALRasterBand* band = nullptr;
};

struct Variable {
    VoxelLayer layer;
    std::vector<Slice> slices;  ///< from below
};

struct Cube {
    std::vector<Dataset> datasets;
    std::vector<Variable> variables;
};

std::string text(const char* value) {
    return value == nullptr ? "" : value;
}

std::string item(GDALMajorObject& object, const std::string& key) {
    return text(object.GetMetadataItem(key.c_str()));
}

/// Of a band, by what says one; nullopt where nothing does.
std::optional<double> height_of(GDALDataset& dataset, GDALRasterBand& band) {
    if (const auto z = parse_number(item(band, "Z"))) {
        return z;
    }
    for (const char* name : {"z", "depth", "elevation", "altitude", "height", "level", "lev", "Z"}) {
        if (const auto z = parse_number(item(band, std::string("NETCDF_DIM_") + name))) {
            const bool down = item(dataset, std::string(name) + "#positive") == "down";
            return down ? -*z : *z;
        }
    }
    const std::string description = band.GetDescription();
    const std::size_t begin = description.find("z=");
    const std::size_t from = begin == std::string::npos ? 0 : begin + 2;
    return parse_number(description.substr(from, description.find(' ', from) - from));
}

std::vector<std::string> words(const std::string& line) {
    std::istringstream stream(line);
    std::vector<std::string> result;
    for (std::string word; stream >> word;) {
        result.push_back(word);
    }
    return result;
}

/// "@T" of a slice at the time T of an axis of times, by its label where the axis has those.
std::string time_mark(GDALDataset& dataset, GDALRasterBand& band) {
    const auto clock = parse_number(item(band, "NETCDF_DIM_time"));
    if (!clock) {
        return "";
    }
    std::string all = item(dataset, "NETCDF_DIM_time_VALUES");  // {0,1,2}
    std::erase_if(all, [](char c) { return c == '{' || c == '}'; });
    std::istringstream values(all);
    std::istringstream labels(item(dataset, "time#labels"));
    for (std::string value, label; std::getline(values, value, ',') && std::getline(labels, label, ';');) {
        if (parse_number(value) == clock) {
            return name_at("", label);
        }
    }
    return name_at("", time_label(item(band, "NETCDF_DIM_time")));
}

VoxelLayer layer_of(GDALDataset& dataset, GDALRasterBand& band, const std::string& name, const std::string& fallback) {
    const std::string variable = item(band, "NETCDF_VARNAME");
    const std::string prefix = variable + "#";
    std::vector<std::string> classes = words(item(dataset, prefix + "flag_meanings"));
    for (int c = 0; classes.empty() || c > 0; ++c) {
        const std::string key = plain_name(name) + "_" + std::to_string(c);
        const char* of_class = dataset.GetMetadataItem(key.c_str(), "CLASSES");
        if (of_class == nullptr) {
            break;
        }
        classes.emplace_back(of_class);
    }
    const GDALDataType type = band.GetRasterDataType();
    const bool integer = type != GDT_Float32 && type != GDT_Float64;
    std::string unit = band.GetUnitType();
    const std::string long_name = item(dataset, prefix + "long_name");
    const std::string shown = !name.empty() ? name : !variable.empty() ? variable : fallback;
    const bool categorical = !classes.empty() || (integer && !variable.empty());
    const std::string full = (variable.empty() || long_name.empty() ? shown : long_name) + time_mark(dataset, band);
    return grid_layer(full, unit == "1" ? "" : unit, categorical, item(dataset, prefix + "scale") == "log10",
                      std::move(classes));
}

Dataset open_raster(const std::string& path, const Source& source, const GdalScope& scope) {
    Dataset dataset(
        GDALDataset::Open(path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, raster_drivers.data(), nullptr, nullptr));
    if (!dataset) {
        throw InputError(source.describe() + ": no raster that can be read: " + scope.failure());
    }
    return dataset;
}

void add_bands(GDALDataset& dataset, const Source& source, Cube& cube) {
    std::map<std::string, std::size_t> of_name;
    for (int b = 1; b <= dataset.GetRasterCount(); ++b) {
        GDALRasterBand& band = *dataset.GetRasterBand(b);
        const auto z = height_of(dataset, band);
        if (!z) {
            throw InputError(source.describe() + ": band " + std::to_string(b) +
                             " does not say its height: a cube's have metadata Z, or `z=…` in their descriptions");
        }
        const std::string name = item(band, "PROPERTY") + time_mark(dataset, band);
        const auto [found, added] = of_name.emplace(name, cube.variables.size());
        if (added) {
            cube.variables.push_back({layer_of(dataset, band, item(band, "PROPERTY"), "value"), {}});
        }
        cube.variables[found->second].slices.push_back({*z, &band});
    }
}

Cube open_cube(const Source& source, const GdalScope& scope) {
    Cube cube;
    Dataset dataset = open_raster(source.path, source, scope);
    if (dataset->GetRasterCount() > 0) {
        add_bands(*dataset, source, cube);
        cube.datasets.push_back(std::move(dataset));
    } else {
        char** list = dataset->GetMetadata("SUBDATASETS");
        for (int n = 1;; ++n) {
            const char* name = CSLFetchNameValue(list, ("SUBDATASET_" + std::to_string(n) + "_NAME").c_str());
            if (name == nullptr) {
                break;
            }
            const std::string variable = text(std::strrchr(name, ':')).substr(1);
            if (source.layer.empty() || source.layer == variable) {
                Dataset one = open_raster(name, source, scope);
                add_bands(*one, source, cube);
                cube.datasets.push_back(std::move(one));
            }
        }
    }
    if (cube.variables.empty()) {
        throw InputError(source.describe() + ": there is no variable of slices in it");
    }
    for (Variable& variable : cube.variables) {
        std::ranges::sort(variable.slices, {}, &Slice::z);
    }
    return cube;
}

void place(const Cube& cube, const Source& source, VoxelGrid& grid) {
    GDALDataset& first = *cube.datasets.front();
    double t[6];
    if (first.GetGeoTransform(t) != CE_None || t[2] != 0 || t[4] != 0 || t[1] <= 0 || t[5] == 0) {
        throw InputError(source.describe() + ": the raster does not say where its pixels are, or is turned");
    }
    const auto& slices = cube.variables.front().slices;
    const auto count = static_cast<std::int64_t>(slices.size());
    grid.size = {first.GetRasterXSize(), first.GetRasterYSize(), count};
    grid.spacing = {t[1], std::abs(t[5]), t[1]};
    if (count > 1) {
        grid.spacing.z = (slices.back().z - slices.front().z) / static_cast<double>(count - 1);
    } else if (const auto step = parse_number(item(first, "Z_SPACING"))) {
        grid.spacing.z = *step;
    }
    const double south = t[5] < 0 ? t[3] + static_cast<double>(grid.size[1]) * t[5] : t[3];
    grid.origin = {t[0] + t[1] / 2, south + std::abs(t[5]) / 2, slices.front().z};
    for (const Variable& variable : cube.variables) {
        if (variable.slices.size() != slices.size() ||
            variable.slices.front().band->GetXSize() != first.GetRasterXSize() ||
            variable.slices.front().band->GetYSize() != first.GetRasterYSize()) {
            throw InputError(source.describe() +
                             ": its variables differ in size; name one by layer=" + variable.layer.property.name);
        }
        for (std::size_t k = 0; k < slices.size(); ++k) {
            const double z = grid.origin.z + static_cast<double>(k) * grid.spacing.z;
            if (!(grid.spacing.z > 0) || std::abs(variable.slices[k].z - z) > 0.01 * grid.spacing.z) {
                throw InputError(source.describe() + ": its slices are not evenly spaced at height " +
                                 std::to_string(variable.slices[k].z));
            }
        }
    }
    if (const OGRSpatialReference* crs = first.GetSpatialRef()) {
        char* wkt = nullptr;
        const char* const options[] = {"FORMAT=WKT2_2019", nullptr};
        crs->exportToWkt(&wkt, options);
        set_grid_crs(text(wkt), grid);
        CPLFree(wkt);
    }
}

/// 64 rows of all columns of one slice, from the south.
void read_rows(GDALRasterBand& band, std::int64_t south, int rows, bool north_up, const Source& source,
               std::vector<float>& out) {
    const GdalScope scope;
    const int columns = band.GetXSize();
    out.resize(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
    const int first = static_cast<int>(north_up ? band.GetYSize() - south - rows : south);
    if (band.RasterIO(GF_Read, 0, first, columns, rows, out.data(), columns, rows, GDT_Float32, 0, 0, nullptr) !=
        CE_None) {
        throw InputError(source.describe() + ": the raster cannot be read: " + scope.failure());
    }
    int has_nodata = 0;
    const auto nodata = static_cast<float>(band.GetNoDataValue(&has_nodata));
    const auto scale = static_cast<float>(band.GetScale());
    const auto offset = static_cast<float>(band.GetOffset());
    for (float& value : out) {
        const bool missing = !std::isfinite(value) || (has_nodata != 0 && value == nodata);
        value = missing ? std::numeric_limits<float>::quiet_NaN() : scale * value + offset;
    }
    if (north_up) {
        for (int r = 0; r < rows / 2; ++r) {
            std::swap_ranges(out.begin() + static_cast<std::ptrdiff_t>(r) * columns,
                             out.begin() + static_cast<std::ptrdiff_t>(r + 1) * columns,
                             out.begin() + static_cast<std::ptrdiff_t>(rows - 1 - r) * columns);
        }
    }
}

/// A row of blocks along x.
void read_blocks(const Cube& cube, const Source& source, std::int64_t y, std::int64_t z, GridContents& contents) {
    constexpr int edge = Brick::edge;
    const auto& size = contents.grid.size;
    const int rows = static_cast<int>(std::min<std::int64_t>(edge, size[1] - y));
    const int slices = static_cast<int>(std::min<std::int64_t>(edge, size[2] - z));
    const auto blocks = static_cast<std::size_t>((size[0] + edge - 1) / edge);
    std::vector<std::vector<std::vector<float>>> values(blocks);  // [block][variable]
    std::vector<std::size_t> same(cube.variables.size());
    double t[6];
    cube.datasets.front()->GetGeoTransform(t);
    std::vector<float> plane;
    for (std::size_t v = 0; v < cube.variables.size(); ++v) {
        same[v] = v;
        for (auto& block : values) {
            block.emplace_back();
        }
        for (int k = 0; k < slices; ++k) {
            const Slice& slice = cube.variables[v].slices[static_cast<std::size_t>(z + k)];
            read_rows(*slice.band, y, rows, t[5] < 0, source, plane);
            for (int j = 0; j < rows; ++j) {
                const float* row = plane.data() + static_cast<std::ptrdiff_t>(j) * size[0];
                for (std::int64_t x = 0; x < size[0]; ++x) {
                    std::vector<float>& block = values[static_cast<std::size_t>(x / edge)][v];
                    if (!std::isnan(row[x])) {
                        block.resize(std::size_t{edge} * edge * edge, std::numeric_limits<float>::quiet_NaN());
                        block[Brick::index(static_cast<int>(x % edge), j, k)] = row[x];
                    }
                }
            }
        }
    }
    for (std::size_t b = 0; b < blocks; ++b) {
        contents.blocks->put({static_cast<std::int64_t>(b), y / edge, z / edge}, values[b], same);
    }
}

}  // namespace

GridContents read_raster_cube(const Source& source, const std::string& spill) {
    const GdalScope scope(source.path);
    const Cube cube = open_cube(source, scope);
    GridContents contents;
    place(cube, source, contents.grid);
    for (const Variable& variable : cube.variables) {
        contents.grid.layers.push_back(variable.layer);
    }
    name_layers(contents.grid.layers);
    contents.blocks = make_blocks(contents.grid, spill);
    for (std::int64_t z = 0; z < contents.grid.size[2]; z += Brick::edge) {
        for (std::int64_t y = 0; y < contents.grid.size[1]; y += Brick::edge) {
            read_blocks(cube, source, y, z, contents);
        }
    }
    return contents;
}

}  // namespace terratet
