// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <unistd.h>
#include <cassert>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <optional>

#include "io/base/output_file.hpp"
#include "io/model/model_meta.hpp"
#include "io/model/model_schema.hpp"
#include "io/model/storable.hpp"
#include "io/model_store.hpp"
#include "io/source.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

/// The time in force: SOURCE_DATE_EPOCH (seconds since 1970) when set, so that equal runs give equal files.
std::time_t current_time() {
    const char* const epoch = std::getenv("SOURCE_DATE_EPOCH");
    char* end = nullptr;
    const long long seconds = epoch ? std::strtoll(epoch, &end, 10) : 0;
    return epoch && end != epoch && *end == '\0' ? static_cast<std::time_t>(seconds) : std::time(nullptr);
}

std::string iso8601(std::time_t time, const char* format) {
    std::tm parts{};
    gmtime_r(&time, &parts);
    char text[40];
    std::strftime(text, sizeof text, format, &parts);
    return text;
}

void require_storable(const std::string& text, const std::string& what) {
    if (!is_storable(text)) {
        throw Error("the model cannot be stored: " + what + " is not valid UTF-8, or holds a NUL");
    }
}

/// Before anything is written: what a database could not hold.
void require_storable(const Model& model, const JournalEntry& entry) {
    for (const std::string* text : {&model.frame.crs_wkt, &model.frame.crs_name, &model.frame.unit}) {
        require_storable(*text, "the coordinate system's text");
    }
    for (const Property& property : model.properties) {
        require_storable(property.name, "a property's name");
        require_storable(property.unit, "the unit of " + property.name);
        for (const std::string& name : property.classes) {
            require_storable(name, "a class of " + property.name);
        }
    }
    for (const Borehole& borehole : model.boreholes) {
        require_storable(borehole.id, "a borehole's id");
    }
    const auto require_surface = [](const Surface& surface) {
        require_storable(surface.name, "a surface's name");
        require_storable(surface.file, "the file name of surface " + surface.name);
    };
    for (const Surface& surface : model.surfaces) {
        require_surface(surface);
    }
    for (const Barrier& fault : model.barriers) {
        require_storable(fault.name, "a fault's name");
        require_surface(fault.sheet);
        require_surface(fault.margin);
    }
    require_storable(model.estimator, "the estimator's specification");
    for (const std::string* text : {&entry.time, &entry.command, &entry.arguments}) {
        require_storable(*text, "the journal entry");
    }
}

/// Writes all layers of one model into an open dataset.
class ModelWriter {
  public:
    ModelWriter(GDALDataset& dataset, const GdalScope& scope, std::string file, const Model& model)
        : dataset_(dataset),
          scope_(scope),
          file_(std::move(file)),
          model_(model),
          columns_(schema::property_columns(model.properties)),
          censored_columns_(schema::censored_columns(columns_, model.samples)) {
        // A text that is no CRS (or none) leaves the layers without; the text itself is in the meta layer.
        const GdalScope quiet;
        if (!model.frame.crs_wkt.empty() && reference_.importFromWkt(model.frame.crs_wkt.c_str()) == OGRERR_NONE) {
            reference_.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
            has_reference_ = true;
        }
    }

    void write(const JournalEntry& entry) {
        write_boreholes();
        write_samples();
        write_surfaces();
        write_vertices();
        write_meta();
        write_journal(entry);
    }

  private:
    LayerWriter layer(const char* name, OGRwkbGeometryType type) {
        return {dataset_, scope_, file_, name, type, has_reference_ && type != wkbNone ? &reference_ : nullptr};
    }

    Vec3 world(const Vec3& local) const {
        assert(model_.frame.snapped(local) == local && "not snapped to the frame: it would not reload exactly");
        return model_.frame.to_world(local);
    }

    void set_values(LayerWriter& layer, const std::vector<Column>& columns,
                    const std::vector<std::vector<double>>& values, std::size_t row);
    void set_mesh(LayerWriter& layer, const schema::SurfaceColumns& columns, const Surface& surface);
    void write_boreholes();
    void write_samples();
    void write_surfaces();
    void write_vertices();
    void write_meta();
    void write_journal(const JournalEntry& entry);
    std::vector<Seed> seeds_among_vertices(std::size_t fault) const;

    /// Rows are numbered from 1.
    static std::int64_t row_of(std::size_t index) { return static_cast<std::int64_t>(index) + 1; }
    [[nodiscard]] std::int64_t sheet_row(std::size_t fault) const { return row_of(model_.surfaces.size() + 2 * fault); }

    GDALDataset& dataset_;
    const GdalScope& scope_;
    std::string file_;
    const Model& model_;
    std::vector<std::string> columns_;
    std::vector<std::string> censored_columns_;
    OGRSpatialReference reference_;
    bool has_reference_ = false;
};

void ModelWriter::set_values(LayerWriter& layer, const std::vector<Column>& columns,
                             const std::vector<std::vector<double>>& values, std::size_t row) {
    for (std::size_t p = 0; p < columns.size(); ++p) {
        const Property& property = model_.properties[p];
        const double value = values[p][row];
        if (property.kind == Kind::continuous) {
            layer.set(columns[p], value);
        } else if (!std::isnan(value)) {
            assert(value >= 0 && value < static_cast<double>(property.classes.size()));
            layer.set(columns[p], property.classes[static_cast<std::size_t>(value)]);
        }
    }
}

void ModelWriter::write_boreholes() {
    LayerWriter layer = this->layer(schema::boreholes, wkbLineStringZM);
    const schema::BoreholeColumns columns(layer);
    layer.create();
    for (const Borehole& borehole : model_.boreholes) {
        const Vec3 collar = world(borehole.collar);
        layer.set(columns.id, borehole.id);
        layer.set(columns.collar_x, collar.x);
        layer.set(columns.collar_y, collar.y);
        layer.set(columns.collar_z, collar.z);
        auto line = std::make_unique<OGRLineString>();
        line->set3D(true);
        line->setMeasured(true);
        for (std::size_t i = 0; i < borehole.path.size(); ++i) {
            const Vec3 p = world(borehole.path[i]);
            line->addPoint(p.x, p.y, p.z, borehole.path_depth[i]);
        }
        layer.set_geometry(std::move(line));
        layer.write();
    }
}

void ModelWriter::write_samples() {
    LayerWriter layer = this->layer(schema::samples, wkbPoint25D);
    const schema::SampleColumns columns(layer, model_.properties, columns_, censored_columns_);
    layer.create();
    const Samples& samples = model_.samples;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        if (samples.borehole[i] >= 0) {
            const auto hole = static_cast<std::size_t>(samples.borehole[i]);
            layer.set(columns.borehole, model_.boreholes[hole].id);
            layer.set(columns.hole, row_of(hole));
        }
        layer.set(columns.depth, samples.depth[i]);
        layer.set(columns.length, samples.length[i]);
        set_values(layer, columns.values, samples.values, i);
        for (std::size_t p = 0; p < columns.censored.size(); ++p) {
            if (const Censoring censoring = samples.censoring(p, i); censoring != Censoring::none) {
                layer.set(*columns.censored[p], std::string(to_string(censoring)));
            }
        }
        layer.set_point(world(samples.positions[i]));
        layer.write();
    }
}

/// The geometry is for people and their programs; the arrays beside it hold which corners are one vertex, which no set
/// of polygons tells (dirty surfaces have distinct vertices at one place), and vertices that no triangle uses.
void ModelWriter::set_mesh(LayerWriter& layer, const schema::SurfaceColumns& columns, const Surface& surface) {
    std::vector<Vec3> corners;
    corners.reserve(surface.vertices.size());
    for (const Vec3& p : surface.vertices) {
        corners.push_back(world(p));
    }
    auto geometry = std::make_unique<OGRMultiPolygon>();
    geometry->set3D(true);
    for (const Triangle& t : surface.triangles) {
        auto ring = std::make_unique<OGRLinearRing>();
        for (const std::uint32_t corner : {t[0], t[1], t[2], t[0]}) {
            ring->addPoint(corners[corner].x, corners[corner].y, corners[corner].z);
        }
        auto polygon = std::make_unique<OGRPolygon>();
        polygon->addRingDirectly(ring.release());
        geometry->addGeometryDirectly(polygon.release());
    }
    layer.set_geometry(std::move(geometry));
    layer.set(columns.mesh_vertices, std::as_bytes(std::span(corners)));
    layer.set(columns.mesh_triangles, std::as_bytes(std::span(surface.triangles)));

    const SurfaceStatistics description = statistics(surface);
    layer.set(columns.name, surface.name);
    layer.set(columns.file, surface.file);
    layer.set(columns.area, description.area);
    layer.set(columns.dip, description.dip_mean_deg);
    layer.set(columns.dip_direction, description.dip_direction_deg);
    layer.set(columns.dip_min, description.dip_min_deg);
    layer.set(columns.dip_max, description.dip_max_deg);
}

/// What a reader would find of a fault's seeds in the vertices.
std::vector<Seed> ModelWriter::seeds_among_vertices(std::size_t fault) const {
    std::vector<Seed> seeds;
    for (const Vertex& vertex : model_.vertices) {
        if (vertex.role == Role::seed && vertex.owner == static_cast<std::int32_t>(fault)) {
            seeds.push_back({vertex.position, vertex.side});
        }
    }
    return seeds;
}

void ModelWriter::write_surfaces() {
    LayerWriter layer = this->layer(schema::surfaces, wkbMultiPolygon25D);
    const schema::SurfaceColumns columns(layer);
    layer.create();
    for (const Surface& surface : model_.surfaces) {
        set_mesh(layer, columns, surface);
        layer.set(columns.kind, std::string(to_string(surface.kind)));
        layer.write();
    }
    for (std::size_t f = 0; f < model_.barriers.size(); ++f) {
        const Barrier& fault = model_.barriers[f];
        for (const bool margin : {false, true}) {
            set_mesh(layer, columns, margin ? fault.margin : fault.sheet);
            layer.set(columns.kind, to_string(fault.sheet.kind) + std::string(margin ? "_margin" : "_sheet"));
            layer.set(columns.fault, fault.name);
            layer.set(columns.spacing, fault.spacing);
            layer.set(columns.width, fault.width);
            layer.set(columns.covering_radius, fault.covering_radius);
            layer.set(columns.protection_radius, fault.protection_radius);
            if (!margin) {
                layer.set(columns.seed_count, static_cast<std::int64_t>(fault.seeds.size()));
            }
            if (!margin && seeds_among_vertices(f) != fault.seeds) {
                std::vector<double> packed;
                for (const Seed& seed : fault.seeds) {
                    const Vec3 p = world(seed.position);
                    packed.insert(packed.end(), {p.x, p.y, p.z, static_cast<double>(seed.side)});
                }
                layer.set(columns.seeds, std::as_bytes(std::span(packed)));
            }
            layer.write();
        }
    }
}

void ModelWriter::write_vertices() {
    LayerWriter layer = this->layer(schema::vertices, wkbPoint25D);
    const schema::VertexColumns columns(layer, model_.properties, columns_);
    layer.create();
    const std::string roles[] = {"sample", "seed", "domain", "inserted"};
    for (std::size_t i = 0; i < model_.vertices.size(); ++i) {
        const Vertex& vertex = model_.vertices[i];
        layer.set(columns.id, static_cast<std::int64_t>(vertex.id));
        layer.set(columns.role, roles[static_cast<std::size_t>(vertex.role)]);
        if (vertex.role == Role::sample || vertex.role == Role::seed) {
            const auto owner = static_cast<std::size_t>(vertex.owner);
            layer.set(columns.owner, vertex.role == Role::sample ? row_of(owner) : sheet_row(owner));
        }
        layer.set(columns.side, std::int64_t{vertex.side});
        layer.set(columns.extrapolation, model_.vertex_values.extrapolation[i]);
        set_values(layer, columns.values, model_.vertex_values.values, i);
        layer.set_point(world(vertex.position));
        layer.write();
    }
}

void ModelWriter::write_meta() {
    LayerWriter layer = this->layer(schema::meta, wkbNone);
    const schema::MetaColumns columns(layer);
    layer.create();
    for (const auto& [key, value] : to_meta(model_, columns_, censored_columns_)) {
        layer.set(columns.key, key);
        layer.set(columns.value, value);
        layer.write();
    }
}

void ModelWriter::write_journal(const JournalEntry& entry) {
    LayerWriter layer = this->layer(schema::journal, wkbNone);
    const schema::JournalColumns columns(layer);
    layer.create();
    layer.set(columns.edit, entry.edit);
    layer.set(columns.time, entry.time.empty() ? iso8601(current_time(), "%Y-%m-%dT%H:%M:%SZ") : entry.time);
    layer.set(columns.command, entry.command);
    layer.set(columns.arguments, entry.arguments);
    layer.write();
    LayerWriter changes = this->layer(schema::changes, wkbNone);
    [[maybe_unused]] const schema::ChangeColumns change_columns(changes);
    changes.create();
}

[[noreturn]] void fail(const std::string& path, const GdalScope& scope) {
    throw Error("cannot write " + path + because(scope));
}

/// SQLite's settings while a new database is made, whatever the environment's OGR_SQLITE_… variables say. The driver
/// makes its tables in a hundred transactions of their own; nobody sees the file yet, so these need not wait for the
/// disk.
struct CreationSettings {
    GdalOption journal{"OGR_SQLITE_JOURNAL", "DELETE"};
    GdalOption synchronous{"OGR_SQLITE_SYNCHRONOUS", "OFF"};
    GdalOption pragma{"OGR_SQLITE_PRAGMA", ""};
};

std::string pragma(GDALDataset& dataset, const char* name) {
    OGRLayer* const result = dataset.ExecuteSQL((std::string("PRAGMA ") + name).c_str(), nullptr, nullptr);
    if (!result) {
        return {};
    }
    std::string value;
    if (const OGRFeatureUniquePtr row{result->GetNextFeature()}) {
        value = row->GetFieldAsString(0);
    }
    dataset.ReleaseResultSet(result);
    return value;
}

/// From here on as safe as SQLite can be. Asked back, since a setting it does not know is silently ignored.
void make_durable(GDALDataset& dataset) {
    pragma(dataset, "synchronous=FULL");
    if (pragma(dataset, "journal_mode") != "delete" || pragma(dataset, "synchronous") != "2") {
        throw Error("SQLite does not take journal_mode=DELETE and synchronous=FULL; the model would not be safe");
    }
}

/// One transaction around everything: all or nothing.
void write_transaction(Dataset& dataset, GdalScope& scope, const std::string& path, const Model& model,
                       const JournalEntry& entry) {
    if (dataset->StartTransaction() != OGRERR_NONE) {
        fail(path, scope);
    }
    try {
        ModelWriter(*dataset, scope, path, model).write(entry);
        dataset->FlushCache(false);  // extents and counts belong to the transaction too
        if (dataset->CommitTransaction() != OGRERR_NONE || scope.failed()) {
            fail(path, scope);
        }
    } catch (...) {
        dataset->RollbackTransaction();
        throw;
    }
    dataset.reset();  // closing writes too: what GDAL defers
    if (scope.failed()) {
        fail(path, scope);
    }
}

void save_in_database(const std::string& path, const Model& model, const JournalEntry& entry, bool overwrite) {
    GdalScope scope;
    const char* const drivers[] = {"PostgreSQL", nullptr};
    Dataset dataset(GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_UPDATE, drivers, nullptr, nullptr));
    if (!dataset) {
        fail(path, scope);
    }
    if (!overwrite && dataset->GetLayerByName(schema::meta)) {
        throw Error(path +
                    " holds a model already; give `overwrite` to replace it, or another schema (active_schema=…)");
    }
    scope.clear();
    write_transaction(dataset, scope, path, model, entry);
}

/// SQLite's own files beside the temporary one, gone with it whatever happens.
struct SideFiles {
    const std::string& database;
    ~SideFiles() {
        for (const char* suffix : {"-journal", "-wal", "-shm"}) {
            unlink((database + suffix).c_str());
        }
    }
};

void save_in_file(const std::string& path, const Model& model, const JournalEntry& entry, bool overwrite) {
    OutputFile file(path, overwrite);
    file.close();
    const SideFiles side_files{file.temporary_path()};
    unlink(file.temporary_path().c_str());  // the driver insists on making it
    {
        GdalScope scope;
        const CreationSettings settings;
        const std::string time = iso8601(current_time(), "%Y-%m-%dT%H:%M:%S.000Z");
        const GdalOption now("OGR_CURRENT_DATE", time.c_str());
        GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName("GPKG");
        Dataset dataset(driver ? driver->Create(file.temporary_path().c_str(), 0, 0, 0, GDT_Unknown, nullptr)
                               : nullptr);
        if (!dataset) {
            fail(path, scope);
        }
        make_durable(*dataset);
        write_transaction(dataset, scope, path, model, entry);
    }
    file.commit();
}

}  // namespace

void save_model(const std::string& path, const Model& model, const JournalEntry& entry, bool overwrite) {
    require_storable(model, entry);
    if (is_connection(path)) {
        save_in_database(path, model, entry, overwrite);
    } else {
        save_in_file(path, model, entry, overwrite);
    }
}

}  // namespace terratet
