// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/barrier/seeds/settle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "tess/base/random_share.hpp"

namespace terratet {
namespace {

constexpr double low = 0.2;    ///< seeds lower than that, in radii, go less deep
constexpr double even = 10;    ///< heights that differ by less are the same, in depths: the sheet is flat,
constexpr double aside = 0.2;  ///< and its seeds are moved along it by that, in depths

/// How the seeds round a corner stand over one of its sheets: on each side, between which heights.
struct Tilt {
    Vec3 normal;
    std::array<double, 2> lowest{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    std::array<double, 2> highest{};
};

class Settler {
  public:
    Settler(const SheetComplex& complex, std::span<const double> radii, std::span<const BallPair> pairs, double depth,
            std::span<const std::uint32_t> among)
        : complex_(complex), radii_(radii), pairs_(pairs), among_(among) {
        for_each_corner([&](std::uint32_t t, std::uint32_t v) {
            double& of_point = depths_.try_emplace(v, depth).first->second;
            of_point = std::min(of_point, depth * pairs[t].height / (low * radii[v]));
            Vec3& normal = tilts_[{v, complex.sheet[t]}].normal;
            normal = normal + normal_of(t);
        });
        for (auto& [key, tilt] : tilts_) {
            tilt.normal = unit(tilt.normal);
        }
        for_each_corner([&](std::uint32_t t, std::uint32_t v) {
            Tilt& tilt = tilts_.at({v, complex.sheet[t]});
            for (const int side : {0, 1}) {
                const double height = height_over(tilt, seed(t, side) - complex.points[v], side);
                tilt.lowest[side] = std::min(tilt.lowest[side], height);
                tilt.highest[side] = std::max(tilt.highest[side], height);
            }
        });
    }

    [[nodiscard]] Vec3 settled(std::uint32_t t, int side) const {
        const Vec3 given = seed(t, side);
        std::array<Vec3, 3> up;  // from the corners, in radii
        std::array<double, 3> sink{};
        double flatness = 1;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t v = complex_.triangles[t][k];
            const Tilt& tilt = tilts_.at({v, complex_.sheet[t]});
            const Vec3 way = given - complex_.points[v];
            up[k] = way / radii_[v];
            const double half = 0.5 * (tilt.highest[side] - tilt.lowest[side]);
            const double height = height_over(tilt, way, side) - tilt.lowest[side] - half;
            const double least = even * depths_.at(v) * radii_[v];
            sink[k] = depths_.at(v) * radii_[v] * height / std::max(half, least);
            flatness = std::min(flatness, std::max(0.0, 1 - half / least));
        }
        const Vec3 turned = cross(up[1], up[2]);
        const Vec3 step =
            (sink[0] * turned + sink[1] * cross(up[2], up[0]) + sink[2] * cross(up[0], up[1])) / dot(up[0], turned);
        return given - step + flatness * along(t);
    }

  private:
    template <class Call>
    void for_each_corner(const Call& call) const {
        for (const std::uint32_t t : among_) {
            if (pairs_[t].height > 0) {
                for (const std::uint32_t v : complex_.triangles[t]) {
                    call(t, v);
                }
            }
        }
    }

    [[nodiscard]] Vec3 normal_of(std::uint32_t t) const { return unit(area_vector(corners(complex_, t))); }

    [[nodiscard]] Vec3 seed(std::uint32_t t, int side) const {
        return pairs_[t].foot + (side == 0 ? pairs_[t].height : -pairs_[t].height) * normal_of(t);
    }

    static double height_over(const Tilt& tilt, const Vec3& way, int side) {
        return (side == 0 ? 1 : -1) * dot(way, tilt.normal);
    }

    /// Somewhere, the same for both seeds.
    [[nodiscard]] Vec3 along(std::uint32_t t) const {
        const Triangle& v = complex_.triangles[t];
        const TriangleCorners c = corners(complex_, t);
        const double way = aside * std::min({depths_.at(v[0]), depths_.at(v[1]), depths_.at(v[2])});
        return way *
               ((2 * random_share(2 * t) - 1) * (c[1] - c[0]) + (2 * random_share(2 * t + 1) - 1) * (c[2] - c[0]));
    }

    const SheetComplex& complex_;
    std::span<const double> radii_;
    std::span<const BallPair> pairs_;
    std::span<const std::uint32_t> among_;                           ///< triangles
    std::map<std::uint32_t, double> depths_;                         ///< by point, in radii
    std::map<std::pair<std::uint32_t, std::uint32_t>, Tilt> tilts_;  ///< by point and surface
};

}  // namespace

std::vector<std::array<Vec3, 2>> settled_seeds(const SheetComplex& complex, std::span<const double> radii,
                                               std::span<const BallPair> pairs, double depth,
                                               std::span<const std::uint32_t> of,
                                               std::span<const std::uint32_t> among) {
    const Settler settler(complex, radii, pairs, depth, among);
    std::vector<std::array<Vec3, 2>> result;
    for (const std::uint32_t t : of) {
        result.push_back({settler.settled(t, 0), settler.settled(t, 1)});
    }
    return result;
}

}  // namespace terratet
