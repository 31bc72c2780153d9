// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/model/regions.hpp"

#include <algorithm>
#include <set>

#include "tess/barrier/query/model_bounds.hpp"
#include "tess/base/box_clip.hpp"
#include "tess/base/tetrahedron.hpp"
#include "tess/mesh/gap_cell.hpp"
#include "tess/mesh/quality.hpp"

namespace terratet {
namespace {

/// Does the triangle share an area with the box?
bool overlaps(const Box3& box, const std::array<Vec3, 3>& triangle) {
    const std::vector<Vec3> polygon = clipped({triangle.begin(), triangle.end()}, box);
    Vec3 area;
    for (std::size_t i = 2; i < polygon.size(); ++i) {
        area = area + cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
    }
    return squared_length(area) > 0;
}

/// Barrier blocks: connected components of the extent without the gap cells, numbered by their smallest cell. Two cells
/// are connected when they share a facet that the extent has a part of: outside it the way round a fault's end is open.
/// They also are by gap cells that no sheet runs through, those beyond rims: a hole in a fault is open though its
/// margin fills it.
class RegionLabels {
  public:
    RegionLabels(const TetMesh& mesh, std::span<const Vertex> vertices, const BarrierQuery& barriers,
                 const Domain& domain, CellRegions& table)
        : mesh_(mesh),
          vertices_(vertices),
          barriers_(barriers),
          extent_(domain.extent),
          all_inside_(domain.hull == domain.extent),
          table_(table),
          way_(mesh.cells.size(), Way::unknown),
          passed_(mesh.cells.size(), 0) {
        for (const Barrier& barrier : barriers.barriers()) {
            boxes_.push_back(bounding_box(barrier.sheet.vertices));
        }
    }

    void run() {
        std::vector<std::int32_t> component(mesh_.cells.size(), -1);
        for (std::uint32_t first = 0; first < mesh_.cells.size(); ++first) {
            if (component[first] >= 0 || table_.in_extent[first] == 0 || table_.barrier[first] >= 0) {
                continue;
            }
            const std::vector<std::uint32_t> cells = flood(first, component);
            if (!is_pocket(cells)) {
                ++table_.region_count;
                continue;
            }
            for (const std::uint32_t cell : cells) {
                component[cell] = -1;
                table_.barrier[cell] = vertices_[mesh_.cells[cell][0]].owner;
            }
        }
        for (std::size_t c = 0; c < component.size(); ++c) {
            table_.region[c] = table_.in_extent[c] != 0 ? component[c] : -1;
        }
    }

  private:
    enum class Way : std::uint8_t { unknown, barred, clear };

    /// Its cells, without those of gaps that it passes.
    std::vector<std::uint32_t> flood(std::uint32_t first, std::vector<std::int32_t>& component) {
        std::vector<std::uint32_t> cells;
        std::vector<std::uint32_t> reached{first};
        component[first] = table_.region_count;
        ++floods_;
        for (std::size_t i = 0; i < reached.size(); ++i) {
            if (table_.barrier[reached[i]] < 0) {
                cells.push_back(reached[i]);
            }
            for (std::size_t k = 0; k < 4; ++k) {
                const std::int32_t next = mesh_.neighbours[reached[i]][k];
                const auto neighbour = static_cast<std::uint32_t>(next);
                if (next < 0 || table_.beyond[neighbour] != 0) {
                    continue;
                }
                if (table_.barrier[neighbour] >= 0) {
                    if (passed_[neighbour] != floods_ && open(reached[i], k) && lets_pass(neighbour)) {
                        passed_[neighbour] = floods_;
                        reached.push_back(neighbour);
                    }
                } else if (component[neighbour] < 0 && open(reached[i], k)) {
                    component[neighbour] = table_.region_count;
                    reached.push_back(neighbour);
                }
            }
        }
        return cells;
    }

    /// A gap cell within the extent, none of whose edges meets a sheet. Sheets end at the extent's faces, faults do
    /// not.
    [[nodiscard]] bool lets_pass(std::uint32_t cell) {
        if (way_[cell] == Way::unknown) {
            const auto& v = mesh_.cells[cell];
            const bool within =
                std::ranges::all_of(v, [&](std::uint32_t i) { return extent_.contains(mesh_.points[i]); });
            const bool clear = within && std::ranges::none_of(cell_edges, [&](const auto& edge) {
                                   return meets_sheet(mesh_.points[v[edge[0]]], mesh_.points[v[edge[1]]]);
                               });
            way_[cell] = clear ? Way::clear : Way::barred;
        }
        return way_[cell] == Way::clear;
    }

    [[nodiscard]] bool meets_sheet(const Vec3& a, const Vec3& b) const {
        for (std::size_t f = 0; f < boxes_.size(); ++f) {
            if (boxes_[f].meets_box_of(a, b) && barriers_.crosses(static_cast<std::int32_t>(f), a, b)) {
                return true;
            }
        }
        return false;
    }

    /// A few cells between seeds alone, shut in by gaps where faults meet: no block, but of the gaps.
    [[nodiscard]] bool is_pocket(const std::vector<std::uint32_t>& cells) const {
        double volume = 0;
        double spacing = 0;
        for (const std::uint32_t cell : cells) {
            for (const std::uint32_t v : mesh_.cells[cell]) {
                const Vertex& vertex = vertices_[v];
                if (vertex.role != Role::seed) {
                    return false;
                }
                spacing = std::max(spacing, barriers_.barriers()[static_cast<std::size_t>(vertex.owner)].spacing);
            }
            volume += cell_quality(cell_points(mesh_, mesh_.cells[cell])).volume;
        }
        return volume < spacing * spacing * spacing;
    }

    [[nodiscard]] bool open(std::uint32_t cell, std::size_t k) const {
        const auto& v = mesh_.cells[cell];
        return all_inside_ || overlaps(extent_, {mesh_.points[v[(k + 1) % 4]], mesh_.points[v[(k + 2) % 4]],
                                                 mesh_.points[v[(k + 3) % 4]]});
    }

    const TetMesh& mesh_;
    std::span<const Vertex> vertices_;
    const BarrierQuery& barriers_;
    const Box3& extent_;
    bool all_inside_;
    CellRegions& table_;
    std::vector<Box3> boxes_;            ///< of the sheets
    std::vector<Way> way_;               ///< by cell: through gaps
    std::vector<std::uint32_t> passed_;  ///< by cell: in which flood
    std::uint32_t floods_ = 0;
};

/// Where faults meet, or run close to each other, a cell between seeds of several of them, or of one side of a fold,
/// may reach across one: that one, or −1.
std::int32_t gap_at_junction(const std::array<std::uint32_t, 4>& cell, const TetMesh& mesh,
                             std::span<const Vertex> vertices, const BarrierQuery& barriers) {
    if (!std::ranges::all_of(cell, [&](std::uint32_t v) { return vertices[v].role == Role::seed; })) {
        return -1;
    }
    for (std::size_t f = 0; f < barriers.barriers().size(); ++f) {
        for (const auto& [i, j] : cell_edges) {
            if (barriers.crosses(static_cast<std::int32_t>(f), mesh.points[cell[i]], mesh.points[cell[j]])) {
                return static_cast<std::int32_t>(f);
            }
        }
    }
    return -1;
}

}  // namespace

CellRegions regions(const TetMesh& mesh, std::span<const Vertex> vertices, const BarrierQuery& barriers,
                    const Domain& domain) {
    const std::size_t n = mesh.cells.size();
    CellRegions table;
    table.region.assign(n, -1);
    table.barrier.resize(n);
    table.in_extent.resize(n);
    table.beyond.resize(n);
    const ModelBounds bounds(domain, barriers);
    const auto bounds_model = [&](std::int32_t f) {
        return f >= 0 && is_bound(barriers.barriers()[static_cast<std::size_t>(f)].sheet.kind);
    };
    for (std::size_t c = 0; c < n; ++c) {
        table.barrier[c] = gap_barrier(mesh.cells[c], vertices);
        if (table.barrier[c] < 0) {
            table.barrier[c] = gap_at_junction(mesh.cells[c], mesh, vertices, barriers);
        }
        const CellPoints points = cell_points(mesh, mesh.cells[c]);
        const Vec3 centroid = 0.25 * (points[0] + points[1] + points[2] + points[3]);
        table.beyond[c] = bounds_model(table.barrier[c]) || bounds.excludes(centroid) ? 1 : 0;
        table.in_extent[c] = table.beyond[c] == 0 && domain.extent.contains(centroid);
    }
    RegionLabels(mesh, vertices, barriers, domain, table).run();
    return table;
}

std::int32_t RegionFinder::at(const Vec3& p) {
    const auto position = walk_.locate(p);
    std::vector<std::uint32_t> open;
    std::set<std::uint32_t> seen;
    const auto reach = [&](std::uint32_t cell) {
        if (regions_.barrier[cell] < 0 && regions_.beyond[cell] == 0 && seen.insert(cell).second) {
            open.push_back(cell);
        }
    };
    if (position) {
        reach(position->cell);
    }
    for (std::size_t i = 0; i < open.size(); ++i) {
        if (regions_.region[open[i]] >= 0) {
            return regions_.region[open[i]];
        }
        for (const std::int32_t next : mesh_.neighbours[open[i]]) {
            if (next >= 0) {
                reach(static_cast<std::uint32_t>(next));
            }
        }
    }
    return -1;
}

}  // namespace terratet
