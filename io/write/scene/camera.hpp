// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// From the scene onto a picture.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "tess/geometry.hpp"

namespace terratet {

/// Where a scene is first seen from: azimuth of the eye, and its height above the horizon.
inline constexpr double default_azimuth_deg = 205;
inline constexpr double default_height_deg = 24;

/// A part of the picture, in pixels.
struct PictureArea {
    double left = 0;
    double top = 0;
    double width = 1;
    double height = 1;
};

/// A perspective that fits a box into an area. Heights may be stretched.
class Camera {
  public:
    Camera(const Box3& box, double stretch, double azimuth_deg, double height_deg, const PictureArea& area)
        : stretch_(stretch) {
        const double a = azimuth_deg * std::numbers::pi / 180;
        const double h = height_deg * std::numbers::pi / 180;
        back_ = {std::sin(a) * std::cos(h), std::sin(h), -std::cos(a) * std::cos(h)};
        right_ = {-std::cos(a), 0, -std::sin(a)};
        up_ = cross(back_, right_);
        const Vec3 lo = stretched(box.lo);
        const Vec3 hi = stretched(box.hi);
        middle_ = 0.5 * (lo + hi);
        constexpr double far_away = 3.6;  // half diagonals: 32° or so
        away_ = far_away * 0.5 * length(hi - lo);
        Box3 seen;
        for (int i = 0; i < 8; ++i) {
            seen.extend(flat(box_corner(box, i)));
        }
        scale_ = std::min(area.width / (seen.hi.x - seen.lo.x), area.height / (seen.hi.y - seen.lo.y));
        shift_ = {area.left + 0.5 * area.width - scale_ * 0.5 * (seen.lo.x + seen.hi.x),
                  area.top + 0.5 * area.height - scale_ * 0.5 * (seen.lo.y + seen.hi.y), 0};
    }

    static Vec3 box_corner(const Box3& box, int i) {
        return {(i & 1) != 0 ? box.hi.x : box.lo.x, (i & 2) != 0 ? box.hi.y : box.lo.y,
                (i & 4) != 0 ? box.hi.z : box.lo.z};
    }

    /// In pixels; z is the inverse of the distance from the eye's plane.
    [[nodiscard]] Vec3 onto_picture(const Vec3& p) const {
        const Vec3 at = flat(p);
        return {scale_ * at.x + shift_.x, scale_ * at.y + shift_.y, at.z};
    }
    [[nodiscard]] const Vec3& towards_eye() const { return back_; }

  private:
    [[nodiscard]] Vec3 stretched(const Vec3& p) const { return {p.x, stretch_ * p.y, p.z}; }
    [[nodiscard]] Vec3 flat(const Vec3& p) const {
        const Vec3 d = stretched(p) - middle_;
        const double inverse = 1 / (away_ - dot(d, back_));
        return {dot(d, right_) * inverse, -dot(d, up_) * inverse, inverse};
    }

    double stretch_;
    Vec3 back_;
    Vec3 right_;
    Vec3 up_;
    Vec3 middle_;
    double away_ = 1;
    double scale_ = 1;
    Vec3 shift_;
};

}  // namespace terratet
