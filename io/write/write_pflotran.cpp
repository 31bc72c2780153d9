// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// Meshes for PFLOTRAN. NAME.uge: control volumes and their connections, from the Voronoi cells ("explicit unstructured
/// grid"). NAME.ugi: tetrahedra ("implicit unstructured grid"). What regions of an input deck refer to lies in a folder
/// NAME: boundary connections or facets, and numbers of cells.

#include <algorithm>
#include <map>

#include "io/write/clip.hpp"
#include "io/write/companions.hpp"
#include "io/write/mesh_groups.hpp"
#include "io/write/number_lines.hpp"
#include "io/write/write_voronoi.hpp"

namespace terratet {
namespace {

/// Of walls with nothing beyond, by what they lie on.
std::map<std::string, std::vector<std::uint32_t>> outer_walls(const Model& model, const VoronoiCells& cells) {
    std::map<std::string, std::vector<std::uint32_t>> by_name;
    for (std::uint32_t w = 0; w < cells.barrier.size(); ++w) {
        const std::int32_t beyond = cells.complex.walls[w].beyond;
        if (beyond >= 0) {
            continue;
        }
        const std::int32_t barrier = cells.barrier[w];
        by_name[beyond > beyond_bound ? side_names[-1 - beyond]
                : barrier >= 0        ? model.barriers[static_cast<std::size_t>(barrier)].name
                                      : "bound"]
            .push_back(w);
    }
    return by_name;
}

class UgeWriter {
  public:
    UgeWriter(const ModelView& view, const std::string& path, const ExportOptions& options)
        : view_(view), options_(options), voronoi_(mapped_voronoi(view, options.progress)), companions_(path) {
        for (const std::uint32_t v : voronoi_.cells.vertex) {
            site_.push_back(view.model.frame.to_world(view.model.vertices[v].position));
        }
    }

    void write(OutputFile& file) const {
        const auto& [cells, points, measures] = voronoi_;
        NumberLines out(file);
        out.line("CELLS", site_.size());
        for (std::size_t c = 0; c < site_.size(); ++c) {
            out.line(c + 1, site_[c].x, site_[c].y, site_[c].z, measures.volume[c]);
        }
        const auto& walls = cells.complex.walls;
        out.line("CONNECTIONS", std::ranges::count_if(walls, [](const VoronoiWall& w) { return w.beyond >= 0; }));
        for (std::size_t w = 0; w < walls.size(); ++w) {
            if (walls[w].beyond >= 0) {
                const auto other = static_cast<std::size_t>(walls[w].beyond);
                const Vec3 middle = 0.5 * (site_[walls[w].cell] + site_[other]);
                out.line(walls[w].cell + 1, other + 1, middle.x, middle.y, middle.z, length(measures.area[w]));
            }
        }
        out.flush();
    }

    std::uint64_t write_companions() {
        std::uint64_t bytes = 0;
        for (const auto& [name, walls] : outer_walls(view_.model, voronoi_.cells)) {
            bytes += write_boundary(name, walls);
        }
        std::map<std::string, std::vector<std::size_t>> blocks;
        for (std::size_t c = 0; c < site_.size(); ++c) {
            if (const std::int32_t region = voronoi_.cells.region[c]; region >= 0) {
                blocks[view_.cells.region_name[static_cast<std::size_t>(region)]].push_back(c);
            }
        }
        for (const auto& [name, cells] : blocks) {
            OutputFile file(companions_.path_of(name, ".txt"), options_.overwrite);
            NumberLines out(file);
            for (const std::size_t c : cells) {
                out.line(c + 1);
            }
            out.flush();
            bytes += file.commit();
        }
        return bytes + write_barriers();
    }

  private:
    /// A cell, a place that tells how far away the boundary is, and the area.
    std::uint64_t write_boundary(const std::string& name, const std::vector<std::uint32_t>& walls) {
        OutputFile file(companions_.path_of(name, ".ex"), options_.overwrite);
        NumberLines out(file);
        out.line("CONNECTIONS", walls.size());
        for (const std::uint32_t w : walls) {
            const std::uint32_t cell = voronoi_.cells.complex.walls[w].cell;
            const Vec3& area = voronoi_.measures.area[w];
            const double size = length(area);
            const Vec3 normal = size > 0 ? area / size : Vec3{};
            const Vec3& corner = voronoi_.points[voronoi_.cells.complex.corners[voronoi_.cells.complex.walls[w].begin]];
            // A vertex on the boundary would have no distance to it: at least half the cell's depth.
            const double depth = size > 0 ? 0.5 * voronoi_.measures.volume[cell] / size : 0;
            const Vec3 place = site_[cell] + std::max(dot(corner - site_[cell], normal), depth) * normal;
            out.line(cell + 1, place.x, place.y, place.z, size);
        }
        out.flush();
        return file.commit();
    }

    /// The connections across each fault or horizon, to close or to open them.
    std::uint64_t write_barriers() {
        std::uint64_t bytes = 0;
        for (std::size_t b = 0; b < view_.model.barriers.size(); ++b) {
            const auto across = [&](std::size_t w) {
                return voronoi_.cells.barrier[w] == static_cast<std::int32_t>(b) &&
                       voronoi_.cells.complex.walls[w].beyond >= 0;
            };
            if (is_bound(view_.model.barriers[b].sheet.kind)) {
                continue;
            }
            OutputFile file(companions_.path_of(view_.model.barriers[b].name, ".pairs"), options_.overwrite);
            NumberLines out(file);
            for (std::size_t w = 0; w < voronoi_.cells.barrier.size(); ++w) {
                if (across(w)) {
                    const VoronoiWall& wall = voronoi_.cells.complex.walls[w];
                    out.line(wall.cell + 1, wall.beyond + 1);
                }
            }
            out.flush();
            bytes += file.commit();
        }
        return bytes;
    }

    const ModelView& view_;
    const ExportOptions& options_;
    MappedVoronoi voronoi_;
    Companions companions_;
    std::vector<Vec3> site_;  ///< of each cell, true coordinates
};

}  // namespace

OutputRecord write_uge(const ModelView& view, const std::string& path, const ExportOptions& options) {
    OutputFile file(path, options.overwrite);
    UgeWriter writer(view, path, options);
    writer.write(file);
    const std::uint64_t bytes = writer.write_companions();
    return {path, bytes + file.commit(), {}};
}

OutputRecord write_ugi(const ModelView& view, const std::string& path, const ExportOptions& options) {
    OutputFile file(path, options.overwrite);
    const ClippedMesh mesh = clip_to_extent(view, ClippedCells::mended, options.progress);
    NumberLines out(file);
    out.line(mesh.cells.size(), mesh.points.size());
    for (const auto& v : mesh.cells) {
        out.line("T", v[0] + 1, v[1] + 1, v[2] + 1, v[3] + 1);
    }
    for (const Vec3& point : mesh.points) {
        const Vec3 p = view.model.frame.to_world(point);
        out.line(p.x, p.y, p.z);
    }
    out.flush();
    std::uint64_t bytes = 0;
    Companions companions(path);
    for (const MeshGroup& group : mesh_groups(view, mesh)) {
        OutputFile part(companions.path_of(group.name, group.dimension == 2 ? ".ss" : ".txt"), options.overwrite);
        NumberLines lines(part);
        if (group.dimension == 2) {
            lines.line(group.elements.size());
        }
        for (std::size_t e = 0; e < group.elements.size(); ++e) {
            const auto& v = group.elements[e];
            if (group.dimension == 2) {
                lines.line("T", v[0] + 1, v[1] + 1, v[2] + 1);
            } else {
                lines.line(group.cells[e] + 1);
            }
        }
        lines.flush();
        bytes += part.commit();
    }
    return {path, bytes + file.commit(), clipped_shapes(view, mesh)};
}

}  // namespace terratet
