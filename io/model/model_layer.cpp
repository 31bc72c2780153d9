// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/model/model_layer.hpp"

#include <cpl_string.h>

#include <algorithm>
#include <cassert>
#include <charconv>
#include <climits>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "tess/error.hpp"

namespace terratet {

std::string because(const GdalScope& scope) {
    const auto says = [&](const char* what) { return scope.failure().find(what) != std::string::npos; };
    const char* const advice =
        says("full")             ? "; free some space or choose another folder"
        : says("disk I/O error") ? "; is the disk full, or does a limit of the shell (ulimit -f) allow no larger file?"
                                 : "";
    return scope.failed() ? ": " + scope.failure() + advice : "";
}

LayerWriter::LayerWriter(GDALDataset& dataset, const GdalScope& scope, std::string file, const char* name,
                         OGRwkbGeometryType type, const OGRSpatialReference* reference)
    : dataset_(dataset),
      scope_(scope),
      file_(std::move(file)),
      name_(name),
      type_(type),
      reference_(reference),
      postgis_(EQUAL(dataset.GetDriverName(), "PostgreSQL")) {}

Column LayerWriter::add(const std::string& name, OGRFieldType type) {
    columns_.emplace_back(name, type);
    return static_cast<Column>(columns_.size() - 1);
}

/// The same names in every database, whatever its driver's habits. GDAL hands numbers to PostgreSQL with 15 digits; so
/// its fields are text, in columns that are float8 all the same.
void LayerWriter::create() {
    CPLStringList options;
    options.SetNameValue("FID", "fid");
    options.SetNameValue("GEOMETRY_NAME", "geom");
    if (postgis_) {
        std::string numbers;
        for (const auto& [name, type] : columns_) {
            numbers += type == OFTReal ? (numbers.empty() ? "" : ",") + name + "=float8" : "";
        }
        options.SetNameValue("COLUMN_TYPES", numbers.c_str());
        options.SetNameValue("LAUNDER", "NO");
        options.SetNameValue("OVERWRITE", "YES");
        options.SetNameValue("FID64", "TRUE");
        options.SetNameValue("SPATIAL_INDEX", "NONE");
    } else {
        // An R-tree costs four times the rest of the writing; Terratet never uses it and QGIS makes one on request.
        options.SetNameValue("SPATIAL_INDEX", "NO");
    }
    layer_ = dataset_.CreateLayer(name_.c_str(), const_cast<OGRSpatialReference*>(reference_), type_, options.List());
    if (!layer_) {
        throw Error("cannot write " + file_ + ": layer " + name_ + because(scope_));
    }
    for (const auto& [name, type] : columns_) {
        OGRFieldDefn definition(name.c_str(), postgis_ && type == OFTReal ? OFTString : type);
        if (layer_->CreateField(&definition) != OGRERR_NONE) {
            throw Error("cannot write " + file_ + ": layer " + name_ + ", column " + name + because(scope_));
        }
    }
    // One feature serves all rows; its cells are null (not unset), so that the driver prepares its statement once.
    row_.reset(OGRFeature::CreateFeature(layer_->GetLayerDefn()));
    assert(row_->GetFieldCount() == static_cast<int>(columns_.size()));
    for (Column column = 0; column < row_->GetFieldCount(); ++column) {
        row_->SetFieldNull(column);
    }
}

void LayerWriter::set(Column column, double value) {
    if (std::isnan(value)) {
        row_->SetFieldNull(column);
    } else if (postgis_) {
        char text[32] = {};
        std::to_chars(std::begin(text), std::end(text) - 1, value);
        row_->SetField(column, text);
    } else {
        row_->SetField(column, value);
    }
}

void LayerWriter::set(Column column, std::int64_t value) {
    row_->SetField(column, static_cast<GIntBig>(value));
}

void LayerWriter::set(Column column, const std::string& value) {
    row_->SetField(column, value.c_str());
}

void LayerWriter::set(Column column, std::span<const std::byte> value) {
    if (value.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
        throw Error("cannot write " + file_ + ": a surface of more than 2 GiB; split it");
    }
    row_->SetField(column, static_cast<int>(value.size()), value.data());
}

void LayerWriter::set_point(const Vec3& position) {
    if (!point_) {
        auto point = std::make_unique<OGRPoint>();
        point_ = point.get();
        row_->SetGeometryDirectly(point.release());
    }
    *point_ = OGRPoint(position.x, position.y, position.z);
}

void LayerWriter::set_geometry(std::unique_ptr<OGRGeometry> geometry) {
    row_->SetGeometryDirectly(geometry.release());
}

void LayerWriter::write() {
    row_->SetFID(++row_number_);
    if (layer_->CreateFeature(row_.get()) != OGRERR_NONE) {
        throw Error("cannot write " + file_ + because(scope_));
    }
    for (Column column = 0; column < row_->GetFieldCount(); ++column) {
        row_->SetFieldNull(column);
    }
}

LayerReader::LayerReader(GDALDataset& dataset, GdalScope& scope, std::string file, const char* name)
    : scope_(scope), file_(std::move(file)), name_(name), layer_(dataset.GetLayerByName(name)) {
    if (!layer_) {
        throw InputError(file_ + ": layer " + name_ + " is missing; this is no complete Terratet model");
    }
    layer_->ResetReading();
}

Column LayerReader::find(const std::string& name, OGRFieldType type) const {
    const OGRFeatureDefn& definition = *layer_->GetLayerDefn();
    const Column column = definition.GetFieldIndex(name.c_str());
    const OGRFieldType found = column < 0 ? OFTMaxType : definition.GetFieldDefn(column)->GetType();
    if (found != type && !(type == OFTInteger64 && found == OFTInteger)) {
        throw InputError(file_ + ": layer " + name_ + " has no column " + name + " of type " +
                         OGRFieldDefn::GetFieldTypeName(type) + "; it was changed or damaged");
    }
    return column;
}

bool LayerReader::next() {
    scope_.clear();
    const std::int64_t before = row_ ? row_->GetFID() : std::numeric_limits<std::int64_t>::min();
    row_.reset(layer_->GetNextFeature());
    if (scope_.failed()) {
        throw InputError(file_ + ": layer " + name_ + " is damaged: " + scope_.failure());
    }
    if (row_ && row_->GetFID() <= before) {
        fail("rows are out of order");
    }
    return row_ != nullptr;
}

double LayerReader::number_at(Column column) const {
    return is_set(column) ? row_->GetFieldAsDouble(column) : std::numeric_limits<double>::quiet_NaN();
}

double LayerReader::required_number_at(Column column) const {
    if (!is_set(column)) {
        fail(std::string("no value in column ") + row_->GetFieldDefnRef(column)->GetNameRef());
    }
    return row_->GetFieldAsDouble(column);
}

std::optional<std::int64_t> LayerReader::integer_at(Column column) const {
    return is_set(column) ? std::optional<std::int64_t>(row_->GetFieldAsInteger64(column)) : std::nullopt;
}

std::int64_t LayerReader::required_integer_at(Column column) const {
    if (!is_set(column)) {
        fail(std::string("no value in column ") + row_->GetFieldDefnRef(column)->GetNameRef());
    }
    return row_->GetFieldAsInteger64(column);
}

std::optional<std::string> LayerReader::text_at(Column column) const {
    if (!is_set(column)) {
        return std::nullopt;
    }
    std::string text = row_->GetFieldAsString(column);
    if (!CPLIsUTF8(text.c_str(), static_cast<int>(std::min<std::size_t>(text.size(), INT_MAX)))) {
        fail(std::string("the text in column ") + row_->GetFieldDefnRef(column)->GetNameRef() + " is not UTF-8");
    }
    return text;
}

std::string LayerReader::required_text_at(Column column) const {
    auto text = text_at(column);
    if (!text) {
        fail(std::string("no value in column ") + row_->GetFieldDefnRef(column)->GetNameRef());
    }
    return *std::move(text);
}

std::span<const std::byte> LayerReader::bytes_at(Column column) const {
    if (!is_set(column)) {
        return {};
    }
    int size = 0;
    const GByte* const bytes = row_->GetFieldAsBinary(column, &size);
    return std::as_bytes(std::span(bytes, static_cast<std::size_t>(size)));
}

Vec3 LayerReader::point() const {
    const OGRGeometry* const found = geometry();
    if (!found || wkbFlatten(found->getGeometryType()) != wkbPoint || found->IsEmpty() || !found->Is3D()) {
        fail("its geometry is no point with z");
    }
    const OGRPoint& p = *found->toPoint();
    const Vec3 position{p.getX(), p.getY(), p.getZ()};
    if (!is_acceptable(position)) {
        fail("its coordinates " + std::to_string(position.x) + ", " + std::to_string(position.y) + ", " +
             std::to_string(position.z) + " are no numbers within 1e9");
    }
    return position;
}

void LayerReader::require(bool good, Column column, const char* wanted) const {
    if (!good) {
        const std::string found = is_set(column) ? row_->GetFieldAsString(column) : "nothing";
        fail(std::string("column ") + row_->GetFieldDefnRef(column)->GetNameRef() + " holds " + found +
             ", which is not " + wanted);
    }
}

void LayerReader::fail(const std::string& what) const {
    throw InputError(file_ + ": layer " + name_ + ", row " + std::to_string(row_->GetFID()) + ": " + what);
}

}  // namespace terratet
