// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// Surfaces of the scene, from the facets of the clipped tessellation.

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "io/scene.hpp"

namespace terratet {
namespace {

/// A facet between two labels, seen from one side: its corners turn counter-clockwise as seen from outside the cell.
struct Facet {
    Triangle corners;     ///< of ClippedMesh::points
    std::int32_t region;  ///< of the cell whose facet it is
};

struct Facets {
    std::vector<Facet> outer;  ///< on the extent's faces
    std::vector<Facet> walls;  ///< between a region and a gap or another region, once from each region
};

/// Corners of facet k as seen from outside the cell.
constexpr std::size_t outward[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

/// One side of a facet, to be matched with the other.
struct Half {
    Triangle key;  ///< sorted
    Triangle corners;
    std::int32_t region;
};

/// Sides of all facets that may be on the extent's faces or between regions: most cells lie whole among cells of their
/// own region, and their facets need not be looked at.
std::vector<Half> candidate_halves(const ModelView& view, const ClippedMesh& clipped) {
    using Fate = ClippedMesh::Fate;
    std::vector<std::int32_t> region_of(clipped.fate.size(), -1);
    for (std::size_t c = 0; c < clipped.cells.size(); ++c) {
        region_of[clipped.parent[c]] = clipped.region[c];
    }
    std::vector<Half> halves;
    for (std::size_t c = 0; c < clipped.cells.size(); ++c) {
        const std::uint32_t parent = clipped.parent[c];
        for (std::size_t k = 0; k < 4; ++k) {
            // A whole cell keeps the order of its corners: its facet k is its parent's.
            const std::int32_t neighbour = view.mesh.neighbours[parent][k];
            if (clipped.fate[parent] == Fate::whole && neighbour >= 0) {
                const auto n = static_cast<std::size_t>(neighbour);
                if (clipped.fate[n] == Fate::whole && region_of[n] == clipped.region[c]) {
                    continue;
                }
            }
            const auto& cell = clipped.cells[c];
            Half half{{}, {cell[outward[k][0]], cell[outward[k][1]], cell[outward[k][2]]}, clipped.region[c]};
            half.key = half.corners;
            std::sort(half.key.begin(), half.key.end());
            halves.push_back(half);
        }
    }
    return halves;
}

Facets find_facets(const ModelView& view, const ClippedMesh& clipped) {
    std::vector<Half> halves = candidate_halves(view, clipped);
    std::stable_sort(halves.begin(), halves.end(), [](const Half& a, const Half& b) { return a.key < b.key; });
    Facets facets;
    for (std::size_t i = 0; i < halves.size();) {
        if (i + 1 == halves.size() || halves[i].key != halves[i + 1].key) {
            facets.outer.push_back({halves[i].corners, halves[i].region});
            ++i;
            continue;
        }
        if (halves[i].region != halves[i + 1].region) {
            for (const Half& half : {halves[i], halves[i + 1]}) {
                if (half.region >= 0) {
                    facets.walls.push_back({half.corners, half.region});
                }
            }
        }
        i += 2;
    }
    return facets;
}

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
        const Vec3 normal = SceneFrame::turned(facet_normal(clipped_, corners));
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
    return values;
}

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
    const ClippedMesh clipped = clip_to_extent(view);
    const Facets facets = find_facets(view, clipped);
    const auto values = all_values(view, clipped);

    PartBuilder boundary("domain boundary", clipped, frame, values);
    for (const Facet& facet : facets.outer) {
        const auto& [a, b, c] = facet.corners;
        boundary.add({a, c, b}, box_face(facet_normal(clipped, facet.corners)));
    }
    std::vector<ScenePart> parts;
    parts.push_back(boundary.take());
    parts.back().double_sided = false;
    parts.back().lit = false;

    std::vector<PartBuilder> regions;
    for (std::int32_t region = 0; region < view.cells.region_count; ++region) {
        regions.emplace_back("region " + std::to_string(region), clipped, frame, values);
    }
    for (const Facet& wall : facets.walls) {
        regions[static_cast<std::size_t>(wall.region)].add(wall.corners, 0);
    }
    for (PartBuilder& region : regions) {
        parts.push_back(region.take());
    }
    return parts;
}

ScenePart fault_sheet(const Fault& fault, std::size_t index, const SceneFrame& frame) {
    ScenePart part;
    part.name = "fault: " + fault.name;
    part.color = class_color(index + 5);  // vermilion first
    part.opacity = 0.55;
    part.triangles = fault.sheet.triangles;
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
