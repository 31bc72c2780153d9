// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// What the files for VTK tell of vertices, at the mesh's points or for their Voronoi cells, and of the model.

#include <string>
#include <vector>

#include "io/write/vtk_xml.hpp"
#include "tess/cells.hpp"
#include "tess/model.hpp"

namespace terratet {

/// Columns in step.
struct VertexTable {
    std::vector<Vertex> vertices;
    std::vector<std::int64_t> ids;            ///< −1 for points that are no vertices
    std::vector<std::vector<double>> values;  ///< [property]
    std::vector<double> extrapolation;
};

/// Arrays of each property, its logarithm where it has that scale, role, owner, side, id, extrapolation, and what is
/// censored. They stay where they are: it is not to be copied, and outlives what is written.
class VertexArrays {
  public:
    /// \param taken  names that further arrays beside them have
    VertexArrays(const Model& model, VertexTable table, std::span<const char* const> taken = {});
    VertexArrays(const VertexArrays&) = delete;
    VertexArrays& operator=(const VertexArrays&) = delete;

    [[nodiscard]] std::vector<VtkArray> arrays() const;
    [[nodiscard]] const std::vector<std::string>& property_names() const { return names_; }
    [[nodiscard]] std::string first_property() const { return names_.empty() ? "" : names_[0]; }

  private:
    VertexTable table_;
    std::vector<std::string> names_;
    std::vector<std::string> log10_names_;
    std::vector<std::vector<double>> decades_;
    std::vector<std::string> censored_names_;
    std::vector<std::vector<std::uint8_t>> censored_;
    std::vector<std::uint8_t> role_;
    std::vector<std::int32_t> owner_;
    std::vector<std::int8_t> side_;
};

/// What makes the properties' arrays understandable without the model: CRS, units, names behind numbers.
std::vector<VtkStrings> property_field_data(const Model& model, const std::vector<std::string>& property_names);

/// The same, and of the other arrays: faults, regions, reasons.
std::vector<VtkStrings> vtu_field_data(const Model& model, const CellTable& cells,
                                       const std::vector<std::string>& property_names);

}  // namespace terratet
