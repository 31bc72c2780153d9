// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/write/mesh_groups.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace terratet {
namespace {

/// Which side of the extent a facet lies on; empty: none.
std::string side_of(const ClippedMesh& mesh, const Triangle& corners, const Box3& extent) {
    const double tolerance = 1e-9 * extent.diagonal();
    for (int axis = 0; axis < 3; ++axis) {
        for (int end = 0; end < 2; ++end) {
            const double plane = end == 0 ? extent.lo[axis] : extent.hi[axis];
            if (std::ranges::all_of(
                    corners, [&](std::uint32_t v) { return std::abs(mesh.points[v][axis] - plane) <= tolerance; })) {
                return side_names[2 * axis + end];
            }
        }
    }
    return {};
}

class Groups {
  public:
    MeshGroup& of(int dimension, const std::string& name) {
        const auto [entry, fresh] = index_.try_emplace({-dimension, name}, groups_.size());
        if (fresh) {
            int tag = 1;
            for (const MeshGroup& group : groups_) {
                tag += group.dimension == dimension ? 1 : 0;
            }
            groups_.push_back({dimension, tag, name, {}, {}});
        }
        return groups_[entry->second];
    }
    void add(int dimension, const std::string& name, const std::array<std::uint32_t, 4>& element, std::uint32_t cell) {
        MeshGroup& group = of(dimension, name);
        group.elements.push_back(element);
        group.cells.push_back(cell);
    }
    /// Surfaces before volumes, as Gmsh lists them.
    std::vector<MeshGroup> take() {
        std::ranges::stable_sort(groups_, {}, &MeshGroup::dimension);
        return std::move(groups_);
    }

  private:
    std::map<std::pair<int, std::string>, std::size_t> index_;
    std::vector<MeshGroup> groups_;
};

/// The barrier whose gap is on the one side of a facet, or, of a collapsed one, the only barrier there is near.
std::string barrier_name(const ModelView& view, const ClippedMesh& mesh, const ClippedMesh::Facet& facet) {
    for (const std::int64_t cell : {std::int64_t{facet.cell}, facet.beyond}) {
        if (cell >= 0) {
            if (const std::int32_t b = view.cells.barrier[mesh.parent[static_cast<std::size_t>(cell)]]; b >= 0) {
                return view.model.barriers[static_cast<std::size_t>(b)].name;
            }
        }
    }
    for (const std::uint32_t corner : facet.corners) {
        if (const auto place = mesh.place[corner]; place < view.model.vertices.size()) {
            const Vertex& vertex = view.model.vertices[place];
            if (vertex.role == Role::seed) {
                return view.model.barriers[static_cast<std::size_t>(vertex.owner)].name;
            }
        }
    }
    return "faults";
}

}  // namespace

std::vector<MeshGroup> mesh_groups(const ModelView& view, const ClippedMesh& mesh) {
    Groups groups;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
        const std::int32_t barrier = view.cells.barrier[mesh.parent[c]];
        const std::string name = mesh.region[c] >= 0 ? view.cells.region_name[static_cast<std::size_t>(mesh.region[c])]
                                 : barrier >= 0
                                     ? "gap of " + view.model.barriers[static_cast<std::size_t>(barrier)].name
                                     : "outside";
        groups.add(3, name, mesh.cells[c], static_cast<std::uint32_t>(c));
    }
    for (const ClippedMesh::Facet& facet : mesh.facets) {
        const std::string side = side_of(mesh, facet.corners, view.model.domain.extent);
        if (side.empty() && facet.beyond >= 0 &&
            mesh.region[facet.cell] == mesh.region[static_cast<std::size_t>(facet.beyond)]) {
            continue;  // between two pieces of a cut
        }
        const auto& t = facet.corners;
        groups.add(2, side.empty() ? barrier_name(view, mesh, facet) : side, {t[0], t[1], t[2], 0}, facet.cell);
    }
    return groups.take();
}

}  // namespace terratet
