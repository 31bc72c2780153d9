// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "io/write/clip.hpp"
#include "tess/cut_cells.hpp"
#include "tess/error.hpp"
#include "tess/model/regions.hpp"
#include "tools/options/values.hpp"
#include "tools/run/query.hpp"

namespace terratet::tools {
namespace {

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
    const double value = option_numbers("--above", text.substr(equals + 1), 1, 1).front();
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
    const auto cut = cut_asked(a.above, model);
    std::vector<double> volumes(static_cast<std::size_t>(table.region_count), 0);
    std::vector<double> above(volumes.size(), 0);
    // Cut at the extent: a cell whose middle is outside has parts of a block within as well.
    const ClippedMesh clipped = clip_to_extent({model, opened.mesh(), table}, ClippedCells::as_cut);
    std::vector<double> level;
    for (const double value : cut ? clipped.values(model, cut->property) : std::vector<double>{}) {
        level.push_back(to_scale(model.properties[cut->property], value));
    }
    for (std::size_t c = 0; c < clipped.cells.size(); ++c) {
        if (clipped.region[c] < 0 || table.beyond[clipped.parent[c]] != 0) {
            continue;
        }
        const auto& v = clipped.cells[c];
        const Vec3& d = clipped.points[v[3]];
        const double six =
            std::abs(dot(clipped.points[v[0]] - d, cross(clipped.points[v[1]] - d, clipped.points[v[2]] - d)));
        const double size = six / 6 / model.frame.z_scale;
        const auto region = static_cast<std::size_t>(clipped.region[c]);
        volumes[region] += size;
        if (cut) {
            const double share = share_above({level[v[0]], level[v[1]], level[v[2]], level[v[3]]}, cut->level);
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
