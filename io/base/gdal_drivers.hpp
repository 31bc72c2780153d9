// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// GDAL's drivers that files are opened with. Others hang on hostile files (DXF), write beside them (GML), or call
/// servers that the file names (VRT, WMS, WFS).

#include <array>

namespace terratet {

constexpr std::array<const char*, 14> vector_drivers{
    "CSV",    "XLSX",       "XLS",     "ODS",        "GPKG",        "ESRI Shapefile", "PostgreSQL",
    "SQLite", "FlatGeobuf", "GeoJSON", "GeoJSONSeq", "OpenFileGDB", "MapInfo File",   nullptr};

/// What the writers use besides.
constexpr std::array<const char*, 1> writing_drivers{"COG"};

constexpr std::array<const char*, 14> raster_drivers{"GTiff", "AAIGrid", "GRASSASCIIGrid", "EHdr", "ENVI",
                                                     "HFA",   "SRTMHGT", "DTED",           "GSAG", "GSBG",
                                                     "GS7BG", "netCDF",  "ZMap",           nullptr};

}  // namespace terratet
