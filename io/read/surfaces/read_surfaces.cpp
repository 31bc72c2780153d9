// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read/surfaces/read_surfaces.hpp"

#include <ogrsf_frmts.h>

#include <algorithm>

#include "io/base/gdal_dataset.hpp"
#include "io/base/library_failure.hpp"
#include "io/base/text_lines.hpp"
#include "io/read/meshes/read_mesh.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

enum class Held { points, lines, polygons };

/// Records without geometry may have their coordinates in columns; what is neither point nor line are surfaces.
Held held_by(OGRLayer& layer) {
    OGRwkbGeometryType type = wkbFlatten(layer.GetGeomType());
    if (type == wkbUnknown) {
        const OGRFeatureUniquePtr first{layer.GetNextFeature()};
        const OGRGeometry* const geometry = first ? first->GetGeometryRef() : nullptr;
        type = geometry ? wkbFlatten(geometry->getGeometryType()) : wkbNone;
    }
    if (type == wkbNone || type == wkbPoint || type == wkbMultiPoint) {
        return Held::points;
    }
    return type == wkbLineString || type == wkbMultiLineString ? Held::lines : Held::polygons;
}

Held held_by(const Source& source, Diagnostics& diagnostics) {
    const GdalScope scope(source.path);
    const Dataset dataset = open_vector(source);
    ResultSet result_set;
    OGRLayer& layer = open_layer(*dataset, source, scope, result_set);
    const Held held = held_by(layer);
    if (const std::string note = other_layers(*dataset, layer, source); held != Held::points && !note.empty()) {
        diagnostics.note(source.describe() + ": " + note);
    }
    return held;
}

RawSurfaces read_any(const Source& source, SurfaceKind kind, const ColumnNames& columns, const SurfaceOptions& options,
                     Diagnostics& diagnostics) {
    if (is_gocad(source.path)) {
        return read_tsurf(source, kind, diagnostics);
    }
    if (!is_connection(source.path)) {
        if (const auto format = mesh_format(source.path)) {
            return {read_mesh(source.path, *format, kind, diagnostics), {}};
        }
    }
    if (is_raster(source.path)) {
        return read_raster_surface(source, kind, diagnostics);
    }
    switch (held_by(source, diagnostics)) {
        case Held::points:
            return read_fault_points(source, kind, columns, options, diagnostics);
        case Held::lines:
            return read_traces(source, kind, columns, options, diagnostics);
        case Held::polygons:
            break;
    }
    return read_ogr_surfaces(source, kind, columns, diagnostics);
}

}  // namespace

RawSurfaces read_surfaces(const Source& source, SurfaceKind kind, const ColumnNames& columns, Diagnostics& diagnostics,
                          const SurfaceOptions& options) {
    RawSurfaces raw =
        naming_file(source.describe(), [&] { return read_any(source, kind, columns, options, diagnostics); });
    if (options.z_positive == ZPositive::down && !raw.z_stated) {
        for (Surface& surface : raw.surfaces) {
            std::ranges::for_each(surface.vertices, [](Vec3& p) { p.z = -p.z; });
        }
        raw.z_stated = true;
    }
    return raw;
}

}  // namespace terratet
