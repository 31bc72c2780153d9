// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "io/write/clipped_parts.hpp"
#include "io/write/view_barriers.hpp"
#include "tess/base/no_index.hpp"
#include "tess/mending/mend_cells.hpp"

namespace terratet {
namespace {

constexpr double wanted_edge = 0.3;  ///< over l_min: shorter ones make a cell worse

std::int32_t gap_of(const ModelView& view, std::uint32_t parent) {
    return view.cells.barrier[parent];
}

MendableMesh cut_mesh(const ModelView& view, const ClippedMesh& mesh) {
    MendableMesh result;
    result.box = view.model.domain.extent;
    result.least_edge = wanted_edge * smallest_l_min(view.model.criteria);
    result.points = mesh.points;
    for (const ClippedMesh::Place place : mesh.place) {
        const bool is_vertex = place < view.model.vertices.size();
        const Role role = is_vertex ? view.model.vertices[place].role : Role::domain;
        result.hold.push_back(role == Role::sample ? MendableMesh::Hold::fixed
                              : role == Role::seed ? MendableMesh::Hold::surface
                                                   : MendableMesh::Hold::free);
    }
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
        const std::int32_t gap = gap_of(view, mesh.parent[c]);
        result.cells.push_back(
            {mesh.cells[c], mesh.parent[c], gap >= 0 ? -2 - gap : mesh.region[c], gap < 0, mesh.changed[c] != 0});
    }
    return result;
}

bool on_face(const Box3& box, const Vec3& p) {
    for (int axis = 0; axis < 3; ++axis) {
        if (p[axis] == box.lo[axis] || p[axis] == box.hi[axis]) {
            return true;
        }
    }
    return false;
}

void take_points(const ModelView& view, const MendableMesh& mended, ClippedMesh& mesh) {
    std::vector<std::uint32_t> parent_at(mended.points.size(), no_index);
    for (std::size_t c = mesh.cells.size(); c-- > 0;) {
        for (const std::uint32_t v : mesh.cells[c]) {
            parent_at[v] = mesh.parent[c];
        }
    }
    const ViewBarriers barriers(view);
    const OwnSideField field(view.mesh, view.cells.barrier, *barriers);
    const std::size_t first = view.model.vertices.size() + mesh.cuts.size();
    for (std::size_t i = 0; i < mended.points.size(); ++i) {
        if (mended.moved[i] != 0 && parent_at[i] != no_index) {
            mesh.points[i] = mended.points[i];
            mesh.place[i] = static_cast<std::uint32_t>(first + mesh.moved.size());
            mesh.moved.push_back(
                {field.at(mesh.points[i], parent_at[i]), on_face(view.model.domain.extent, mesh.points[i])});
        }
    }
}

void take_cells(const MendableMesh& mended, ClippedMesh& mesh) {
    std::vector<std::uint32_t> order;
    for (std::uint32_t c = 0; c < mended.cells.size(); ++c) {
        if (mended.cells[c].corners[0] != mended.cells[c].corners[1]) {
            order.push_back(c);
        }
    }
    std::ranges::stable_sort(order, {}, [&](std::uint32_t c) { return mended.cells[c].parent; });
    mesh.cells.clear();
    mesh.parent.clear();
    mesh.region.clear();
    mesh.changed.clear();
    for (const std::uint32_t c : order) {
        const MendableMesh::Cell& cell = mended.cells[c];
        mesh.cells.push_back(cell.corners);
        mesh.parent.push_back(cell.parent);
        mesh.region.push_back(std::max(cell.part, -1));
        mesh.changed.push_back(cell.touched ? 1 : 0);
    }
}

}  // namespace

void mend_clipped(const ModelView& view, ClippedMesh& mesh, const Progress& progress) {
    MendableMesh mended = cut_mesh(view, mesh);
    mend_cells(mended, progress);
    take_cells(mended, mesh);
    take_points(view, mended, mesh);
    drop_unused_points(mesh);
}

void drop_unused_points(ClippedMesh& mesh) {
    std::vector<std::uint32_t> number(mesh.points.size(), no_index);
    for (const Corners& cell : mesh.cells) {
        for (const std::uint32_t v : cell) {
            number[v] = 0;
        }
    }
    std::uint32_t count = 0;
    for (std::size_t i = 0; i < number.size(); ++i) {
        if (number[i] != no_index) {
            mesh.points[count] = mesh.points[i];
            mesh.place[count] = mesh.place[i];
            number[i] = count++;
        }
    }
    mesh.points.resize(count);
    mesh.place.resize(count);
    for (Corners& cell : mesh.cells) {
        for (std::uint32_t& v : cell) {
            v = number[v];
        }
    }
}

}  // namespace terratet
