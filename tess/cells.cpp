// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/cells.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>

#include "tess/box_clip.hpp"
#include "tess/insertion_rule.hpp"
#include "tess/mesh_walk.hpp"
#include "tess/model_bounds.hpp"
#include "tess/own_side.hpp"
#include "tess/point_grid.hpp"
#include "tess/quality.hpp"

namespace terratet {

namespace {

constexpr std::array<std::array<std::size_t, 2>, 6> cell_edges{{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

CellPoints corners(const TetMesh& mesh, const std::array<std::uint32_t, 4>& cell) {
    return {mesh.points[cell[0]], mesh.points[cell[1]], mesh.points[cell[2]], mesh.points[cell[3]]};
}

JudgedCell judged(const TetMesh& mesh, std::array<std::uint32_t, 4> cell) {
    std::ranges::sort(cell);
    const CellPoints points = corners(mesh, cell);
    return {cell, points, circumsphere(points)};
}

/// Why the refiner left a cell as it is: the refiner's own rule, asked again, plus the distance of a projected point,
/// which needs all vertices.
class Explainer {
  public:
    Explainer(const Model& model, const TetMesh& mesh)
        : mesh_(mesh),
          proximity_(model_proximity(model)),
          rule_(model.criteria, model.domain, model.frame, proximity_, model.properties, model.vertex_values) {
        for (const Vec3& p : mesh.points) {
            rule_.note_vertex(p);
        }
    }

    Reason operator()(const std::array<std::uint32_t, 4>& cell) {
        const JudgedCell judged_cell = judged(mesh_, cell);
        if (rule_.violation(judged_cell) <= 1) {
            return Reason::none;
        }
        if (rule_.violation_in_force(judged_cell) <= 1) {
            return Reason::smooth;
        }
        const Proposal proposal = rule_.propose(judged_cell);
        const Reason reason = proposal.reason != Reason::none ? proposal.reason
                              : crowded(proposal.point)       ? Reason::too_close
                                                              : Reason::none;
        if (reason == Reason::none || !proposal.projected) {
            return reason;
        }
        const auto instead = rule_.instead_of_split(judged_cell);
        if (!instead || crowded(*instead)) {
            return reason == Reason::too_close ? Reason::near_face : reason;
        }
        return Reason::none;
    }

  private:
    bool crowded(const Vec3& place) { return vertices().any_within(place, rule_.resolution().l_min(place)); }

    const PointGrid& vertices() {
        if (!vertices_) {
            vertices_.emplace(rule_.resolution().largest_l_min());
            for (const Vec3& p : mesh_.points) {
                vertices_->insert(p);
            }
        }
        return *vertices_;
    }

    const TetMesh& mesh_;
    FaultProximity proximity_;
    InsertionRule rule_;
    std::optional<PointGrid> vertices_;
};

/// Does the triangle share an area with the box?
bool overlaps(const Box3& box, const std::array<Vec3, 3>& triangle) {
    const std::vector<Vec3> polygon = clipped({triangle.begin(), triangle.end()}, box);
    Vec3 area;
    for (std::size_t i = 2; i < polygon.size(); ++i) {
        area = area + cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
    }
    return squared_length(area) > 0;
}

bool overlap(const Box3& box, const Vec3& a, const Vec3& b) {
    for (int axis = 0; axis < 3; ++axis) {
        if (std::max(a[axis], b[axis]) < box.lo[axis] || std::min(a[axis], b[axis]) > box.hi[axis]) {
            return false;
        }
    }
    return true;
}

/// Fault blocks: connected components of the extent without the gap cells, numbered by their smallest cell. Two cells
/// are connected when they share a facet that the extent has a part of: outside it the way round a fault's end is open.
/// They also are by gap cells that no sheet runs through, those beyond rims: a hole in a fault is open though its
/// margin fills it.
class RegionLabels {
  public:
    RegionLabels(const Model& model, const TetMesh& mesh, const FaultProximity& faults, CellTable& table)
        : model_(model),
          extent_(model.domain.extent),
          all_inside_(model.domain.hull == model.domain.extent),
          mesh_(mesh),
          faults_(faults),
          table_(table),
          way_(mesh.cells.size(), Way::unknown),
          passed_(mesh.cells.size(), 0) {
        for (const Fault& fault : model.faults) {
            boxes_.push_back(bounding_box(fault.sheet.vertices));
        }
    }

    void run() {
        std::vector<std::int32_t> component(mesh_.cells.size(), -1);
        for (std::uint32_t first = 0; first < mesh_.cells.size(); ++first) {
            if (component[first] >= 0 || table_.in_extent[first] == 0 || table_.fault[first] >= 0) {
                continue;
            }
            const std::vector<std::uint32_t> cells = flood(first, component);
            if (!is_pocket(cells)) {
                ++table_.region_count;
                continue;
            }
            for (const std::uint32_t cell : cells) {
                component[cell] = -1;
                table_.fault[cell] = model_.vertices[mesh_.cells[cell][0]].owner;
                table_.reason[cell] = Reason::fault_gap;
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
            if (table_.fault[reached[i]] < 0) {
                cells.push_back(reached[i]);
            }
            for (std::size_t k = 0; k < 4; ++k) {
                const std::int32_t next = mesh_.neighbours[reached[i]][k];
                const auto neighbour = static_cast<std::uint32_t>(next);
                if (next < 0 || table_.beyond[neighbour] != 0) {
                    continue;
                }
                if (table_.fault[neighbour] >= 0) {
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
            if (overlap(boxes_[f], a, b) && faults_.crosses(static_cast<std::int32_t>(f), a, b)) {
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
                const Vertex& vertex = model_.vertices[v];
                if (vertex.role != Role::seed) {
                    return false;
                }
                spacing = std::max(spacing, model_.faults[static_cast<std::size_t>(vertex.owner)].spacing);
            }
            volume += cell_quality(corners(mesh_, mesh_.cells[cell])).volume;
        }
        return volume < spacing * spacing * spacing;
    }

    [[nodiscard]] bool open(std::uint32_t cell, std::size_t k) const {
        const auto& v = mesh_.cells[cell];
        return all_inside_ || overlaps(extent_, {mesh_.points[v[(k + 1) % 4]], mesh_.points[v[(k + 2) % 4]],
                                                 mesh_.points[v[(k + 3) % 4]]});
    }

    const Model& model_;
    const Box3& extent_;
    bool all_inside_;
    const TetMesh& mesh_;
    const FaultProximity& faults_;
    CellTable& table_;
    std::vector<Box3> boxes_;            ///< of the sheets
    std::vector<Way> way_;               ///< by cell: through gaps
    std::vector<std::uint32_t> passed_;  ///< by cell: in which flood
    std::uint32_t floods_ = 0;
};

/// The region of the cell that holds a point; of one without, as its centroid is beyond the extent, that of the nearest
/// cells that it hangs together with. −1 for a point in a gap or outside.
std::int32_t region_at(const Vec3& p, MeshWalk& walk, const TetMesh& mesh, const CellTable& table) {
    const auto position = walk.locate(p);
    std::vector<std::uint32_t> open;
    std::set<std::uint32_t> seen;
    const auto reach = [&](std::uint32_t cell) {
        if (table.fault[cell] < 0 && table.beyond[cell] == 0 && seen.insert(cell).second) {
            open.push_back(cell);
        }
    };
    if (position) {
        reach(position->cell);
    }
    for (std::size_t i = 0; i < open.size(); ++i) {
        if (table.region[open[i]] >= 0) {
            return table.region[open[i]];
        }
        for (const std::int32_t next : mesh.neighbours[open[i]]) {
            if (next >= 0) {
                reach(static_cast<std::uint32_t>(next));
            }
        }
    }
    return -1;
}

void name_regions(const Model& model, const TetMesh& mesh, CellTable& table) {
    for (std::int32_t region = 0; region < table.region_count; ++region) {
        table.region_name.push_back("region " + std::to_string(region));
    }
    MeshWalk walk(mesh);
    for (const RegionName& named : model.region_names) {
        const std::int32_t region = region_at(named.point, walk, mesh, table);
        if (region >= 0) {
            table.region_name[static_cast<std::size_t>(region)] = named.name;
        }
    }
}

double percent(std::size_t part, std::size_t whole) {
    return whole == 0 ? 0 : 100 * static_cast<double>(part) / static_cast<double>(whole);
}

/// Value at fraction q of a sorted sequence, nearest rank.
double quantile(const std::vector<float>& sorted, double q) {
    return sorted.empty() ? 0 : sorted[static_cast<std::size_t>(q * static_cast<double>(sorted.size() - 1))];
}

}  // namespace

std::int32_t gap_fault(const std::array<std::uint32_t, 4>& cell, std::span<const Vertex> vertices) {
    const std::int32_t owner = vertices[cell[0]].owner;
    bool plus = false;
    bool minus = false;
    for (const std::uint32_t v : cell) {
        const Vertex& vertex = vertices[v];
        if (vertex.role != Role::seed || vertex.owner != owner) {
            return -1;
        }
        plus = plus || vertex.side > 0;
        minus = minus || vertex.side < 0;
    }
    return plus && minus ? owner : -1;
}

namespace {

/// Where faults meet, or run close to each other, a cell between seeds of several of them, or of one side of a fold,
/// may reach across one: that one, or −1.
std::int32_t gap_at_junction(const std::array<std::uint32_t, 4>& cell, const Model& model, const TetMesh& mesh,
                             const FaultProximity& faults) {
    if (!std::ranges::all_of(cell, [&](std::uint32_t v) { return model.vertices[v].role == Role::seed; })) {
        return -1;
    }
    for (std::size_t f = 0; f < model.faults.size(); ++f) {
        for (const auto& [i, j] : cell_edges) {
            if (faults.crosses(static_cast<std::int32_t>(f), mesh.points[cell[i]], mesh.points[cell[j]])) {
                return static_cast<std::int32_t>(f);
            }
        }
    }
    return -1;
}

}  // namespace

CellTable describe_cells(const Model& model, const TetMesh& mesh) {
    const std::size_t n = mesh.cells.size();
    CellTable table;
    table.region.assign(n, -1);
    table.fault.resize(n);
    table.in_extent.resize(n);
    table.beyond.resize(n);
    table.reason.resize(n);
    table.radius_edge.resize(n);
    table.aspect.resize(n);
    table.dihedral_min_deg.resize(n);
    Explainer explain(model, mesh);
    const FaultProximity faults(model.faults);
    const ModelBounds bounds(model.domain, faults);
    const auto bounds_model = [&](std::int32_t f) {
        return f >= 0 && is_bound(model.faults[static_cast<std::size_t>(f)].sheet.kind);
    };
    for (std::size_t c = 0; c < n; ++c) {
        const CellPoints points = corners(mesh, mesh.cells[c]);
        const CellQuality quality = cell_quality(points);
        table.radius_edge[c] = static_cast<float>(quality.radius_edge);
        table.aspect[c] = static_cast<float>(quality.aspect);
        table.dihedral_min_deg[c] = static_cast<float>(quality.dihedral_min_deg);
        table.fault[c] = gap_fault(mesh.cells[c], model.vertices);
        if (table.fault[c] < 0) {
            table.fault[c] = gap_at_junction(mesh.cells[c], model, mesh, faults);
        }
        table.reason[c] = table.fault[c] >= 0 ? Reason::fault_gap : explain(mesh.cells[c]);
        const Vec3 centroid = 0.25 * (points[0] + points[1] + points[2] + points[3]);
        table.beyond[c] = bounds_model(table.fault[c]) || bounds.excludes(centroid) ? 1 : 0;
        table.in_extent[c] = table.beyond[c] == 0 && model.domain.extent.contains(centroid);
    }
    RegionLabels(model, mesh, faults, table).run();
    name_regions(model, mesh, table);
    return table;
}

CellStatistics cell_statistics(const Model& model, const TetMesh& mesh, const CellTable& cells) {
    CellStatistics s;
    s.vertices = mesh.points.size();
    s.tetrahedra = mesh.cells.size();
    s.regions = static_cast<std::size_t>(cells.region_count);
    const FaultProximity proximity = model_proximity(model);
    const InsertionRule rule(model.criteria, model.domain, model.frame, proximity, model.properties,
                             model.vertex_values);
    std::size_t skinny = 0;
    std::size_t flat = 0;
    std::size_t bad = 0;
    double shortest = std::numeric_limits<double>::infinity();
    double longest = 0;
    std::vector<float> dihedrals;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
        if (cells.fault[c] >= 0) {
            ++s.gap_tetrahedra;
            continue;
        }
        if (cells.in_extent[c] == 0) {
            continue;
        }
        const bool is_skinny = model.criteria.radius_edge > 0 && cells.radius_edge[c] > model.criteria.radius_edge;
        const bool is_flat = !is_skinny && model.criteria.aspect > 0 && cells.aspect[c] > model.criteria.aspect;
        skinny += is_skinny ? 1 : 0;
        flat += is_flat ? 1 : 0;
        bad += is_skinny || is_flat || rule.violation(judged(mesh, mesh.cells[c])) > 1 ? 1 : 0;
        dihedrals.push_back(cells.dihedral_min_deg[c]);
        if (cells.dihedral_min_deg[c] < model.criteria.dihedral_deg) {
            ++s.below_dihedral;
            s.below_dihedral_given += std::ranges::all_of(mesh.cells[c], [&](std::uint32_t v) {
                return model.vertices[v].role == Role::sample || model.vertices[v].role == Role::seed;
            });
        }
        s.below_v_min +=
            model.criteria.v_min > 0 && cell_quality(corners(mesh, mesh.cells[c])).volume < model.criteria.v_min;
        for (const auto& [i, j] : cell_edges) {
            const double d = squared_distance(mesh.points[mesh.cells[c][i]], mesh.points[mesh.cells[c][j]]);
            shortest = std::min(shortest, d);
            longest = std::max(longest, d);
        }
    }
    std::ranges::sort(dihedrals);
    s.skinny_percent = percent(skinny, dihedrals.size());
    s.flat_percent = percent(flat, dihedrals.size());
    s.bad_percent = percent(bad, dihedrals.size());
    s.dihedral_min_deg = quantile(dihedrals, 0);
    s.dihedral_p1_deg = quantile(dihedrals, 0.01);
    s.dihedral_p5_deg = quantile(dihedrals, 0.05);
    s.dihedral_median_deg = quantile(dihedrals, 0.5);
    s.edge_min = dihedrals.empty() ? 0 : std::sqrt(shortest);
    s.edge_max = std::sqrt(longest);
    return s;
}

std::vector<EmptyBlock> empty_blocks(const Model& model, const TetMesh& mesh, const CellTable& cells) {
    std::vector<EmptyBlock> blocks(static_cast<std::size_t>(cells.region_count));
    std::vector<std::size_t> asked;
    for (std::size_t p = 0; p < model.properties.size(); ++p) {
        if (!std::ranges::all_of(model.samples.values[p], [](double value) { return std::isnan(value); })) {
            asked.push_back(p);
        }
    }
    std::vector<std::vector<char>> valued(asked.size(), std::vector<char>(blocks.size(), 0));
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
        if (cells.region[c] < 0) {
            continue;
        }
        const auto region = static_cast<std::size_t>(cells.region[c]);
        blocks[region].volume += cell_quality(corners(mesh, mesh.cells[c])).volume / model.frame.z_scale;
        for (std::size_t i = 0; i < asked.size(); ++i) {
            const auto& values = model.vertex_values.values[asked[i]];
            valued[i][region] |=
                std::ranges::none_of(mesh.cells[c], [&](std::uint32_t v) { return std::isnan(values[v]); });
        }
    }
    for (std::size_t region = 0; region < blocks.size(); ++region) {
        blocks[region].region = static_cast<std::int32_t>(region);
        blocks[region].name = cells.region_name[region];
        for (std::size_t i = 0; i < asked.size(); ++i) {
            if (valued[i][region] == 0) {
                blocks[region].properties.push_back(model.properties[asked[i]].name);
            }
        }
        blocks[region].of_all = blocks[region].properties.size() == asked.size();
    }
    std::erase_if(blocks, [](const EmptyBlock& block) { return block.properties.empty(); });
    return blocks;
}

std::vector<CrossingEdge> fault_crossing_edges(const Model& model, const TetMesh& mesh) {
    std::vector<CrossingEdge> crossing;
    const FaultProximity proximity(model.faults);
    for (std::size_t f = 0; f < model.faults.size(); ++f) {
        const auto fault = static_cast<std::int32_t>(f);
        const Box3 box = bounding_box(model.faults[f].sheet.vertices);
        const auto is_own_seed = [&](std::uint32_t v) {
            return model.vertices[v].role == Role::seed && proximity.meet(fault, model.vertices[v].owner);
        };
        std::vector<std::array<std::uint32_t, 2>> suspects;
        for (const auto& cell : mesh.cells) {
            for (const auto& [i, j] : cell_edges) {
                const auto [a, b] = std::minmax(cell[i], cell[j]);
                if (overlap(box, mesh.points[a], mesh.points[b]) && !(is_own_seed(a) && is_own_seed(b))) {
                    suspects.push_back({a, b});
                }
            }
        }
        std::ranges::sort(suspects);
        suspects.erase(std::ranges::unique(suspects).begin(), suspects.end());
        for (const auto& [a, b] : suspects) {
            if (proximity.crosses(fault, mesh.points[a], mesh.points[b])) {
                crossing.push_back({a, b, fault});
            }
        }
    }
    return crossing;
}

std::vector<Fidelity> fidelity(const Model& model, const TetMesh& mesh) {
    std::vector<Fidelity> result(model.properties.size());
    std::vector<double> squares(model.properties.size(), 0);
    MeshWalk walk(mesh);
    const FaultProximity faults = model_proximity(model);
    std::vector<OwnSide> sides;
    for (std::size_t property = 0; property < result.size(); ++property) {
        sides.emplace_back(mesh, std::span<const std::int32_t>(), faults.seen_by(property));
    }
    for (std::size_t i = 0; i < model.samples.size(); ++i) {
        const Vec3& p = model.samples.positions[i];
        if (!model.domain.hull.contains(p)) {
            continue;
        }
        auto position = walk.locate(p);
        if (!position) {
            continue;
        }
        const std::int32_t gap = gap_fault(mesh.cells[position->cell], model.vertices);
        if (gap >= 0 && model.faults[static_cast<std::size_t>(gap)].sheet.kind != SurfaceKind::fault) {
            keep_to_own_side(*position, p, mesh, model.vertices);
        }
        for (std::size_t property = 0; property < result.size(); ++property) {
            const Property& kind = model.properties[property];
            const VertexWeights own = sides[property].weights(position->cell, p, position->weights);
            double value = 0;
            double heaviest = -1;
            for (std::size_t k = 0; k < 4; ++k) {
                const double w = own.weights[k];
                const double at_vertex = to_scale(kind, model.vertex_values.values[property][own.vertices[k]]);
                if (kind.kind == Kind::categorical) {
                    value = w > heaviest ? at_vertex : value;
                    heaviest = std::max(heaviest, w);
                } else if (w != 0) {
                    value += w * at_vertex;
                }
            }
            const double measured = to_scale(kind, model.samples.values[property][i]);
            const double error =
                kind.kind == Kind::categorical ? (measured == value ? 0.0 : 1.0) : std::abs(value - measured);
            if (!std::isnan(measured) && !std::isnan(value)) {
                squares[property] += error * error;
                result[property].max = std::max(result[property].max, error);
                ++result[property].count;
            }
        }
    }
    for (std::size_t property = 0; property < result.size(); ++property) {
        if (result[property].count > 0) {
            result[property].rms = std::sqrt(squares[property] / static_cast<double>(result[property].count));
        }
    }
    return result;
}

}  // namespace terratet
