// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/domain.hpp"

#include <algorithm>

#include "tess/base/grid_steps.hpp"
#include "tess/base/point_grid.hpp"
#include "tess/base/poll.hpp"

namespace terratet {

std::vector<Vec3> face_grid(const Box3& hull, double l_min, double l_max, std::span<const Vec3> obstacles,
                            const Frame& frame, const Poll& poll) {
    PatientPoll go_on(poll);
    PointGrid near(l_min);
    for (const Vec3& p : obstacles) {
        go_on();
        near.insert(p);
    }
    std::array<int, 3> n{};
    std::ranges::transform(grid_steps(hull, l_min, l_max), n.begin(),
                           [](double steps) { return static_cast<int>(steps); });
    const auto coordinate = [&](int axis, int i) {
        const int last = n[static_cast<std::size_t>(axis)];
        return i == last ? hull.hi[axis] : hull.lo[axis] + hull.size()[axis] * i / last;
    };
    std::vector<Vec3> points;
    for (int i = 0; i <= n[0]; ++i) {
        for (int j = 0; j <= n[1]; ++j) {
            const bool on_side = i == 0 || i == n[0] || j == 0 || j == n[1];
            for (int k = 0; k <= n[2]; k += on_side ? 1 : n[2]) {
                go_on();
                const bool corner = (i == 0 || i == n[0]) && (j == 0 || j == n[1]) && (k == 0 || k == n[2]);
                const Vec3 p = frame.snapped({coordinate(0, i), coordinate(1, j), coordinate(2, k)});
                if (corner || !near.any_within(p, l_min)) {
                    points.push_back(p);
                }
            }
        }
    }
    std::ranges::sort(points);
    return points;
}

}  // namespace terratet
