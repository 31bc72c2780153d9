// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/write/seen_output.hpp"

#include <cpl_vsi.h>
#include <fmt/format.h>
#include <gdal_priv.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "io/base/crs.hpp"
#include "io/base/file_bytes.hpp"
#include "io/base/gdal_drivers.hpp"
#include "io/base/gdal_scope.hpp"
#include "io/source.hpp"
#include "tess/error.hpp"

namespace terratet {

namespace {

using Json = nlohmann::json;

constexpr std::size_t head_size = 1 << 16;
constexpr std::size_t largest_json = 256U << 20U;

std::uint32_t word_at(const std::string& bytes, std::size_t at) {
    std::uint32_t word = 0;
    for (int i = 3; i >= 0; --i) {
        word = word << 8U | static_cast<unsigned char>(bytes.at(at + static_cast<std::size_t>(i)));
    }
    return word;
}

std::string text_of(const Json& object, const char* key) {
    const auto found = object.is_object() ? object.find(key) : object.end();
    return object.is_object() && found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

const Json& list_of(const Json& object, const char* key) {
    static const Json none = Json::array();
    const auto found = object.is_object() ? object.find(key) : object.end();
    return object.is_object() && found != object.end() && found->is_array() ? *found : none;
}

std::optional<Vec3> vector_of(const Json& list) {
    const bool numbers =
        list.is_array() && list.size() == 3 && std::ranges::all_of(list, [](const Json& n) { return n.is_number(); });
    return numbers ? std::optional(Vec3{list[0].get<double>(), list[1].get<double>(), list[2].get<double>()})
                   : std::nullopt;
}

std::vector<std::string> names_in(const Json& list) {
    std::vector<std::string> names;
    for (const Json& item : list) {
        if (const std::string name = text_of(item, "name"); !name.empty()) {
            names.push_back(name);
        }
    }
    return names;
}

/// The box of all positions, from y up to z up, at the origin that the file states.
Box3 gltf_extent(const Json& document, const Vec3& origin) {
    Box3 box;
    const Json& accessors = list_of(document, "accessors");
    for (const Json& mesh : list_of(document, "meshes")) {
        for (const Json& primitive : list_of(mesh, "primitives")) {
            const Json attributes =
                primitive.is_object() ? primitive.value("attributes", Json::object()) : Json::object();
            const auto position = attributes.is_object() ? attributes.find("POSITION") : attributes.end();
            if (!attributes.is_object() || position == attributes.end() || !position->is_number_unsigned() ||
                position->get<std::size_t>() >= accessors.size()) {
                continue;
            }
            const Json& accessor = accessors[position->get<std::size_t>()];
            const auto lo = vector_of(list_of(accessor, "min"));
            const auto hi = vector_of(list_of(accessor, "max"));
            if (lo && hi) {
                box.extend({origin.x + lo->x, origin.y - hi->z, origin.z + lo->y});
                box.extend({origin.x + hi->x, origin.y - lo->z, origin.z + hi->y});
            }
        }
    }
    return box;
}

/// The name of what a file carries as WKT.
std::string crs_label(const std::string& text) {
    const Crs crs = crs_from_wkt(text);
    return crs.empty() ? text.substr(0, 120) : crs.name;
}

SeenOutput see_gltf(const std::string& path, const std::string& text, const char* format) {
    const Json document = Json::parse(text, nullptr, false);
    if (document.is_discarded() || !document.is_object()) {
        throw InputError(path + ": a glTF file whose JSON is damaged");
    }
    const Json asset = document.value("asset", Json::object());
    const Json extras = asset.is_object() ? asset.value("extras", Json::object()) : Json::object();
    SeenOutput seen;
    seen.format = fmt::format("glTF {}{}", text_of(asset, "version"), format);
    seen.crs = text_of(extras, "crs_name").empty() ? crs_label(text_of(extras, "crs")) : text_of(extras, "crs_name");
    seen.extent = gltf_extent(document, vector_of(list_of(extras, "origin")).value_or(Vec3{0, 0, 0}));
    seen.facts.emplace_back("meshes", std::to_string(list_of(document, "meshes").size()));
    seen.facts.emplace_back("made by", text_of(asset, "generator"));
    seen.lists.emplace_back("nodes", names_in(list_of(document, "nodes")));
    std::vector<std::string> extensions;
    for (const Json& name : list_of(document, "extensionsUsed")) {
        if (name.is_string()) {
            extensions.push_back(name.get<std::string>());
        }
    }
    seen.lists.emplace_back("extensions", extensions);
    return seen;
}

SeenOutput see_glb(const std::string& path, const std::string& head) {
    if (head.size() < 20) {
        throw InputError(path + ": a GLB file cut short");
    }
    const std::size_t length = word_at(head, 12);
    const std::string text = length <= largest_json ? file_bytes(path, 20, length) : "";
    if (text.size() != length) {
        throw InputError(path + ": a GLB file cut short: its JSON is not whole");
    }
    return see_gltf(path, text, " binary");
}

/// The value of an attribute in a tag's text.
std::string attribute(std::string_view tag, const std::string& name) {
    const std::size_t at = tag.find(" " + name + "=\"");
    if (at == std::string_view::npos) {
        return {};
    }
    const std::size_t begin = at + name.size() + 3;
    return std::string(tag.substr(begin, tag.find('"', begin) - begin));
}

/// VTK's XML: what stands before the data.
SeenOutput see_vtk(const std::string& head) {
    const std::string text = head.substr(0, head.find("<AppendedData"));
    SeenOutput seen;
    const std::string type = attribute(text, "type");
    seen.format = "VTK " + (type.empty() ? "file" : type);
    std::string part;
    std::vector<std::string> points, cells, files;
    for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at + 1)) {
        const std::string_view tag = std::string_view(text).substr(at, text.find('>', at) - at);
        if (tag.starts_with("<Piece")) {
            seen.facts.emplace_back("points", attribute(tag, "NumberOfPoints"));
            seen.facts.emplace_back("cells", attribute(tag, "NumberOfCells").empty() ? attribute(tag, "NumberOfPolys")
                                                                                     : attribute(tag, "NumberOfCells"));
        } else if (tag.starts_with("<PointData") || tag.starts_with("<CellData") || tag.starts_with("<FieldData")) {
            part = tag.substr(1, 5);
        } else if (tag.starts_with("</PointData") || tag.starts_with("</CellData") || tag.starts_with("</FieldData")) {
            part.clear();
        } else if (tag.starts_with("<DataSet")) {
            files.push_back(attribute(tag, "file"));
        } else if (tag.starts_with("<DataArray") && !part.empty() && part != "Field") {
            (part == "Point" ? points : cells).push_back(attribute(tag, "Name"));
        }
    }
    seen.lists = {{"point data", points}, {"cell data", cells}, {"files", files}};
    return seen;
}

SeenOutput see_vdb(const std::string& path) {
    openvdb::initialize();
    openvdb::io::File file(path);
    SeenOutput seen;
    seen.format = "OpenVDB";
    try {
        file.open();
        const openvdb::GridPtrVecPtr grids = file.readAllGridMetadata();
        std::vector<std::string> names;
        for (const auto& grid : *grids) {
            const openvdb::Vec3d size = grid->voxelSize();
            names.push_back(fmt::format("{} ({}, voxels {:g} x {:g} x {:g})", grid->getName(), grid->valueType(),
                                        size.x(), size.y(), size.z()));
            const auto lo = grid->metaValue<openvdb::Vec3i>("file_bbox_min");
            const auto hi = grid->metaValue<openvdb::Vec3i>("file_bbox_max");
            if (lo.x() <= hi.x()) {
                const openvdb::Vec3d a = grid->indexToWorld(openvdb::Vec3d(lo.x() - 0.5, lo.y() - 0.5, lo.z() - 0.5));
                const openvdb::Vec3d b = grid->indexToWorld(openvdb::Vec3d(hi.x() + 0.5, hi.y() + 0.5, hi.z() + 0.5));
                seen.extent.extend({a.x(), a.y(), a.z()});
                seen.extent.extend({b.x(), b.y(), b.z()});
            }
        }
        if (!grids->empty() && grids->front()->getMetadata<openvdb::StringMetadata>("crs")) {
            seen.crs = crs_label(grids->front()->metaValue<std::string>("crs"));
        }
        const openvdb::MetaMap::Ptr meta = file.getMetadata();
        for (auto item = meta->beginMeta(); meta && item != meta->endMeta(); ++item) {
            const std::string value = item->second->str();
            if (item->first == "crs" || item->first == "crs_name") {
                seen.crs = crs_label(value);
            } else if (value.size() < 120) {
                seen.facts.emplace_back(item->first, value);
            }
        }
        seen.lists.emplace_back("grids", names);
        file.close();
    } catch (const std::exception& error) {
        throw InputError(fmt::format("{}: a VDB file that cannot be read ({})", path, error.what()));
    }
    return seen;
}

/// Rasters and cubes, by GDAL.
std::optional<SeenOutput> see_raster(const std::string& path) {
    const GdalScope quiet(path);
    GDALDataset* const dataset =
        GDALDataset::Open(path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, raster_drivers.data());
    if (dataset == nullptr) {
        return std::nullopt;
    }
    SeenOutput seen;
    seen.format = fmt::format("raster ({})", dataset->GetDriver()->GetDescription());
    seen.facts.emplace_back("columns", std::to_string(dataset->GetRasterXSize()));
    seen.facts.emplace_back("rows", std::to_string(dataset->GetRasterYSize()));
    seen.facts.emplace_back("bands", std::to_string(dataset->GetRasterCount()));
    if (const OGRSpatialReference* const reference = dataset->GetSpatialRef(); reference && reference->GetName()) {
        seen.crs = reference->GetName();
    }
    std::array<double, 6> map{};
    if (dataset->GetGeoTransform(map.data()) == CE_None) {
        for (const int column : {0, dataset->GetRasterXSize()}) {
            for (const int row : {0, dataset->GetRasterYSize()}) {
                seen.extent.extend(
                    {map[0] + column * map[1] + row * map[2], map[3] + column * map[4] + row * map[5], 0});
            }
        }
    }
    std::vector<std::string> bands;
    for (int band = 1; band <= std::min(dataset->GetRasterCount(), 1000); ++band) {
        const std::string text = dataset->GetRasterBand(band)->GetDescription();
        if (!text.empty()) {
            bands.push_back(text);
        }
    }
    seen.lists.emplace_back("bands described", bands);
    GDALClose(dataset);
    return seen;
}

/// PFLOTRAN's explicit grid, "CELLS n", or its implicit one: how many cells and vertices, then a cell a line, its kind
/// first.
std::optional<SeenOutput> see_pflotran(const std::string& head) {
    std::istringstream text(head);
    std::string first;
    std::string second;
    std::string kind;
    text >> first >> second;
    const auto is_count = [](const std::string& word) {
        return !word.empty() && std::ranges::all_of(word, [](unsigned char c) { return std::isdigit(c) != 0; });
    };
    if (first == "CELLS" && is_count(second)) {
        SeenOutput seen;
        seen.format = "PFLOTRAN explicit unstructured grid";
        seen.facts = {{"cells", second}};
        return seen;
    }
    if (is_count(first) && is_count(second) && text >> kind &&
        (kind == "T" || kind == "H" || kind == "W" || kind == "P")) {
        SeenOutput seen;
        seen.format = "PFLOTRAN implicit unstructured grid";
        seen.facts = {{"cells", first}, {"vertices", second}};
        return seen;
    }
    return std::nullopt;
}

}  // namespace

std::optional<SeenOutput> see_output(const std::string& path) {
    if (is_connection(path) || path.find("/vsistdin/") != std::string::npos) {
        return std::nullopt;
    }
    const std::string head = file_bytes(path, 0, head_size);
    const std::string_view start = std::string_view(head).substr(0, std::min<std::size_t>(head.size(), 2000));
    const auto plain = [](const char* format) { return SeenOutput{format, "", {}, {}, {}}; };
    if (head.starts_with("glTF")) {
        return see_glb(path, head);
    }
    if (start.find("<VTKFile") != std::string_view::npos) {
        return see_vtk(head);
    }
    if (head.size() > 8 && head.compare(0, 4, " BDV") == 0) {
        return see_vdb(path);
    }
    if (head.starts_with("\x89PNG")) {
        SeenOutput seen = plain("PNG picture");
        if (head.size() > 24) {
            const auto big = [&](std::size_t at) {
                std::uint32_t word = 0;
                for (std::size_t i = 0; i < 4; ++i) {
                    word = word << 8U | static_cast<unsigned char>(head[at + i]);
                }
                return std::to_string(word);
            };
            seen.facts = {{"width", big(16)}, {"height", big(20)}};
        }
        return seen;
    }
    if (head.starts_with("$MeshFormat")) {
        SeenOutput seen = plain("Gmsh mesh");
        const std::size_t line = head.find('\n') + 1;
        seen.format = "Gmsh mesh " + head.substr(line, head.find_first_of(" \n", line) - line);
        return seen;
    }
    if (auto seen = see_pflotran(head)) {
        return seen;
    }
    if (start.find("<html") != std::string_view::npos || start.starts_with("<!DOCTYPE html") ||
        start.starts_with("<!doctype html")) {
        SeenOutput seen = plain("HTML page");
        const std::size_t title = head.find("<title>");
        if (title != std::string::npos) {
            seen.facts.emplace_back("title", head.substr(title + 7, head.find("</title>", title) - title - 7));
        }
        return seen;
    }
    if (start.find("<svg") != std::string_view::npos) {
        return plain("SVG picture");
    }
    const std::size_t first = start.find_first_not_of(" \t\r\n");
    if (first != std::string_view::npos && start[first] == '{' && head.find("\"asset\"") != std::string::npos) {
        const std::string text = file_bytes(path, 0, largest_json);
        const Json document = Json::parse(text, nullptr, false);
        if (document.is_object() && document.contains("geometricError")) {
            SeenOutput seen = plain("3D Tiles tileset");
            seen.format += " " + text_of(document.value("asset", Json::object()), "version");
            seen.facts.emplace_back("geometric error", document["geometricError"].dump());
            return seen;
        }
        return document.is_object() && (document.contains("meshes") || document.contains("scenes"))
                   ? std::optional(see_gltf(path, text, ""))
                   : std::nullopt;
    }
    if (head.starts_with("II*") || head.starts_with(std::string("MM\0*", 4)) || head.starts_with("II+") ||
        head.starts_with("CDF") || head.starts_with("\x89HDF")) {
        return see_raster(path);
    }
    return std::nullopt;
}

}  // namespace terratet
