// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/voxels/cf_grid_mapping.hpp"

#include <cpl_conv.h>
#include <ogr_spatialref.h>

#include <cstring>

#include "io/base/gdal_scope.hpp"

namespace terratet {
namespace {

/// One parameter: what CF calls it, and what OGR does.
struct Parameter {
    const char* cf;
    const char* ogr;
};

struct Projection {
    const char* ogr;
    const char* cf;
    std::vector<Parameter> parameters;
};

const std::vector<Projection>& projections() {
    static const Parameter easting{"false_easting", SRS_PP_FALSE_EASTING};
    static const Parameter northing{"false_northing", SRS_PP_FALSE_NORTHING};
    static const Parameter latitude{"latitude_of_projection_origin", SRS_PP_LATITUDE_OF_ORIGIN};
    static const Parameter meridian{"longitude_of_central_meridian", SRS_PP_CENTRAL_MERIDIAN};
    static const Parameter longitude{"longitude_of_projection_origin", SRS_PP_CENTRAL_MERIDIAN};
    static const std::vector<Projection> all{
        {SRS_PT_TRANSVERSE_MERCATOR,
         "transverse_mercator",
         {meridian, latitude, {"scale_factor_at_central_meridian", SRS_PP_SCALE_FACTOR}, easting, northing}},
        {SRS_PT_LAMBERT_CONFORMAL_CONIC_2SP, "lambert_conformal_conic", {meridian, latitude, easting, northing}},
        {SRS_PT_LAMBERT_CONFORMAL_CONIC_1SP,
         "lambert_conformal_conic",
         {{"standard_parallel", SRS_PP_LATITUDE_OF_ORIGIN}, meridian, latitude, easting, northing}},
        {SRS_PT_ALBERS_CONIC_EQUAL_AREA,
         "albers_conical_equal_area",
         {{"longitude_of_central_meridian", SRS_PP_LONGITUDE_OF_CENTER},
          {"latitude_of_projection_origin", SRS_PP_LATITUDE_OF_CENTER},
          easting,
          northing}},
        {SRS_PT_LAMBERT_AZIMUTHAL_EQUAL_AREA,
         "lambert_azimuthal_equal_area",
         {{"longitude_of_projection_origin", SRS_PP_LONGITUDE_OF_CENTER},
          {"latitude_of_projection_origin", SRS_PP_LATITUDE_OF_CENTER},
          easting,
          northing}},
        {SRS_PT_AZIMUTHAL_EQUIDISTANT,
         "azimuthal_equidistant",
         {{"longitude_of_projection_origin", SRS_PP_LONGITUDE_OF_CENTER},
          {"latitude_of_projection_origin", SRS_PP_LATITUDE_OF_CENTER},
          easting,
          northing}},
        {SRS_PT_STEREOGRAPHIC,
         "stereographic",
         {longitude, latitude, {"scale_factor_at_projection_origin", SRS_PP_SCALE_FACTOR}, easting, northing}},
        {SRS_PT_MERCATOR_1SP,
         "mercator",
         {longitude, {"scale_factor_at_projection_origin", SRS_PP_SCALE_FACTOR}, easting, northing}},
    };
    return all;
}

std::string text_of(const OGRSpatialReference& crs, const char* format) {
    char* text = nullptr;
    const std::string option = std::string("FORMAT=") + format;
    const char* const options[] = {option.c_str(), nullptr};
    const std::string result = crs.exportToWkt(&text, options) == OGRERR_NONE && text != nullptr ? text : "";
    CPLFree(text);
    return result;
}

void add_projection(const OGRSpatialReference& crs, std::vector<CfAttribute>& out) {
    const char* name = crs.GetAttrValue("PROJECTION");
    if (crs.IsGeographic()) {
        out.emplace_back("grid_mapping_name", "latitude_longitude");
        return;
    }
    if (name == nullptr) {
        return;
    }
    for (const Projection& projection : projections()) {
        if (std::strcmp(name, projection.ogr) == 0) {
            out.emplace_back("grid_mapping_name", projection.cf);
            for (const Parameter& parameter : projection.parameters) {
                out.emplace_back(parameter.cf, crs.GetNormProjParm(parameter.ogr, 0));
            }
            if (std::strcmp(name, SRS_PT_LAMBERT_CONFORMAL_CONIC_2SP) == 0 ||
                std::strcmp(name, SRS_PT_ALBERS_CONIC_EQUAL_AREA) == 0) {
                out.emplace_back("standard_parallel",
                                 std::vector<double>{crs.GetNormProjParm(SRS_PP_STANDARD_PARALLEL_1, 0),
                                                     crs.GetNormProjParm(SRS_PP_STANDARD_PARALLEL_2, 0)});
            }
        }
    }
}

}  // namespace

std::vector<CfAttribute> cf_grid_mapping(const std::string& wkt) {
    const GdalScope scope;
    OGRSpatialReference crs;
    if (wkt.empty() || crs.SetFromUserInput(wkt.c_str()) != OGRERR_NONE || crs.IsLocal()) {
        return {};
    }
    std::vector<CfAttribute> out;
    OGRSpatialReference plane(crs);
    if (plane.IsCompound()) {
        plane.StripVertical();
    }
    add_projection(plane, out);
    out.emplace_back("semi_major_axis", plane.GetSemiMajor());
    out.emplace_back("inverse_flattening", plane.GetInvFlattening());
    out.emplace_back("longitude_of_prime_meridian", plane.GetPrimeMeridian());
    out.emplace_back("crs_wkt", text_of(crs, "WKT2_2019"));
    out.emplace_back("esri_pe_string", text_of(plane, "WKT1_ESRI"));
    return out;
}

}  // namespace terratet
