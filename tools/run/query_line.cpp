// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "interp/estimator_spec.hpp"
#include "interp/plan/estimator_choice.hpp"
#include "tess/barrier/query/model_bounds.hpp"
#include "tess/base/tri_mesh.hpp"
#include "tess/error.hpp"
#include "tess/model/regions.hpp"
#include "tools/options/site_options.hpp"
#include "tools/run/query.hpp"

namespace terratet::tools {
namespace {

/// A place on the line.
struct Stop {
    double distance = 0;  ///< along it, true
    Vec3 place;           ///< local
    std::string fault;    ///< crossed here
};

/// Where the segment from a to b meets the triangle, as a fraction of it (Möller and Trumbore, 1997).
std::optional<double> crossing(const Vec3& a, const Vec3& b, const Vec3& p, const Vec3& q, const Vec3& r) {
    const Vec3 way = b - a;
    const Vec3 across = cross(way, r - p);
    const double det = dot(q - p, across);
    if (det == 0) {
        return std::nullopt;
    }
    const Vec3 from = a - p;
    const double u = dot(from, across) / det;
    const Vec3 turned = cross(from, q - p);
    const double v = dot(way, turned) / det;
    const double t = dot(r - p, turned) / det;
    return u >= 0 && v >= 0 && u + v <= 1 && t >= 0 && t <= 1 ? std::optional(t) : std::nullopt;
}

/// Fractions of a segment at which a sheet is crossed; at an edge of two triangles once.
std::vector<double> crossings(const Surface& sheet, const Vec3& a, const Vec3& b) {
    std::vector<double> found;
    for (const Triangle& t : sheet.triangles) {
        const auto& v = sheet.vertices;
        const std::array<Vec3, 3> corners{v[t[0]], v[t[1]], v[t[2]]};
        if (bounding_box(corners).meets_box_of(a, b)) {
            if (const auto at = crossing(a, b, corners[0], corners[1], corners[2])) {
                found.push_back(*at);
            }
        }
    }
    std::ranges::sort(found);
    const auto near = [](double x, double y) { return y - x < 1e-9; };
    found.erase(std::unique(found.begin(), found.end(), near), found.end());
    return found;
}

class Line {
  public:
    Line(const Model& model, std::vector<Vec3> corners, double step) : model_(model), corners_(std::move(corners)) {
        double along = 0;
        for (std::size_t i = 0; i + 1 < corners_.size(); ++i) {
            add_segment(corners_[i], corners_[i + 1], along, step);
        }
        stops_.push_back({along, corners_.back(), ""});
        std::ranges::stable_sort(stops_, {}, &Stop::distance);
    }

    [[nodiscard]] const std::vector<Stop>& stops() const { return stops_; }

  private:
    void add_segment(const Vec3& a, const Vec3& b, double& along, double step) {
        const double length = distance(model_.frame.to_world_size(a), model_.frame.to_world_size(b));
        if (length == 0) {
            return;
        }
        const double parts = std::max(1.0, std::ceil(length / step * (1 - 1e-12)));
        if (parts > 1e7) {
            throw UsageError("query line: --step makes more than ten million rows");
        }
        for (double i = 0; i < parts; ++i) {
            const double t = std::min(1.0, i * step / length);
            if (i == 0 || t < 1) {
                stops_.push_back({along + t * length, a + t * (b - a), ""});
            }
        }
        for (const Barrier& barrier : model_.barriers) {
            for (const double t : crossings(barrier.sheet, a, b)) {
                stops_.push_back({along + t * length, a + t * (b - a), barrier.name});
            }
        }
        along += length;
    }

    const Model& model_;
    std::vector<Vec3> corners_;
    std::vector<Stop> stops_;
};

double step_asked(const QueryArguments& a, const Model& model) {
    return a.step ? a.step->in(model.frame.metres_per_unit) : model.criteria.l_min / 2;
}

}  // namespace

void query_line(const ModelSnapshot& opened, const QueryArguments& a, RowSink& sink, QueryRemarks& remarks) {
    const Model& model = opened.model();
    PointTable points = query_points(opened, a, remarks.diagnostics);
    std::erase_if(points.positions, [](const Vec3& p) { return !is_finite(p); });
    if (points.positions.size() < 2) {
        throw UsageError("query line: give two places or more, in the order of the line");
    }
    const Line line(model, points.positions, step_asked(a, model));
    std::optional<ModelEstimator> other;
    if (!a.estimator.empty()) {
        other.emplace(model, opened.barriers(), with_open_chosen(parse_estimator(a.estimator)), nullptr,
                      ModelEstimatorOptions{.uncertainty = !a.no_deviation});
    }
    const ModelEstimator& estimator = other            ? *other
                                      : a.no_deviation ? opened.estimator()
                                                       : opened.estimator_with_errors();
    std::vector<RowColumn> columns{{"distance"}, {"x"}, {"y"}, {"z"}};
    for (const Property& property : model.properties) {
        add_column(columns, property.name,
                   property.kind == Kind::categorical ? RowColumn::Type::text : RowColumn::Type::number);
        add_column(columns, property.name + "_sd");
    }
    add_column(columns, "region", RowColumn::Type::text);
    add_column(columns, "fault", RowColumn::Type::text);
    sink.begin(columns);

    const ModelBounds bounds(model.domain, opened.barriers());
    RegionFinder regions(opened.mesh(), opened.cells());
    std::vector<ValueQuery> queries;
    for (const Stop& stop : line.stops()) {
        queries.push_back({stop.place, -1, static_cast<std::int8_t>(a.side == "-" ? -1 : 1)});
    }
    const auto estimates = estimator.estimates(queries);
    std::vector<Row> rows;
    for (std::size_t i = 0; i < line.stops().size(); ++i) {
        const Stop& stop = line.stops()[i];
        const Vec3 world = model.frame.to_world(stop.place);
        const bool outside = bounds.excludes(stop.place);
        remarks.excluded += outside ? 1 : 0;
        Row row{{stop.distance, world.x, world.y, world.z}, {world}};
        for (std::size_t p = 0; p < model.properties.size(); ++p) {
            row.cells.push_back(outside ? RowCell() : value_cell(model.properties[p], estimates[p].value[i]));
            row.cells.push_back(outside ? RowCell() : RowCell(estimates[p].deviation[i]));
        }
        const std::int32_t region = outside ? -1 : regions.at(stop.place);
        row.cells.push_back(region < 0 ? RowCell()
                                       : RowCell(opened.cells().region_name[static_cast<std::size_t>(region)]));
        row.cells.push_back(stop.fault.empty() ? RowCell() : RowCell(stop.fault));
        rows.push_back(std::move(row));
    }
    sink.add(rows);
}

}  // namespace terratet::tools
