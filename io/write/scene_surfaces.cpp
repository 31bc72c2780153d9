// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// Surfaces of the scene, from the facets of the clipped tessellation.

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "io/write/clip.hpp"
#include "io/write/scene.hpp"
#include "tess/barrier/query/model_bounds.hpp"

namespace terratet {
namespace {

Vec3 facet_normal(const ClippedMesh& clipped, const Triangle& t) {
    return cross(clipped.points[t[1]] - clipped.points[t[0]], clipped.points[t[2]] - clipped.points[t[0]]);
}

Vec3 unit(const Vec3& v) {
    const double l = length(v);
    return l > 0 ? v / l : Vec3{0, 0, 1};
}

/// Collects triangles, giving each (point, group) one vertex.
class PartBuilder {
  public:
    PartBuilder(std::string name, const ClippedMesh& clipped, const SceneFrame& frame,
                const std::vector<std::vector<double>>& values)
        : clipped_(clipped), frame_(frame), values_(values) {
        part_.name = std::move(name);
        part_.values.resize(values.size());
        part_.colored = true;
    }

    /// Normals add up, weighted by area, where triangles of a group share a vertex.
    void add(const Triangle& corners, int group) {
        const Vec3 normal = frame_.normal(facet_normal(clipped_, corners));
        Triangle triangle;
        for (std::size_t k = 0; k < 3; ++k) {
            triangle[k] = vertex(corners[k], group);
            part_.normals[triangle[k]] = part_.normals[triangle[k]] + normal;
        }
        part_.triangles.push_back(triangle);
    }

    ScenePart take() {
        for (Vec3& normal : part_.normals) {
            normal = unit(normal);
        }
        return std::move(part_);
    }

  private:
    std::uint32_t vertex(std::uint32_t point, int group) {
        const auto [entry, fresh] =
            index_.try_emplace({point, group}, static_cast<std::uint32_t>(part_.positions.size()));
        if (fresh) {
            part_.positions.push_back(frame_.position(clipped_.points[point]));
            part_.normals.push_back({});
            for (std::size_t p = 0; p < values_.size(); ++p) {
                part_.values[p].push_back(values_[p][point]);
            }
        }
        return entry->second;
    }

    const ClippedMesh& clipped_;
    const SceneFrame& frame_;
    const std::vector<std::vector<double>>& values_;
    std::map<std::pair<std::uint32_t, int>, std::uint32_t> index_;
    ScenePart part_;
};

std::vector<std::vector<double>> all_values(const ModelView& view, const ClippedMesh& clipped) {
    std::vector<std::vector<double>> values;
    for (std::size_t p = 0; p < view.model.properties.size(); ++p) {
        values.push_back(clipped.values(view.model, p));
    }
    values.push_back(clipped.extrapolation(view.model));
    return values;
}

constexpr double upright_limit = 1e-3;  ///< cosine: the walls of a domain are, grounds seldom

/// 0…5: which face of a box a normal belongs to.
int box_face(const Vec3& normal) {
    int axis = 0;
    for (int a = 1; a < 3; ++a) {
        axis = std::abs(normal[a]) > std::abs(normal[axis]) ? a : axis;
    }
    return 2 * axis + (normal[axis] > 0 ? 1 : 0);
}

}  // namespace

std::vector<ScenePart> tessellation_surfaces(const ModelView& view, const SceneFrame& frame) {
    const ClippedMesh clipped = clip_to_extent(view, ClippedCells::as_cut);
    const auto values = all_values(view, clipped);

    PartBuilder boundary("domain boundary", clipped, frame, values);
    std::map<std::int32_t, PartBuilder> regions;
    const auto add_wall = [&](const Triangle& corners, std::int32_t region) {
        if (region >= 0) {
            const auto [entry, fresh] = regions.try_emplace(
                region, view.cells.region_name[static_cast<std::size_t>(region)], clipped, frame, values);
            entry->second.add(corners, 0);
        }
    };
    // Off the extent's faces, a facet of one cell has its twin on a fault, and none where the model ends.
    const auto places_of = [&](const ClippedMesh::Facet& facet) {
        std::array<Vec3, 3> places;
        std::transform(facet.corners.begin(), facet.corners.end(), places.begin(),
                       [&](std::uint32_t v) { return clipped.points[v]; });
        std::sort(places.begin(), places.end());
        return places;
    };
    std::map<std::array<Vec3, 3>, int> facets_at;
    for (const ClippedMesh::Facet& facet : clipped.facets) {
        if (facet.beyond < 0 && !facet.on_extent) {
            ++facets_at[places_of(facet)];
        }
    }
    constexpr int ground = 6;  // after the box's faces, before the outline's
    for (const ClippedMesh::Facet& facet : clipped.facets) {
        const auto& [a, b, c] = facet.corners;
        if (facet.beyond < 0 && !facet.on_extent && facets_at[places_of(facet)] < 2) {
            const Vec3 normal = facet_normal(clipped, facet.corners);
            const bool upright = std::abs(normal.z) < upright_limit * length(normal);
            boundary.add({a, c, b}, upright ? ground + 1 + box_face(normal) : ground);
        } else if (facet.beyond < 0 && !facet.on_extent) {
            add_wall({a, b, c}, clipped.region[facet.cell]);
        } else if (facet.beyond < 0) {
            boundary.add({a, c, b}, box_face(facet_normal(clipped, facet.corners)));
        } else if (const std::int32_t here = clipped.region[facet.cell],
                   there = clipped.region[static_cast<std::size_t>(facet.beyond)];
                   here != there) {
            add_wall({a, b, c}, here);
            add_wall({a, c, b}, there);
        }
    }
    std::vector<ScenePart> parts;
    parts.push_back(boundary.take());
    parts.back().double_sided = false;
    parts.back().lit = false;
    if (regions.size() > 1) {
        for (auto& [region, builder] : regions) {
            parts.push_back(builder.take());
            parts.back().double_sided = false;
        }
    }
    return parts;
}

ScenePart fault_sheet(const Model& model, std::size_t index, const SceneFrame& frame) {
    const Barrier& fault = model.barriers[index];
    ScenePart part;
    part.name = std::string(to_string(fault.sheet.kind)) + ": " + fault.name;
    // Frosted glass with a tint: a strong colour would turn what is seen through it into mud.
    const Color tint = class_color(index + 5);
    part.color = {0.4 + 0.6 * tint.r, 0.4 + 0.6 * tint.g, 0.4 + 0.6 * tint.b};
    part.opacity = 0.5;
    const BarrierQuery faults(model.barriers);
    const ModelBounds bounds(model.domain, faults);
    for (const Triangle& t : fault.sheet.triangles) {
        const auto& v = fault.sheet.vertices;
        if (!bounds.excludes((v[t[0]] + v[t[1]] + v[t[2]]) / 3)) {
            part.triangles.push_back(t);
        }
    }
    part.normals.resize(fault.sheet.vertices.size());
    for (const Vec3& vertex : fault.sheet.vertices) {
        part.positions.push_back(frame.position(vertex));
    }
    for (const Triangle& t : part.triangles) {
        const Vec3 normal =
            cross(part.positions[t[1]] - part.positions[t[0]], part.positions[t[2]] - part.positions[t[0]]);
        for (const std::uint32_t v : t) {
            part.normals[v] = part.normals[v] + normal;
        }
    }
    for (Vec3& normal : part.normals) {
        normal = unit(normal);
    }
    return part;
}

}  // namespace terratet
