// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/base/tri_mesh.hpp"

#include <unordered_map>

namespace terratet {

TriangleCorners corners(const TriMesh& mesh, const Triangle& t) {
    return {mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]};
}

Vec3 area_vector(const TriangleCorners& t) {
    return 0.5 * cross(t[1] - t[0], t[2] - t[0]);
}

double area(const TriMesh& mesh) {
    double sum = 0;
    for (const Triangle& t : mesh.triangles) {
        sum += length(area_vector(corners(mesh, t)));
    }
    return sum;
}

Vec3 unit(const Vec3& a) {
    const double size = length(a);
    return size > 0 ? a / size : Vec3{};
}

std::vector<Vec3> vertex_normals(const TriMesh& mesh) {
    std::vector<Vec3> normals(mesh.points.size());
    for (const Triangle& t : mesh.triangles) {
        const Vec3 weighted = area_vector(corners(mesh, t));
        for (const std::uint32_t v : t) {
            normals[v] = normals[v] + weighted;
        }
    }
    for (Vec3& normal : normals) {
        normal = unit(normal);
    }
    return normals;
}

std::vector<RimEdge> rim_edges(const TriMesh& mesh) {
    const auto key = [](std::uint32_t a, std::uint32_t b) {
        return std::uint64_t{std::min(a, b)} << 32U | std::max(a, b);
    };
    std::unordered_map<std::uint64_t, int> uses;
    for (const Triangle& t : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            ++uses[key(t[k], t[(k + 1) % 3])];
        }
    }
    std::vector<RimEdge> rim;
    for (const Triangle& t : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            if (uses[key(t[k], t[(k + 1) % 3])] == 1) {
                rim.push_back({t[k], t[(k + 1) % 3]});
            }
        }
    }
    return rim;
}

void compact(TriMesh& mesh) {
    constexpr std::uint32_t unused = ~std::uint32_t{0};
    std::vector<std::uint32_t> place(mesh.points.size(), unused);
    for (const Triangle& t : mesh.triangles) {
        for (const std::uint32_t v : t) {
            place[v] = 0;
        }
    }
    std::uint32_t count = 0;
    for (std::size_t v = 0; v < place.size(); ++v) {
        if (place[v] != unused) {
            mesh.points[count] = mesh.points[v];
            place[v] = count++;
        }
    }
    mesh.points.resize(count);
    for (Triangle& t : mesh.triangles) {
        for (std::uint32_t& v : t) {
            v = place[v];
        }
    }
}

void append(TriMesh& mesh, const TriMesh& more) {
    const auto offset = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.insert(mesh.points.end(), more.points.begin(), more.points.end());
    for (const Triangle& t : more.triangles) {
        mesh.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
    }
}

double covering_radius(const TriangleCorners& t) {
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 u = t[(k + 1) % 3] - t[k];
        const Vec3 v = t[(k + 2) % 3] - t[k];
        if (dot(u, v) <= 0) {  // Obtuse: the bisectors of the two short edges meet the longest one apart.
            const double longest = distance(t[(k + 1) % 3], t[(k + 2) % 3]);
            const auto reach = [&](const Vec3& side) {  // half the side over the cosine of its angle at the long edge
                const double along = squared_length(side) - dot(u, v);
                return along > 0 ? 0.5 * squared_length(side) * longest / along : 0.5 * longest;
            };
            return std::min(0.5 * longest, std::max(reach(u), reach(v)));
        }
    }
    const Vec3 u = t[1] - t[0];
    const Vec3 v = t[2] - t[0];
    return 0.5 * length(u) * length(v) * length(u - v) / length(cross(u, v));
}

Vec3 centroid(const TriangleCorners& t) {
    return (t[0] + t[1] + t[2]) / 3;
}

double radius_about(const Vec3& center, const TriangleCorners& t) {
    return std::max({distance(center, t[0]), distance(center, t[1]), distance(center, t[2])});
}

std::array<TriangleCorners, 4> quartered(const TriangleCorners& t) {
    const Vec3 ab = 0.5 * (t[0] + t[1]);
    const Vec3 bc = 0.5 * (t[1] + t[2]);
    const Vec3 ca = 0.5 * (t[2] + t[0]);
    return {{{t[0], ab, ca}, {ab, t[1], bc}, {ca, bc, t[2]}, {ab, bc, ca}}};
}

}  // namespace terratet
