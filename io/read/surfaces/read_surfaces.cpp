// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read/surfaces/read_surfaces.hpp"

#include <ogrsf_frmts.h>

#include "io/base/gdal_dataset.hpp"
#include "io/base/library_failure.hpp"
#include "io/base/text_lines.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

/// A drawing begins with the group code 0 and SECTION, after comments (code 999), or with the binary format's
/// signature.
bool is_dxf(const std::string& path) {
    if (EQUAL(CPLGetExtension(path.c_str()), "dxf")) {
        return true;
    }
    try {
        LineReader reader(path);
        std::string_view code, value;
        while (reader.next(code) && trimmed(code) == "999" && reader.next(value)) {
        }
        if (code.starts_with("AutoCAD Binary DXF")) {
            return true;
        }
        return trimmed(code) == "0" && reader.next(value) && trimmed(value) == "SECTION";
    } catch (const InputError&) {
        return false;
    }
}

/// Points, or records without geometry, which may have their coordinates in columns; what is neither are surfaces.
bool holds_points(OGRLayer& layer) {
    OGRwkbGeometryType type = wkbFlatten(layer.GetGeomType());
    if (type == wkbUnknown) {
        const OGRFeatureUniquePtr first{layer.GetNextFeature()};
        const OGRGeometry* const geometry = first ? first->GetGeometryRef() : nullptr;
        type = geometry ? wkbFlatten(geometry->getGeometryType()) : wkbNone;
    }
    return type == wkbNone || type == wkbPoint || type == wkbMultiPoint;
}

bool holds_points(const Source& source) {
    const GdalScope scope(source.path);
    const Dataset dataset = open_vector(source);
    ResultSet result_set;
    return holds_points(open_layer(*dataset, source, scope, result_set));
}

RawSurfaces read_any(const Source& source, SurfaceKind kind, const ColumnNames& columns, Diagnostics& diagnostics) {
    if (is_gocad(source.path)) {
        return read_tsurf(source, kind, diagnostics);
    }
    if (is_raster(source.path)) {
        return read_raster_surface(source, kind, diagnostics);
    }
    if (is_dxf(source.path)) {
        throw InputError(
            source.path +
            ": DXF is not read here, since GDAL's reader of it can hang on a damaged file; convert a drawing "
            "you trust with: ogr2ogr faults.gpkg " +
            CPLGetFilename(source.path.c_str()));
    }
    return holds_points(source) ? read_fault_points(source, kind, columns, diagnostics)
                                : read_ogr_surfaces(source, kind, columns, diagnostics);
}

}  // namespace

RawSurfaces read_surfaces(const Source& source, SurfaceKind kind, const ColumnNames& columns,
                          Diagnostics& diagnostics) {
    return naming_file(source.describe(), [&] { return read_any(source, kind, columns, diagnostics); });
}

}  // namespace terratet
