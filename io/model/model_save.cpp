// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <unistd.h>
#include <functional>
#include <memory>

#include "io/base/current_time.hpp"
#include "io/base/output_file.hpp"
#include "io/model/model_rows.hpp"
#include "io/model/model_schema.hpp"
#include "io/model/model_styles.hpp"
#include "io/model/sqlite_rows.hpp"
#include "io/model_store.hpp"
#include "io/source.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

/// A layer to write to, new or there already.
using LayerSource = std::function<std::unique_ptr<RowWriter>(const char* name, OGRwkbGeometryType type)>;

/// Makes all layers of a model, and unless `empty` fills them.
class ModelWriter {
  public:
    ModelWriter(const LayerSource& layers, const Model& model, bool empty)
        : layers_(layers), model_(model), rows_(model), empty_(empty) {}

    void write(const JournalEntry& entry) {
        add<schema::BoreholeColumns>(schema::boreholes, wkbLineStringZM, [&](RowWriter& to, const auto& columns) {
            for (std::size_t i = 0; i < model_.boreholes.size(); ++i) {
                rows_.borehole(to, columns, i);
            }
        });
        add(
            schema::samples, wkbPoint25D, [&](RowWriter& to) { return rows_.sample_columns(to); },
            [&](RowWriter& to, const auto& columns) {
                for (std::size_t i = 0; i < model_.samples.size(); ++i) {
                    rows_.sample(to, columns, i);
                }
            });
        add<schema::SurfaceColumns>(schema::surfaces, wkbMultiPolygon25D, [&](RowWriter& to, const auto& columns) {
            for (std::size_t i = 0; i < model_.surfaces.size(); ++i) {
                rows_.surface(to, columns, i);
            }
            for (std::size_t f = 0; f < model_.barriers.size(); ++f) {
                rows_.barrier_part(to, columns, f, false);
                rows_.barrier_part(to, columns, f, true);
            }
        });
        add(
            schema::vertices, wkbPoint25D, [&](RowWriter& to) { return rows_.vertex_columns(to); },
            [&](RowWriter& to, const auto& columns) {
                for (std::size_t i = 0; i < model_.vertices.size(); ++i) {
                    rows_.vertex(to, columns, i);
                }
            });
        add<schema::MetaColumns>(schema::meta, wkbNone, [&](RowWriter& to, const auto& columns) {
            for (const auto& [key, value] : rows_.meta()) {
                to.set(columns.key, key);
                to.set(columns.value, value);
                to.write();
            }
        });
        add<schema::JournalColumns>(schema::journal, wkbNone, [&](RowWriter& to, const auto& columns) {
            to.set(columns.edit, entry.edit);
            to.set(columns.time, entry.time.empty() ? current_time_text() : entry.time);
            to.set(columns.command, entry.command);
            to.set(columns.arguments, entry.arguments);
            to.write();
        });
        add<schema::ChangeColumns>(schema::changes, wkbNone, [](RowWriter&, const auto&) {});
    }

  private:
    template <typename ColumnsOf, typename Fill>
    void add(const char* name, OGRwkbGeometryType type, const ColumnsOf& columns_of, const Fill& fill) {
        const std::unique_ptr<RowWriter> layer = layers_(name, type);
        const auto columns = columns_of(*layer);
        layer->create();
        if (!empty_) {
            fill(*layer, columns);
        }
        layer->finish();
    }
    template <typename Columns, typename Fill>
    void add(const char* name, OGRwkbGeometryType type, const Fill& fill) {
        add(
            name, type, [](RowWriter& to) { return Columns(to); }, fill);
    }

    const LayerSource& layers_;
    const Model& model_;
    ModelRows rows_;
    bool empty_;
};

[[noreturn]] void fail(const std::string& path, const GdalScope& scope) {
    throw Error("cannot write " + path + because(scope));
}

/// SQLite's settings while a new database is made, whatever the environment's OGR_SQLITE_… variables say. The driver
/// makes its tables in a hundred transactions of their own; nobody sees the file yet, so these need not wait for the
/// disk: the rows, which come after, do.
struct CreationSettings {
    GdalOption journal{"OGR_SQLITE_JOURNAL", "DELETE"};
    GdalOption synchronous{"OGR_SQLITE_SYNCHRONOUS", "OFF"};
    GdalOption pragma{"OGR_SQLITE_PRAGMA", ""};
};

/// By GDAL, in one transaction around everything: all or nothing.
void write_transaction(Dataset& dataset, GdalScope& scope, const std::string& path, const Model& model,
                       const JournalEntry& entry, bool empty) {
    if (dataset->StartTransaction() != OGRERR_NONE) {
        fail(path, scope);
    }
    try {
        OGRSpatialReference reference;  // a text that is no CRS (or none) leaves the layers without; meta has the text
        bool has_reference = false;
        if (const GdalScope quiet; !model.frame.crs_wkt.empty()) {
            has_reference = reference.importFromWkt(model.frame.crs_wkt.c_str()) == OGRERR_NONE;
            reference.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
        }
        const LayerSource layers = [&](const char* name, OGRwkbGeometryType type) {
            return std::make_unique<LayerWriter>(*dataset, scope, path, name, type,
                                                 has_reference && type != wkbNone ? &reference : nullptr);
        };
        ModelWriter(layers, model, empty).write(entry);
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
    write_transaction(dataset, scope, path, model, entry, false);
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

/// Into the empty layers, by SQLite: GDAL would take ten times as long.
void fill(const std::string& file, const std::string& path, const Model& model, const JournalEntry& entry,
          const std::string& time) {
    SqliteDatabase database(file, path);
    SqliteTransaction transaction(database);
    const LayerSource layers = [&](const char* name, OGRwkbGeometryType) {
        return std::make_unique<SqliteRowWriter>(database, name);
    };
    ModelWriter(layers, model, false).write(entry);
    write_styles(database, model, time);
    transaction.commit();
}

void save_in_file(const std::string& path, const Model& model, const JournalEntry& entry, const SaveOptions& options) {
    OutputFile file(path, options.overwrite);
    file.close();
    const SideFiles side_files{file.temporary_path()};
    unlink(file.temporary_path().c_str());  // the driver insists on making it
    const CreationSettings settings;
    const GeoPackageTime now;
    {
        GdalScope scope;
        GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName("GPKG");
        Dataset dataset(driver ? driver->Create(file.temporary_path().c_str(), 0, 0, 0, GDT_Unknown, nullptr)
                               : nullptr);
        if (!dataset) {
            fail(path, scope);
        }
        write_transaction(dataset, scope, path, model, entry, true);
    }
    fill(file.temporary_path(), path, model, entry, now.text());
    if (options.spatial_index) {
        write_spatial_indices(file.temporary_path(), path);
    }
    file.commit();
}

}  // namespace

void save_model(const std::string& path, const Model& model, const JournalEntry& entry, const SaveOptions& options) {
    require_storable(model);
    for (const std::string* text : {&entry.time, &entry.command, &entry.arguments}) {
        require_storable(*text, "the journal entry");
    }
    if (is_connection(path)) {
        save_in_database(path, model, entry, options.overwrite);
    } else {
        save_in_file(path, model, entry, options);
    }
}

}  // namespace terratet
