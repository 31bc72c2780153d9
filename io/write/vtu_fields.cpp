// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/write/vtu_fields.hpp"

#include "io/model/role_names.hpp"
#include "io/read/column_names.hpp"
#include "tess/refinement.hpp"

namespace terratet {
namespace {

constexpr const char* own_arrays[] = {"role", "owner", "side", "id", "extrapolation"};

template <class To, class Member>
std::vector<To> column_of(const std::vector<Vertex>& vertices, Member member) {
    std::vector<To> result(vertices.size());
    for (std::size_t v = 0; v < vertices.size(); ++v) {
        result[v] = static_cast<To>(vertices[v].*member);
    }
    return result;
}

std::vector<std::uint8_t> censoring_column(const Model& model, const std::vector<Vertex>& vertices, std::size_t p) {
    std::vector<std::uint8_t> result;
    result.reserve(vertices.size());
    for (const Vertex& vertex : vertices) {
        result.push_back(static_cast<std::uint8_t>(censoring_of(model, vertex, p)));
    }
    return result;
}

/// Properties that are drawn in decades.
std::vector<std::size_t> log10_properties(const Model& model) {
    std::vector<std::size_t> found;
    for (std::size_t p = 0; p < model.properties.size(); ++p) {
        if (model.properties[p].scale == Scale::log10 && model.properties[p].kind == Kind::continuous) {
            found.push_back(p);
        }
    }
    return found;
}

const char* scale_name(const Property& property) {
    return property.kind == Kind::categorical ? "categorical" : property.scale == Scale::log10 ? "log10" : "linear";
}

}  // namespace

std::vector<VtkStrings> property_field_data(const Model& model, const std::vector<std::string>& names) {
    std::vector<VtkStrings> fields{{"CRS", {model.frame.crs_wkt}}, {"LengthUnit", {model.frame.unit}}};
    VtkStrings properties{"Properties", names};
    VtkStrings units{"PropertyUnits", {}};
    VtkStrings scales{"PropertyScales", {}};
    for (const Property& property : model.properties) {
        units.values.push_back(property.unit);
        scales.values.emplace_back(scale_name(property));
    }
    fields.insert(fields.end(), {properties, units, scales});
    for (std::size_t p = 0; p < names.size(); ++p) {
        if (model.properties[p].kind == Kind::categorical) {
            fields.push_back({"Classes:" + names[p], model.properties[p].classes});
        }
    }
    return fields;
}

std::vector<VtkStrings> vtu_field_data(const Model& model, const CellTable& cells,
                                       const std::vector<std::string>& names) {
    std::vector<VtkStrings> fields = property_field_data(model, names);
    VtkStrings faults{"Faults", {}};
    for (const Barrier& fault : model.barriers) {
        faults.values.push_back(fault.name);
    }
    VtkStrings reasons{"Reasons", {}};
    for (int reason = 0; reason <= static_cast<int>(Reason::fault_gap); ++reason) {
        reasons.values.push_back(to_string(static_cast<Reason>(reason)));
    }
    fields.insert(fields.end(), {{"Regions", cells.region_name}, faults, reasons});
    return fields;
}

VertexArrays::VertexArrays(const Model& model, VertexTable table, std::span<const char* const> taken)
    : table_(std::move(table)) {
    for (const Property& property : model.properties) {
        names_.push_back(property.name);
    }
    for (const std::size_t p : censored_properties(model)) {
        names_.push_back(model.properties[p].name + "_censored");
        censored_.push_back(censoring_column(model, table_.vertices, p));
    }
    for (const std::size_t p : log10_properties(model)) {
        names_.push_back(model.properties[p].name + "_log10");
        decades_.push_back(table_.values[p]);
        for (double& value : decades_.back()) {
            value = to_scale(model.properties[p], value);
        }
    }
    std::vector<const char*> all_taken(std::begin(own_arrays), std::end(own_arrays));
    all_taken.insert(all_taken.end(), taken.begin(), taken.end());
    names_ = distinct_names(std::move(names_), all_taken);
    const auto further = names_.begin() + std::ssize(model.properties);
    censored_names_.assign(further, further + std::ssize(censored_));
    log10_names_.assign(further + std::ssize(censored_), names_.end());
    names_.resize(model.properties.size());
    role_ = column_of<std::uint8_t>(table_.vertices, &Vertex::role);
    owner_ = column_of<std::int32_t>(table_.vertices, &Vertex::owner);
    side_ = column_of<std::int8_t>(table_.vertices, &Vertex::side);
}

std::vector<VtkArray> VertexArrays::arrays() const {
    std::vector<VtkArray> arrays;
    for (std::size_t p = 0; p < names_.size(); ++p) {
        arrays.push_back(vtk_array(names_[p], table_.values[p]));
    }
    for (std::size_t i = 0; i < decades_.size(); ++i) {
        arrays.push_back(vtk_array(log10_names_[i], decades_[i]));
    }
    arrays.insert(arrays.end(), {vtk_array("role", role_), vtk_array("owner", owner_), vtk_array("side", side_),
                                 vtk_array("id", table_.ids), vtk_array("extrapolation", table_.extrapolation)});
    for (std::size_t i = 0; i < censored_.size(); ++i) {
        arrays.push_back(vtk_array(censored_names_[i], censored_[i]));
    }
    return arrays;
}

}  // namespace terratet
