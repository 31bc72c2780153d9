// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/gdal_dataset.hpp"
#include "io/base/file_bytes.hpp"

#include <ogrsf_frmts.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "io/base/gdal_drivers.hpp"
#include "io/base/text_lines.hpp"
#include "tess/error.hpp"

namespace terratet {

namespace {

/// The file behind `CSV:path`.
std::string plain_path(const std::string& path) {
    return path.starts_with("CSV:") ? path.substr(4) : path;
}

bool is_stream(const std::string& path) {
    return path.starts_with("/vsistdin/");
}

enum class Content { text, utf16, binary };

Content classify(const std::string& head) {
    if (head.starts_with("\xFF\xFE") || head.starts_with("\xFE\xFF")) {
        return Content::utf16;
    }
    return head.find('\0') == std::string::npos ? Content::text : Content::binary;
}

/// A file with this extension is read by the CSV driver whatever it holds.
bool is_csv_name(const std::string& path) {
    const std::string extension = CPLGetExtension(path.c_str());
    return std::ranges::any_of(std::array{"csv", "tsv", "psv"},
                               [&](const char* known) { return EQUAL(extension.c_str(), known); });
}

void require_file(const Source& source, const std::string& path) {
    VSIStatBufL status;
    if (VSIStatL(path.c_str(), &status) != 0) {
        throw InputError(source.describe() + ": not found");
    }
    if (VSI_ISDIR(status.st_mode) && !EQUAL(CPLGetExtension(path.c_str()), "gdb")) {
        throw InputError(source.describe() + ": is a folder; name a file in it");
    }
    if (!VSI_ISDIR(status.st_mode) && status.st_size == 0) {
        throw InputError(source.describe() + ": the file is empty");
    }
}

/// Can this be a table in text, and no other kind of text?
bool looks_like_text_table(const std::string& head) {
    const std::size_t first = head.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
    return classify(head) == Content::text && first != std::string::npos && head[first] != '<' && head[first] != '{' &&
           !head.starts_with("[{") && !head.starts_with("GOCAD") && !head.starts_with("# vtk DataFile") &&
           !head.starts_with("%PDF") && !head.starts_with("$MeshFormat");
}

/// What a file is that no driver reads, and what to do with it; empty: nobody knows.
std::string stranger(const std::string& path, const std::string& head) {
    const std::string extension = CPLGetExtension(path.c_str());
    const auto named = [&](const char* other) { return EQUAL(extension.c_str(), other); };
    if (head.starts_with("PK\x03\x04")) {
        const std::string inside = "/vsizip/" + path;
        const CPLStringList names(VSIReadDirRecursive(inside.c_str()));
        std::string list;
        for (int i = 0; i < std::min(names.Count(), 5); ++i) {
            list += (list.empty() ? "" : ", ") + to_utf8(names[i]);
        }
        return list.empty() ? ""
                            : "is a zip archive; name a file in it, as " + inside + "/" + to_utf8(names[0]) +
                                  " (it holds " + list + (names.Count() > 5 ? ", …)" : ")");
    }
    if (head.starts_with("\x1F\x8B")) {
        return "is compressed by gzip; name it /vsigzip/" + path;
    }
    if (head.starts_with("%PDF")) {
        return "is a PDF; export its table as CSV or XLSX";
    }
    if (head.find("Standard Jet DB") < 40 || head.find("Standard ACE DB") < 40) {
        return "is an Access database; export its tables as CSV or XLSX";
    }
    if (head.starts_with("AC10") && named("dwg")) {
        return "is a DWG; save it as DXF with 3DFACEs or polyface meshes";
    }
    if (head.find("<kml") != std::string::npos || head.find("<gpx") != std::string::npos ||
        head.find("<gml") != std::string::npos || head.find("opengis.net/gml") != std::string::npos) {
        return "is XML of maps (KML, GPX, GML), which is not read; convert it: ogr2ogr out.gpkg " +
               to_utf8(CPLGetFilename(path.c_str()));
    }
    if (head.find("<LandXML") != std::string::npos) {
        return "is LandXML, which is not read; export its surface as DXF (3DFACE), OBJ or STL";
    }
    if (head.find("<VTKFile") != std::string::npos || head.starts_with("# vtk DataFile")) {
        return "is a VTK file that is none of triangles; save its surface as VTP";
    }
    if (head.starts_with("glTF") || named("gltf")) {
        return "is glTF, which is written and not read; export OBJ, PLY or STL";
    }
    if (head.starts_with("$MeshFormat")) {
        return "is a Gmsh mesh, which is written and not read; save it as STL or PLY";
    }
    return "";
}

Dataset try_open(const std::string& path, const Source& source) {
    CPLStringList options;
    for (const std::string& option : source.open_options) {
        options.AddString(option.c_str());
    }
    return Dataset(GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY, vector_drivers.data(),
                                     options.List(), nullptr));
}

std::string reason(const GdalScope& scope) {
    return scope.failed() ? " (" + scope.failure() + ")" : "";
}

std::string layer_names(GDALDataset& dataset) {
    std::string names;
    for (const OGRLayer* layer : dataset.GetLayers()) {
        names += (names.empty() ? "" : ", ") + to_utf8(const_cast<OGRLayer*>(layer)->GetName());
    }
    return names.empty() ? "none" : names;
}

OGRLayer* find_layer(GDALDataset& dataset, const Source& source, const GdalScope& scope, ResultSet& result_set) {
    if (!source.sql.empty()) {
        result_set = ResultSet(dataset.ExecuteSQL(source.sql.c_str(), nullptr, nullptr), {&dataset});
        if (!result_set) {
            throw InputError(source.describe() + ": the statement '" + source.sql + "' gives no rows" + reason(scope));
        }
        return result_set.get();
    }
    OGRLayer* const layer = source.layer.empty() ? dataset.GetLayer(0) : dataset.GetLayerByName(source.layer.c_str());
    if (layer == nullptr) {
        throw InputError(source.path + (source.layer.empty() ? ": has no layer" : ": has no layer " + source.layer) +
                         "; layers: " + layer_names(dataset));
    }
    return layer;
}

}  // namespace

namespace {

/// The beginning of a file that is there and can be what its name says; empty for a connection.
std::string checked_head(const Source& source) {
    const std::string path = plain_path(source.path);
    if (is_connection(source.path)) {
        return "";
    }
    if (!is_stream(path)) {
        require_file(source, path);
    }
    std::string head = file_bytes(path, 0, 4096);
    if (is_csv_name(path) && classify(head) == Content::binary) {
        throw InputError(source.describe() + ": holds binary data, not a table in text");
    }
    return head;
}

/// GDAL makes nonsense of it.
void refuse_utf16(const Source& source, const std::string& head) {
    if (classify(head) == Content::utf16) {
        throw InputError(source.describe() +
                         ": is UTF-16 text, which filters, statements and GDAL's options do not "
                         "understand; save it as UTF-8");
    }
}

}  // namespace

bool is_text_table(const Source& source) {
    const GdalScope scope(source.path);
    const std::string head = checked_head(source);
    const std::string path = plain_path(source.path);
    if (path != source.path || is_csv_name(path) || classify(head) == Content::utf16) {
        return !head.empty();
    }
    return looks_like_text_table(head) &&
           (is_stream(path) ||
            GDALIdentifyDriverEx(path.c_str(), GDAL_OF_VECTOR, vector_drivers.data(), nullptr) == nullptr);
}

Dataset open_vector(const Source& source) {
    const GdalScope scope(source.path);
    const SafeSqlite settings;
    const std::string path = plain_path(source.path);
    const bool file = !is_connection(source.path);
    const std::string head = checked_head(source);
    refuse_utf16(source, head);
    Dataset dataset = try_open(source.path, source);
    if (!dataset && file && path == source.path && looks_like_text_table(head)) {
        dataset = try_open("CSV:" + path, source);
    }
    if (const std::string what = dataset ? "" : stranger(path, head); !what.empty()) {
        throw InputError(source.describe() + ": " + what);
    }
    if (!dataset) {
        throw InputError(
            source.describe() +
            ": no table that can be read (CSV, XLSX, ODS, XLS, GeoPackage, Shapefile, FlatGeobuf, GeoJSON, "
            "FileGDB, SQLite, MapInfo, PostGIS)" +
            reason(scope));
    }
    const std::string driver = dataset->GetDriver() == nullptr ? "" : dataset->GetDriver()->GetDescription();
    if (scope.failed() && (driver == "XLSX" || driver == "ODS")) {  // texts would be missing, or stand for others
        throw InputError(source.describe() + ": is damaged, or made to do harm" + reason(scope));
    }
    return dataset;
}

OGRLayer& open_layer(GDALDataset& dataset, const Source& source, const GdalScope& scope, ResultSet& result_set) {
    OGRLayer* const layer = find_layer(dataset, source, scope, result_set);
    if (!source.where.empty() && layer->SetAttributeFilter(source.where.c_str()) != OGRERR_NONE) {
        throw InputError(source.describe() + ": the filter where=" + source.where + " is not understood" +
                         reason(scope));
    }
    return *layer;
}

std::string other_layers(GDALDataset& dataset, OGRLayer& layer, const Source& source) {
    if (!source.layer.empty() || !source.sql.empty() || dataset.GetLayerCount() < 2) {
        return "";
    }
    std::string others;
    for (OGRLayer* const other : dataset.GetLayers()) {
        others += other == &layer ? "" : (others.empty() ? "" : ", ") + to_utf8(other->GetName());
    }
    return "of " + std::to_string(dataset.GetLayerCount()) + " layers the first one, " + to_utf8(layer.GetName()) +
           ", is read; the others are " + others + " (layer= names one)";
}

Crs crs_of(OGRLayer& layer) {
    const OGRSpatialReference* const reference = layer.GetSpatialRef();
    char* wkt = nullptr;
    const char* const options[] = {"FORMAT=WKT2_2019", nullptr};
    const bool stated = reference && reference->exportToWkt(&wkt, options) == OGRERR_NONE;
    Crs crs = stated ? crs_from_wkt(wkt) : Crs{};
    CPLFree(wkt);
    return crs;
}

}  // namespace terratet
