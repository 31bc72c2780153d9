// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Points, boxes and the few measures every floor needs. All coordinates are doubles; whether they are true (in the
/// model's CRS) or frame-local is said by whoever holds them (see frame.hpp).

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

namespace terratet {

struct Vec3 {
    double x = 0;
    double y = 0;
    double z = 0;

    double& operator[](int axis) { return axis == 0 ? x : axis == 1 ? y : z; }
    double operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
    friend bool operator==(const Vec3&, const Vec3&) = default;
    friend auto operator<=>(const Vec3&, const Vec3&) = default;  // NOLINT(modernize-use-nullptr): not a pointer's 0
};

inline Vec3 operator+(const Vec3& a, const Vec3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Vec3 operator-(const Vec3& a, const Vec3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vec3 operator-(const Vec3& a) {
    return {-a.x, -a.y, -a.z};
}
inline Vec3 operator*(double s, const Vec3& a) {
    return {s * a.x, s * a.y, s * a.z};
}
inline Vec3 operator*(const Vec3& a, double s) {
    return s * a;
}
inline Vec3 operator/(const Vec3& a, double s) {
    return {a.x / s, a.y / s, a.z / s};
}
inline double dot(const Vec3& a, const Vec3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vec3 cross(const Vec3& a, const Vec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double squared_length(const Vec3& a) {
    return dot(a, a);
}
inline double length(const Vec3& a) {
    return std::sqrt(dot(a, a));
}
inline double squared_distance(const Vec3& a, const Vec3& b) {
    return squared_length(a - b);
}
inline double distance(const Vec3& a, const Vec3& b) {
    return length(a - b);
}
inline bool is_finite(const Vec3& a) {
    return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

/// The largest absolute coordinate accepted from outside: beyond it exact predicates lose their guarantees long before
/// any map projection is meaningful.
inline constexpr double max_coordinate = 1e9;

/// Finite and within max_coordinate on every axis.
inline bool is_acceptable(const Vec3& a) {
    return is_finite(a) && std::abs(a.x) <= max_coordinate && std::abs(a.y) <= max_coordinate &&
           std::abs(a.z) <= max_coordinate;
}

/// Closed axis-parallel box; the default is empty.
struct Box3 {
    Vec3 lo{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
            std::numeric_limits<double>::infinity()};
    Vec3 hi{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
            -std::numeric_limits<double>::infinity()};

    [[nodiscard]] bool empty() const { return !(lo.x <= hi.x && lo.y <= hi.y && lo.z <= hi.z); }
    [[nodiscard]] Vec3 size() const { return hi - lo; }
    [[nodiscard]] Vec3 center() const { return 0.5 * (lo + hi); }
    [[nodiscard]] double diagonal() const { return length(hi - lo); }
    [[nodiscard]] double volume() const { return (hi.x - lo.x) * (hi.y - lo.y) * (hi.z - lo.z); }
    [[nodiscard]] bool contains(const Vec3& p) const {
        return p.x >= lo.x && p.x <= hi.x && p.y >= lo.y && p.y <= hi.y && p.z >= lo.z && p.z <= hi.z;
    }
    /// Does it share a point with the box round a segment?
    [[nodiscard]] bool meets_box_of(const Vec3& a, const Vec3& b) const {
        for (int axis = 0; axis < 3; ++axis) {
            if (std::max(a[axis], b[axis]) < lo[axis] || std::min(a[axis], b[axis]) > hi[axis]) {
                return false;
            }
        }
        return true;
    }
    /// The nearest point of the box.
    [[nodiscard]] Vec3 clamped(const Vec3& p) const {
        return {std::clamp(p.x, lo.x, hi.x), std::clamp(p.y, lo.y, hi.y), std::clamp(p.z, lo.z, hi.z)};
    }
    void extend(const Vec3& p) {
        for (int axis = 0; axis < 3; ++axis) {
            lo[axis] = std::min(lo[axis], p[axis]);
            hi[axis] = std::max(hi[axis], p[axis]);
        }
    }
    [[nodiscard]] Box3 grown(double margin) const {
        const Vec3 m{margin, margin, margin};
        return {lo - m, hi + m};
    }
    friend bool operator==(const Box3&, const Box3&) = default;
};

/// Indices of a triangle's corners in the vertex array it belongs to.
using Triangle = std::array<std::uint32_t, 3>;

/// Nearest point of the closed triangle abc to p (Ericson, Real-Time Collision Detection, 5.1.5).
Vec3 closest_point_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

/// Box around all points; empty for no points.
Box3 bounding_box(std::span<const Vec3> points);

}  // namespace terratet
