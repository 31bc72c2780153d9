// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/barrier/complex/margin.hpp"

#include <algorithm>
#include <map>
#include <numbers>

#include "tess/barrier/complex/clip_sheet.hpp"

namespace terratet {
namespace {

constexpr double shallowest = 0.17;  ///< sine of 10°: surfaces flatter against a face are not extended to it

/// One face of the extent: how far beyond it a point is, and the direction out.
struct Face {
    int axis = 0;
    double sign = 1;
    double at = 0;

    [[nodiscard]] double beyond(const Vec3& p) const { return sign * (p[axis] - at); }
    [[nodiscard]] Vec3 outward() const {
        Vec3 n;
        n[axis] = sign;
        return n;
    }
};

/// Part of the face's normal that is tangent to the surface; its length is the sine of the angle between them.
Vec3 heading(const Face& face, const Vec3& normal) {
    const Vec3 out = face.outward();
    return out - dot(out, normal) * normal;
}

/// The step from a rim point straight to the plane `reach` beyond the face.
Vec3 step_across(const Face& face, const Vec3& p, const Vec3& normal, double reach) {
    const Vec3 way = heading(face, normal);
    return (reach - face.beyond(p)) / squared_length(way) * way;
}

std::vector<RimEdge> edges_to_extend(const TriMesh& mesh, const std::vector<RimEdge>& rim,
                                     const std::vector<Vec3>& normals, const Face& face, double snap, double reach) {
    std::vector<RimEdge> chosen;
    const auto in_reach = [&](std::uint32_t v) {
        const double beyond = face.beyond(mesh.points[v]);
        return beyond >= -snap && beyond < reach * (1 - 1e-9) && length(heading(face, normals[v])) >= shallowest;
    };
    for (const RimEdge& e : rim) {
        if (!in_reach(e.from) || !in_reach(e.to)) {
            continue;
        }
        const Vec3& a = mesh.points[e.from];
        const Vec3& b = mesh.points[e.to];
        const Vec3 normal = unit(normals[e.from] + normals[e.to]);
        const Vec3 outward = unit(cross(b - a, normal));
        const Vec3 from_step = step_across(face, a, normals[e.from], reach);
        const Vec3 to_step = step_across(face, b, normals[e.to], reach);
        const bool leads_out = dot(outward, unit(from_step)) > 0.05 && dot(outward, unit(to_step)) > 0.05;
        const bool folds = dot(area_vector({b, a, a + from_step}), normal) <= 0 ||
                           dot(area_vector({b, a + from_step, b + to_step}), normal) <= 0;
        if (leads_out && !folds) {
            chosen.push_back(e);
        }
    }
    return chosen;
}

void extend_across(TriMesh& mesh, const Face& face, double snap, double reach, double spacing) {
    const std::vector<RimEdge> rim = rim_edges(mesh);
    const std::vector<Vec3> normals = rim_normals(mesh, rim);
    const std::vector<RimEdge> chosen = edges_to_extend(mesh, rim, normals, face, snap, reach);
    double longest = 0;
    for (const RimEdge& e : chosen) {
        for (const std::uint32_t v : {e.from, e.to}) {
            longest = std::max(longest, length(step_across(face, mesh.points[v], normals[v], reach)));
        }
    }
    const auto rows = static_cast<std::uint32_t>(std::ceil(longest / spacing * (1 - 1e-9)));
    std::map<std::uint32_t, std::uint32_t> first_of;  // rim point to the first of its row points
    const auto row_point = [&](std::uint32_t v, std::uint32_t row) {
        const auto [entry, fresh] = first_of.try_emplace(v, static_cast<std::uint32_t>(mesh.points.size()));
        if (fresh) {
            const Vec3 start = mesh.points[v];
            const Vec3 step = step_across(face, start, normals[v], reach);
            for (std::uint32_t k = 1; k <= rows; ++k) {
                mesh.points.push_back(start + (static_cast<double>(k) / rows) * step);
            }
            mesh.points.back()[face.axis] = face.at + face.sign * reach;
        }
        return row == 0 ? v : entry->second + row - 1;
    };
    for (const RimEdge& e : chosen) {
        for (std::uint32_t row = 0; row < rows; ++row) {
            const std::uint32_t a = row_point(e.from, row);
            const std::uint32_t b = row_point(e.to, row);
            const std::uint32_t beyond_a = row_point(e.from, row + 1);
            const std::uint32_t beyond_b = row_point(e.to, row + 1);
            mesh.triangles.push_back({b, a, beyond_a});
            mesh.triangles.push_back({b, beyond_a, beyond_b});
        }
    }
}

bool on_boundary(const Vec3& a, const Vec3& b, const Box3& box) {
    for (int axis = 0; axis < 3; ++axis) {
        for (const double at : {box.lo[axis], box.hi[axis]}) {
            const double tolerance = 1e-9 * (std::abs(at) + box.size()[axis]);
            if (std::abs(a[axis] - at) <= tolerance && std::abs(b[axis] - at) <= tolerance) {
                return true;
            }
        }
    }
    return false;
}

bool near(const Vec3& a, const Vec3& b, const Box3& box, double width) {
    const Box3 grown = box.grown(width);
    for (int axis = 0; axis < 3; ++axis) {
        if (std::max(a[axis], b[axis]) < grown.lo[axis] || std::min(a[axis], b[axis]) > grown.hi[axis]) {
            return false;
        }
    }
    return true;
}

Vec3 rotated(const Vec3& v, const Vec3& axis, double angle) {  // Rodrigues
    return std::cos(angle) * v + std::sin(angle) * cross(axis, v) + (1 - std::cos(angle)) * dot(axis, v) * axis;
}

/// A fan about `center` from direction `first`, turning by `angle` about `normal`; circumscribed, so that it holds the
/// whole sector of the given width.
void add_fan(TriMesh& mesh, const Vec3& center, const Vec3& first, const Vec3& normal, double angle, double width) {
    const int steps = std::max(1, static_cast<int>(std::ceil(angle / (std::numbers::pi / 6))));
    const double reach = width / std::cos(0.5 * angle / steps);
    const auto hub = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.push_back(center);
    for (int k = 0; k <= steps; ++k) {
        mesh.points.push_back(center + reach * rotated(first, normal, angle * k / steps));
        if (k > 0) {
            const auto last = static_cast<std::uint32_t>(mesh.points.size() - 1);
            mesh.triangles.push_back({hub, last - 1, last});
        }
    }
}

}  // namespace

std::vector<Vec3> rim_normals(const TriMesh& mesh, const std::vector<RimEdge>& rim) {
    std::vector<Vec3> normals = vertex_normals(mesh);
    for (int round = 0; round < 3; ++round) {
        std::vector<Vec3> sum = normals;
        for (const RimEdge& e : rim) {
            sum[e.from] = sum[e.from] + 0.5 * normals[e.to];
            sum[e.to] = sum[e.to] + 0.5 * normals[e.from];
        }
        for (std::size_t v = 0; v < sum.size(); ++v) {
            normals[v] = unit(sum[v]);
        }
    }
    return normals;
}

TriMesh extended_across(const TriMesh& part, const Box3& extent, double snap, double reach, double spacing) {
    const Box3 limit = extent.grown(reach);
    TriMesh mesh = cut_to_box(part, limit).inside;
    for (int axis = 0; axis < 3; ++axis) {
        for (const Face& face : {Face{axis, -1, extent.lo[axis]}, Face{axis, 1, extent.hi[axis]}}) {
            extend_across(mesh, face, snap, reach, spacing);
        }
    }
    return cut_to_box(std::move(mesh), limit).inside;
}

TriMesh skirt(const TriMesh& part, const std::vector<RimEdge>& rim, double width, const Box3& extent,
              const Box3& limit) {
    const std::vector<Vec3> normals = vertex_normals(part);
    TriMesh strips;
    std::map<std::uint32_t, std::vector<Vec3>> arriving;  // outward directions of rim edges, by the point they end in
    std::map<std::uint32_t, std::vector<Vec3>> leaving;
    for (const RimEdge& e : rim) {
        const Vec3& a = part.points[e.from];
        const Vec3& b = part.points[e.to];
        const Vec3 outward = unit(cross(b - a, unit(normals[e.from] + normals[e.to])));
        if (outward == Vec3{} || on_boundary(a, b, limit) || !near(a, b, extent, width)) {
            continue;
        }
        arriving[e.to].push_back(outward);
        leaving[e.from].push_back(outward);
        const auto first = static_cast<std::uint32_t>(strips.points.size());
        strips.points.insert(strips.points.end(), {a, b, a + width * outward, b + width * outward});
        strips.triangles.push_back({first + 1, first, first + 2});
        strips.triangles.push_back({first + 1, first + 2, first + 3});
    }
    for (const auto& [v, in] : arriving) {
        const auto out = leaving.find(v);
        if (out == leaving.end()) {
            continue;  // the rim goes on where the surface was cut
        }
        const Vec3& normal = normals[v];
        const Vec3 first = unit(in.front() - dot(in.front(), normal) * normal);
        if (in.size() > 1 || out->second.size() > 1) {  // several fans meet here: all round
            add_fan(strips, part.points[v], first, normal, 2 * std::numbers::pi, width);
            continue;
        }
        const Vec3 last = unit(out->second.front() - dot(out->second.front(), normal) * normal);
        const double angle = std::atan2(dot(cross(first, last), normal), dot(first, last));
        if (angle > 1e-9) {
            add_fan(strips, part.points[v], first, normal, angle, width);
        }
    }
    return cut_to_box(std::move(strips), limit).inside;
}

}  // namespace terratet
