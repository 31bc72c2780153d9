// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/write/write_rows.hpp"

#include <gdal_priv.h>
#include <ogrsf_frmts.h>
#include <unistd.h>

#include <map>

#include "io/base/csv_text.hpp"
#include "io/base/current_time.hpp"
#include "io/base/gdal_dataset.hpp"
#include "io/base/gdal_scope.hpp"
#include "io/base/lower_case.hpp"
#include "io/base/output_file.hpp"
#include "tess/base/words.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

void append_cell(std::string& text, const RowCell& cell) {
    switch (cell.kind) {
        case RowCell::Kind::number:
            return append_csv_number(text, cell.number);
        case RowCell::Kind::integer:
            return append_csv_number(text, cell.integer);
        case RowCell::Kind::text:
            return append_csv_text(text, cell.text);
        case RowCell::Kind::nothing:
            return;
    }
}

class CsvFile final : public RowSink {
  public:
    CsvFile(const std::string& path, bool overwrite) : file_(path, overwrite) {}
    void begin(const std::vector<RowColumn>& columns) override { file_.write(csv_line(columns)); }
    void add(const std::vector<Row>& rows) override { file_.write(csv_lines(rows)); }
    void end() override { file_.commit(); }

  private:
    OutputFile file_;
};

OGRFieldType field_type(RowColumn::Type type) {
    return type == RowColumn::Type::number ? OFTReal : type == RowColumn::Type::integer ? OFTInteger64 : OFTString;
}

std::unique_ptr<OGRGeometry> geometry_of(const std::vector<Vec3>& outline) {
    if (outline.size() == 1) {
        return std::make_unique<OGRPoint>(outline[0].x, outline[0].y, outline[0].z);
    }
    auto ring = std::make_unique<OGRLinearRing>();
    for (const Vec3& p : outline) {
        ring->addPoint(p.x, p.y, p.z);
    }
    ring->closeRings();
    auto polygon = std::make_unique<OGRPolygon>();
    polygon->addRingDirectly(ring.release());
    return polygon;
}

class OgrFile final : public RowSink {
  public:
    OgrFile(const std::string& path, const char* driver, std::string layer, const Frame& frame, bool overwrite)
        : path_(path), layer_name_(std::move(layer)), file_(path, overwrite) {
        file_.close();
        unlink(file_.temporary_path().c_str());  // drivers insist on making it
        GDALDriver* const found = GetGDALDriverManager()->GetDriverByName(driver);
        dataset_.reset(found ? found->Create(file_.temporary_path().c_str(), 0, 0, 0, GDT_Unknown, nullptr) : nullptr);
        if (!dataset_) {
            fail();
        }
        if (!frame.crs_wkt.empty() && reference_.importFromWkt(frame.crs_wkt.c_str()) == OGRERR_NONE) {
            reference_.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
            has_reference_ = true;
        }
    }

    void begin(const std::vector<RowColumn>& columns) override { columns_ = columns; }

    void add(const std::vector<Row>& rows) override {
        for (const Row& row : rows) {
            if (layer_ == nullptr) {
                create_layer(row.outline.size());
            }
            const OGRFeatureUniquePtr feature(OGRFeature::CreateFeature(layer_->GetLayerDefn()));
            for (std::size_t i = 0; i < row.cells.size(); ++i) {
                set(*feature, static_cast<int>(i), row.cells[i]);
            }
            if (!row.outline.empty()) {
                feature->SetGeometryDirectly(geometry_of(row.outline).release());
            }
            if (layer_->CreateFeature(feature.get()) != OGRERR_NONE) {
                fail();
            }
        }
    }

    void end() override {
        if (layer_ == nullptr) {
            create_layer(0);
        }
        if (in_transaction_ && dataset_->CommitTransaction() != OGRERR_NONE) {
            fail();
        }
        dataset_.reset();
        if (scope_.failed()) {
            fail();
        }
        file_.commit();
    }

  private:
    void create_layer(std::size_t corners) {
        const OGRwkbGeometryType type = corners == 0 ? wkbNone : corners == 1 ? wkbPoint25D : wkbPolygon25D;
        layer_ = dataset_->CreateLayer(layer_name_.c_str(), has_reference_ ? &reference_ : nullptr, type, nullptr);
        if (layer_ == nullptr) {
            fail();
        }
        for (const RowColumn& column : columns_) {
            OGRFieldDefn field(column.name.c_str(), field_type(column.type));
            if (layer_->CreateField(&field) != OGRERR_NONE) {
                fail();
            }
        }
        in_transaction_ =
            dataset_->TestCapability(ODsCTransactions) != 0 && dataset_->StartTransaction() == OGRERR_NONE;
    }

    static void set(OGRFeature& feature, int field, const RowCell& cell) {
        switch (cell.kind) {
            case RowCell::Kind::number:
                return feature.SetField(field, cell.number);
            case RowCell::Kind::integer:
                return feature.SetField(field, static_cast<GIntBig>(cell.integer));
            case RowCell::Kind::text:
                return feature.SetField(field, cell.text.c_str());
            case RowCell::Kind::nothing:
                return feature.SetFieldNull(field);
        }
    }

    [[noreturn]] void fail() const {
        throw Error("cannot write " + path_ + (scope_.failed() ? ": " + scope_.failure() : ""));
    }

    GdalScope scope_;
    GeoPackageTime now_;
    std::string path_;
    std::string layer_name_;
    OutputFile file_;
    Dataset dataset_;
    OGRSpatialReference reference_;
    bool has_reference_ = false;
    std::vector<RowColumn> columns_;
    OGRLayer* layer_ = nullptr;
    bool in_transaction_ = false;
};

}  // namespace

std::string csv_line(const std::vector<RowColumn>& columns) {
    std::string line;
    for (std::size_t i = 0; i < columns.size(); ++i) {
        line += i == 0 ? "" : ",";
        append_csv_text(line, columns[i].name);
    }
    return line + '\n';
}

std::string csv_lines(const std::vector<Row>& rows) {
    std::string text;
    for (const Row& row : rows) {
        for (std::size_t i = 0; i < row.cells.size(); ++i) {
            text += i == 0 ? "" : ",";
            append_cell(text, row.cells[i]);
        }
        text += '\n';
    }
    return text;
}

std::unique_ptr<RowSink> rows_to_file(const std::string& path, const std::string& layer, const Frame& frame,
                                      bool overwrite) {
    static const std::map<std::string, const char*> drivers{
        {"geojson", "GeoJSON"}, {"json", "GeoJSON"},   {"geojsonl", "GeoJSONSeq"},
        {"gpkg", "GPKG"},       {"fgb", "FlatGeobuf"}, {"sqlite", "SQLite"},
        {"xlsx", "XLSX"},       {"ods", "ODS"},        {"tab", "MapInfo File"}};
    const std::size_t dot = path.rfind('.');
    const std::string extension = dot == std::string::npos ? "" : lower_case(path.substr(dot + 1));
    if (extension == "csv" || extension == "txt") {
        return std::make_unique<CsvFile>(path, overwrite);
    }
    const auto found = drivers.find(extension);
    if (found == drivers.end()) {
        const std::vector<std::string> known{"csv", "geojson", "gpkg", "fgb", "sqlite", "xlsx", "ods", "tab"};
        throw UsageError(path + ": rows are written as ." + listed(known) + did_you_mean(extension, known));
    }
    return std::make_unique<OgrFile>(path, found->second, layer, frame, overwrite);
}

}  // namespace terratet
