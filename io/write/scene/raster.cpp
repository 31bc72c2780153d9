// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/write/scene/raster.hpp"

#include <algorithm>
#include <cmath>

namespace terratet {

Raster::Raster(std::uint32_t width, std::uint32_t height, const Color& background)
    : width_(width),
      height_(height),
      depth_(std::size_t{width} * height, 0),
      color_(std::size_t{width} * height,
             {static_cast<float>(background.r), static_cast<float>(background.g), static_cast<float>(background.b)}) {}

void Raster::put(std::size_t pixel, float depth, const std::array<float, 3>& color, float opacity) {
    if (depth <= depth_[pixel]) {
        return;
    }
    if (opacity >= 1) {
        depth_[pixel] = depth;
    }
    for (std::size_t k = 0; k < 3; ++k) {
        color_[pixel][k] += opacity * (color[k] - color_[pixel][k]);
    }
}

void Raster::triangle(const std::array<RasterCorner, 3>& corners, double opacity) {
    const Vec3& a = corners[0].at;
    const Vec3& b = corners[1].at;
    const Vec3& c = corners[2].at;
    const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    if (!(std::abs(area) > 1e-9)) {
        return;
    }
    // A pixel on an edge belongs to one of the two triangles there, or glass would be twice as thick.
    const auto owns = [area](const Vec3& from, const Vec3& to) {
        const double down = area > 0 ? to.y - from.y : from.y - to.y;
        return down > 0 || (down == 0 && (area > 0 ? to.x < from.x : to.x > from.x));
    };
    const bool owns_a = owns(b, c);
    const bool owns_b = owns(c, a);
    const bool owns_c = owns(a, b);
    const auto first = [](double low) { return static_cast<std::int64_t>(std::max(0.0, std::ceil(low - 0.5))); };
    const auto last = [](double high, std::uint32_t size) {
        return static_cast<std::int64_t>(std::min(static_cast<double>(size) - 1, std::floor(high - 0.5)));
    };
    const std::int64_t y_end = last(std::max({a.y, b.y, c.y}), height_);
    const std::int64_t x_begin = first(std::min({a.x, b.x, c.x}));
    const std::int64_t x_end = last(std::max({a.x, b.x, c.x}), width_);
    for (std::int64_t y = first(std::min({a.y, b.y, c.y})); y <= y_end; ++y) {
        const double py = static_cast<double>(y) + 0.5;
        for (std::int64_t x = x_begin; x <= x_end; ++x) {
            const double px = static_cast<double>(x) + 0.5;
            const double wa = ((b.x - px) * (c.y - py) - (b.y - py) * (c.x - px)) / area;
            const double wb = ((c.x - px) * (a.y - py) - (c.y - py) * (a.x - px)) / area;
            const double wc = ((a.x - px) * (b.y - py) - (a.y - py) * (b.x - px)) / area;
            if (wa < 0 || wb < 0 || wc < 0 || (wa == 0 && !owns_a) || (wb == 0 && !owns_b) || (wc == 0 && !owns_c)) {
                continue;
            }
            const double depth = wa * a.z + wb * b.z + wc * c.z;
            const std::array<double, 3> share{wa * a.z / depth, wb * b.z / depth, wc * c.z / depth};
            std::array<float, 3> color{};
            for (std::size_t k = 0; k < 3; ++k) {
                color[0] += static_cast<float>(share[k] * corners[k].color.r);
                color[1] += static_cast<float>(share[k] * corners[k].color.g);
                color[2] += static_cast<float>(share[k] * corners[k].color.b);
            }
            put(static_cast<std::size_t>(y) * width_ + static_cast<std::size_t>(x), static_cast<float>(depth), color,
                static_cast<float>(opacity));
        }
    }
}

void Raster::line(const RasterCorner& a, const RasterCorner& b, double width, double opacity) {
    Vec3 along = b.at - a.at;
    along.z = 0;
    const double size = length(along);
    if (!(size > 0)) {
        return;
    }
    const Vec3 aside = Vec3{-along.y, along.x, 0} * (0.5 * width / size);
    constexpr double nearer = 1.002;
    const auto moved = [&](const RasterCorner& corner, double sign) {
        RasterCorner result = corner;
        result.at = corner.at + sign * aside;
        result.at.z *= nearer;
        return result;
    };
    triangle({moved(a, -1), moved(b, -1), moved(b, 1)}, opacity);
    triangle({moved(a, -1), moved(b, 1), moved(a, 1)}, opacity);
}

std::vector<std::uint32_t> Raster::shrunk(std::uint32_t n) const {
    std::vector<std::uint32_t> pixels;
    pixels.reserve(std::size_t{width_ / n} * (height_ / n));
    for (std::uint32_t y = 0; y + n <= height_; y += n) {
        for (std::uint32_t x = 0; x + n <= width_; x += n) {
            std::array<float, 3> sum{};
            for (std::uint32_t j = 0; j < n; ++j) {
                for (std::uint32_t i = 0; i < n; ++i) {
                    const auto& color = color_[std::size_t{y + j} * width_ + x + i];
                    for (std::size_t k = 0; k < 3; ++k) {
                        sum[k] += color[k];
                    }
                }
            }
            std::uint32_t pixel = 0xFF;
            for (const float part : sum) {
                const float mean = part / static_cast<float>(n * n);
                pixel = pixel << 8 | static_cast<std::uint32_t>(std::lround(255 * std::clamp(mean, 0.0F, 1.0F)));
            }
            pixels.push_back(pixel);
        }
    }
    return pixels;
}

}  // namespace terratet
