// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/write/scene/scene_frame.hpp"

#include <cmath>

#include "io/base/crs.hpp"
#include "io/base/earth_centred.hpp"
#include "io/base/vertical_crs.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

Vec3 turned(const Vec3& v) {
    return {v.x, v.z, -v.y};
}

}  // namespace

/// By PROJ to the globe, and from there to axes at the origin.
struct SceneFrame::Globe {
    CrsTransform transform;
    Vec3 centre{};
    Vec3 east{};
    Vec3 north{};
    Vec3 up{};

    void put_axes_at(const Vec3& place) {
        const double lon = place.x * radian_per_degree;
        const double lat = place.y * radian_per_degree;
        centre = earth_centred(place);
        east = {-std::sin(lon), std::cos(lon), 0};
        north = {-std::sin(lat) * std::cos(lon), -std::sin(lat) * std::sin(lon), std::cos(lat)};
        up = {std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat)};
    }
    [[nodiscard]] Vec3 east_north_up(const Vec3& place) const {
        const Vec3 d = earth_centred(place) - centre;
        return {dot(d, east), dot(d, north), dot(d, up)};
    }
};

SceneFrame::SceneFrame(const Model& model, Axes axes, const std::string& vertical_crs)
    : frame_(&model.frame), axes_(axes) {
    const Box3& extent = model.domain.extent;
    const double step = std::pow(10.0, std::floor(std::log10(extent.diagonal() / 100)));
    const Vec3 middle = frame_->to_world(extent.center());
    for (int axis = 0; axis < 3; ++axis) {
        origin_[axis] = std::round(middle[axis] / step) * step;
    }
    local_origin_ = frame_->to_local(origin_);

    const Crs crs = with_vertical(crs_from_wkt(frame_->crs_wkt), vertical_crs);
    if (!crs.empty() && !crs.local) {
        try {
            CrsTransform transform(crs, parse_crs("EPSG:4979"));
            std::vector<Vec3> place{origin_};
            transform.apply(place);
            if (is_finite(place[0])) {
                const double convergence = -CrsTransform(parse_crs("EPSG:4326"), crs).convergence_deg(origin_);
                to_globe_ = std::make_unique<Globe>(Globe{std::move(transform)});
                to_globe_->put_axes_at(place[0]);
                const auto& [t, c, e, n, u] = *to_globe_;
                globe_ = GlobePlace{place[0].x,
                                    place[0].y,
                                    place[0].z,
                                    {e.x, e.y, e.z, 0, n.x, n.y, n.z, 0, u.x, u.y, u.z, 0, c.x, c.y, c.z, 1},
                                    convergence};
            }
        } catch (const Error&) {
            globe_.reset();  // no way from there to the globe: the scene says nothing of it
        }
    }
    if (axes_ == Axes::enu && !globe_) {
        throw UsageError(
            "a scene in axes of the globe (FRAME=enu) needs a model with a coordinate system on the globe");
    }
}

SceneFrame::~SceneFrame() = default;
SceneFrame::SceneFrame(SceneFrame&&) noexcept = default;

double SceneFrame::metres_per_unit() const {
    return frame_->metres_per_unit;
}

Vec3 SceneFrame::position(const Vec3& local) const {
    return axes_ == Axes::enu ? positions({local})[0]
                              : turned(frame_->to_world_size(local - local_origin_)) * frame_->metres_per_unit;
}

std::vector<Vec3> SceneFrame::places_on_globe(std::vector<Vec3> world) const {
    if (!to_globe_) {
        return {};
    }
    to_globe_->transform.apply(world);
    return world;
}

std::vector<Vec3> SceneFrame::positions(const std::vector<Vec3>& local) const {
    std::vector<Vec3> result;
    result.reserve(local.size());
    if (axes_ == Axes::grid) {
        for (const Vec3& p : local) {
            result.push_back(position(p));
        }
        return result;
    }
    for (const Vec3& p : local) {
        result.push_back(frame_->to_world(p));
    }
    result = places_on_globe(std::move(result));
    for (Vec3& p : result) {
        p = turned(to_globe_->east_north_up(p));
    }
    return result;
}

}  // namespace terratet
