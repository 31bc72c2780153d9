// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "io/base/gdal_dataset.hpp"
#include "io/base/library_failure.hpp"
#include "io/base/rejections.hpp"
#include "io/base/text_lines.hpp"
#include "io/read/surfaces/polygon_surface.hpp"
#include "io/read/surfaces/read_surfaces.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

constexpr double parting = 1e-7;  ///< of the polygon's size: rings that touch are moved apart by it

using Geometry = std::unique_ptr<OGRGeometry>;

bool acceptable(const OGRGeometry& geometry) {
    OGREnvelope box;
    geometry.getEnvelope(&box);
    return is_acceptable({box.MinX, box.MinY, 0}) && is_acceptable({box.MaxX, box.MaxY, 0});
}

/// The polygons of a feature, sound ones.
class PolygonCollector {
  public:
    PolygonCollector(const Source& source, Diagnostics& diagnostics)
        : source_(source), diagnostics_(diagnostics), rejections_(diagnostics, source.describe()) {}

    void add(const OGRFeature& feature) {
        const std::int64_t record = feature.GetFID();
        const auto reject = [&](const std::string& reason) { rejections_.add(record, [&] { return reason; }); };
        const OGRGeometry* const geometry = feature.GetGeometryRef();
        if (!geometry || geometry->IsEmpty()) {
            reject("no geometry");
            return;
        }
        if (!acceptable(*geometry)) {
            reject("coordinates must be numbers within 1e9");
            return;
        }
        Geometry flat(geometry->getLinearGeometry());
        flat->flattenTo2D();
        for_each_polygon(
            *flat, [&](const OGRPolygon& polygon) { add(polygon, record); },
            [&](const char* type) { reject("a " + std::string(type) + " encloses nothing; polygons are needed"); });
    }

    /// Their union, which has no edges between neighbours. Throws InputError when there is none.
    Geometry all() {
        if (polygons_.IsEmpty()) {
            throw InputError(
                source_.describe() + ": no polygon bounds a domain" + rejections_.first() +
                "; a layer of polygons is needed: name it with layer=, and close lines to polygons before");
        }
        return Geometry(polygons_.UnionCascaded());
    }

    void reject(const std::string& reason) {
        rejections_.add(0, [&] { return reason; });
    }

  private:
    void add(const OGRPolygon& polygon, std::int64_t record) {
        if (polygon.IsValid()) {
            polygons_.addGeometry(&polygon);
            return;
        }
        const Geometry repaired(polygon.MakeValid());
        double area = 0;
        if (repaired) {
            for_each_polygon(
                *repaired,
                [&](const OGRPolygon& part) {
                    polygons_.addGeometry(&part);
                    area += part.get_Area();
                },
                [](const char*) {});  // what had no area
        }
        if (area == 0) {
            reject("a polygon without area");
            return;
        }
        diagnostics_.note(
            fmt::format("{}, record {}: the polygon crosses or touches itself; it is used as repaired by GDAL's "
                        "MakeValid, with an area of {:.6g}: see that this is what was meant",
                        source_.describe(), record, area));
    }

    const Source& source_;
    Diagnostics& diagnostics_;
    Rejections rejections_;
    OGRMultiPolygon polygons_;
};

/// Rings that touch, though valid, are no edges of one triangulation: they are moved apart by a hair.
std::string add_parted(const OGRPolygon& polygon, PolygonSurface& surface) {
    OGREnvelope box;
    polygon.getEnvelope(&box);
    const Geometry smaller(polygon.Buffer(-parting * std::hypot(box.MaxX - box.MinX, box.MaxY - box.MinY)));
    std::string problem = smaller ? "" : "it cannot be triangulated";
    if (smaller) {
        for_each_polygon(
            *smaller,
            [&](const OGRPolygon& part) {
                const std::string why = surface.add(rings_of(part));
                problem = why.empty() ? problem : why;
            },
            [](const char*) {});
    }
    return problem;
}

RawSurfaces read_polygons(const Source& source, Diagnostics& diagnostics) {
    const GdalScope scope(source.path);
    const Dataset dataset = open_vector(source);
    ResultSet result_set;
    OGRLayer& layer = open_layer(*dataset, source, scope, result_set);

    RawSurfaces result;
    result.crs = crs_of(layer);
    PolygonCollector polygons(source, diagnostics);
    layer.ResetReading();
    while (const OGRFeatureUniquePtr feature{layer.GetNextFeature()}) {
        polygons.add(*feature);
    }
    if (scope.failed()) {
        polygons.reject("reading was not complete: " + scope.failure());
    }
    PolygonSurface surface;
    const Geometry all = polygons.all();
    for_each_polygon(
        *all,
        [&](const OGRPolygon& polygon) {
            if (!surface.add(rings_of(polygon)).empty()) {
                if (const std::string problem = add_parted(polygon, surface); !problem.empty()) {
                    polygons.reject(problem);
                }
            }
        },
        [](const char*) {});
    if (surface.empty()) {
        throw InputError(source.describe() + ": its polygons have no area");
    }
    result.surfaces.push_back(surface.finish(to_utf8(source.layer.empty() ? layer.GetName() : source.layer)));
    result.surfaces.back().kind = SurfaceKind::domain;
    result.surfaces.back().file = to_utf8(source.path);
    return result;
}

}  // namespace

RawSurfaces read_domain(const Source& source, Diagnostics& diagnostics) {
    return naming_file(source.describe(), [&] { return read_polygons(source, diagnostics); });
}

}  // namespace terratet
