// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/crs.hpp"

#include <proj.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "io/base/lower_case.hpp"
#include "tess/error.hpp"
#include "tess/samples.hpp"

namespace terratet {

namespace {

/// A context of one's own (they are not thread-safe), silent: what goes wrong is in our exceptions.
struct ContextDeleter {
    void operator()(PJ_CONTEXT* context) const { proj_context_destroy(context); }
};
using Context = std::unique_ptr<PJ_CONTEXT, ContextDeleter>;

struct PjDeleter {
    void operator()(PJ* pj) const { proj_destroy(pj); }
};
using Pj = std::unique_ptr<PJ, PjDeleter>;

Context quiet_context() {
    Context context(proj_context_create());
    proj_log_level(context.get(), PJ_LOG_NONE);
    return context;
}

bool is_geographic(PJ_TYPE type) {
    return type == PJ_TYPE_GEOGRAPHIC_2D_CRS || type == PJ_TYPE_GEOGRAPHIC_3D_CRS;
}

/// The CRS that gives the plane coordinates: of a compound one its first, of a bound one its base.
Pj horizontal_part(PJ_CONTEXT* context, Pj crs) {
    for (int depth = 0; depth < 4; ++depth) {
        const PJ_TYPE type = proj_get_type(crs.get());
        if (type == PJ_TYPE_BOUND_CRS) {
            crs.reset(proj_get_source_crs(context, crs.get()));
        } else if (type == PJ_TYPE_COMPOUND_CRS) {
            crs.reset(proj_crs_get_sub_crs(context, crs.get(), 0));
        } else {
            break;
        }
        if (!crs) {
            break;
        }
    }
    return crs;
}

struct Axis {
    std::string unit;
    double to_si = 1;  ///< metres or radians
};

/// The unit of an axis; nothing when there is no such axis.
std::optional<Axis> axis_of(PJ_CONTEXT* context, const PJ* crs, int index) {
    const Pj system(proj_crs_get_coordinate_system(context, crs));
    const char* unit = nullptr;
    Axis axis;
    if (!system || index >= proj_cs_get_axis_count(context, system.get()) ||
        proj_cs_get_axis_info(context, system.get(), index, nullptr, nullptr, nullptr, &axis.to_si, &unit, nullptr,
                              nullptr) == 0) {
        return std::nullopt;
    }
    axis.unit = unit == nullptr ? "" : unit;
    return axis;
}

/// Metres in the unit of heights, when the CRS has heights of its own: its third axis, or its vertical component.
std::optional<double> own_height_unit(PJ_CONTEXT* context, const PJ* crs) {
    const PJ_TYPE type = proj_get_type(crs);
    if (type == PJ_TYPE_BOUND_CRS) {
        const Pj base(proj_get_source_crs(context, crs));
        return base ? own_height_unit(context, base.get()) : std::nullopt;
    }
    const bool compound = type == PJ_TYPE_COMPOUND_CRS;
    Pj vertical(compound ? proj_crs_get_sub_crs(context, crs, 1) : nullptr);
    if (compound && vertical && proj_get_type(vertical.get()) == PJ_TYPE_BOUND_CRS) {
        vertical.reset(proj_get_source_crs(context, vertical.get()));
    }
    const std::optional<Axis> axis =
        compound ? (vertical ? axis_of(context, vertical.get(), 0) : std::nullopt) : axis_of(context, crs, 2);
    return axis ? std::optional(axis->to_si) : std::nullopt;
}

std::string display_name(const PJ* crs) {
    const char* name = proj_get_name(crs);
    const char* authority = proj_get_id_auth_name(crs, 0);
    const char* code = proj_get_id_code(crs, 0);
    const std::string text = name == nullptr ? "unnamed" : name;
    return authority != nullptr && code != nullptr ? std::string(authority) + ":" + code + " " + text : text;
}

/// Empty when the object is no CRS that places things in a plane.
Crs describe(PJ_CONTEXT* context, const Pj& crs) {
    if (!crs || proj_is_crs(crs.get()) == 0) {
        return {};
    }
    const Pj plane = horizontal_part(context, Pj(proj_clone(context, crs.get())));
    if (!plane) {
        return {};
    }
    const PJ_TYPE type = proj_get_type(plane.get());
    const bool geographic = is_geographic(type);
    const std::optional<Axis> axis = axis_of(context, plane.get(), 0);
    const char* const options[] = {"MULTILINE=NO", nullptr};
    const char* wkt = proj_as_wkt(context, crs.get(), PJ_WKT2_2019, options);
    const bool flat =
        geographic || type == PJ_TYPE_PROJECTED_CRS || type == PJ_TYPE_ENGINEERING_CRS || type == PJ_TYPE_OTHER_CRS;
    if (!axis || wkt == nullptr || !flat) {
        return {};
    }
    Crs result;
    result.wkt = wkt;
    result.name = display_name(crs.get());
    result.geographic = geographic;
    result.local = result.wkt.starts_with("ENGCRS");
    result.unit = axis->unit;
    result.metres_per_unit = geographic ? 1.0 : axis->to_si;
    result.metres_per_height = own_height_unit(context, crs.get()).value_or(result.metres_per_unit);
    return result;
}

std::string engineering_wkt(const std::string& unit) {
    const std::string axis_unit = ",LENGTHUNIT[" + unit + "]]";
    return "ENGCRS[\"local\",EDATUM[\"local\"],CS[Cartesian,2],AXIS[\"(E)\",east,ORDER[1]" + axis_unit +
           ",AXIS[\"(N)\",north,ORDER[2]" + axis_unit + "]";
}

/// What PROJ shall read: our names for local frames spelt out, a PROJ string marked as a CRS.
std::string completed(const std::string& text) {
    const std::string key = lower_case(text);
    if (key == "local" || key == "local:m") {
        return engineering_wkt("\"metre\",1");
    }
    if (key == "local:ft") {
        return engineering_wkt("\"foot\",0.3048");
    }
    return text.starts_with("+") && text.find("+type=crs") == std::string::npos ? text + " +type=crs" : text;
}

/// Wraps to [−180, 180).
double wrapped_longitude(double longitude) {
    return longitude - 360 * std::floor((longitude + 180) / 360);
}

int utm_zone_number(double longitude, double latitude) {
    if (latitude >= 56 && latitude < 64 && longitude >= 3 && longitude < 12) {
        return 32;  // south-western Norway
    }
    if (latitude >= 72 && longitude >= 0 && longitude < 42) {  // Svalbard
        return longitude < 9 ? 31 : longitude < 21 ? 33 : longitude < 33 ? 35 : 37;
    }
    return static_cast<int>(std::floor((longitude + 180) / 6)) + 1;
}

}  // namespace

Crs parse_crs(const std::string& text) {
    const Context context = quiet_context();
    const std::string definition = completed(text);
    const Pj object(definition.empty() ? nullptr : proj_create(context.get(), definition.c_str()));
    Crs result = describe(context.get(), object);
    if (result.empty()) {
        const std::string why = object ? "is no geographic, projected or local CRS" : "is not understood";
        throw UsageError("coordinate system '" + text + "' " + why +
                         ": give a code such as EPSG:3067, a WKT, or local");
    }
    return result;
}

Crs crs_from_wkt(const std::string& wkt) {
    const Context context = quiet_context();
    Crs result = describe(context.get(), Pj(wkt.empty() ? nullptr : proj_create(context.get(), wkt.c_str())));
    return lower_case(result.name).find("undefined") == std::string::npos ? result : Crs{};
}

bool AreaOfUse::nearly_holds(double longitude_deg, double latitude_deg) const {
    const double width = east - west + (east < west ? 360 : 0);
    const double margin = std::min(1.0, 0.1 * std::max(width, north - south));
    const double from_west = longitude_deg - west - 360 * std::floor((longitude_deg - west + margin) / 360);
    return from_west <= width + margin && latitude_deg >= south - margin && latitude_deg <= north + margin;
}

std::optional<AreaOfUse> area_of_use(const Crs& crs) {
    const Context context = quiet_context();
    Pj pj(proj_create(context.get(), crs.wkt.c_str()));
    AreaOfUse area;
    const char* name = nullptr;
    const auto ask = [&](const Pj& object) {
        return object &&
               proj_get_area_of_use(context.get(), object.get(), &area.west, &area.south, &area.east, &area.north,
                                    &name) != 0 &&
               area.west >= -180;
    };
    if (!ask(pj)) {
        pj = horizontal_part(context.get(), std::move(pj));
        if (!ask(pj)) {
            return std::nullopt;
        }
    }
    area.name = name == nullptr ? "" : name;
    return area;
}

Crs utm_zone(double longitude_deg, double latitude_deg) {
    if (!(latitude_deg >= -80 && latitude_deg <= 84) || !std::isfinite(longitude_deg)) {
        throw InputError("no UTM zone at longitude " + std::to_string(longitude_deg) + ", latitude " +
                         std::to_string(latitude_deg) + ": name a projected coordinate system with -t_srs");
    }
    const int zone = utm_zone_number(wrapped_longitude(longitude_deg), latitude_deg);
    return parse_crs("EPSG:" + std::to_string((latitude_deg < 0 ? 32700 : 32600) + zone));
}

struct CrsTransform::Impl {
    Context context = quiet_context();
    Pj forward;      ///< null: identity
    Pj to_geodetic;  ///< target → its longitude and latitude; null for a local frame
    bool source_geographic = false;
    double height_factor = 1;  ///< applied to what PROJ gives
    std::string names;
    mutable std::string remark;
};

namespace {

/// From one CRS to another with x before y on both sides; null when PROJ knows no way.
Pj normalized_transform(PJ_CONTEXT* context, const PJ* source, const PJ* target) {
    const Pj raw(proj_create_crs_to_crs_from_pj(context, source, target, nullptr, nullptr));
    return Pj(raw ? proj_normalize_for_visualization(context, raw.get()) : nullptr);
}

Vec3 transformed(PJ* pj, const Vec3& point, PJ_DIRECTION direction = PJ_FWD) {
    const PJ_COORD out = proj_trans(pj, direction, proj_coord(point.x, point.y, point.z, HUGE_VAL));
    const Vec3 result{out.xyz.x, out.xyz.y, out.xyz.z};
    return is_finite(result) ? result : Vec3{missing, missing, missing};
}

double azimuth_deg(const Vec3& from, const Vec3& to) {
    return std::atan2(to.x - from.x, to.y - from.y) * 180 / std::numbers::pi;
}

/// About a hundred metres of latitude, in degrees: long against rounding, short against the bend of a meridian.
constexpr double short_arc_deg = 1e-3;

}  // namespace

CrsTransform::CrsTransform(const Crs& source, const Crs& target) : impl_(std::make_unique<Impl>()) {
    PJ_CONTEXT* const context = impl_->context.get();
    const Pj from(proj_create(context, source.wkt.c_str()));
    const Pj to(proj_create(context, target.wkt.c_str()));
    if (!from || !to) {
        throw InputError("coordinate system '" + (from ? target.name : source.name) + "' is not understood by PROJ");
    }
    impl_->source_geographic = source.geographic;
    impl_->names = source.name + " → " + target.name;
    if (const Pj geodetic{proj_crs_get_geodetic_crs(context, to.get())}) {
        impl_->to_geodetic = normalized_transform(context, to.get(), geodetic.get());
    }
    const bool equal = proj_is_equivalent_to_with_ctx(context, from.get(), to.get(),
                                                      PJ_COMP_EQUIVALENT_EXCEPT_AXIS_ORDER_GEOGCRS) != 0;
    if (equal) {
        return;
    }
    impl_->forward = normalized_transform(context, from.get(), to.get());
    if (!impl_->forward) {
        throw InputError("no transformation from " + source.name + " to " + target.name +
                         " is known: give the inputs coordinate systems that can be related (srs=, -s_srs, -t_srs)");
    }
    // PROJ minds the unit of heights only between CRSs that both have them.
    if (!own_height_unit(context, from.get()) || !own_height_unit(context, to.get())) {
        impl_->height_factor = source.metres_per_height / target.metres_per_height;
    }
}

CrsTransform::~CrsTransform() = default;
CrsTransform::CrsTransform(CrsTransform&&) noexcept = default;
CrsTransform& CrsTransform::operator=(CrsTransform&&) noexcept = default;

bool CrsTransform::identity() const {
    return impl_->forward == nullptr;
}

void CrsTransform::apply(std::vector<Vec3>& points) const {
    if (identity()) {
        return;
    }
    for (Vec3& point : points) {
        const bool no_height = std::isnan(point.z);
        point = transformed(impl_->forward.get(), no_height ? Vec3{point.x, point.y, 0} : point);
        point.z = no_height ? missing : point.z * impl_->height_factor;
    }
    // One point tells: inputs rarely straddle the edge of a datum grid.
    const Pj used(proj_trans_get_last_used_operation(impl_->forward.get()));
    if (used && proj_coordoperation_has_ballpark_transformation(impl_->context.get(), used.get()) != 0) {
        impl_->remark = impl_->names +
                        ": PROJ has only a ballpark transformation between the datums, no grid; positions may be "
                        "metres to hundreds of metres off (installing proj-data or PROJ_NETWORK=ON may help)";
    }
}

std::string CrsTransform::remark() const {
    return impl_->remark;
}

double CrsTransform::north_deg(const Vec3& source_point) const {
    if (identity()) {
        return 0;
    }
    const double step = impl_->source_geographic ? short_arc_deg : 100;
    const Vec3 here{source_point.x, source_point.y, 0};
    return azimuth_deg(transformed(impl_->forward.get(), here),
                       transformed(impl_->forward.get(), here + Vec3{0, step, 0}));
}

double CrsTransform::convergence_deg(const Vec3& target_point) const {
    if (!impl_->to_geodetic) {
        return 0;
    }
    const Vec3 here{target_point.x, target_point.y, 0};
    const Vec3 north = transformed(impl_->to_geodetic.get(), here) + Vec3{0, short_arc_deg, 0};
    return azimuth_deg(here, transformed(impl_->to_geodetic.get(), north, PJ_INV));
}

}  // namespace terratet
