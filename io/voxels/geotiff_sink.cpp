// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// GeoTIFF: a band a slice of voxels, from below, described `z=…` by the height of their centres; with several
/// properties one set of bands after the other, each named. With ExportOptions::cog a cloud-optimised one.

#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <charconv>
#include <cmath>
#include <limits>

#include "io/base/gdal_dataset.hpp"
#include "io/base/gdal_scope.hpp"
#include "io/base/output_file.hpp"
#include "io/voxels/voxel_sink.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

constexpr int block = 64;
static_assert(Brick::edge == block);

std::string decimal(double value) {
    char digits[32];
    return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}

class GeotiffSink final : public VoxelSink {
  public:
    GeotiffSink(const VoxelGrid& grid, const std::string& path, const ExportOptions& options)
        : grid_(grid), options_(options), path_(path), file_(path, options.overwrite) {
        file_.close();
        for (std::size_t f = 0; f < grid.layers.size(); ++f) {
            if (options.all_fields || grid.layers[f].role == VoxelLayer::Role::property) {
                fields_.push_back(f);
            }
        }
        if (fields_.empty()) {
            throw UsageError(path + ": there is no property to write; -co FIELDS=ALL writes the region's number");
        }
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (grid.size[axis] > std::numeric_limits<std::uint16_t>::max()) {
                throw UsageError(path + ": GeoTIFF takes at most 65 535 voxels along an axis; take larger ones");
            }
        }
        columns_ = static_cast<int>(grid.size[0]);
        rows_ = static_cast<int>(grid.size[1]);
        scratch_ = options.cog ? file_.temporary_path() + ".tif" : file_.temporary_path();
        create();
        pending_.resize(fields_.size());
    }

    ~GeotiffSink() override {
        const GdalScope silent;
        dataset_.reset();
        if (options_.cog) {
            VSIUnlink(scratch_.c_str());
        }
    }
    GeotiffSink(const GeotiffSink&) = delete;
    GeotiffSink& operator=(const GeotiffSink&) = delete;

    [[nodiscard]] std::unique_ptr<BrickPiece> prepare(const Brick&) const override { return nullptr; }

    /// A row of bricks from the north holds 64 rows of the raster, fewer where it begins; its blocks hold 64 always.
    void put(const Brick& brick, std::unique_ptr<BrickPiece>) override {
        if (brick.lo[0] == 0) {
            begin_rows(brick);
        }
        for (std::size_t n = 0; n < fields_.size(); ++n) {
            const auto& values = brick.values[fields_[n]];
            for (int k = 0; k < brick.size[2]; ++k) {
                for (int j = 0; j < brick.size[1]; ++j) {
                    float* row = row_of(n, k, first_new_ + brick.size[1] - 1 - j) + brick.lo[0];
                    for (int i = 0; i < brick.size[0]; ++i) {
                        row[i] = values.empty() ? no_value() : values[Brick::index(i, j, k)];
                    }
                }
            }
        }
        if (brick.lo[0] + brick.size[0] == grid_.size[0]) {
            slices_ = brick.size[2];
            height_ += brick.size[1];
            const bool last = brick.lo[1] == 0;
            while (height_ >= block || (last && height_ > 0)) {
                write_blocks(static_cast<int>(brick.lo[2]));
            }
            if (last) {
                block_row_ = 0;
            }
        }
    }

    void close() override {
        const GdalScope scope;
        dataset_.reset();  // writes what is left
        if (scope.failed()) {
            fail(scope);
        }
        if (options_.cog) {
            make_cog();
        }
    }
    [[nodiscard]] OutputRecord commit() override { return {path_, file_.commit()}; }

  private:
    static float no_value() { return std::numeric_limits<float>::quiet_NaN(); }

    [[noreturn]] void fail(const GdalScope& scope) const {
        throw Error("cannot write " + path_ + ": GDAL says " + scope.failure() + "; is the disk full, or failing?");
    }

    void create() {
        const GdalScope scope;
        CPLStringList create;
        create.SetNameValue("TILED", "YES");
        create.SetNameValue("BLOCKXSIZE", std::to_string(block).c_str());
        create.SetNameValue("BLOCKYSIZE", std::to_string(block).c_str());
        create.SetNameValue("INTERLEAVE", "BAND");
        create.SetNameValue("BIGTIFF", "IF_SAFER");
        create.SetNameValue("SPARSE_OK", "TRUE");
        if (options_.compress.value_or(true)) {
            create.SetNameValue("COMPRESS", "DEFLATE");
            create.SetNameValue("ZLEVEL", "1");
            create.SetNameValue("PREDICTOR", "3");
            create.SetNameValue("NUM_THREADS", "ALL_CPUS");  // the order of blocks stays as they are written
        }
        const std::int64_t bands = static_cast<std::int64_t>(fields_.size()) * grid_.size[2];
        if (bands > 65535) {
            throw UsageError(path_ + ": GeoTIFF takes at most 65 535 bands, and " + std::to_string(bands) +
                             " slices are wanted");
        }
        GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
        dataset_.reset(
            driver->Create(scratch_.c_str(), columns_, rows_, static_cast<int>(bands), GDT_Float32, create.List()));
        if (!dataset_) {
            fail(scope);
        }
        place();
        describe();
    }

    void place() {
        const Vec3& s = grid_.spacing;
        double transform[6] = {
            grid_.origin.x - s.x / 2, s.x, 0, grid_.origin.y + (static_cast<double>(rows_) - 0.5) * s.y, 0, -s.y};
        dataset_->SetGeoTransform(transform);
        OGRSpatialReference crs;
        if (!grid_.frame.crs_wkt.empty() && crs.SetFromUserInput(grid_.frame.crs_wkt.c_str()) == OGRERR_NONE) {
            crs.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
            dataset_->SetSpatialRef(&crs);
        }
    }

    void describe() {
        for (std::size_t n = 0; n < fields_.size(); ++n) {
            const VoxelLayer& layer = grid_.layers[fields_[n]];
            for (std::int64_t k = 0; k < grid_.size[2]; ++k) {
                GDALRasterBand* band = band_of(n, k);
                const std::string z = decimal(grid_.center(0, 0, k).z);
                band->SetDescription(("z=" + z + (fields_.size() == 1 ? "" : " " + layer.property.name)).c_str());
                band->SetMetadataItem("Z", z.c_str());
                band->SetMetadataItem("PROPERTY", layer.property.name.c_str());
                if (!layer.property.unit.empty()) {
                    band->SetUnitType(layer.property.unit.c_str());
                }
                band->SetNoDataValue(std::numeric_limits<double>::quiet_NaN());
            }
            if (layer.is_class()) {
                for (std::size_t c = 0; c < layer.property.classes.size(); ++c) {
                    dataset_->SetMetadataItem((layer.plain_name + "_" + std::to_string(c)).c_str(),
                                              layer.property.classes[c].c_str(), "CLASSES");
                }
            }
        }
        dataset_->SetMetadataItem("Z_SPACING", decimal(grid_.spacing.z).c_str());
        dataset_->SetMetadataItem("LENGTH_UNIT", grid_.frame.unit.c_str());
        dataset_->SetMetadataItem("AREA_OR_POINT", "Area");
    }

    [[nodiscard]] GDALRasterBand* band_of(std::size_t n, std::int64_t k) const {
        return dataset_->GetRasterBand(static_cast<int>(static_cast<std::int64_t>(n) * grid_.size[2] + k + 1));
    }

    void begin_rows(const Brick& brick) {
        const std::size_t wanted = static_cast<std::size_t>(2 * block) * block * static_cast<std::size_t>(columns_);
        for (auto& rows : pending_) {
            rows.resize(wanted, no_value());
        }
        first_new_ = height_;
        static_cast<void>(brick);
    }

    /// Row r of those pending, of slice k of a layer of bricks.
    [[nodiscard]] float* row_of(std::size_t n, int k, int r) {
        return pending_[n].data() + (static_cast<std::size_t>(k) * 2 * block + static_cast<std::size_t>(r)) *
                                        static_cast<std::size_t>(columns_);
    }

    /// The first 64 pending rows, or what there is of them, as a row of blocks of each slice.
    void write_blocks(int first_slice) {
        const GdalScope scope;
        const int taken = std::min(height_, block);
        std::vector<float> tile(static_cast<std::size_t>(block) * block);
        for (std::size_t n = 0; n < fields_.size(); ++n) {
            for (int k = 0; k < slices_; ++k) {
                for (int column = 0; column < columns_; column += block) {
                    std::ranges::fill(tile, no_value());
                    bool any = false;
                    for (int r = 0; r < taken; ++r) {
                        const float* row = row_of(n, k, r);
                        for (int i = 0; i < std::min(block, columns_ - column); ++i) {
                            tile[static_cast<std::size_t>(r) * block + static_cast<std::size_t>(i)] = row[column + i];
                            any |= !std::isnan(row[column + i]);
                        }
                    }
                    if (any &&
                        band_of(n, first_slice + k)->WriteBlock(column / block, block_row_, tile.data()) != CE_None) {
                        fail(scope);
                    }
                }
                for (int r = taken; r < height_; ++r) {
                    std::copy_n(row_of(n, k, r), columns_, row_of(n, k, r - taken));
                }
            }
        }
        height_ -= taken;
        ++block_row_;
    }

    void make_cog() {
        const GdalScope scope;
        const Dataset source(GDALDataset::Open(scratch_.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY));
        CPLStringList create;
        create.SetNameValue("COMPRESS", options_.compress.value_or(true) ? "DEFLATE" : "NONE");
        create.SetNameValue("PREDICTOR", options_.compress.value_or(true) ? "YES" : "NO");
        create.SetNameValue("LEVEL", "1");
        create.SetNameValue("RESAMPLING", "AVERAGE");
        create.SetNameValue("BIGTIFF", "IF_SAFER");
        create.SetNameValue("NUM_THREADS", "ALL_CPUS");
        GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("COG");
        Dataset cog(source && driver ? driver->CreateCopy(file_.temporary_path().c_str(), source.get(), FALSE,
                                                          create.List(), nullptr, nullptr)
                                     : nullptr);
        const bool made = cog != nullptr;
        cog.reset();
        if (!made || scope.failed()) {
            fail(scope);
        }
    }

    const VoxelGrid& grid_;
    ExportOptions options_;
    std::string path_;
    OutputFile file_;
    std::string scratch_;
    Dataset dataset_;
    std::vector<std::size_t> fields_;
    int columns_ = 0;
    int rows_ = 0;
    std::vector<std::vector<float>> pending_;  ///< [field]: [slice][row, 128 at most][column]
    int height_ = 0;                           ///< rows pending
    int first_new_ = 0;
    int slices_ = 0;
    int block_row_ = 0;
};

}  // namespace

std::unique_ptr<VoxelSink> make_geotiff_sink(const VoxelGrid& grid, const std::string& path,
                                             const ExportOptions& options) {
    return std::make_unique<GeotiffSink>(grid, path, options);
}

}  // namespace terratet
