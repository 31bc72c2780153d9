// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/model/block_finder.hpp"

#include "tess/barrier_query.hpp"
#include "tess/model/regions.hpp"
#include "tess/tessellation.hpp"

namespace terratet {
namespace {

/// What the faults alone divide the extent into: the corners of the hull box and the seeds.
std::vector<Vertex> corners_and_seeds(const Domain& domain, std::span<const Barrier> barriers) {
    std::vector<Vertex> vertices;
    const auto add = [&](const Vec3& position, Role role, std::int32_t owner, std::int8_t side) {
        vertices.push_back({vertices.size(), position, role, owner, side});
    };
    for (unsigned corner = 0; corner < 8; ++corner) {
        const auto pick = [&](int axis) {
            return (corner >> static_cast<unsigned>(axis) & 1U) != 0 ? domain.hull.hi[axis] : domain.hull.lo[axis];
        };
        add({pick(0), pick(1), pick(2)}, Role::domain, -1, 0);
    }
    for (std::size_t f = 0; f < barriers.size(); ++f) {
        for (const Seed& seed : barriers[f].seeds) {
            if (domain.hull.contains(seed.position)) {
                add(seed.position, Role::seed, static_cast<std::int32_t>(f), seed.side);
            }
        }
    }
    return vertices;
}

}  // namespace

BlockFinder::BlockFinder(const Domain& domain, std::span<const Barrier> barriers) {
    const std::vector<Vertex> vertices = corners_and_seeds(domain, barriers);
    Tessellation tessellation;
    tessellation.insert(vertices);
    mesh_ = tessellation.mesh();
    block_ = regions(mesh_, vertices, BarrierQuery(barriers), domain).region;
}

std::int32_t BlockFinder::at(const Vec3& place) const {
    const auto position = walk_.locate(place);
    return position ? block_[position->cell] : -1;
}

}  // namespace terratet
