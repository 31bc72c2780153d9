// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// Vertices as a table, quoted as RFC 4180 says, numbers with as many digits as they need to be read back exactly.

#include <charconv>
#include <cmath>
#include <string>

#include "io/column_names.hpp"
#include "io/export.hpp"
#include "io/output_file.hpp"
#include "io/role_names.hpp"

namespace terratet {
namespace {

constexpr const char* own_columns[] = {"x", "y", "z", "id", "role", "owner", "side", "extrapolation"};

void append_text(std::string& row, const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) {
        row += text;
        return;
    }
    row += '"';
    for (const char c : text) {
        row += c;
        if (c == '"') {
            row += '"';
        }
    }
    row += '"';
}

template <class Number>
void append_number(std::string& row, Number value) {
    char digits[32];
    row.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

/// Nothing for a missing value; a category by its name.
void append_value(std::string& row, const Property& property, double value) {
    if (std::isnan(value)) {
        return;
    }
    if (property.kind == Kind::categorical && value >= 0 && value < static_cast<double>(property.classes.size())) {
        append_text(row, property.classes[static_cast<std::size_t>(value)]);
    } else {
        append_number(row, value);
    }
}

std::string header(const Model& model) {
    std::vector<std::string> names;
    for (const Property& property : model.properties) {
        names.push_back(property.name);
    }
    std::string row = "x,y,z,id,role,owner,side";
    for (const std::string& name : distinct_names(names, own_columns)) {
        row += ',';
        append_text(row, name);
    }
    return row + ",extrapolation\n";
}

void append_vertex(std::string& row, const Model& model, std::size_t v) {
    const Vertex& vertex = model.vertices[v];
    const Vec3 place = model.frame.to_world(vertex.position);
    for (const double coordinate : {place.x, place.y, place.z}) {
        append_number(row, coordinate);
        row += ',';
    }
    append_number(row, vertex.id);
    row += ',';
    row += role_name(vertex.role);
    row += ',';
    append_text(row, owner_name(model, vertex));
    row += ',';
    append_number(row, static_cast<int>(vertex.side));
    for (std::size_t p = 0; p < model.properties.size(); ++p) {
        row += ',';
        append_value(row, model.properties[p], model.vertex_values.values[p][v]);
    }
    row += ',';
    append_number(row, model.vertex_values.extrapolation[v]);
    row += '\n';
}

}  // namespace

OutputRecord write_csv(const ModelView& view, const std::string& path, const ExportOptions& options) {
    const Model& model = view.model;
    OutputFile file(path, options.overwrite);
    file.write(header(model));
    constexpr std::size_t batch = 4096;
    std::string rows;
    for (std::size_t v = 0; v < model.vertices.size(); ++v) {
        append_vertex(rows, model, v);
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
