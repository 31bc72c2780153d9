// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Opening vector sources with GDAL, for the readers of this floor: never installed.

#include <gdal_priv.h>

#include <memory>
#include <string>

#include "io/base/crs.hpp"
#include "io/base/gdal_scope.hpp"
#include "io/source.hpp"

namespace terratet {

struct DatasetCloser {
    void operator()(GDALDataset* dataset) const { GDALClose(dataset); }
};
using Dataset = std::unique_ptr<GDALDataset, DatasetCloser>;

/// Opens read-only with a list of allowed drivers: GDAL's DXF reader can hang on hostile input, its GML one writes
/// beside the file. A text file without a known extension is tried as CSV. Throws InputError: not found, a folder,
/// empty, binary, UTF-16, of no known format.
Dataset open_vector(const Source& source);

/// Is this a table in text (CSV and its kin), and of no other known format? Throws InputError as open_vector does for
/// what is not there, empty, or called CSV and is none.
bool is_text_table(const Source& source);

/// The layer that `source` names: by sql, by name, or the first; the filter set. Throws InputError (lists the layers
/// there are). `result_set` releases the result of a statement; keep it as long as the layer.
struct ResultSetReleaser {
    GDALDataset* dataset = nullptr;
    void operator()(OGRLayer* layer) const { dataset->ReleaseResultSet(layer); }
};
using ResultSet = std::unique_ptr<OGRLayer, ResultSetReleaser>;
OGRLayer& open_layer(GDALDataset& dataset, const Source& source, const GdalScope& scope, ResultSet& result_set);

/// What to say when the layer is the first of several and nobody named it: the others. Empty otherwise.
std::string other_layers(GDALDataset& dataset, OGRLayer& layer, const Source& source);

/// What the layer states; empty when that is nothing.
Crs crs_of(OGRLayer& layer);

}  // namespace terratet
