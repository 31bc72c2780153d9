// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/model/model_styles.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <vector>

#include "io/base/gdal_dataset.hpp"
#include "io/base/gdal_scope.hpp"
#include "io/model/model_layer.hpp"
#include "io/model/model_schema.hpp"
#include "io/style/qml.hpp"
#include "io/style/qml_symbols.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

struct Style {
    std::string name;
    std::string qml;
};

/// How a layer presents itself.
struct Presentation {
    std::string layer;
    std::string title;
    std::string description;
    std::vector<ColumnLabel> columns;
    std::vector<Style> styles = {};  ///< the first one is the default
};

constexpr Color hole_color{0.12, 0.12, 0.14};
constexpr Color fault_color{0.76, 0.20, 0.16};
constexpr Color horizon_color{0.13, 0.47, 0.33};
constexpr Color ground_color{0.52, 0.42, 0.24};
constexpr Color domain_color{0.35, 0.35, 0.40};
constexpr double sample_size = 1.8;
constexpr double vertex_size = 1.1;

std::string with_unit(const std::string& name, const std::string& unit) {
    return unit.empty() ? name : name + " [" + unit + "]";
}

ColumnLabel length_label(const Model& model, const char* column, const char* title, const char* description) {
    return {column, with_unit(title, model.frame.unit), description};
}

std::string kind_of_values(const Property& property) {
    return property.kind == Kind::categorical ? "a category"
           : property.scale == Scale::log10   ? "worked with as its decimal logarithm"
                                              : "";
}

/// The properties' columns, and a style for each.
void add_properties(const Model& model, const std::vector<std::string>& names, const char* what, double size,
                    Presentation& layer) {
    for (std::size_t p = 0; p < names.size(); ++p) {
        const Property& property = model.properties[p];
        const std::string kind = kind_of_values(property);
        layer.columns.push_back({names[p], with_unit(property.name, property.unit),
                                 what + property.name + (kind.empty() ? "" : ", " + kind)});
    }
    for (std::size_t p = 0; p < names.size(); ++p) {
        layer.styles.push_back({names[p], qml_document(qml_values(model.properties[p], names[p], color_range(model, p),
                                                                  ColorMap::named("viridis"), size),
                                                       layer.columns)});
    }
    if (names.empty()) {
        layer.styles.push_back(
            {layer.title, qml_document(qml_single(qml_marker("0", hole_color, size)), layer.columns)});
    }
}

Presentation of_samples(const Model& model, const std::vector<std::string>& names) {
    Presentation layer{schema::samples,
                       "Samples",
                       "What was measured, where it was",
                       {{"borehole", "Borehole", "Its id; none for a loose sample"},
                        {"hole", "Row of the borehole", "Its fid in the layer boreholes"},
                        length_label(model, "depth", "Depth along the hole", "Of the middle of the interval"),
                        length_label(model, "length", "Length", "Of the interval that the value stands for")}};
    const std::vector<std::string> censored = schema::censored_columns(names, model.samples);
    add_properties(model, names, "As measured: ", sample_size, layer);
    for (std::size_t p = 0; p < censored.size(); ++p) {
        if (!censored[p].empty()) {
            layer.columns.push_back(
                {censored[p], model.properties[p].name + " is a bound",
                 "< or > where the value is a bound, <> where it is a mean of bounds of either kind"});
        }
    }
    return layer;
}

Presentation of_boreholes(const Model& model) {
    Presentation layer{schema::boreholes,
                       "Boreholes",
                       "Their paths; the measure M is the depth along the hole",
                       {{"id", "Borehole", "Its id"},
                        {"collar_x", "Collar x", "Where it begins"},
                        {"collar_y", "Collar y", "Where it begins"},
                        {"collar_z", "Collar z", "Where it begins"},
                        length_label(model, "length", "Length", "Along the hole"),
                        {"azimuth", "Azimuth [degrees]", "From collar to end, clockwise from grid north"},
                        {"dip", "Dip [degrees]", "From collar to end, below the horizontal"}}};
    layer.styles.push_back(
        {"Boreholes", qml_document(qml_single(qml_path("0", hole_color, 0.35)), layer.columns, "id")});
    return layer;
}

std::string of_kind(const std::string& kind) {
    return qml_column("kind") + " = " + qml_text(kind);
}

Presentation of_surfaces(const Model& model) {
    Presentation layer{
        schema::surfaces,
        "Surfaces",
        "Faults, horizons, the ground and the domain: as they were read, and as they were prepared",
        {{"name", "Name", "Of the surface"},
         {"kind", "Kind", "As read (fault, horizon, topography, domain), or a prepared one's sheet or margin"},
         {"file", "File", "Where it was read from"},
         {"area", with_unit("Area", model.frame.unit + "²"), "Of its triangles"},
         {"dip", "Dip [degrees]", "Mean by area, below the horizontal"},
         {"dip_direction", "Dip direction [degrees]", "Clockwise from grid north"},
         {"dip_min", "Least dip [degrees]", "Of its triangles"},
         {"dip_max", "Largest dip [degrees]", "Of its triangles"},
         {"fault", "Barrier", "The name of the prepared surface"}}};
    const std::vector<StyleRule> rules = {
        {of_kind("domain"), "Domain", qml_outline("0", domain_color, 0.4)},
        {of_kind("topography_sheet"), "Ground", qml_outline("1", ground_color, 0.1), false},
        {of_kind("horizon_sheet"), "Horizons", qml_fill("2", horizon_color, 0.25, 0.1)},
        {of_kind("fault_sheet"), "Faults", qml_fill("3", fault_color, 0.35, 0.2)},
        {qml_column("kind") + " LIKE " + qml_text("%_margin"), "Beyond the rims", qml_outline("4", domain_color, 0.1),
         false},
        {qml_column("kind") + " IN ('fault', 'horizon', 'topography')", "As read", qml_outline("5", fault_color, 0.1),
         false},
    };
    layer.styles.push_back({"Surfaces", qml_document(qml_rules(rules), layer.columns)});
    return layer;
}

Presentation of_vertices(const Model& model, const std::vector<std::string>& names) {
    Presentation layer{schema::vertices,
                       "Vertices",
                       "Of the tessellation, with its values",
                       {{"id", "Vertex", "Its number, for good"},
                        {"role", "Role", "sample, seed (of a fault), domain, or inserted by refinement"},
                        {"owner", "Owner", "Of a sample its fid in samples, of a seed that of its sheet in surfaces"},
                        {"side", "Side", "Of its fault: 1 or -1; else 0"},
                        {"extrapolation", "Extrapolation", "0 among the samples to 1 beyond their reach"}}};
    add_properties(model, names, "Value of the tessellation: ", vertex_size, layer);
    return layer;
}

/// Plain tables have a title and a description alone.
std::array<Presentation, 3> of_tables() {
    return {Presentation{schema::meta, "About the model", "Keys and values; see Terratet's docs/model-file.md", {}},
            Presentation{schema::journal, "Journal", "The commands that made and changed the model", {}},
            Presentation{schema::changes, "Changes", "The rows that each command changed", {}}};
}

class StyleWriter {
  public:
    StyleWriter(SqliteDatabase& database, const std::string& time)
        : contents_(
              database.prepare("UPDATE gpkg_contents SET identifier = ?1, description = ?2 WHERE table_name = ?3")),
          columns_(database.prepare("INSERT INTO gpkg_data_columns (table_name, column_name, name, title, description) "
                                    "VALUES (?1, ?2, ?3, ?3, ?4)")),
          styles_(database.prepare(
              "INSERT INTO layer_styles (f_table_catalog, f_table_schema, f_table_name, f_geometry_column, styleName, "
              "styleQML, styleSLD, useAsDefault, description, owner, update_time) "
              "VALUES ('', '', ?1, 'geom', ?2, ?3, '', ?4, ?5, '', ?6)")),
          database_(database),
          time_(time) {}

    void write(const Presentation& layer) {
        run(contents_, {layer.title, layer.description, layer.layer});
        std::set<std::string> titles;  // unique in a layer by the format's rule; a property may be called "Owner"
        for (const ColumnLabel& label : layer.columns) {
            std::string title = label.title;
            while (!titles.insert(title).second) {
                title += " (" + label.column + ")";
            }
            run(columns_, {layer.layer, label.column, title, label.description});
        }
        bool first = true;
        for (const Style& style : layer.styles) {
            run(styles_, {layer.layer, style.name, style.qml, first ? "1" : "0", layer.description, time_});
            first = false;
        }
    }

  private:
    void run(SqliteStatement& statement, const std::vector<std::string>& values) {
        for (std::size_t i = 0; i < values.size(); ++i) {
            statement.bind(static_cast<int>(i) + 1, values[i]);
        }
        database_.step(statement);
        statement.reset();
    }

    SqliteStatement contents_, columns_, styles_;
    SqliteDatabase& database_;
    std::string time_;
};

/// As GeoPackage's extension for schemas and as QGIS itself make them.
void create_tables(SqliteDatabase& database, const std::string& time) {
    database.run(
        "CREATE TABLE IF NOT EXISTS gpkg_extensions (table_name TEXT, column_name TEXT, extension_name TEXT NOT NULL, "
        "definition TEXT NOT NULL, scope TEXT NOT NULL, CONSTRAINT ge_tce UNIQUE (table_name, column_name, "
        "extension_name))");
    database.run(
        "CREATE TABLE gpkg_data_columns (table_name TEXT NOT NULL, column_name TEXT NOT NULL, name TEXT, title TEXT, "
        "description TEXT, mime_type TEXT, constraint_name TEXT, CONSTRAINT pk_gdc PRIMARY KEY (table_name, "
        "column_name), CONSTRAINT gdc_tn UNIQUE (table_name, name))");
    database.run(
        "CREATE TABLE gpkg_data_column_constraints (constraint_name TEXT NOT NULL, constraint_type TEXT NOT NULL, "
        "value TEXT, min NUMERIC, min_is_inclusive BOOLEAN, max NUMERIC, max_is_inclusive BOOLEAN, description TEXT, "
        "CONSTRAINT gdcc_ntv UNIQUE (constraint_name, constraint_type, value))");
    for (const char* table : {"gpkg_data_columns", "gpkg_data_column_constraints"}) {
        database.run("INSERT INTO gpkg_extensions VALUES ('" + std::string(table) +
                     "', NULL, 'gpkg_schema', 'http://www.geopackage.org/spec121/#extension_schema', 'read-write')");
    }
    database.run(
        "CREATE TABLE layer_styles (id INTEGER PRIMARY KEY AUTOINCREMENT NOT NULL, f_table_catalog TEXT(256), "
        "f_table_schema TEXT(256), f_table_name TEXT(256), f_geometry_column TEXT(256), styleName TEXT(30), styleQML "
        "TEXT, styleSLD TEXT, useAsDefault BOOLEAN, description TEXT, owner TEXT(30), ui TEXT(30), update_time "
        "DATETIME DEFAULT (strftime('%Y-%m-%dT%H:%M:%fZ','now')))");
    SqliteStatement contents = database.prepare(
        "INSERT INTO gpkg_contents (table_name, data_type, identifier, description, last_change) "
        "VALUES ('layer_styles', 'attributes', 'layer_styles', 'How QGIS draws the layers', ?1)");
    contents.bind(1, time);
    database.step(contents);
}

}  // namespace

void write_styles(SqliteDatabase& database, const Model& model, const std::string& time) {
    create_tables(database, time);
    const std::vector<std::string> names = schema::property_columns(model.properties);
    StyleWriter writer(database, time);
    for (const Presentation& layer :
         {of_boreholes(model), of_samples(model, names), of_surfaces(model), of_vertices(model, names)}) {
        writer.write(layer);
    }
    for (const Presentation& table : of_tables()) {
        writer.write(table);
    }
}

void write_spatial_indices(const std::string& file, const std::string& shown) {
    GdalScope scope;
    const char* const drivers[] = {"GPKG", nullptr};
    Dataset dataset(GDALDataset::Open(file.c_str(), GDAL_OF_VECTOR | GDAL_OF_UPDATE, drivers, nullptr, nullptr));
    for (const char* layer : {schema::boreholes, schema::samples, schema::surfaces, schema::vertices}) {
        const std::string sql = "SELECT CreateSpatialIndex('" + std::string(layer) + "', 'geom')";
        OGRLayer* const result = dataset ? dataset->ExecuteSQL(sql.c_str(), nullptr, nullptr) : nullptr;
        const OGRFeatureUniquePtr row(result ? result->GetNextFeature() : nullptr);
        const bool done = row && row->GetFieldAsInteger(0) == 1;
        if (dataset) {
            dataset->ReleaseResultSet(result);
        }
        if (!done) {
            throw Error("cannot write " + shown + ": layer " + layer + " got no spatial index" + because(scope));
        }
    }
}

}  // namespace terratet
