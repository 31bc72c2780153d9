// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "tess/cut_cells.hpp"
#include "tess/error.hpp"
#include "tess/model/regions.hpp"
#include "tools/run/query.hpp"

namespace terratet::tools {
namespace {

/// A tetrahedron with a level at its corners.
struct Piece {
    std::array<Vec3, 4> corners;
    std::array<double, 4> level;
};

double volume(const Piece& piece) {
    const auto& c = piece.corners;
    return std::abs(dot(c[1] - c[0], cross(c[2] - c[0], c[3] - c[0]))) / 6;
}

/// A place on the edge from corner i to j where the plane passes, with its level.
std::pair<Vec3, double> between(const Piece& piece, const std::array<double, 4>& d, std::size_t i, std::size_t j) {
    const double t = d[i] / (d[i] - d[j]);
    return {piece.corners[i] + t * (piece.corners[j] - piece.corners[i]),
            piece.level[i] + t * (piece.level[j] - piece.level[i])};
}

/// Appends the parts of it on the plane's positive side: one tetrahedron, or the three of a prism.
void clip(const Piece& piece, const CutPlane& plane, std::vector<Piece>& out) {
    std::array<double, 4> d{};
    std::vector<std::size_t> in;
    std::vector<std::size_t> off;
    for (std::size_t i = 0; i < 4; ++i) {
        d[i] = plane.distance(piece.corners[i]);
        (d[i] >= 0 ? in : off).push_back(i);
    }
    const auto corner = [&](std::size_t i) { return std::pair(piece.corners[i], piece.level[i]); };
    using End = std::pair<Vec3, double>;
    const auto add = [&](const End& a, const End& b, const End& c, const End& e) {
        out.push_back({{a.first, b.first, c.first, e.first}, {a.second, b.second, c.second, e.second}});
    };
    const auto prism = [&](const std::array<End, 3>& top, const std::array<End, 3>& bottom) {
        add(top[0], top[1], top[2], bottom[0]);
        add(top[1], top[2], bottom[0], bottom[1]);
        add(top[2], bottom[0], bottom[1], bottom[2]);
    };
    if (off.empty()) {
        out.push_back(piece);
    } else if (in.size() == 1) {
        add(corner(in[0]), between(piece, d, in[0], off[0]), between(piece, d, in[0], off[1]),
            between(piece, d, in[0], off[2]));
    } else if (in.size() == 2) {
        prism({corner(in[0]), between(piece, d, in[0], off[0]), between(piece, d, in[0], off[1])},
              {corner(in[1]), between(piece, d, in[1], off[0]), between(piece, d, in[1], off[1])});
    } else if (in.size() == 3) {
        prism({corner(in[0]), corner(in[1]), corner(in[2])},
              {between(piece, d, in[0], off[0]), between(piece, d, in[1], off[0]), between(piece, d, in[2], off[0])});
    }
}

/// The part within the box.
std::vector<Piece> clipped(const Piece& piece, const Box3& box) {
    std::vector<Piece> pieces{piece};
    for (int axis = 0; axis < 3; ++axis) {
        Vec3 normal;
        normal[axis] = 1;
        for (const CutPlane& plane : {CutPlane{normal, box.lo[axis]}, CutPlane{-normal, -box.hi[axis]}}) {
            std::vector<Piece> next;
            for (const Piece& part : pieces) {
                clip(part, plane, next);
            }
            pieces = std::move(next);
        }
    }
    return pieces;
}

struct Cut {
    std::size_t property;
    double level;  ///< in the property's scale
};

std::optional<Cut> cut_asked(const std::string& text, const Model& model) {
    if (text.empty()) {
        return std::nullopt;
    }
    const auto equals = text.rfind('=');
    const auto found = equals == std::string::npos
                           ? model.properties.end()
                           : std::ranges::find(model.properties, text.substr(0, equals), &Property::name);
    if (found == model.properties.end() || found->kind == Kind::categorical) {
        throw UsageError(
            fmt::format("query region --above: '{}' is not P=V, with a property P that has numbers", text));
    }
    const double value = parse_numbers("--above", text.substr(equals + 1), 1, 1).front();
    const double level = to_scale(*found, value);
    if (std::isnan(level)) {
        throw UsageError(fmt::format("query region --above: {} has no logarithm", text.substr(equals + 1)));
    }
    return Cut{static_cast<std::size_t>(found - model.properties.begin()), level};
}

void at_places(const ModelSnapshot& opened, const QueryArguments& a, RowSink& sink, QueryRemarks& remarks) {
    const Model& model = opened.model();
    const PointTable points = query_points(opened, a, remarks.diagnostics);
    RegionFinder finder(opened.mesh(), opened.cells());
    sink.begin({{"query", RowColumn::Type::integer}, {"x"}, {"y"}, {"z"}, {"region", RowColumn::Type::text}});
    std::vector<Row> rows;
    for (std::size_t i = 0; i < points.positions.size(); ++i) {
        const Vec3& p = points.positions[i];
        if (!is_finite(p)) {
            continue;
        }
        const Vec3 world = model.frame.to_world(p);
        const std::int32_t region = model.domain.extent.contains(p) ? finder.at(p) : -1;
        rows.push_back(
            {{static_cast<std::int64_t>(i) + 1, world.x, world.y, world.z,
              region < 0 ? RowCell() : RowCell(opened.cells().region_name[static_cast<std::size_t>(region)])},
             {world}});
    }
    sink.add(rows);
}

}  // namespace

void query_regions(const ModelSnapshot& opened, const QueryArguments& a, RowSink& sink, QueryRemarks& remarks) {
    if (!a.at.empty() || a.words.size() > 1) {
        at_places(opened, a, sink, remarks);
        return;
    }
    const Model& model = opened.model();
    const CellTable& table = opened.cells();
    const TetMesh& mesh = opened.mesh();
    const auto cut = cut_asked(a.above, model);
    std::vector<double> volumes(static_cast<std::size_t>(table.region_count), 0);
    std::vector<double> above(volumes.size(), 0);
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
        if (table.region[c] < 0) {
            continue;
        }
        Piece cell;
        for (std::size_t k = 0; k < 4; ++k) {
            const std::uint32_t v = mesh.cells[c][k];
            cell.corners[k] = mesh.points[v];
            cell.level[k] =
                cut ? to_scale(model.properties[cut->property], model.vertex_values.values[cut->property][v]) : 0;
        }
        const auto region = static_cast<std::size_t>(table.region[c]);
        for (const Piece& piece : clipped(cell, model.domain.extent)) {
            const double size = volume(piece) / model.frame.z_scale;
            volumes[region] += size;
            const double share = cut ? share_above(piece.level, cut->level) : 0;
            above[region] += std::isnan(share) ? 0 : share * size;
        }
    }
    std::vector<RowColumn> columns{{"region", RowColumn::Type::text}, {"volume"}};
    if (cut) {
        columns.push_back({"volume_above"});
    }
    sink.begin(columns);
    std::vector<Row> rows;
    for (std::size_t r = 0; r < volumes.size(); ++r) {
        Row row{{table.region_name[r], volumes[r]}, {}};
        if (cut) {
            row.cells.emplace_back(above[r]);
        }
        rows.push_back(std::move(row));
    }
    sink.add(rows);
}

}  // namespace terratet::tools
