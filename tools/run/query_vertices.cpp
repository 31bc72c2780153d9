// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Distances are true ones: a stretched z (Frame::z_scale) is stretched back.
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "interp/sites/site_tree.hpp"
#include "tess/error.hpp"
#include "tess/mesh/mesh_walk.hpp"
#include "tess/mesh/quality.hpp"
#include "tools/options/site_options.hpp"
#include "tools/options/text.hpp"
#include "tools/options/values.hpp"
#include "tools/run/query.hpp"

namespace terratet::tools {
namespace {

using Vertices = std::vector<std::uint32_t>;

/// The vertices whose Voronoi cells would share a wall with a place's, if it were one of them: those of the cells whose
/// circumspheres hold it. Of a place where a vertex is, that vertex' own neighbours.
class Neighbours {
  public:
    explicit Neighbours(const TetMesh& mesh) : mesh_(mesh), walk_(mesh) {}

    Vertices of(const Vec3& p) {
        const auto position = walk_.locate(p);
        if (!position) {
            return {};
        }
        std::optional<std::uint32_t> at;
        for (const std::uint32_t v : mesh_.cells[position->cell]) {
            at = mesh_.points[v] == p ? std::optional(v) : at;
        }
        const auto belongs = [&](std::uint32_t cell) {
            if (at) {
                return std::ranges::count(mesh_.cells[cell], *at) > 0;
            }
            const Circumsphere sphere = circumsphere(cell_points(mesh_, mesh_.cells[cell]));
            return squared_distance(sphere.center, p) < sphere.squared_radius;
        };
        std::set<std::uint32_t> seen{position->cell};
        Vertices cells{position->cell};
        std::set<std::uint32_t> found;
        for (std::size_t i = 0; i < cells.size(); ++i) {
            found.insert(mesh_.cells[cells[i]].begin(), mesh_.cells[cells[i]].end());
            for (const std::int32_t next : mesh_.neighbours[cells[i]]) {
                const auto cell = static_cast<std::uint32_t>(next);
                if (next >= 0 && !seen.contains(cell) && belongs(cell)) {
                    seen.insert(cell);
                    cells.push_back(cell);
                }
            }
        }
        if (at) {
            found.erase(*at);
        }
        return {found.begin(), found.end()};
    }

  private:
    const TetMesh& mesh_;
    MeshWalk walk_;
};

class VertexQueries {
  public:
    VertexQueries(const ModelSnapshot& opened, const QueryArguments& a, RowSink& sink, QueryRemarks& remarks)
        : opened_(opened), model_(opened.model()), a_(a), sink_(sink), remarks_(remarks) {}

    void run() {
        std::vector<RowColumn> columns{{"query", RowColumn::Type::integer}, {"id", RowColumn::Type::integer}};
        for (const char* name : {"x", "y", "z", "distance"}) {
            columns.push_back({name});
        }
        add_property_columns(model_, columns);
        const std::string& verb = a_.words.front();
        if (verb == "box") {
            const Box3 box = box_asked();
            sink_.begin(columns);
            in_box(box);
        } else if (verb == "neighbours" && !a_.borehole.empty()) {
            const Vertices found = opened_.neighbours_of(a_.borehole);
            sink_.begin(columns);
            write(1, {}, found);
        } else {
            const PointTable points = query_points(opened_, a_, remarks_.diagnostics);
            const auto search = search_of(verb);
            sink_.begin(columns);
            for (std::size_t i = 0; i < points.positions.size(); ++i) {
                if (is_finite(points.positions[i])) {
                    write(static_cast<std::int64_t>(i) + 1, points.positions[i], search(points.positions[i]));
                }
            }
        }
        flush();
    }

  private:
    /// In true lengths, from the origin.
    [[nodiscard]] Vec3 plain(const Vec3& local) const { return model_.frame.to_world_size(local); }

    [[nodiscard]] Box3 box_asked() const {
        const std::string& text = !a_.box.empty() ? a_.box : a_.words.size() > 1 ? a_.words[1] : a_.box;
        if (text.empty()) {
            throw UsageError("query box: give --box xmin,ymin,zmin,xmax,ymax,zmax");
        }
        const auto n = option_numbers("--box", text, 6, 6);
        return {{n[0], n[1], n[2]}, {n[3], n[4], n[5]}};
    }

    void in_box(const Box3& box) {
        Vertices found;
        for (std::uint32_t v = 0; v < model_.vertices.size(); ++v) {
            if (box.contains(model_.frame.to_world(model_.vertices[v].position))) {
                found.push_back(v);
            }
        }
        write(1, {}, found);
    }

    using Search = std::function<Vertices(const Vec3&)>;

    Search search_of(const std::string& verb) {
        if (verb == "neighbours") {
            auto neighbours = std::make_shared<Neighbours>(opened_.mesh());
            return [neighbours](const Vec3& p) { return neighbours->of(p); };
        }
        std::size_t count = model_.vertices.size();
        double radius = std::numeric_limits<double>::infinity();
        if (verb == "nearest") {
            const auto k = parse_number(a_.count);
            if (!k || !(*k >= 1 && *k <= 1e9) || *k != std::floor(*k)) {
                throw UsageError("query nearest -k: '" + a_.count + "' is no whole number from 1");
            }
            count = std::min(count, static_cast<std::size_t>(*k));
        } else {
            if (!a_.distance) {
                throw UsageError("query within: give -d DISTANCE");
            }
            radius = a_.distance->in(model_.frame.metres_per_unit);
        }
        std::vector<Vec3> places;
        for (const Vertex& vertex : model_.vertices) {
            places.push_back(plain(vertex.position));
        }
        auto tree = std::make_shared<SiteTree>(places);
        return [this, tree, count, radius](const Vec3& p) {
            std::vector<NearSite> near;
            const double reach = radius * (1 + 1e-12);
            tree->nearest(plain(p), count, reach * reach, near);
            Vertices found;
            for (const NearSite& site : near) {
                if (distance_to(p, site.site) <= radius) {
                    found.push_back(site.site);
                }
            }
            return found;
        };
    }

    [[nodiscard]] double distance_to(const Vec3& p, std::uint32_t vertex) const {
        return distance(plain(p), plain(model_.vertices[vertex].position));
    }

    void write(std::int64_t query, const std::optional<Vec3>& from, const Vertices& found) {
        for (const std::uint32_t v : found) {
            const Vec3 place = model_.frame.to_world(model_.vertices[v].position);
            Row row;
            row.cells = {query,   static_cast<std::int64_t>(model_.vertices[v].id),
                         place.x, place.y,
                         place.z, from ? distance_to(*from, v) : 0.0};
            for (std::size_t p = 0; p < model_.properties.size(); ++p) {
                row.cells.push_back(value_cell(model_.properties[p], model_.vertex_values.values[p][v]));
            }
            row.outline = {place};
            rows_.push_back(std::move(row));
        }
        if (rows_.size() >= 65536) {
            flush();
        }
    }

    void flush() {
        sink_.add(rows_);
        rows_.clear();
    }

    const ModelSnapshot& opened_;
    const Model& model_;
    const QueryArguments& a_;
    RowSink& sink_;
    QueryRemarks& remarks_;
    std::vector<Row> rows_;
};

}  // namespace

void query_vertices(const ModelSnapshot& model, const QueryArguments& a, RowSink& sink, QueryRemarks& remarks) {
    VertexQueries(model, a, sink, remarks).run();
}

void query_cells(const ModelSnapshot& opened, const QueryArguments& a, RowSink& sink, QueryRemarks& remarks) {
    const Model& model = opened.model();
    const PointTable points = query_points(opened, a, remarks.diagnostics);
    const TetMesh& mesh = opened.mesh();
    const CellTable& table = opened.cells();
    std::vector<RowColumn> columns{{"query", RowColumn::Type::integer}};
    for (const char* name : {"x", "y", "z"}) {
        columns.push_back({name});
    }
    columns.push_back({"cell", RowColumn::Type::integer});
    columns.push_back({"region", RowColumn::Type::text});
    columns.push_back({"fault", RowColumn::Type::text});
    for (const char* name : {"id0", "id1", "id2", "id3"}) {
        columns.push_back({name, RowColumn::Type::integer});
    }
    for (const char* name : {"weight0", "weight1", "weight2", "weight3"}) {
        columns.push_back({name});
    }
    add_property_columns(model, columns);
    sink.begin(columns);
    MeshWalk walk(mesh);
    std::vector<Row> rows;
    for (std::size_t i = 0; i < points.positions.size(); ++i) {
        const Vec3& p = points.positions[i];
        if (!is_finite(p)) {
            continue;
        }
        const Vec3 world = model.frame.to_world(p);
        Row row{{static_cast<std::int64_t>(i) + 1, world.x, world.y, world.z}, {world}};
        const auto position = walk.locate(p);
        if (!position) {
            row.cells.resize(columns.size());
            rows.push_back(std::move(row));
            continue;
        }
        const auto& cell = mesh.cells[position->cell];
        const std::int32_t region = table.region[position->cell];
        const std::int32_t fault = table.barrier[position->cell];
        row.cells.emplace_back(static_cast<std::int64_t>(position->cell));
        row.cells.push_back(region < 0 ? RowCell() : RowCell(table.region_name[static_cast<std::size_t>(region)]));
        row.cells.push_back(fault < 0 ? RowCell() : RowCell(model.barriers[static_cast<std::size_t>(fault)].name));
        for (const std::uint32_t v : cell) {
            row.cells.emplace_back(static_cast<std::int64_t>(model.vertices[v].id));
        }
        for (const double weight : position->weights) {
            row.cells.emplace_back(weight);
        }
        for (std::size_t k = 0; k < model.properties.size(); ++k) {
            const Property& property = model.properties[k];
            const auto& values = model.vertex_values.values[k];
            double value = 0;
            std::size_t heaviest = 0;
            for (std::size_t c = 0; c < 4; ++c) {
                value += position->weights[c] * to_scale(property, values[cell[c]]);
                heaviest = position->weights[c] > position->weights[heaviest] ? c : heaviest;
            }
            row.cells.push_back(property.kind == Kind::categorical ? value_cell(property, values[cell[heaviest]])
                                                                   : value_cell(property, from_scale(property, value)));
        }
        rows.push_back(std::move(row));
    }
    sink.add(rows);
}

}  // namespace terratet::tools
