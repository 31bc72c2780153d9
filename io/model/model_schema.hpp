// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Layers and columns of the model file (docs/model-file.md), for writing and reading alike.

#include <optional>
#include <set>
#include <string>
#include <type_traits>
#include <vector>

#include "io/model/model_layer.hpp"
#include "tess/property.hpp"
#include "tess/samples.hpp"

namespace terratet::schema {

/// Raised when files of this version can no longer be read by older ones.
inline constexpr int format_version = 1;

inline constexpr const char* samples = "samples";
inline constexpr const char* boreholes = "boreholes";
inline constexpr const char* surfaces = "surfaces";
inline constexpr const char* vertices = "vertices";
inline constexpr const char* meta = "terratet_meta";
inline constexpr const char* journal = "terratet_journal";
inline constexpr const char* changes = "terratet_changes";

/// Column names that databases and the layers know already, in lower case.
const std::set<std::string>& reserved_columns();

/// Column names of properties: the property's name where a database takes it as it is, else made fit and unique. The
/// mapping is stored, so any name survives.
std::vector<std::string> property_columns(const std::vector<Property>& properties);

/// Of each property the column that says which of its samples are censored; empty where none is. Stored as well.
std::vector<std::string> censored_columns(const std::vector<std::string>& property_columns, const Samples& samples);

/// Numbers for continuous properties, text for classes.
template <typename Layer>
std::vector<Column> value_columns(Layer& layer, const std::vector<Property>& properties,
                                  const std::vector<std::string>& names) {
    std::vector<Column> columns;
    for (std::size_t i = 0; i < properties.size(); ++i) {
        columns.push_back(properties[i].kind == Kind::categorical ? layer.text(names[i]) : layer.number(names[i]));
    }
    return columns;
}

/// Of what follows from the rest of its row and is there for people: written, never read.
template <typename Layer>
Column shown_number(Layer& layer, const char* name) {
    if constexpr (std::is_base_of_v<RowWriter, Layer>) {
        return layer.number(name);
    } else {
        return -1;
    }
}

struct BoreholeColumns {
    Column id, collar_x, collar_y, collar_z, length, azimuth, dip;
    template <typename Layer>
    explicit BoreholeColumns(Layer& layer)
        : id(layer.text("id")),
          collar_x(layer.number("collar_x")),
          collar_y(layer.number("collar_y")),
          collar_z(layer.number("collar_z")),
          length(shown_number(layer, "length")),
          azimuth(shown_number(layer, "azimuth")),
          dip(shown_number(layer, "dip")) {}
};

struct SampleColumns {
    Column borehole, hole, depth, length;
    std::vector<Column> values;
    std::vector<std::optional<Column>> censored;  ///< of each property
    template <typename Layer>
    SampleColumns(Layer& layer, const std::vector<Property>& properties, const std::vector<std::string>& names,
                  const std::vector<std::string>& censored_names)
        : borehole(layer.text("borehole")),
          hole(layer.integer("hole")),
          depth(layer.number("depth")),
          length(layer.number("length")),
          values(value_columns(layer, properties, names)) {
        for (const std::string& name : censored_names) {
            censored.push_back(name.empty() ? std::nullopt : std::optional(layer.text(name)));
        }
    }
};

struct SurfaceColumns {
    Column name, kind, file, area, dip, dip_direction, dip_min, dip_max, fault, spacing, width, covering_radius,
        protection_radius, mesh_vertices, mesh_triangles, seed_count, seeds;
    template <typename Layer>
    explicit SurfaceColumns(Layer& layer)
        : name(layer.text("name")),
          kind(layer.text("kind")),
          file(layer.text("file")),
          area(layer.number("area")),
          dip(layer.number("dip")),
          dip_direction(layer.number("dip_direction")),
          dip_min(layer.number("dip_min")),
          dip_max(layer.number("dip_max")),
          fault(layer.text("fault")),
          spacing(layer.number("spacing")),
          width(layer.number("width")),
          covering_radius(layer.number("covering_radius")),
          protection_radius(layer.number("protection_radius")),
          mesh_vertices(layer.bytes("mesh_vertices")),
          mesh_triangles(layer.bytes("mesh_triangles")),
          seed_count(layer.integer("seed_count")),
          seeds(layer.bytes("seeds")) {}
};

struct VertexColumns {
    Column id, role, owner, side, extrapolation;
    std::vector<Column> values;
    template <typename Layer>
    VertexColumns(Layer& layer, const std::vector<Property>& properties, const std::vector<std::string>& names)
        : id(layer.integer("id")),
          role(layer.text("role")),
          owner(layer.integer("owner")),
          side(layer.integer("side")),
          extrapolation(layer.number("extrapolation")),
          values(value_columns(layer, properties, names)) {}
};

struct MetaColumns {
    Column key, value;
    template <typename Layer>
    explicit MetaColumns(Layer& layer) : key(layer.text("key")), value(layer.text("value")) {}
};

struct JournalColumns {
    Column edit, time, command, arguments;
    template <typename Layer>
    explicit JournalColumns(Layer& layer)
        : edit(layer.integer("edit")),
          time(layer.text("time")),
          command(layer.text("command")),
          arguments(layer.text("arguments")) {}
};

struct ChangeColumns {
    Column edit, table, row_id, before, after;
    template <typename Layer>
    explicit ChangeColumns(Layer& layer)
        : edit(layer.integer("edit")),
          table(layer.text("table")),
          row_id(layer.integer("row_id")),
          before(layer.text("before")),
          after(layer.text("after")) {}
};

}  // namespace terratet::schema
