// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cpl_conv.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "io/base/gdal_dataset.hpp"
#include "io/base/gdal_drivers.hpp"
#include "io/read/surfaces/read_surfaces.hpp"
#include "tess/base/no_index.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();
constexpr double most_nodes = 250'000;  ///< of the surface: larger rasters are averaged into fewer pixels

/// Heights at the pixels' centres, row by row from the raster's first.
struct Heights {
    int columns = 0;
    int rows = 0;
    std::vector<double> z;  ///< NaN: none there

    [[nodiscard]] double at(int column, int row) const {
        return z[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column)];
    }
};

Heights read_heights(GDALDataset& dataset, const Source& source, const GdalScope& scope) {
    GDALRasterBand* const band = dataset.GetRasterBand(1);
    const double pixels = static_cast<double>(dataset.GetRasterXSize()) * dataset.GetRasterYSize();
    const double step = std::ceil(std::sqrt(std::max(1.0, pixels / most_nodes)));
    Heights heights;
    heights.columns = std::max(2, static_cast<int>(dataset.GetRasterXSize() / step));
    heights.rows = std::max(2, static_cast<int>(dataset.GetRasterYSize() / step));
    heights.z.resize(static_cast<std::size_t>(heights.columns) * static_cast<std::size_t>(heights.rows));
    GDALRasterIOExtraArg averaging;
    INIT_RASTERIO_EXTRA_ARG(averaging);
    averaging.eResampleAlg = GRIORA_Average;
    if (band->RasterIO(GF_Read, 0, 0, dataset.GetRasterXSize(), dataset.GetRasterYSize(), heights.z.data(),
                       heights.columns, heights.rows, GDT_Float64, 0, 0, &averaging) != CE_None) {
        throw InputError(source.describe() + ": the raster cannot be read: " + scope.failure());
    }
    int has_nodata = 0;
    const double nodata = band->GetNoDataValue(&has_nodata);
    const double scale = band->GetScale();
    const double offset = band->GetOffset();
    for (double& z : heights.z) {
        const double height = scale * z + offset;
        z = (has_nodata != 0 && z == nodata) || !(std::abs(height) <= max_coordinate) ? nowhere : height;
    }
    return heights;
}

/// Between and beyond the pixels' centres: a raster reaches half a pixel farther than these.
double height(const Heights& heights, int column, int row) {
    const int inner_column = std::clamp(column, 0, heights.columns - 1);
    const int inner_row = std::clamp(row, 0, heights.rows - 1);
    const double here = heights.at(inner_column, inner_row);
    const double inwards = heights.at(2 * inner_column - column, 2 * inner_row - row);
    return column == inner_column && row == inner_row ? here : here + 0.5 * (here - inwards);
}

/// A grid of the pixels' centres and the raster's border; two triangles between four of them with heights.
Surface triangulated(const Heights& heights, const std::array<double, 6>& transform, int width, int lines) {
    Surface surface;
    const auto pixel = [](int k, int count, int extent) {
        return std::clamp((k + 0.5) / count, 0.0, 1.0) * static_cast<double>(extent);
    };
    std::vector<std::uint32_t> above;
    for (int row = -1; row <= heights.rows; ++row) {
        std::vector<std::uint32_t> line;
        const double y = pixel(row, heights.rows, lines);
        for (int column = -1; column <= heights.columns; ++column) {
            const double x = pixel(column, heights.columns, width);
            const double z = height(heights, column, row);
            line.push_back(std::isnan(z) ? no_index : static_cast<std::uint32_t>(surface.vertices.size()));
            if (!std::isnan(z)) {
                surface.vertices.push_back({transform[0] + x * transform[1] + y * transform[2],
                                            transform[3] + x * transform[4] + y * transform[5], z});
            }
        }
        for (std::size_t k = 1; !above.empty() && k < line.size(); ++k) {
            for (const Triangle& t :
                 {Triangle{above[k - 1], line[k - 1], line[k]}, {above[k - 1], line[k], above[k]}}) {
                if (std::ranges::find(t, no_index) == t.end()) {
                    surface.triangles.push_back(t);
                }
            }
        }
        above = std::move(line);
    }
    return surface;
}

Crs crs_of(GDALDataset& dataset) {
    const OGRSpatialReference* const reference = dataset.GetSpatialRef();
    char* wkt = nullptr;
    const char* const options[] = {"FORMAT=WKT2_2019", nullptr};
    const bool stated = reference != nullptr && reference->exportToWkt(&wkt, options) == OGRERR_NONE;
    Crs crs = stated ? crs_from_wkt(wkt) : Crs{};
    CPLFree(wkt);
    return crs;
}

}  // namespace

bool is_raster(const std::string& path) {
    const GdalScope scope(path);
    return GDALIdentifyDriverEx(path.c_str(), GDAL_OF_RASTER, raster_drivers.data(), nullptr) != nullptr;
}

RawSurfaces read_raster_surface(const Source& source, SurfaceKind kind, Diagnostics& diagnostics) {
    const GdalScope scope(source.path);
    const Dataset dataset(GDALDataset::Open(source.path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY,
                                            raster_drivers.data(), nullptr, nullptr));
    if (!dataset || dataset->GetRasterCount() < 1 || dataset->GetRasterXSize() < 2 || dataset->GetRasterYSize() < 2) {
        throw InputError(source.describe() + ": no raster of heights that can be read" +
                         (scope.failed() ? " (" + scope.failure() + ")" : ""));
    }
    std::array<double, 6> transform{};
    if (dataset->GetGeoTransform(transform.data()) != CE_None) {
        throw InputError(source.describe() + ": the raster does not say where its pixels are");
    }
    const Heights heights = read_heights(*dataset, source, scope);
    RawSurfaces raw;
    raw.surfaces.push_back(triangulated(heights, transform, dataset->GetRasterXSize(), dataset->GetRasterYSize()));
    Surface& surface = raw.surfaces.back();
    surface.name = CPLGetBasename(source.path.c_str());
    surface.kind = kind;
    surface.file = source.path;
    if (surface.triangles.empty()) {
        throw InputError(source.describe() + ": the raster has no heights");
    }
    if (heights.columns < dataset->GetRasterXSize()) {
        diagnostics.note(source.path + ": " + std::to_string(dataset->GetRasterXSize()) + " x " +
                         std::to_string(dataset->GetRasterYSize()) + " pixels are averaged into " +
                         std::to_string(heights.columns) + " x " + std::to_string(heights.rows));
    }
    raw.crs = crs_of(*dataset);
    return raw;
}

}  // namespace terratet
