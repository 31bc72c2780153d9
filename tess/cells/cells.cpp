// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/cells.hpp"

#include <optional>

#include "tess/base/point_grid.hpp"
#include "tess/mesh/quality.hpp"
#include "tess/model/regions.hpp"
#include "tess/refine/insertion_rule.hpp"

namespace terratet {
namespace {

/// Why the refiner left a cell as it is: the refiner's own rule, asked again, plus the distance of a projected point,
/// which needs all vertices.
class Explainer {
  public:
    Explainer(const Model& model, const TetMesh& mesh, const BarrierQuery& barriers)
        : mesh_(mesh),
          rule_(model.criteria, model.domain, model.frame, barriers, model.properties, model.vertex_values) {
        for (const Vec3& p : mesh.points) {
            rule_.note_vertex(p);
        }
    }

    Reason operator()(const std::array<std::uint32_t, 4>& cell) {
        const JudgedCell judged_cell = judged(mesh_, cell);
        if (rule_.violation_in_force(judged_cell) > 1) {
            return refusal(judged_cell);
        }
        const Reason otherwise = rule_.violation(judged_cell) > 1 ? Reason::smooth : Reason::none;
        if (!rule_.unsure(judged_cell)) {
            return otherwise;
        }
        const Reason refused = refusal(judged_cell);
        return refused == Reason::none ? otherwise : refused;
    }

  private:
    /// Why it may have no new vertex; none when it may.
    Reason refusal(const JudgedCell& judged_cell) {
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
    InsertionRule rule_;
    std::optional<PointGrid> vertices_;
};

void name_regions(const Model& model, const TetMesh& mesh, CellTable& table) {
    for (std::int32_t region = 0; region < table.region_count; ++region) {
        table.region_name.push_back("region " + std::to_string(region));
    }
    RegionFinder finder(mesh, table);
    for (const RegionName& named : model.region_names) {
        const std::int32_t region = finder.at(named.point);
        if (region >= 0) {
            table.region_name[static_cast<std::size_t>(region)] = named.name;
        }
    }
}

}  // namespace

CellTable measure_cells(const Model& model, const TetMesh& mesh, const BarrierQuery& barriers) {
    const std::size_t n = mesh.cells.size();
    CellTable table{regions(mesh, model.vertices, barriers, model.domain), {}, {}, {}, {}, {}};
    table.radius_edge.resize(n);
    table.aspect.resize(n);
    table.dihedral_min_deg.resize(n);
    for (std::size_t c = 0; c < n; ++c) {
        const CellQuality quality = cell_quality(cell_points(mesh, mesh.cells[c]));
        table.radius_edge[c] = static_cast<float>(quality.radius_edge);
        table.aspect[c] = static_cast<float>(quality.aspect);
        table.dihedral_min_deg[c] = static_cast<float>(quality.dihedral_min_deg);
    }
    name_regions(model, mesh, table);
    return table;
}

CellTable describe_cells(const Model& model, const TetMesh& mesh, const BarrierQuery& barriers) {
    CellTable table = measure_cells(model, mesh, barriers);
    Explainer explain(model, mesh, barriers);
    table.reason.resize(mesh.cells.size());
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
        table.reason[c] = table.barrier[c] >= 0 ? Reason::fault_gap : explain(mesh.cells[c]);
    }
    return table;
}

CellTable describe_cells(const Model& model, const TetMesh& mesh) {
    return describe_cells(model, mesh, model_proximity(model));
}

}  // namespace terratet
