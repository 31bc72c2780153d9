// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "tess/cut_cells.hpp"
#include "tess/error.hpp"
#include "tools/run/query.hpp"

namespace terratet::tools {
namespace {

/// A corner of a section's polygon with its values, in each property's scale.
struct Corner {
    Vec3 place;
    std::vector<double> values;
};

/// What lies on the side of the plane that its normal points from is cut off (Sutherland and Hodgman).
std::vector<Corner> clipped(const std::vector<Corner>& polygon, const CutPlane& plane) {
    std::vector<Corner> result;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Corner& a = polygon[i];
        const Corner& b = polygon[(i + 1) % polygon.size()];
        const double da = plane.distance(a.place);
        const double db = plane.distance(b.place);
        if (da >= 0) {
            result.push_back(a);
        }
        if ((da < 0) != (db < 0)) {
            const double t = da / (da - db);
            Corner between{a.place + t * (b.place - a.place), a.values};
            for (std::size_t k = 0; k < between.values.size(); ++k) {
                between.values[k] += t * (b.values[k] - a.values[k]);
            }
            result.push_back(std::move(between));
        }
    }
    return result;
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
        std::vector<std::vector<double>> values;
        for (std::size_t p = 0; p < model_.properties.size(); ++p) {
            values.push_back(cut.values(model_.properties[p], model_.vertex_values.values[p]));
        }
        std::vector<CutPlane> ends = part.ends;
        const Box3& extent = model_.domain.extent;
        for (int axis = 0; axis < 3; ++axis) {
            Vec3 normal;
            normal[axis] = 1;
            ends.push_back({normal, extent.lo[axis]});
            ends.push_back({-normal, -extent.hi[axis]});
        }
        for (std::size_t t = 0; t < cut.triangles.size(); ++t) {
            std::vector<Corner> polygon;
            for (const std::uint32_t corner : cut.triangles[t]) {
                polygon.push_back({places[corner], {}});
                for (std::size_t p = 0; p < values.size(); ++p) {
                    polygon.back().values.push_back(to_scale(model_.properties[p], values[p][corner]));
                }
            }
            for (const CutPlane& end : ends) {
                polygon = clipped(polygon, end);
            }
            if (polygon.size() >= 3) {
                write(polygon, part, cut.cell[t]);
            }
        }
        sink_.add(rows_);
        rows_.clear();
    }

  private:
    /// On the way to a file one row a polygon, with the mean of its corners; as text a row a corner.
    void write(const std::vector<Corner>& polygon, const Part& part, std::uint32_t cell) {
        ++polygons_;
        const std::int32_t region = opened_.cells().region[cell];
        const RowCell name =
            region < 0 ? RowCell() : RowCell(opened_.cells().region_name[static_cast<std::size_t>(region)]);
        Corner mean{{}, std::vector<double>(model_.properties.size(), 0)};
        std::vector<Vec3> outline;
        for (const Corner& corner : polygon) {
            outline.push_back(model_.frame.to_world(corner.place));
            mean.place = mean.place + corner.place / static_cast<double>(polygon.size());
            for (std::size_t p = 0; p < mean.values.size(); ++p) {
                mean.values[p] += corner.values[p] / static_cast<double>(polygon.size());
            }
        }
        rows_.push_back(row_of(mean, part, name));
        Row& row = rows_.back();
        row.in_plan = part.in_plan;
        for (std::size_t i = 0; i < outline.size(); ++i) {
            const auto& [x, y, z] = outline[i];
            row.flat.push_back(
                {part.in_plan ? x : distance_of(polygon[i], part), part.in_plan ? y : z, polygon[i].values});
        }
        row.outline = std::move(outline);
    }

    [[nodiscard]] double distance_of(const Corner& corner, const Part& part) const {
        return part.before + dot(model_.frame.to_world_size(corner.place - part.start), part.direction);
    }

    [[nodiscard]] Row row_of(const Corner& corner, const Part& part, const RowCell& region) const {
        const Vec3 world = model_.frame.to_world(corner.place);
        Row row{{polygons_, distance_of(corner, part), world.x, world.y, world.z}, {}};
        for (std::size_t p = 0; p < corner.values.size(); ++p) {
            const Property& property = model_.properties[p];
            row.cells.push_back(property.kind == Kind::categorical
                                    ? value_cell(property, std::round(corner.values[p]))
                                    : value_cell(property, from_scale(property, corner.values[p])));
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
    const auto n = parse_numbers("--plane", text, 6, 6);
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
