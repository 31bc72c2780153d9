// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/model/model_rows.hpp"

#include <cassert>
#include <cmath>

#include "io/model/storable.hpp"
#include "tess/error.hpp"

namespace terratet {

RowNumbers numbers_of_new(const Model& model) {
    RowNumbers numbers;
    const auto count = [](std::vector<std::int64_t>& rows, std::size_t size, std::int64_t first, std::int64_t step) {
        for (std::size_t i = 0; i < size; ++i) {
            rows.push_back(first + static_cast<std::int64_t>(i) * step);
        }
    };
    count(numbers.boreholes, model.boreholes.size(), 1, 1);
    count(numbers.samples, model.samples.size(), 1, 1);
    count(numbers.surfaces, model.surfaces.size(), 1, 1);
    count(numbers.sheets, model.barriers.size(), static_cast<std::int64_t>(model.surfaces.size()) + 1, 2);
    count(numbers.vertices, model.vertices.size(), 1, 1);
    return numbers;
}

ModelRows::ModelRows(const Model& model, const RowNumbers& numbers)
    : model_(model),
      numbers_(numbers),
      columns_(schema::property_columns(model.properties)),
      censored_columns_(schema::censored_columns(columns_, model.samples)) {}

ModelRows::ModelRows(const Model& model)
    : model_(model),
      own_(numbers_of_new(model)),
      numbers_(own_),
      columns_(schema::property_columns(model.properties)),
      censored_columns_(schema::censored_columns(columns_, model.samples)) {}

schema::SampleColumns ModelRows::sample_columns(RowWriter& layer) const {
    return {layer, model_.properties, columns_, censored_columns_};
}

schema::VertexColumns ModelRows::vertex_columns(RowWriter& layer) const {
    return {layer, model_.properties, columns_};
}

Vec3 ModelRows::world(const Vec3& local) const {
    assert(model_.frame.snapped(local) == local && "not snapped to the frame: it would not reload exactly");
    return model_.frame.to_world(local);
}

void ModelRows::set_values(RowWriter& layer, const std::vector<Column>& columns,
                           const std::vector<std::vector<double>>& values, std::size_t row) const {
    for (std::size_t p = 0; p < columns.size(); ++p) {
        const Property& property = model_.properties[p];
        const double value = values[p][row];
        if (property.kind == Kind::continuous) {
            layer.set(columns[p], value);
        } else if (!std::isnan(value)) {
            assert(value >= 0 && value < static_cast<double>(property.classes.size()));
            layer.set(columns[p], property.classes[static_cast<std::size_t>(value)]);
        }
    }
}

/// From the collar to the end.
void ModelRows::set_direction(RowWriter& layer, const schema::BoreholeColumns& columns, const Borehole& hole) const {
    if (hole.path.empty()) {
        return;
    }
    constexpr double degrees = 57.29577951308232;
    const Vec3 way = world(hole.path.back()) - world(hole.path.front());
    const double across = std::hypot(way.x, way.y);
    layer.set(columns.length, hole.path_depth.back() - hole.path_depth.front());
    if (across > 0) {
        const double azimuth = std::atan2(way.x, way.y) * degrees;
        layer.set(columns.azimuth, azimuth < 0 ? azimuth + 360 : azimuth);
    }
    if (across > 0 || way.z != 0) {
        layer.set(columns.dip, std::atan2(-way.z, across) * degrees);
    }
}

void ModelRows::borehole(RowWriter& layer, const schema::BoreholeColumns& columns, std::size_t i) const {
    const Borehole& borehole = model_.boreholes[i];
    const Vec3 collar = world(borehole.collar);
    layer.set(columns.id, borehole.id);
    layer.set(columns.collar_x, collar.x);
    layer.set(columns.collar_y, collar.y);
    layer.set(columns.collar_z, collar.z);
    set_direction(layer, columns, borehole);
    auto line = std::make_unique<OGRLineString>();
    line->set3D(true);
    line->setMeasured(true);
    for (std::size_t k = 0; k < borehole.path.size(); ++k) {
        const Vec3 p = world(borehole.path[k]);
        line->addPoint(p.x, p.y, p.z, borehole.path_depth[k]);
    }
    layer.set_geometry(std::move(line));
    layer.write();
}

void ModelRows::sample(RowWriter& layer, const schema::SampleColumns& columns, std::size_t i) const {
    const Samples& samples = model_.samples;
    if (samples.borehole[i] >= 0) {
        const auto hole = static_cast<std::size_t>(samples.borehole[i]);
        layer.set(columns.borehole, model_.boreholes[hole].id);
        layer.set(columns.hole, numbers_.boreholes[hole]);
    }
    layer.set(columns.depth, samples.depth[i]);
    layer.set(columns.length, samples.length[i]);
    set_values(layer, columns.values, samples.values, i);
    for (std::size_t p = 0; p < columns.censored.size(); ++p) {
        if (const Censoring censoring = samples.censoring(p, i); censoring != Censoring::none) {
            layer.set(*columns.censored[p], std::string(to_string(censoring)));
        }
    }
    layer.set_point(world(samples.positions[i]));
    layer.write();
}

/// The geometry is for people and their programs; the arrays beside it hold which corners are one vertex, which no set
/// of polygons tells (dirty surfaces have distinct vertices at one place), and vertices that no triangle uses.
void ModelRows::set_mesh(RowWriter& layer, const schema::SurfaceColumns& columns, const Surface& surface) const {
    std::vector<Vec3> corners;
    corners.reserve(surface.vertices.size());
    for (const Vec3& p : surface.vertices) {
        corners.push_back(world(p));
    }
    auto geometry = std::make_unique<OGRMultiPolygon>();
    geometry->set3D(true);
    for (const Triangle& t : surface.triangles) {
        auto ring = std::make_unique<OGRLinearRing>();
        for (const std::uint32_t corner : {t[0], t[1], t[2], t[0]}) {
            ring->addPoint(corners[corner].x, corners[corner].y, corners[corner].z);
        }
        auto polygon = std::make_unique<OGRPolygon>();
        polygon->addRingDirectly(ring.release());
        geometry->addGeometryDirectly(polygon.release());
    }
    layer.set_geometry(std::move(geometry));
    layer.set(columns.mesh_vertices, std::as_bytes(std::span(corners)));
    layer.set(columns.mesh_triangles, std::as_bytes(std::span(surface.triangles)));

    const SurfaceStatistics description = statistics(surface);
    layer.set(columns.name, surface.name);
    layer.set(columns.file, surface.file);
    layer.set(columns.area, description.area);
    layer.set(columns.dip, description.dip_mean_deg);
    layer.set(columns.dip_direction, description.dip_direction_deg);
    layer.set(columns.dip_min, description.dip_min_deg);
    layer.set(columns.dip_max, description.dip_max_deg);
}

/// What a reader would find of a fault's seeds in the vertices.
std::vector<Seed> ModelRows::seeds_among_vertices(std::size_t fault) const {
    std::vector<Seed> seeds;
    for (const Vertex& vertex : model_.vertices) {
        if (vertex.role == Role::seed && vertex.owner == static_cast<std::int32_t>(fault)) {
            seeds.push_back({vertex.position, vertex.side});
        }
    }
    return seeds;
}

void ModelRows::surface(RowWriter& layer, const schema::SurfaceColumns& columns, std::size_t i) const {
    set_mesh(layer, columns, model_.surfaces[i]);
    layer.set(columns.kind, std::string(to_string(model_.surfaces[i].kind)));
    layer.write();
}

void ModelRows::barrier_part(RowWriter& layer, const schema::SurfaceColumns& columns, std::size_t i,
                             bool margin) const {
    const Barrier& fault = model_.barriers[i];
    set_mesh(layer, columns, margin ? fault.margin : fault.sheet);
    layer.set(columns.kind, to_string(fault.sheet.kind) + std::string(margin ? "_margin" : "_sheet"));
    layer.set(columns.fault, fault.name);
    layer.set(columns.spacing, fault.spacing);
    layer.set(columns.width, fault.width);
    layer.set(columns.covering_radius, fault.covering_radius);
    layer.set(columns.protection_radius, fault.protection_radius);
    if (!margin) {
        layer.set(columns.seed_count, static_cast<std::int64_t>(fault.seeds.size()));
        if (seeds_among_vertices(i) != fault.seeds) {
            std::vector<double> packed;
            for (const Seed& seed : fault.seeds) {
                const Vec3 p = world(seed.position);
                packed.insert(packed.end(), {p.x, p.y, p.z, static_cast<double>(seed.side)});
            }
            layer.set(columns.seeds, std::as_bytes(std::span(packed)));
        }
    }
    layer.write();
}

void ModelRows::vertex(RowWriter& layer, const schema::VertexColumns& columns, std::size_t i) const {
    static const std::string roles[] = {"sample", "seed", "domain", "inserted"};
    const Vertex& vertex = model_.vertices[i];
    layer.set(columns.id, static_cast<std::int64_t>(vertex.id));
    layer.set(columns.role, roles[static_cast<std::size_t>(vertex.role)]);
    if (vertex.role == Role::sample || vertex.role == Role::seed) {
        const auto owner = static_cast<std::size_t>(vertex.owner);
        layer.set(columns.owner, vertex.role == Role::sample ? numbers_.samples[owner] : numbers_.sheets[owner]);
    }
    layer.set(columns.side, std::int64_t{vertex.side});
    layer.set(columns.extrapolation, model_.vertex_values.extrapolation[i]);
    set_values(layer, columns.values, model_.vertex_values.values, i);
    layer.set_point(world(vertex.position));
    layer.write();
}

void require_storable(const std::string& text, const std::string& what) {
    if (!is_storable(text)) {
        throw Error("the model cannot be stored: " + what + " is not valid UTF-8, or holds a NUL");
    }
}

void require_storable(const Model& model) {
    for (const std::string* text : {&model.frame.crs_wkt, &model.frame.crs_name, &model.frame.unit}) {
        require_storable(*text, "the coordinate system's text");
    }
    for (const Property& property : model.properties) {
        require_storable(property.name, "a property's name");
        require_storable(property.unit, "the unit of " + property.name);
        for (const std::string& name : property.classes) {
            require_storable(name, "a class of " + property.name);
        }
    }
    for (const Borehole& borehole : model.boreholes) {
        require_storable(borehole.id, "a borehole's id");
    }
    const auto require_surface = [](const Surface& surface) {
        require_storable(surface.name, "a surface's name");
        require_storable(surface.file, "the file name of surface " + surface.name);
    };
    for (const Surface& surface : model.surfaces) {
        require_surface(surface);
    }
    for (const Barrier& fault : model.barriers) {
        require_storable(fault.name, "a fault's name");
        require_surface(fault.sheet);
        require_surface(fault.margin);
    }
    require_storable(model.estimator, "the estimator's specification");
}

}  // namespace terratet
