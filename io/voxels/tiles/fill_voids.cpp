// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/voxels/tiles/fill_voids.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace terratet {
namespace {

/// Voids beside a value along one axis, from the values as they are.
void go_on(const std::array<int, 3>& count, std::size_t axis, std::ptrdiff_t stride, bool smooth, bool positive,
           std::vector<float>& values) {
    const std::vector<float> before = values;
    const std::size_t planes = static_cast<std::size_t>(count[1]) * static_cast<std::size_t>(count[2]);
    const auto value = [&](std::size_t at, std::ptrdiff_t way) {
        const auto from = static_cast<std::ptrdiff_t>(at) + way;
        return before[static_cast<std::size_t>(from)];
    };
    for (std::size_t at = 0; at < values.size(); ++at) {
        if (!std::isnan(before[at])) {
            continue;
        }
        const int place =
            static_cast<int>(axis == 0   ? at / planes
                             : axis == 1 ? at / static_cast<std::size_t>(count[2]) % static_cast<std::size_t>(count[1])
                                         : at % static_cast<std::size_t>(count[2]));
        float sum = 0;
        int ways = 0;
        for (const int way : {-1, 1}) {
            const int reach = way < 0 ? place : count[axis] - 1 - place;
            if (reach < 1 || std::isnan(value(at, way * stride))) {
                continue;
            }
            const float near = value(at, way * stride);
            const float far = reach < 2 || !smooth ? near : value(at, 2 * way * stride);
            sum += std::isnan(far) ? near : 2 * near - far;
            ++ways;
        }
        if (ways > 0) {
            const float mean = smooth ? sum / static_cast<float>(ways) : sum;
            values[at] = !smooth && ways == 2 ? value(at, -stride) : positive ? std::max(mean, 0.0F) : mean;
        }
    }
}

/// Every void the nearest value of its line, forwards and backwards.
void spread(std::size_t lines, int length, std::ptrdiff_t stride, const auto& begin_of, std::vector<float>& values) {
    for (std::size_t line = 0; line < lines; ++line) {
        float* v = values.data() + begin_of(line);
        int last = -1;
        for (int n = 0; n <= length; ++n) {
            if (n < length && std::isnan(v[n * stride])) {
                continue;
            }
            for (int m = last + 1; m < n; ++m) {
                const bool from_last = last >= 0 && (n == length || m - last <= n - m);
                if (from_last) {
                    v[m * stride] = v[last * stride];
                } else if (n < length) {
                    v[m * stride] = v[n * stride];
                }
            }
            last = n;
        }
    }
}

}  // namespace

void fill_voids(const std::array<int, 3>& count, bool smooth, bool positive, std::vector<float>& values) {
    if (std::ranges::none_of(values, [](float v) { return std::isnan(v); })) {
        return;
    }
    const auto nx = static_cast<std::size_t>(count[0]);
    const auto ny = static_cast<std::size_t>(count[1]);
    const auto nz = static_cast<std::size_t>(count[2]);
    const std::array<std::ptrdiff_t, 3> stride{static_cast<std::ptrdiff_t>(ny * nz), static_cast<std::ptrdiff_t>(nz),
                                               1};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        go_on(count, axis, stride[axis], smooth, positive, values);
    }
    spread(
        nx * ny, count[2], stride[2], [&](std::size_t line) { return line * nz; }, values);
    spread(
        nx * nz, count[1], stride[1], [&](std::size_t line) { return line / nz * ny * nz + line % nz; }, values);
    spread(
        ny * nz, count[0], stride[0], [](std::size_t line) { return line; }, values);
    std::ranges::replace_if(
        values, [](float v) { return std::isnan(v); }, 0.0F);
}

}  // namespace terratet
