// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/sites/principal_box.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace terratet {
namespace {

constexpr double flat = 1e-4;      // thickness, of the longest side: coordinates in files are rounded
constexpr double rounding = 1e-8;  // of a place's coordinates, of the longest side

int flat_sides(const Vec3& size) {
    const double thick = flat * std::max({size.x, size.y, size.z});
    return (size.x <= thick) + (size.y <= thick) + (size.z <= thick);
}

}  // namespace

PrincipalBox::PrincipalBox(std::span<const Vec3> points) {
    Vec3 sum;
    for (const Vec3& p : points) {
        sum = sum + (p - points.front());
    }
    mean_ = points.front() + (1.0 / static_cast<double>(points.size())) * sum;
    Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
    for (const Vec3& p : points) {
        const Eigen::Vector3d d{p.x - mean_.x, p.y - mean_.y, p.z - mean_.z};
        moments += d * d.transpose();
    }
    const Eigen::Matrix3d axes = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(moments).eigenvectors();
    for (int i = 0; i < 3; ++i) {
        axes_[static_cast<std::size_t>(i)] = {axes(0, i), axes(1, i), axes(2, i)};
    }
    for (const Vec3& p : points) {
        const Vec3 d = p - mean_;
        extent_.extend({dot(d, axes_[0]), dot(d, axes_[1]), dot(d, axes_[2])});
    }
    const Vec3 size = extent_.size();
    tolerance_ = rounding * std::max({size.x, size.y, size.z});
    flat_and_tilted_ = flat_sides(size) > flat_sides(bounding_box(points).size());
}

Vec3 PrincipalBox::clamped(const Vec3& q) const {
    const Vec3 d = q - mean_;
    Vec3 out = q;
    for (int i = 0; i < 3; ++i) {
        const double at = dot(d, axis(i));
        const double to = std::clamp(at, extent_.lo[i] - tolerance_, extent_.hi[i] + tolerance_);
        if (to != at) {
            out = out + (to - at) * axis(i);
        }
    }
    return out;
}

}  // namespace terratet
