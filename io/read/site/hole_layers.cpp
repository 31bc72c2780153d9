// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read/site/hole_layers.hpp"

#include <ogrsf_frmts.h>

#include <algorithm>

#include "io/base/gdal_dataset.hpp"
#include "io/base/text_lines.hpp"

namespace terratet {

LayerUse use_of(const Table& titles, bool points, const ColumnNames& names) {
    const auto has = [&](Meaning meaning) { return find_optional_column(titles, meaning, names) >= 0; };
    if (!has(Meaning::id)) {
        return LayerUse::other;
    }
    if (has(Meaning::from) && has(Meaning::to)) {
        return LayerUse::log;
    }
    if (has(Meaning::depth) && has(Meaning::azimuth) && has(Meaning::dip)) {
        return LayerUse::survey;
    }
    if (points || (has(Meaning::x) && has(Meaning::y))) {
        return LayerUse::collar;
    }
    return has(Meaning::depth) ? LayerUse::log : LayerUse::other;
}

std::vector<HoleLayer> hole_layers(const Source& source, const ColumnNames& names) {
    if (!source.layer.empty() || !source.sql.empty() || source.path.find("/vsistdin/") != std::string::npos) {
        return {};
    }
    if (is_text_table(source)) {
        return {};  // one table, and split here rather than by GDAL
    }
    const GdalScope scope(source.path);
    const Dataset dataset = open_vector(source);
    std::vector<HoleLayer> layers;
    for (int i = 0; i < dataset->GetLayerCount(); ++i) {
        OGRLayer& layer = *dataset->GetLayer(i);
        const OGRFeatureDefn& definition = *layer.GetLayerDefn();
        Table titles;
        for (int field = 0; field < definition.GetFieldCount(); ++field) {
            titles.columns.push_back(to_utf8(trimmed(definition.GetFieldDefn(field)->GetNameRef())));
        }
        const OGRwkbGeometryType type = wkbFlatten(layer.GetGeomType());
        const bool points = type == wkbPoint || type == wkbMultiPoint;
        layers.push_back({to_utf8(layer.GetName()), use_of(titles, points, names), titles.columns});
    }
    return layers;
}

const char* to_string(LayerUse use) {
    switch (use) {
        case LayerUse::collar:
            return "collar";
        case LayerUse::survey:
            return "survey";
        case LayerUse::log:
            return "log";
        case LayerUse::other:
            break;
    }
    return "other";
}

}  // namespace terratet
