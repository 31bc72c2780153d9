// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/onto/write_place_mesh.hpp"

#include <filesystem>

#include "io/base/csv_text.hpp"
#include "io/base/lower_case.hpp"
#include "io/base/output_file.hpp"
#include "io/read/column_names.hpp"
#include "io/write/vtk_xml.hpp"
#include "io/write/vtu_fields.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

std::vector<std::string> property_names(const Model& model) {
    std::vector<std::string> names;
    for (const Property& property : model.properties) {
        names.push_back(property.name);
    }
    static constexpr const char* own = "extrapolation";
    return distinct_names(std::move(names), {&own, 1});
}

std::vector<VtkArray> arrays_of(const ValueBatch& values, const std::vector<std::string>& names) {
    std::vector<VtkArray> arrays;
    for (std::size_t p = 0; p < names.size(); ++p) {
        arrays.push_back(vtk_array(names[p], values.values[p]));
    }
    arrays.push_back(vtk_array("extrapolation", values.extrapolation));
    return arrays;
}

void write_vtu(const PlaceMesh& mesh, const MeshValues& values, const Model& model, const ExportOptions& options,
               OutputFile& file) {
    const std::vector<std::string> names = property_names(model);
    VtkPiece piece;
    piece.points = mesh.points.size();
    piece.cells = mesh.ends.size();
    piece.coordinates = {"Points", "Float64", 3, std::as_bytes(std::span(mesh.points))};
    piece.topology = {vtk_array("connectivity", mesh.nodes), vtk_array("offsets", mesh.ends),
                      vtk_array("types", mesh.types)};
    if (!mesh.face_ends.empty()) {
        piece.topology.push_back(vtk_array("faces", mesh.faces));
        piece.topology.push_back(vtk_array("faceoffsets", mesh.face_ends));
    }
    piece.point_data = arrays_of(values.nodes, names);
    piece.cell_data = arrays_of(values.cells, names);
    piece.active_scalars = names.empty() ? "" : names.front();
    piece.field_data = property_field_data(model, names);
    if (!mesh.crs.empty()) {
        piece.field_data.front() = {"CRS", {mesh.crs.wkt}};
    }
    write_vtk(piece, options.compress.value_or(true), file, options.progress);
}

class CsvRows {
  public:
    CsvRows(const Model& model, OutputFile& file) : model_(model), file_(file) {
        text_ = "of,number,x,y,z";
        for (const std::string& name : property_names(model)) {
            text_ += ',';
            append_csv_text(text_, name);
        }
        text_ += ",extrapolation\n";
    }

    void add(const char* of, const std::vector<Vec3>& places, const ValueBatch& values) {
        for (std::size_t i = 0; i < places.size(); ++i) {
            text_ += of;
            text_ += ',' + std::to_string(i);
            for (int axis = 0; axis < 3; ++axis) {
                text_ += ',';
                append_csv_number(text_, places[i][axis]);
            }
            for (std::size_t p = 0; p < values.values.size(); ++p) {
                text_ += ',';
                append_csv_value(text_, model_.properties[p], values.values[p][i]);
            }
            text_ += ',';
            append_csv_value(text_, {}, values.extrapolation[i]);
            text_ += '\n';
            if (text_.size() > 1U << 20U) {
                flush();
            }
        }
    }
    void flush() {
        file_.write(text_);
        text_.clear();
    }

  private:
    const Model& model_;
    OutputFile& file_;
    std::string text_;
};

}  // namespace

OutputRecord write_place_mesh(const PlaceMesh& mesh, const MeshValues& values, const Model& model,
                              const std::string& path, const ExportOptions& options) {
    const std::string extension = lower_case(std::filesystem::path(path).extension().string());
    if (extension != ".vtu" && extension != ".csv") {
        throw UsageError(path + ": a mesh with a model's values becomes .vtu or .csv");
    }
    OutputFile file(path, options.overwrite);
    if (extension == ".vtu") {
        write_vtu(mesh, values, model, options, file);
    } else {
        CsvRows rows(model, file);
        rows.add("node", mesh.points, values.nodes);
        rows.add("cell", mesh.cell_centers(), values.cells);
        rows.flush();
    }
    return {path, file.commit()};
}

}  // namespace terratet
