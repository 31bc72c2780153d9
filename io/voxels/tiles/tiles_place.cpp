// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/voxels/tiles/tiles_place.hpp"

#include <algorithm>
#include <cmath>

#include "io/base/crs.hpp"
#include "io/base/earth_centred.hpp"
#include "io/base/vertical_crs.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

using Json = TilesPlace::Json;

Vec3 unit(const Vec3& v) {
    return 1 / std::sqrt(dot(v, v)) * v;
}

/// Earth-centred, NaN where PROJ knows no place.
std::vector<Vec3> on_globe(const CrsTransform& transform, std::vector<Vec3> world) {
    transform.apply(world);
    for (Vec3& place : world) {
        place = earth_centred(place);
    }
    return world;
}

Vec3 half_size(const VoxelGrid& grid) {
    Vec3 half;
    for (int axis = 0; axis < 3; ++axis) {
        half[axis] = grid.spacing[axis] * static_cast<double>(grid.size[static_cast<std::size_t>(axis)]) / 2;
    }
    return half;
}

/// Axes at the grid's middle as straight as can be, from its mid-faces.
void put_axes(const VoxelGrid& grid, const CrsTransform& transform, TilesPlace& place) {
    const Vec3 half = half_size(grid);
    std::vector<Vec3> world{place.center};
    for (int axis = 0; axis < 3; ++axis) {
        for (const double way : {-1.0, 1.0}) {
            Vec3 face = place.center;
            face[axis] += way * half[axis];
            world.push_back(face);
        }
    }
    for (int n = 0; n < 8; ++n) {
        world.push_back(place.center +
                        Vec3{n & 1 ? half.x : -half.x, n & 2 ? half.y : -half.y, n & 4 ? half.z : -half.z});
    }
    const std::vector<Vec3> globe = on_globe(transform, world);
    if (!std::ranges::all_of(globe, is_finite)) {
        place.on_globe = false;
        return;
    }
    Vec3 axes[3];
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const Vec3 across = globe[2 + 2 * axis] - globe[1 + 2 * axis];
        const double length = std::sqrt(dot(across, across));
        axes[axis] = 1 / length * across;
        place.metres[static_cast<int>(axis)] = length / (2 * half[static_cast<int>(axis)]);
    }
    const Vec3 up = unit(cross(axes[0], axes[1]));
    const Vec3 east = unit(axes[0] - dot(axes[0], axes[1]) / 2 * axes[1]);  // both give way alike
    const Vec3 north = cross(up, east);
    const Vec3& c = globe[0];
    place.transform =
        Json::array({east.x, east.y, east.z, 0, north.x, north.y, north.z, 0, up.x, up.y, up.z, 0, c.x, c.y, c.z, 1});
    for (std::size_t n = 7; n < globe.size(); ++n) {
        const Vec3 d = world[n] - place.center;
        const Vec3 there = c + d.x * place.metres.x * east + d.y * place.metres.y * north + d.z * place.metres.z * up;
        const Vec3 off = there - globe[n];
        place.deviation = std::max(place.deviation, std::sqrt(dot(off, off)));
    }
}

}  // namespace

TilesPlace place_tiles(const VoxelGrid& grid, const std::string& vertical) {
    TilesPlace place;
    const Vec3 half = half_size(grid);
    place.center = grid.origin - 0.5 * grid.spacing + half;
    place.metres = {grid.frame.metres_per_unit, grid.frame.metres_per_unit, grid.frame.metres_per_unit};
    const Crs given = crs_from_wkt(grid.frame.crs_wkt);
    if (given.empty() || given.local) {
        place.on_globe = false;
    } else {
        const Crs crs = with_vertical(given, vertical);
        const CrsTransform transform(crs, parse_crs("EPSG:4979"));
        place.region = crs.geographic;
        if (!place.region) {
            put_axes(grid, transform, place);
        }
        place.remark = transform.remark();
        if (const std::string heights = heights_remark(given, vertical); !heights.empty()) {
            place.remark += (place.remark.empty() ? "" : "; ") + heights;
        }
        const double voxel = std::min({grid.spacing.x * place.metres.x, grid.spacing.y * place.metres.y});
        if (place.on_globe && !place.region && place.deviation > voxel / 2) {
            place.remark += "; the box's corners are up to " + std::to_string(std::lround(place.deviation)) +
                            " m from their places, since the earth is round and the grid's scale changes";
        }
    }
    if (!place.on_globe) {
        const Vec3 c = grid.frame.metres_per_unit * place.center;
        place.transform = Json::array({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, c.x, c.y, c.z, 1});
        place.remark = "without a coordinate system on the globe the tiles lie at their own coordinates in metres";
    }
    return place;
}

Json TilesPlace::bounding_volume(const Vec3& lo, const Vec3& hi) const {
    if (region) {
        return {{"region",
                 {lo.x * radian_per_degree, lo.y * radian_per_degree, hi.x * radian_per_degree,
                  hi.y * radian_per_degree, lo.z * metres.z, hi.z * metres.z}}};
    }
    Vec3 middle = 0.5 * (lo + hi) - center;
    Vec3 half = 0.5 * (hi - lo);
    for (int axis = 0; axis < 3; ++axis) {
        middle[axis] *= metres[axis];
        half[axis] *= metres[axis];
    }
    return {{"box", {middle.x, middle.y, middle.z, half.x, 0, 0, 0, half.y, 0, 0, 0, half.z}}};
}

Json TilesPlace::shape(const Vec3& lo, const Vec3& hi) const {
    const Vec3 size = hi - lo;
    if (!region) {
        return {{"type", "box"}, {"box", {{"size", {size.x * metres.x, size.z * metres.z, size.y * metres.y}}}}};
    }
    return {{"type", "ellipsoid region"},
            {"extensions",
             {{"EXT_implicit_ellipsoid_region",
               {{"semiMajorAxisRadius", 6378137.0},
                {"semiMinorAxisRadius", 6356752.314245179},
                {"minHeight", lo.z * metres.z},
                {"maxHeight", hi.z * metres.z},
                {"minLatitude", lo.y * radian_per_degree},
                {"maxLatitude", hi.y * radian_per_degree},
                {"minLongitude", lo.x * radian_per_degree},
                {"maxLongitude", hi.x * radian_per_degree}}}}}};
}

}  // namespace terratet
