// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// Gmsh's format, 4.1 or 2.2, as text: tetrahedra in physical volumes named after the blocks, the facets of faults and
/// of the extent's sides in physical surfaces. What finite-element codes read.

#include <algorithm>
#include <cmath>
#include <map>

#include "io/base/csv_text.hpp"
#include "io/base/output_file.hpp"
#include "io/export.hpp"
#include "io/write/clip.hpp"

namespace terratet {
namespace {

/// Elements of one physical group, on one geometrical entity of the same number.
struct Group {
    int dimension = 3;
    int tag = 0;
    std::string name;
    std::vector<std::array<std::uint32_t, 4>> elements;  ///< of a triangle the first three
};

/// Which side of the extent a facet lies on; empty: none.
std::string side_of(const ClippedMesh& mesh, const Triangle& corners, const Box3& extent) {
    constexpr const char* names[] = {"west", "east", "south", "north", "bottom", "top"};
    const double tolerance = 1e-9 * extent.diagonal();
    for (int axis = 0; axis < 3; ++axis) {
        for (int end = 0; end < 2; ++end) {
            const double plane = end == 0 ? extent.lo[axis] : extent.hi[axis];
            if (std::ranges::all_of(
                    corners, [&](std::uint32_t v) { return std::abs(mesh.points[v][axis] - plane) <= tolerance; })) {
                return names[2 * axis + end];
            }
        }
    }
    return {};
}

class Groups {
  public:
    Group& of(int dimension, const std::string& name) {
        const auto [entry, fresh] = index_.try_emplace({-dimension, name}, groups_.size());
        if (fresh) {
            int tag = 1;
            for (const Group& group : groups_) {
                tag += group.dimension == dimension ? 1 : 0;
            }
            groups_.push_back({dimension, tag, name, {}});
        }
        return groups_[entry->second];
    }
    /// Surfaces before volumes, as Gmsh lists them.
    std::vector<Group> take() {
        std::ranges::stable_sort(groups_, {}, &Group::dimension);
        return std::move(groups_);
    }

  private:
    std::map<std::pair<int, std::string>, std::size_t> index_;
    std::vector<Group> groups_;
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

std::vector<Group> groups_of(const ModelView& view, const ClippedMesh& mesh) {
    Groups groups;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
        const std::int32_t barrier = view.cells.barrier[mesh.parent[c]];
        const std::string name = mesh.region[c] >= 0 ? view.cells.region_name[static_cast<std::size_t>(mesh.region[c])]
                                 : barrier >= 0
                                     ? "gap of " + view.model.barriers[static_cast<std::size_t>(barrier)].name
                                     : "outside";
        groups.of(3, name).elements.push_back(mesh.cells[c]);
    }
    for (const ClippedMesh::Facet& facet : mesh.facets) {
        const std::string side = side_of(mesh, facet.corners, view.model.domain.extent);
        if (side.empty() && facet.beyond >= 0 &&
            mesh.region[facet.cell] == mesh.region[static_cast<std::size_t>(facet.beyond)]) {
            continue;  // between two pieces of a cut
        }
        const auto& t = facet.corners;
        groups.of(2, side.empty() ? barrier_name(view, mesh, facet) : side).elements.push_back({t[0], t[1], t[2], 0});
    }
    return groups.take();
}

/// Text as it grows, in numbers of all digits.
class Lines {
  public:
    explicit Lines(OutputFile& file) : file_(file) {}
    template <class... Values>
    void line(const Values&... values) {
        bool first = true;
        ((append(values, first), first = false), ...);
        text_ += '\n';
        if (text_.size() > 1 << 20) {
            flush();
        }
    }
    void flush() {
        file_.write(text_);
        text_.clear();
    }

  private:
    template <class Value>
    void append(const Value& value, bool first) {
        text_ += first ? "" : " ";
        if constexpr (std::is_arithmetic_v<Value>) {
            append_csv_number(text_, value);
        } else {
            text_ += value;
        }
    }
    OutputFile& file_;
    std::string text_;
};

/// Gmsh ends a name at a quotation mark.
std::string quoted(std::string name) {
    std::ranges::replace(name, '"', '\'');
    return '"' + name + '"';
}

std::size_t count_of(const std::vector<Group>& groups) {
    std::size_t count = 0;
    for (const Group& group : groups) {
        count += group.elements.size();
    }
    return count;
}

void write_element(Lines& out, std::size_t number, const Group& group, std::size_t e, bool with_tags) {
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

void write_version_2(Lines& out, const std::vector<Vec3>& points, const std::vector<Group>& groups) {
    out.line("$Nodes");
    out.line(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        out.line(i + 1, points[i].x, points[i].y, points[i].z);
    }
    out.line("$EndNodes");
    out.line("$Elements");
    out.line(count_of(groups));
    std::size_t number = 0;
    for (const Group& group : groups) {
        for (std::size_t e = 0; e < group.elements.size(); ++e) {
            write_element(out, ++number, group, e, true);
        }
    }
    out.line("$EndElements");
}

void write_version_4(Lines& out, const std::vector<Vec3>& points, const std::vector<Group>& groups) {
    Box3 box;
    for (const Vec3& p : points) {
        box.extend(p);
    }
    const auto of = [&](int dimension) { return std::ranges::count(groups, dimension, &Group::dimension); };
    out.line("$Entities");
    out.line(0, 0, of(2), of(3));
    for (const Group& group : groups) {
        out.line(group.tag, box.lo.x, box.lo.y, box.lo.z, box.hi.x, box.hi.y, box.hi.z, 1, group.tag, 0);
    }
    out.line("$EndEntities");
    const auto volume = std::ranges::find(groups, 3, &Group::dimension);
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
    for (const Group& group : groups) {
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
    const std::vector<Group> groups = groups_of(view, mesh);
    std::vector<Vec3> points = mesh.points;
    for (Vec3& point : points) {
        point = view.model.frame.to_world(point);
    }
    Lines out(file);
    out.line("$MeshFormat");
    out.line(options.msh_version_2 ? "2.2" : "4.1", 0, 8);
    out.line("$EndMeshFormat");
    out.line("$PhysicalNames");
    out.line(groups.size());
    for (const Group& group : groups) {
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
