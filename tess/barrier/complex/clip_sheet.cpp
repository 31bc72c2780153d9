// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/barrier/complex/clip_sheet.hpp"

#include <unordered_map>

namespace terratet {
namespace {

/// One side's triangles over the points of both.
class Half {
  public:
    explicit Half(std::vector<Triangle>& triangles) : triangles_(triangles) {}

    /// A convex polygon of three or four corners, some of which may coincide after rounding to an end of an edge.
    void add(std::span<const std::uint32_t> polygon) {
        std::array<std::uint32_t, 4> distinct{};
        std::size_t n = 0;
        for (const std::uint32_t v : polygon) {
            if (n == 0 || (v != distinct[n - 1] && v != distinct[0])) {
                distinct[n++] = v;
            }
        }
        for (std::size_t k = 2; k < n; ++k) {
            triangles_.push_back({distinct[0], distinct[k - 1], distinct[k]});
        }
    }

  private:
    std::vector<Triangle>& triangles_;
};

template <class Place>
MendableMesh cut(const TriMesh& mesh, std::span<const double> level, const Place& place) {
    std::vector<Vec3> points = mesh.points;
    std::unordered_map<std::uint64_t, std::uint32_t> crossing_of;
    // One point an edge, whichever triangle asks first. Almost at an end is at the end: no needles of rounding's
    // making.
    const auto crossing = [&](std::uint32_t a, std::uint32_t b) {
        if (a > b) {
            std::swap(a, b);
        }
        const double t = level[a] / (level[a] - level[b]);
        if (t < 1e-9 || t > 1 - 1e-9) {
            return t < 0.5 ? a : b;
        }
        const auto [entry, fresh] =
            crossing_of.try_emplace(std::uint64_t{a} << 32U | b, static_cast<std::uint32_t>(points.size()));
        if (fresh) {
            points.push_back(place(mesh.points[a] + t * (mesh.points[b] - mesh.points[a])));
        }
        return entry->second;
    };
    MendableMesh result;
    Half above(result.above.triangles);
    Half below(result.below.triangles);
    for (const Triangle& t : mesh.triangles) {
        const std::array<bool, 3> up = {level[t[0]] > 0, level[t[1]] > 0, level[t[2]] > 0};
        const int count = up[0] + up[1] + up[2];
        if (count == 0 || count == 3) {
            (count == 3 ? above : below).add(t);
            continue;
        }
        std::size_t lone = 0;  // the corner that is alone on its side
        while (up[lone] != (count == 1)) {
            ++lone;
        }
        const std::uint32_t a = t[lone];
        const std::uint32_t b = t[(lone + 1) % 3];
        const std::uint32_t c = t[(lone + 2) % 3];
        const std::uint32_t ab = crossing(a, b);
        const std::uint32_t ca = crossing(c, a);
        (count == 1 ? above : below).add(Triangle{a, ab, ca});
        (count == 1 ? below : above).add(std::array<std::uint32_t, 4>{ab, b, c, ca});
    }
    result.above.points = points;
    result.below.points = std::move(points);
    compact(result.above);
    compact(result.below);
    return result;
}

}  // namespace

MendableMesh cut_at_zero(const TriMesh& mesh, std::span<const double> level) {
    return cut(mesh, level, [](const Vec3& p) { return p; });
}

MendableMesh cut_at_plane(const TriMesh& mesh, int axis, double at) {
    std::vector<double> level;
    level.reserve(mesh.points.size());
    for (const Vec3& p : mesh.points) {
        level.push_back(p[axis] - at);
    }
    return cut(mesh, level, [&](Vec3 p) {
        p[axis] = at;
        return p;
    });
}

BoxCut cut_to_box(TriMesh mesh, const Box3& box) {
    BoxCut result;
    for (int axis = 0; axis < 3; ++axis) {
        MendableMesh at_low = cut_at_plane(mesh, axis, box.lo[axis]);
        append(result.outside, at_low.below);
        MendableMesh at_high = cut_at_plane(at_low.above, axis, box.hi[axis]);
        append(result.outside, at_high.above);
        mesh = std::move(at_high.below);
    }
    result.inside = std::move(mesh);
    return result;
}

}  // namespace terratet
