// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// Gmsh's format, 4.1 or 2.2, as text: tetrahedra in physical volumes named after the blocks, the facets of faults and
/// of the extent's sides in physical surfaces. What finite-element codes read.

#include <algorithm>

#include "io/export.hpp"
#include "io/write/clip.hpp"
#include "io/write/mesh_groups.hpp"
#include "io/write/number_lines.hpp"

namespace terratet {
namespace {

/// Gmsh ends a name at a quotation mark.
std::string quoted(std::string name) {
    std::ranges::replace(name, '"', '\'');
    return '"' + name + '"';
}

std::size_t count_of(const std::vector<MeshGroup>& groups) {
    std::size_t count = 0;
    for (const MeshGroup& group : groups) {
        count += group.elements.size();
    }
    return count;
}

void write_element(NumberLines& out, std::size_t number, const MeshGroup& group, std::size_t e, bool with_tags) {
    const auto& v = group.elements[e];
    const auto type = group.dimension == 3 ? 4 : 2;
    if (with_tags && group.dimension == 3) {
        out.line(number, type, 2, group.tag, group.tag, v[0] + 1, v[1] + 1, v[2] + 1, v[3] + 1);
    } else if (with_tags) {
        out.line(number, type, 2, group.tag, group.tag, v[0] + 1, v[1] + 1, v[2] + 1);
    } else if (group.dimension == 3) {
        out.line(number, v[0] + 1, v[1] + 1, v[2] + 1, v[3] + 1);
    } else {
        out.line(number, v[0] + 1, v[1] + 1, v[2] + 1);
    }
}

void write_version_2(NumberLines& out, const std::vector<Vec3>& points, const std::vector<MeshGroup>& groups) {
    out.line("$Nodes");
    out.line(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        out.line(i + 1, points[i].x, points[i].y, points[i].z);
    }
    out.line("$EndNodes");
    out.line("$Elements");
    out.line(count_of(groups));
    std::size_t number = 0;
    for (const MeshGroup& group : groups) {
        for (std::size_t e = 0; e < group.elements.size(); ++e) {
            write_element(out, ++number, group, e, true);
        }
    }
    out.line("$EndElements");
}

void write_version_4(NumberLines& out, const std::vector<Vec3>& points, const std::vector<MeshGroup>& groups) {
    Box3 box;
    for (const Vec3& p : points) {
        box.extend(p);
    }
    const auto of = [&](int dimension) { return std::ranges::count(groups, dimension, &MeshGroup::dimension); };
    out.line("$Entities");
    out.line(0, 0, of(2), of(3));
    for (const MeshGroup& group : groups) {
        out.line(group.tag, box.lo.x, box.lo.y, box.lo.z, box.hi.x, box.hi.y, box.hi.z, 1, group.tag, 0);
    }
    out.line("$EndEntities");
    const auto volume = std::ranges::find(groups, 3, &MeshGroup::dimension);
    out.line("$Nodes");
    out.line(1, points.size(), 1, points.size());
    out.line(3, volume == groups.end() ? 1 : volume->tag, 0, points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        out.line(i + 1);
    }
    for (const Vec3& p : points) {
        out.line(p.x, p.y, p.z);
    }
    out.line("$EndNodes");
    out.line("$Elements");
    out.line(groups.size(), count_of(groups), 1, count_of(groups));
    std::size_t number = 0;
    for (const MeshGroup& group : groups) {
        out.line(group.dimension, group.tag, group.dimension == 3 ? 4 : 2, group.elements.size());
        for (std::size_t e = 0; e < group.elements.size(); ++e) {
            write_element(out, ++number, group, e, false);
        }
    }
    out.line("$EndElements");
}

}  // namespace

OutputRecord write_msh(const ModelView& view, const std::string& path, const ExportOptions& options) {
    OutputFile file(path, options.overwrite);
    const ClippedMesh mesh = clip_to_extent(view, ClippedCells::mended, options.progress);
    const std::vector<MeshGroup> groups = mesh_groups(view, mesh);
    std::vector<Vec3> points = mesh.points;
    for (Vec3& point : points) {
        point = view.model.frame.to_world(point);
    }
    NumberLines out(file);
    out.line("$MeshFormat");
    out.line(options.msh_version_2 ? "2.2" : "4.1", 0, 8);
    out.line("$EndMeshFormat");
    out.line("$PhysicalNames");
    out.line(groups.size());
    for (const MeshGroup& group : groups) {
        out.line(group.dimension, group.tag, quoted(group.name));
    }
    out.line("$EndPhysicalNames");
    if (options.msh_version_2) {
        write_version_2(out, points, groups);
    } else {
        write_version_4(out, points, groups);
    }
    out.flush();
    return {path, file.commit(), clipped_shapes(view, mesh)};
}

}  // namespace terratet
