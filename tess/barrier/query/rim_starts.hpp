// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Places in the rims of sheets from which barriers go on (estimation_barriers.hpp).

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <vector>

#include "tess/barrier.hpp"
#include "tess/barrier/complex/rims.hpp"
#include "tess/base/tri_mesh.hpp"

namespace terratet {

inline EdgePlace sorted(const Vec3& a, const Vec3& b) {
    return a < b ? EdgePlace{a, b} : EdgePlace{b, a};
}

/// Of the sheets that are asked for, how many triangles an edge has.
using EdgeUses = std::map<EdgePlace, int>;
template <class Which>
EdgeUses edge_uses(std::span<const Barrier> barriers, const Which& which) {
    EdgeUses uses;
    for (const Barrier& barrier : barriers) {
        for (const Triangle& t : which(barrier) ? barrier.sheet.triangles : std::vector<Triangle>{}) {
            for (std::size_t i = 0; i < 3; ++i) {
                ++uses[sorted(barrier.sheet.vertices[t[i]], barrier.sheet.vertices[t[(i + 1) % 3]])];
            }
        }
    }
    return uses;
}

/// The outward directions of the box's faces that hold both.
inline std::vector<Vec3> faces_with(const Box3& box, const Vec3& a, const Vec3& b) {
    std::vector<Vec3> faces;
    for (int axis = 0; axis < 3; ++axis) {
        for (const double sign : {-1.0, 1.0}) {
            const double at = sign < 0 ? box.lo[axis] : box.hi[axis];
            const double tolerance = 1e-9 * (std::abs(at) + box.size()[axis]);
            if (std::abs(a[axis] - at) <= tolerance && std::abs(b[axis] - at) <= tolerance) {
                Vec3 face;
                face[axis] = sign;
                faces.push_back(face);
            }
        }
    }
    return faces;
}

/// A place in a rim from which barriers go on.
struct RimStart {
    struct Use {
        std::size_t barrier = 0;
        Vec3 normal;    ///< of its sheet
        Vec3 way;       ///< sum of the edges' ways on, in the sheet's tangent plane
        int edges = 0;  ///< of the rim that goes on
    };
    Vec3 position;
    std::vector<Use> uses;
    std::vector<Vec3> rows;  ///< from the position on; empty: not made yet
    Vec3 last;               ///< the last row, far away or where the way ended

    Use& use(std::size_t barrier) {
        const auto found = std::ranges::find(uses, barrier, &Use::barrier);
        return found != uses.end() ? *found : uses.emplace_back(Use{barrier, {}, {}, 0});
    }
    [[nodiscard]] bool is_of(std::size_t barrier) const {
        return std::ranges::find(uses, barrier, &Use::barrier) != uses.end();
    }

    /// Straight on; where sheets meet, along the line in which they do.
    [[nodiscard]] Vec3 way() const {
        Vec3 sum;
        for (const Use& use : uses) {
            sum = sum + unit(use.way);
        }
        sum = unit(sum);
        if (uses.size() > 1) {
            const Vec3 along = cross(unit(uses[0].normal), unit(uses[1].normal));
            const double heading = dot(unit(along), sum);
            if (length(along) > 0.1 && std::abs(heading) > 0.2) {
                return heading < 0 ? -unit(along) : unit(along);
            }
        }
        return sum;
    }
};

}  // namespace terratet
