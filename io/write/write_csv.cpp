// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// Vertices as a table, quoted as RFC 4180 says, numbers with as many digits as they need to be read back exactly.

#include <string>

#include "io/read/column_names.hpp"
#include "io/base/csv_text.hpp"
#include "io/export.hpp"
#include "io/base/output_file.hpp"
#include "io/model/role_names.hpp"

namespace terratet {
namespace {

constexpr const char* own_columns[] = {"x", "y", "z", "id", "role", "owner", "side", "extrapolation"};

std::string header(const Model& model, const std::vector<std::size_t>& censored) {
    std::vector<std::string> names;
    for (const Property& property : model.properties) {
        names.push_back(property.name);
    }
    for (const std::size_t p : censored) {
        names.push_back(model.properties[p].name + "_censored");
    }
    names = distinct_names(std::move(names), own_columns);
    std::string row = "x,y,z,id,role,owner,side";
    for (std::size_t i = 0; i < names.size(); ++i) {
        row += i == model.properties.size() ? ",extrapolation," : ",";
        append_csv_text(row, names[i]);
    }
    return row + (censored.empty() ? ",extrapolation\n" : "\n");
}

void append_vertex(std::string& row, const Model& model, const std::vector<std::size_t>& censored, std::size_t v) {
    const Vertex& vertex = model.vertices[v];
    const Vec3 place = model.frame.to_world(vertex.position);
    for (const double coordinate : {place.x, place.y, place.z}) {
        append_csv_number(row, coordinate);
        row += ',';
    }
    append_csv_number(row, vertex.id);
    row += ',';
    row += role_name(vertex.role);
    row += ',';
    append_csv_text(row, owner_name(model, vertex));
    row += ',';
    append_csv_number(row, static_cast<int>(vertex.side));
    for (std::size_t p = 0; p < model.properties.size(); ++p) {
        row += ',';
        append_csv_value(row, model.properties[p], model.vertex_values.values[p][v]);
    }
    row += ',';
    append_csv_number(row, model.vertex_values.extrapolation[v]);
    for (const std::size_t p : censored) {
        row += ',';
        row += to_string(censoring_of(model, vertex, p));
    }
    row += '\n';
}

}  // namespace

OutputRecord write_csv(const ModelView& view, const std::string& path, const ExportOptions& options) {
    const Model& model = view.model;
    OutputFile file(path, options.overwrite);
    const auto censored = censored_properties(model);
    file.write(header(model, censored));
    constexpr std::size_t batch = 4096;
    std::string rows;
    for (std::size_t v = 0; v < model.vertices.size(); ++v) {
        append_vertex(rows, model, censored, v);
        if ((v + 1) % batch == 0) {
            file.write(rows);
            rows.clear();
            report_progress(options.progress, "write csv",
                            static_cast<double>(v) / static_cast<double>(model.vertices.size()));
        }
    }
    file.write(rows);
    return {path, file.commit()};
}

}  // namespace terratet
