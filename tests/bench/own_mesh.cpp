// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "own_mesh.hpp"

#include <cmath>

#include "tess/barrier_query.hpp"
#include "tess/property.hpp"
#include "tess/value_source.hpp"
#include "timing.hpp"

namespace terratet::bench {

double edge_of_volume(double volume) {
    return std::cbrt(volume * 6 * std::sqrt(2.0));
}

Criteria volume_criteria(double volume, double aspect) {
    Criteria criteria;
    criteria.v_max = volume;
    criteria.aspect = aspect;
    criteria.l_max = 4 * edge_of_volume(volume);
    criteria.l_min = edge_of_volume(volume) / 8;
    return criteria;
}

OwnMesh refined(const PointsInBox& task, const Criteria& criteria, double face_length, const RefineOptions& options) {
    const std::vector<Barrier> no_faults;
    const BarrierQuery proximity(no_faults);
    const Frame frame;
    const std::vector<Property> properties = {{"f", "", Scale::linear, Kind::continuous, {}}};
    const ValueSource constant = [](std::span<const ValueQuery> queries) {
        return ValueBatch{{std::vector<double>(queries.size(), 1)}, std::vector<double>(queries.size(), 0)};
    };
    OwnMesh mesh;
    const double start = cpu_s();
    {
        std::vector<Vertex> vertices;
        for (const Vec3& p : task.points) {
            vertices.push_back({vertices.size(), p, Role::sample, static_cast<std::int32_t>(vertices.size()), 0});
        }
        for (const Vec3& p : face_grid(task.box, criteria.l_min, face_length, task.points, frame)) {
            vertices.push_back({vertices.size(), p, Role::domain, -1, 0});
        }
        mesh.tessellation.insert(vertices);
        mesh.values = {{std::vector<double>(vertices.size(), 1)}, std::vector<double>(vertices.size(), 0)};
    }
    const double refining = cpu_s();
    mesh.report = refine(mesh.tessellation, mesh.values, {task.box, task.box}, frame, proximity, criteria, properties,
                         constant, options);
    const double end = cpu_s();
    mesh.seconds = end - start;
    mesh.refine_seconds = end - refining;
    return mesh;
}

MeshResult measured(const OwnMesh& own) {
    const TetMesh mesh = own.tessellation.mesh();
    return measured(own.seconds, mesh.points.size(), mesh.cells.size(), [&](std::size_t c) {
        const auto& v = mesh.cells[c];
        return CellPoints{mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]], mesh.points[v[3]]};
    });
}

}  // namespace terratet::bench
