// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// One layer of the model file, row by row, through OGR. LayerWriter and LayerReader have the same functions to name
/// columns, so that a layer's columns are written down once (model_schema.hpp) and serve both
/// directions.

#include <ogrsf_frmts.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "io/base/gdal_dataset.hpp"
#include "io/base/gdal_scope.hpp"
#include "io/model/row_writer.hpp"
#include "tess/geometry.hpp"

namespace terratet {

/// What GDAL said of a write that failed, and what to do about a full disk; empty when it said nothing.
std::string because(const GdalScope& scope);

class LayerWriter final : public RowWriter {
  public:
    LayerWriter(GDALDataset& dataset, const GdalScope& scope, std::string file, const char* name,
                OGRwkbGeometryType type, const OGRSpatialReference* reference);

    Column number(const std::string& name) override { return add(name, OFTReal); }
    Column integer(const std::string& name) override { return add(name, OFTInteger64); }
    Column text(const std::string& name) override { return add(name, OFTString); }
    Column bytes(const std::string& name) override { return add(name, OFTBinary); }
    void create() override;
    void set(Column column, double value) override;
    void set(Column column, std::int64_t value) override;
    void set(Column column, const std::string& value) override;
    void set(Column column, std::span<const std::byte> value) override;
    void set_point(const Vec3& position) override;
    void set_geometry(std::unique_ptr<OGRGeometry> geometry) override;

    /// With the next number from 1.
    void write() override;

  private:
    Column add(const std::string& name, OGRFieldType type);

    GDALDataset& dataset_;
    const GdalScope& scope_;
    std::string file_;
    std::string name_;
    OGRwkbGeometryType type_;
    const OGRSpatialReference* reference_;
    bool postgis_;
    std::vector<std::pair<std::string, OGRFieldType>> columns_;
    OGRLayer* layer_ = nullptr;
    std::unique_ptr<OGRFeature> row_;
    OGRPoint* point_ = nullptr;
    std::int64_t row_number_ = 0;
};

class LayerReader {
  public:
    /// Throws InputError when there is no such layer.
    LayerReader(GDALDataset& dataset, GdalScope& scope, std::string file, const char* name);

    /// Columns by name. Throw InputError when there is none of the name and type.
    Column number(const std::string& name) const { return find(name, OFTReal); }
    Column integer(const std::string& name) const { return find(name, OFTInteger64); }
    Column text(const std::string& name) const { return find(name, OFTString); }
    Column bytes(const std::string& name) const { return find(name, OFTBinary); }

    /// To the next row; false behind the last. Throws InputError when the file is damaged.
    bool next();

    /// Cells of the current row. The required ones throw InputError when null.
    [[nodiscard]] double number_at(Column column) const;  ///< NaN when null
    [[nodiscard]] double required_number_at(Column column) const;
    [[nodiscard]] std::optional<std::int64_t> integer_at(Column column) const;
    [[nodiscard]] std::int64_t required_integer_at(Column column) const;
    [[nodiscard]] std::optional<std::string> text_at(Column column) const;
    [[nodiscard]] std::string required_text_at(Column column) const;
    [[nodiscard]] std::span<const std::byte> bytes_at(Column column) const;  ///< empty when null
    [[nodiscard]] bool is_set(Column column) const { return row_->IsFieldSetAndNotNull(column) != 0; }
    [[nodiscard]] Vec3 point() const;  ///< acceptable (geometry.hpp)
    [[nodiscard]] const OGRGeometry* geometry() const { return row_->GetGeometryRef(); }
    [[nodiscard]] std::int64_t row_number() const { return row_->GetFID(); }

    /// Throws InputError naming the file, the layer and the row.
    [[noreturn]] void fail(const std::string& what) const;

    /// Throws InputError naming the column and what is in it as well, unless `good`. \param wanted  "a length from 0"
    void require(bool good, Column column, const char* wanted) const;

  private:
    [[nodiscard]] Column find(const std::string& name, OGRFieldType type) const;

    GdalScope& scope_;
    std::string file_;
    std::string name_;
    OGRLayer* layer_;
    OGRFeatureUniquePtr row_;
};

}  // namespace terratet
