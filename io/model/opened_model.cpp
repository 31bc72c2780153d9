// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/model/opened_model.hpp"

#include <gdal_priv.h>

#include "io/model/model_guard.hpp"
#include "io/model/model_schema.hpp"
#include "io/model/sqlite_database.hpp"
#include "io/source.hpp"
#include "tess/error.hpp"

namespace terratet {

Dataset open_model(const std::string& path, GdalScope& scope) {
    VSIStatBufL status;
    roll_back_interrupted(path);
    if (!is_connection(path) && VSIStatL(path.c_str(), &status) == 0 && holds_model(path)) {
        require_plain_model(path);
    }
    const char* const drivers[] = {"GPKG", "PostgreSQL", nullptr};
    const SafeSqlite settings;
    scope.clear();
    Dataset dataset(GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY, drivers, nullptr, nullptr));
    if (!dataset) {
        const bool there = is_connection(path) || VSIStatL(path.c_str(), &status) == 0;
        throw InputError(path + (there ? ": is no GeoPackage" : ": not found") +
                         (scope.failed() ? ": " + scope.failure() : ""));
    }
    if (!dataset->GetLayerByName(schema::meta)) {
        throw InputError(path + ": is no Terratet model (it has no layer " + schema::meta + ")");
    }
    return dataset;
}

}  // namespace terratet
