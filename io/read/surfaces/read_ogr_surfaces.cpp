// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <ogrsf_frmts.h>

#include <algorithm>
#include <map>
#include <numeric>

#include "io/base/gdal_dataset.hpp"
#include "io/base/rejections.hpp"
#include "io/base/text_lines.hpp"
#include "io/read/surfaces/polygon_surface.hpp"
#include "io/read/surfaces/read_surfaces.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

/// The column that names surfaces: by the usual names, or the layer of a drawing that was converted face by face.
int name_field(OGRFeatureDefn& definition, const Source& source, const ColumnNames& columns) {
    Table header;
    header.file = source.describe();
    for (int i = 0; i < definition.GetFieldCount(); ++i) {
        header.columns.push_back(to_utf8(definition.GetFieldDefn(i)->GetNameRef()));
    }
    const int usual = find_optional_column(header, Meaning::name, columns);
    const int layer = definition.GetFieldIndex("layer");
    return usual < 0 && layer < 0 ? find_column(header, Meaning::name, columns) : usual < 0 ? layer : usual;
}

/// One feature's polygons, by name and record, before it is known how features join.
struct Feature {
    std::string name;
    std::int64_t record = 0;
    std::vector<PolygonRings> polygons;
};

std::vector<Feature> read_features(OGRLayer& layer, int name_index, Rejections& rejections, bool& any_flat) {
    std::vector<Feature> features;
    layer.ResetReading();
    while (const OGRFeatureUniquePtr record{layer.GetNextFeature()}) {
        Feature feature;
        feature.record = record->GetFID();
        const auto reject = [&](const std::string& reason) { rejections.add(feature.record, [&] { return reason; }); };
        const OGRGeometry* const geometry = record->GetGeometryRef();
        if (!geometry || geometry->IsEmpty()) {
            reject("no geometry");
            continue;
        }
        if (!geometry->Is3D()) {
            any_flat = true;
            reject("a " + std::string(OGRGeometryTypeToName(wkbFlatten(geometry->getGeometryType()))) +
                   " without z coordinates is no surface in space");
            continue;
        }
        if (name_index >= 0 && record->IsFieldSetAndNotNull(name_index)) {
            feature.name = to_utf8(record->GetFieldAsString(name_index));
        }
        for_each_polygon(
            *geometry, [&](const OGRPolygon& polygon) { feature.polygons.push_back(rings_of(polygon)); },
            [&](const char* type) { reject("a " + std::string(type) + " is no surface; polygons are needed"); });
        if (!feature.polygons.empty()) {
            features.push_back(std::move(feature));
        }
    }
    return features;
}

/// Names features without one: after the layer when it is one surface face by face or has one feature, else numbered.
void name_the_nameless(std::vector<Feature>& features, const std::string& layer) {
    const auto nameless = [](const Feature& f) { return f.name.empty(); };
    const bool faces =
        std::all_of(features.begin(), features.end(), [&](const Feature& f) { return f.polygons.size() == 1; });
    const bool whole = faces || std::count_if(features.begin(), features.end(), nameless) == 1;
    for (Feature& feature : features) {
        if (nameless(feature)) {
            feature.name = whole ? layer : layer + " " + std::to_string(feature.record);
        }
    }
}

}  // namespace

RawSurfaces read_ogr_surfaces(const Source& source, SurfaceKind kind, const ColumnNames& columns,
                              Diagnostics& diagnostics) {
    const GdalScope scope(source.path);
    const Dataset dataset = open_vector(source);
    ResultSet result_set;
    OGRLayer& layer = open_layer(*dataset, source, scope, result_set);

    RawSurfaces result;
    result.crs = crs_of(layer);
    bool any_flat = false;
    Rejections rejections(diagnostics, source.describe());
    std::vector<Feature> features =
        read_features(layer, name_field(*layer.GetLayerDefn(), source, columns), rejections, any_flat);
    if (scope.failed()) {
        rejections.add(0, [&] { return "reading was not complete: " + scope.failure(); });
    }
    name_the_nameless(features, to_utf8(source.layer.empty() ? layer.GetName() : source.layer));

    std::map<std::string, PolygonSurface> builders;
    for (const Feature& feature : features) {
        for (const PolygonRings& rings : feature.polygons) {
            const std::string reason = builders[feature.name].add(rings);
            if (!reason.empty()) {
                rejections.add(feature.record, [&] { return reason; });
            }
        }
    }
    for (const auto& [name, builder] : builders) {
        if (!builder.empty()) {
            Surface surface = builder.finish(name);
            surface.kind = kind;
            surface.file = to_utf8(source.path);
            result.surfaces.push_back(std::move(surface));
        }
    }
    if (result.surfaces.empty()) {
        throw InputError(
            source.describe() + (any_flat ? ": its geometries have no z" : ": no polygon makes a surface") +
            rejections.first() +
            "; surfaces in space are needed: points with x, y, z, or TIN Z, PolyhedralSurface Z, MultiPolygon Z, "
            "Polygon Z");
    }
    return result;
}

}  // namespace terratet
