// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/natural/cavity.hpp"

#include "interp/sites/sphere_tree.hpp"

#include <algorithm>
#include <span>

namespace terratet {
namespace {

// Beyond so many cells groups are faster, but only where most cells lie away from the boundary: each facet needs a
// cell looked at either way.
constexpr std::size_t walk_limit = 3000;
constexpr std::size_t cells_per_facet = 4;

/// A hint only. Zones are bound by memory: it makes queries a tenth faster.
void prefetch([[maybe_unused]] const CompactDelaunay::Cell& cell) {
#if defined(__GNUC__)
    __builtin_prefetch(&cell);
#endif
}

}  // namespace

void Cavity::find(const CompactDelaunay& mesh, const Vec3& q, const CompactDelaunay::Location& at) {
    const auto find_from = [&](std::int32_t start) {
        home = start;
        if (!grow(mesh, q, start)) {
            find_by_groups(mesh, q);
        }
    };
    find_from(at.cell);
    if (!at.strictly_inside) {
        // Several cells contain q and the walk may end in any of them: start again from the first of the zone.
        const auto all = all_cells(mesh);
        const std::int32_t first = *std::min_element(all.begin(), all.end());
        if (first != home) {
            find_from(first);
        }
    }
    number_vertices(mesh, q);
}

bool Cavity::grow(const CompactDelaunay& mesh, const Vec3& q, std::int32_t start) {
    const auto all = mesh.cells();
    cells.assign(1, start);
    groups.clear();
    facets.clear();
    inside_.clear(all.size());
    inside_.insert(start);
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const auto& cell = all[static_cast<std::size_t>(cells[i])];
        for (std::size_t k = 0; k < 4; ++k) {
            const std::int32_t next = cell.neighbour[k];
            if (next >= 0) {
                if (inside_.contains(next)) {
                    continue;
                }
                const auto& candidate = all[static_cast<std::size_t>(next)];
                if (mesh.in_conflict(candidate, q)) {
                    inside_.insert(next);
                    cells.push_back(next);
                    for (const std::int32_t beyond : candidate.neighbour) {
                        if (beyond >= 0) {
                            prefetch(all[static_cast<std::size_t>(beyond)]);  // to be tested next
                        }
                    }
                    continue;
                }
            }
            add_facet(mesh, cells[i], k);
        }
        if (cells.size() > walk_limit && cells.size() > cells_per_facet * facets.size()) {
            return false;
        }
    }
    return true;
}

void Cavity::find_by_groups(const CompactDelaunay& mesh, const Vec3& q) {
    mesh.sphere_tree().find(mesh, q, groups, cells);
    facets.clear();
    inside_.clear(mesh.cells().size());
    for (const std::int32_t id : cells) {
        inside_.insert(id);
    }
    std::size_t grouped = 0;
    for (const std::uint32_t group : groups) {
        grouped += mesh.sphere_tree().cells(group).size();
    }
    // On a sphere most cells are single ones, and most of those have neighbours in groups.
    const bool all_known = grouped < cells.size();
    for (const std::uint32_t group : all_known ? std::span(groups) : std::span<std::uint32_t>()) {
        for (const std::int32_t id : mesh.sphere_tree().cells(group)) {
            inside_.insert(id);
        }
    }
    const auto is_inside = [&](std::int32_t id) {
        return inside_.contains(id) || (!all_known && mesh.in_conflict(mesh.cells()[static_cast<std::size_t>(id)], q));
    };
    for (const std::int32_t id : cells) {
        const auto& cell = mesh.cells()[static_cast<std::size_t>(id)];
        for (std::size_t k = 0; k < 4; ++k) {
            const std::int32_t next = cell.neighbour[k];
            if (next < 0 || !is_inside(next)) {
                add_facet(mesh, id, k);
            }
        }
    }
}

void Cavity::add_facet(const CompactDelaunay& mesh, std::int32_t cell, std::size_t k) {
    const auto& vertex = mesh.cells()[static_cast<std::size_t>(cell)].vertex;
    const auto corner = [&](int i) { return vertex[static_cast<std::size_t>(facet_corners[k][i])]; };
    facets.push_back({{corner(0), corner(1), corner(2)}, mesh.split(cell, k)});
}

std::vector<std::int32_t> Cavity::all_cells(const CompactDelaunay& mesh) const {
    std::vector<std::int32_t> all = cells;
    for (const std::uint32_t group : groups) {
        const auto more = mesh.sphere_tree().cells(group);
        all.insert(all.end(), more.begin(), more.end());
    }
    return all;
}

void Cavity::number_vertices(const CompactDelaunay& mesh, const Vec3& q) {
    vertices.clear();
    points.clear();
    numbers_.clear(mesh.points().size());
    for (auto& facet : facets) {
        for (std::int32_t& v : facet.vertex) {
            if (!numbers_.contains(v)) {
                numbers_.insert(v, static_cast<std::int32_t>(vertices.size()));
                vertices.push_back(v);
                points.push_back(mesh.points()[static_cast<std::size_t>(v)] - q);
            }
            v = numbers_[v];
        }
    }
}

}  // namespace terratet
