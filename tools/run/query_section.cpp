// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>

#include "tess/cut_cells.hpp"
#include "tess/error.hpp"
#include "tools/options/values.hpp"
#include "tools/run/query.hpp"

namespace terratet::tools {
namespace {

/// A corner of a section's polygon, with the weights of its cell's four vertices there.
struct Corner {
    Vec3 place;
    std::array<double, 4> weights{};
};

using Polygon = std::vector<Corner>;

/// What lies where a distance, linear in space, is negative is cut off (Sutherland and Hodgman).
template <class Distance>
Polygon clipped(const Polygon& polygon, Distance&& distance) {
    Polygon result;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Corner& a = polygon[i];
        const Corner& b = polygon[(i + 1) % polygon.size()];
        const double da = distance(a);
        const double db = distance(b);
        if (da >= 0) {
            result.push_back(a);
        }
        if ((da < 0) != (db < 0)) {
            const double t = da / (da - db);
            Corner between{a.place + t * (b.place - a.place), a.weights};
            for (std::size_t k = 0; k < 4; ++k) {
                between.weights[k] += t * (b.weights[k] - a.weights[k]);
            }
            result.push_back(between);
        }
    }
    return result;
}

/// The part in which a vertex has the largest weight, as voxels and pictures give a place its class.
Polygon nearest_to(const Polygon& polygon, std::size_t vertex) {
    Polygon part = polygon;
    for (std::size_t other = 0; other < 4; ++other) {
        if (other != vertex) {
            part = clipped(part, [&](const Corner& c) { return c.weights[vertex] - c.weights[other]; });
        }
    }
    return part;
}

/// One plane of the section and where it ends besides the extent.
struct Part {
    CutPlane plane;
    std::vector<CutPlane> ends;
    Vec3 start;            ///< distances along count from here
    Vec3 direction;        ///< of distances, a unit vector
    double before = 0;     ///< distance of its start
    bool in_plan = false;  ///< a horizontal plane
};

class Section {
  public:
    Section(const ModelSnapshot& opened, RowSink& sink) : opened_(opened), model_(opened.model()), sink_(sink) {
        const CellTable& table = opened.cells();
        left_out_.assign(table.region.size(), 0);
        for (std::size_t c = 0; c < left_out_.size(); ++c) {
            left_out_[c] = table.barrier[c] >= 0 || table.beyond[c] != 0 ? 1 : 0;
        }
        columns_ = {{"polygon", RowColumn::Type::integer}, {"distance"}, {"x"}, {"y"}, {"z"}};
        add_property_columns(model_, columns_);
        add_column(columns_, "region", RowColumn::Type::text);
        sink.begin(columns_);
    }

    void add(const Part& part) {
        const TetMesh& mesh = opened_.mesh();
        const CellCut cut = cut_cells(mesh.points, mesh.cells, part.plane, left_out_);
        const std::vector<Vec3> places = cut.positions(mesh.points);
        std::vector<CutPlane> ends = part.ends;
        const Box3& extent = model_.domain.extent;
        for (int axis = 0; axis < 3; ++axis) {
            Vec3 normal;
            normal[axis] = 1;
            ends.push_back({normal, extent.lo[axis]});
            ends.push_back({-normal, -extent.hi[axis]});
        }
        for (std::size_t t = 0; t < cut.triangles.size(); ++t) {
            const CellCorners& vertices = mesh.cells[cut.cell[t]];
            Polygon polygon;
            for (const std::uint32_t corner : cut.triangles[t]) {
                polygon.push_back({places[corner], weights_in(vertices, cut.corners[corner])});
            }
            for (const CutPlane& end : ends) {
                polygon = clipped(polygon, [&](const Corner& c) { return end.distance(c.place); });
            }
            if (has_one_class(vertices)) {
                write(polygon, part, cut.cell[t], vertices[0]);
                continue;
            }
            for (std::size_t k = 0; k < 4; ++k) {
                write(nearest_to(polygon, k), part, cut.cell[t], vertices[k]);
            }
        }
        sink_.add(rows_);
        rows_.clear();
    }

  private:
    static std::array<double, 4> weights_in(const CellCorners& vertices, const CellCut::Corner& corner) {
        std::array<double, 4> weights{};
        for (std::size_t k = 0; k < 4; ++k) {
            weights[k] += vertices[k] == corner.a ? 1 - corner.t : 0;
            weights[k] += vertices[k] == corner.b ? corner.t : 0;
        }
        return weights;
    }

    /// Of each category; so that the cell need not be parted by its vertices.
    [[nodiscard]] bool has_one_class(const CellCorners& vertices) const {
        for (std::size_t p = 0; p < model_.properties.size(); ++p) {
            const std::vector<double>& values = model_.vertex_values.values[p];
            const bool mixed = std::ranges::any_of(vertices, [&](std::uint32_t v) {
                return std::isnan(values[v]) != std::isnan(values[vertices[0]]) || values[v] < values[vertices[0]] ||
                       values[v] > values[vertices[0]];
            });
            if (model_.properties[p].kind == Kind::categorical && mixed) {
                return false;
            }
        }
        return true;
    }

    /// In each property's scale: linear in the cell; of a category the owner's.
    [[nodiscard]] std::vector<double> values_at(const Corner& corner, const CellCorners& vertices,
                                                std::uint32_t owner) const {
        std::vector<double> result;
        for (std::size_t p = 0; p < model_.properties.size(); ++p) {
            const Property& property = model_.properties[p];
            const std::vector<double>& values = model_.vertex_values.values[p];
            double value = property.kind == Kind::categorical ? values[owner] : 0;
            for (std::size_t k = 0; k < 4 && property.kind != Kind::categorical; ++k) {
                value += corner.weights[k] == 0 ? 0 : corner.weights[k] * to_scale(property, values[vertices[k]]);
            }
            result.push_back(value);
        }
        return result;
    }

    /// A row a polygon: its middle, and the mean of its corners.
    void write(const Polygon& polygon, const Part& part, std::uint32_t cell, std::uint32_t owner) {
        if (polygon.size() < 3) {
            return;
        }
        ++polygons_;
        const std::int32_t region = opened_.cells().region[cell];
        const RowCell name =
            region < 0 ? RowCell() : RowCell(opened_.cells().region_name[static_cast<std::size_t>(region)]);
        const CellCorners& vertices = opened_.mesh().cells[cell];
        const double share = 1 / static_cast<double>(polygon.size());
        Corner middle;
        for (const Corner& corner : polygon) {
            middle.place = middle.place + share * corner.place;
            for (std::size_t k = 0; k < 4; ++k) {
                middle.weights[k] += share * corner.weights[k];
            }
        }
        rows_.push_back(row_of(middle, values_at(middle, vertices, owner), part, name));
        Row& row = rows_.back();
        row.in_plan = part.in_plan;
        for (const Corner& corner : polygon) {
            const Vec3 world = model_.frame.to_world(corner.place);
            row.outline.push_back(world);
            row.flat.push_back({part.in_plan ? world.x : distance_of(corner, part), part.in_plan ? world.y : world.z,
                                values_at(corner, vertices, owner)});
        }
    }

    [[nodiscard]] double distance_of(const Corner& corner, const Part& part) const {
        return part.before + dot(model_.frame.to_world_size(corner.place - part.start), part.direction);
    }

    [[nodiscard]] Row row_of(const Corner& corner, const std::vector<double>& values, const Part& part,
                             const RowCell& region) const {
        const Vec3 world = model_.frame.to_world(corner.place);
        Row row{{polygons_, distance_of(corner, part), world.x, world.y, world.z}, {}};
        for (std::size_t p = 0; p < values.size(); ++p) {
            const Property& property = model_.properties[p];
            row.cells.push_back(
                value_cell(property, property.kind == Kind::categorical ? values[p] : from_scale(property, values[p])));
        }
        row.cells.push_back(region);
        return row;
    }

    const ModelSnapshot& opened_;
    const Model& model_;
    RowSink& sink_;
    std::vector<std::uint8_t> left_out_;
    std::vector<RowColumn> columns_;
    std::vector<Row> rows_;
    std::int64_t polygons_ = 0;
};

Part plane_asked(const std::string& text, const Frame& frame) {
    const auto n = option_numbers("--plane", text, 6, 6);
    // The normal of a plane in stretched space: planes z = a x + b y + c become z/k = a x + b y + c.
    const Vec3 normal{n[3], n[4], n[5] / frame.z_scale};
    if (!(length(normal) > 0)) {
        throw UsageError("--plane: the normal has no length");
    }
    const Vec3 point = frame.to_local({n[0], n[1], n[2]});
    const Vec3 up{0, 0, 1};
    Vec3 along = cross(up, normal);
    const bool in_plan = !(length(along) > 0);
    along = in_plan ? Vec3{1, 0, 0} : along / length(along);
    return {CutPlane::through(point, normal / length(normal)), {}, point, along, 0, in_plan};
}

std::vector<Part> curtain(const std::vector<Vec3>& line) {
    std::vector<Part> parts;
    double before = 0;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        Vec3 way = line[i + 1] - line[i];
        way.z = 0;
        const double width = length(way);
        if (!(width > 0)) {
            continue;
        }
        const Vec3 direction = way / width;
        const Vec3 normal{-direction.y, direction.x, 0};
        parts.push_back({CutPlane::through(line[i], normal),
                         {CutPlane::through(line[i], direction), CutPlane::through(line[i + 1], -direction)},
                         line[i],
                         direction,
                         before,
                         false});
        before += width;
    }
    return parts;
}

}  // namespace

void query_section(const ModelSnapshot& opened, const QueryArguments& a, RowSink& sink, QueryRemarks& remarks) {
    std::vector<Part> parts;
    if (!a.plane.empty()) {
        parts.push_back(plane_asked(a.plane, opened.model().frame));
    } else {
        PointTable points = query_points(opened, a, remarks.diagnostics);
        std::erase_if(points.positions, [](const Vec3& p) { return !is_finite(p); });
        parts = curtain(points.positions);
        if (parts.empty()) {
            throw UsageError("query section: give two places or more that differ in plan, or --plane");
        }
    }
    Section section(opened, sink);
    for (const Part& part : parts) {
        section.add(part);
    }
}

}  // namespace terratet::tools
