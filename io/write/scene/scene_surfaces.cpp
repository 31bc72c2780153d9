// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// Surfaces of the scene: ground, fault blocks, barriers.

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "io/write/scene/scene.hpp"
#include "tess/barrier/query/model_bounds.hpp"
#include "tess/base/box_clip.hpp"

namespace terratet {
namespace {

constexpr double upright_limit = 1e-3;  ///< cosine: the walls of a domain are, grounds seldom

/// Facets of the cells on their way to a part, each point once.
class FacetPart {
  public:
    FacetPart(ScenePart::Kind kind, std::string name) {
        part_.kind = kind;
        part_.name = std::move(name);
    }

    void add(const Triangle& corners) { triangles_.push_back(corners); }

    ScenePart take(const SceneCells& cells, const SceneFrame& frame) {
        std::map<std::uint32_t, std::uint32_t> index;
        std::vector<Vec3> places;
        for (Triangle& triangle : triangles_) {
            for (std::uint32_t& v : triangle) {
                const auto [entry, fresh] = index.try_emplace(v, static_cast<std::uint32_t>(places.size()));
                if (fresh) {
                    places.push_back(cells.mesh.points[v]);
                }
                v = entry->second;
            }
        }
        part_.positions = frame.positions(places);
        part_.triangles = std::move(triangles_);
        part_.normals = vertex_normals(part_.positions, part_.triangles);
        return std::move(part_);
    }

  private:
    ScenePart part_;
    std::vector<Triangle> triangles_;
};

std::array<Vec3, 3> places_of(const SceneCells& cells, const Triangle& corners) {
    std::array<Vec3, 3> places;
    std::transform(corners.begin(), corners.end(), places.begin(),
                   [&](std::uint32_t v) { return cells.mesh.points[v]; });
    std::sort(places.begin(), places.end());
    return places;
}

}  // namespace

std::vector<ScenePart> surface_parts(const SceneCells& cells, const ModelView& view, const SceneFrame& frame) {
    const ClippedMesh& mesh = cells.mesh;
    // Off the extent's faces, a facet of one cell has its twin on a fault without width, and none where the model ends.
    std::map<std::array<Vec3, 3>, int> facets_at;
    for (const ClippedMesh::Facet& facet : mesh.facets) {
        if (facet.beyond < 0 && !facet.on_extent) {
            ++facets_at[places_of(cells, facet.corners)];
        }
    }
    FacetPart ground(ScenePart::Kind::ground, "ground");
    std::map<std::int32_t, FacetPart> blocks;
    const auto add_wall = [&](const Triangle& corners, std::int32_t region) {
        if (region >= 0) {
            const auto [entry, fresh] = blocks.try_emplace(region, ScenePart::Kind::block,
                                                           view.cells.region_name[static_cast<std::size_t>(region)]);
            entry->second.add(corners);
        }
    };
    for (const ClippedMesh::Facet& facet : mesh.facets) {
        const auto& [a, b, c] = facet.corners;
        const std::int32_t here = mesh.region[facet.cell];
        const std::int32_t there = facet.beyond < 0 ? -1 : mesh.region[static_cast<std::size_t>(facet.beyond)];
        if (facet.beyond < 0 && !facet.on_extent && facets_at[places_of(cells, facet.corners)] < 2) {
            const Vec3 normal = cross(mesh.points[b] - mesh.points[a], mesh.points[c] - mesh.points[a]);
            if (normal.z > upright_limit * length(normal)) {
                ground.add({a, b, c});
            }
        }
        if (here != there || facet.beyond < 0) {
            add_wall({a, b, c}, here);
            add_wall({a, c, b}, facet.beyond < 0 ? -1 : there);
        }
    }
    std::vector<ScenePart> parts;
    if (std::any_of(view.model.surfaces.begin(), view.model.surfaces.end(),
                    [](const Surface& surface) { return surface.kind == SurfaceKind::topography; })) {
        parts.push_back(ground.take(cells, frame));
    } else {
        parts.emplace_back();
    }
    parts.back().color = {0.62, 0.55, 0.42};
    parts.back().opacity = 0.35;
    if (blocks.size() > 1) {
        for (auto& [region, block] : blocks) {
            parts.push_back(block.take(cells, frame));
            parts.back().color = class_color(static_cast<std::size_t>(region));
            parts.back().opacity = 0.12;
            parts.back().feature = region;
        }
    }
    return parts;
}

ClippedSheet clipped_sheet(const Model& model, std::size_t barrier) {
    const BarrierQuery barriers(model.barriers);
    const ModelBounds bounds(model.domain, barriers);
    std::map<Vec3, std::uint32_t> index_of;
    ClippedSheet sheet;
    const auto place = [&](const Vec3& p) {
        const auto [entry, fresh] = index_of.try_emplace(p, static_cast<std::uint32_t>(sheet.places.size()));
        if (fresh) {
            sheet.places.push_back(p);
        }
        return entry->second;
    };
    for (const auto& [a, b, c] : model.barriers[barrier].sheet.triangles) {
        const auto& v = model.barriers[barrier].sheet.vertices;
        const std::vector<Vec3> polygon = clipped({v[a], v[b], v[c]}, model.domain.extent);
        Vec3 middle;
        for (const Vec3& p : polygon) {
            middle = middle + p / static_cast<double>(polygon.size());
        }
        if (polygon.size() < 3 || (!is_bound(model.barriers[barrier].sheet.kind) && bounds.excludes(middle))) {
            continue;
        }
        for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
            sheet.triangles.push_back({place(polygon[0]), place(polygon[k]), place(polygon[k + 1])});
        }
    }
    return sheet;
}

ScenePart barrier_part(const Model& model, std::size_t index, const SceneFrame& frame) {
    const Barrier& barrier = model.barriers[index];
    ScenePart part;
    part.name = std::string(to_string(barrier.sheet.kind)) + ": " + barrier.name;
    part.kind = ScenePart::Kind::barrier;
    part.feature = static_cast<std::int64_t>(index);
    // Frosted glass with a tint: a strong colour would turn what is seen through it into mud.
    const Color tint = class_color(index + 5);
    part.color = {0.4 + 0.6 * tint.r, 0.4 + 0.6 * tint.g, 0.4 + 0.6 * tint.b};
    part.opacity = 0.5;
    ClippedSheet sheet = clipped_sheet(model, index);
    part.positions = frame.positions(sheet.places);
    part.triangles = std::move(sheet.triangles);
    part.normals = vertex_normals(part.positions, part.triangles);
    return part;
}

}  // namespace terratet
