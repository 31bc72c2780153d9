// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// The scene as a page: io/write/scene_page with the model in it.

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "io/base/output_file.hpp"
#include "io/export.hpp"
#include "io/style/markup.hpp"
#include "io/style/property_title.hpp"
#include "io/write/scene/gltf_document.hpp"
#include "io/write/scene/picture.hpp"
#include "io/write/scene/scene_page.hpp"
#include "io/write/scene/scene_text.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

using Json = GltfBuffers::Json;

/// As a script's text: no end tag can be in it.
std::string script_json(const Json& json) {
    std::string out;
    for (const char c : json.dump(-1, ' ', false, Json::error_handler_t::replace)) {
        c == '<' ? out += "\\u003c" : out += c;
    }
    return out;
}

std::string gzipped(const std::string& bytes) {
    z_stream stream{};
    constexpr int gzip = 15 + 16;
    if (deflateInit2(&stream, 9, Z_DEFLATED, gzip, 9, Z_DEFAULT_STRATEGY) != Z_OK) {
        throw Error("zlib has no memory for the page");
    }
    std::string out(deflateBound(&stream, bytes.size()) + 64, '\0');
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream.avail_in = static_cast<uInt>(bytes.size());
    stream.next_out = reinterpret_cast<Bytef*>(out.data());
    stream.avail_out = static_cast<uInt>(out.size());
    const int result = deflate(&stream, Z_FINISH);
    out.resize(stream.total_out);
    deflateEnd(&stream);
    if (result != Z_STREAM_END) {
        throw Error("zlib could not pack the page's data");
    }
    return out;
}

Json classes_of(const std::vector<std::string>& names) {
    Json classes = Json::array();
    for (std::size_t c = 0; c < names.size(); ++c) {
        classes.push_back({{"name", names[c]}, {"color", hex(class_color(c))}});
    }
    return classes;
}

Json properties_of(const Model& model) {
    const std::vector<std::string> attributes = attribute_names(model.properties);
    Json list = Json::array();
    for (std::size_t p = 0; p < model.properties.size(); ++p) {
        const Property& property = model.properties[p];
        const ColorRange range = color_range(model, p);
        Json entry{{"name", property.name},
                   {"unit", property.unit},
                   {"scale", property.scale == Scale::log10 ? "log10" : "linear"},
                   {"attribute", attributes[p]},
                   {"low", range.low},
                   {"high", range.high},
                   {"quartiles", Json::array()}};
        if (property.kind == Kind::categorical) {
            entry["classes"] = classes_of(property.classes);
        } else {
            entry["quartiles"] = sample_quartiles(model, p);
        }
        list.push_back(std::move(entry));
    }
    return list;
}

/// Where the page's own sections are at first, and which are on.
Json sections_of(const Model& model, const ExportOptions& options) {
    Json result = Json::object();
    for (const Section& section : default_sections(model)) {
        result[section.normal.x != 0 ? "ns" : "ew"] = section.normal.x != 0 ? section.point.x : section.point.y;
    }
    const bool own = options.sections.empty();
    result.update({{"ewOn", own}, {"nsOn", own}, {"levelOn", false}, {"freeOn", false}});
    const Frame& frame = model.frame;
    const Vec3 middle = frame.to_world(model.domain.extent.center());
    for (const Section& section : options.sections) {
        const Vec3& n = section.normal;
        if (n.z != 0) {
            result.update({{"level", section.point.z}, {"levelOn", true}});
        } else if (std::abs(n.x) < 1e-9) {
            result.update({{"ew", section.point.y}, {"ewOn", true}});
        } else if (std::abs(n.y) < 1e-9) {
            result.update({{"ns", section.point.x}, {"nsOn", true}});
        } else {
            const double azimuth = std::fmod(std::atan2(-n.y, n.x) * 180 / std::numbers::pi + 360, 360);
            result.update({{"free", {azimuth, 90, dot(n, section.point - Vec3{middle.x, middle.y, section.point.z})}},
                           {"freeOn", true}});
        }
    }
    return result;
}

Json barriers_of(const Model& model) {
    Json list = Json::array();
    for (const Barrier& barrier : model.barriers) {
        Surface surface;
        for (const Vec3& p : barrier.sheet.vertices) {
            surface.vertices.push_back(model.frame.to_world(p));
        }
        surface.triangles = barrier.sheet.triangles;
        const SurfaceStatistics known = statistics(surface);
        list.push_back({{"name", barrier.name},
                        {"kind", to_string(barrier.sheet.kind)},
                        {"dip", known.dip_mean_deg},
                        {"dip_direction", known.dip_direction_deg},
                        {"area", known.area}});
    }
    return list;
}

Json holes_of(const Model& model) {
    Json list = Json::array();
    for (const Borehole& hole : model.boreholes) {
        const Vec3 collar = model.frame.to_world(hole.collar);
        list.push_back({{"id", hole.id},
                        {"length", hole.path_depth.empty() ? 0 : hole.path_depth.back()},
                        {"collar", {collar.x, collar.y, collar.z}}});
    }
    return list;
}

/// Longitudes and latitudes on a grid in plan, between which the page interpolates.
Json globe_of(const Scene& scene, const Model& model) {
    constexpr std::size_t count = 17;
    const Vec3 lo = model.frame.to_world(model.domain.extent.lo);
    const Vec3 hi = model.frame.to_world(model.domain.extent.hi);
    std::vector<Vec3> nodes;
    for (std::size_t j = 0; j < count; ++j) {
        for (std::size_t i = 0; i < count; ++i) {
            const double u = static_cast<double>(i) / (count - 1);
            const double v = static_cast<double>(j) / (count - 1);
            nodes.push_back({lo.x + u * (hi.x - lo.x), lo.y + v * (hi.y - lo.y), scene.frame.origin().z});
        }
    }
    nodes = scene.frame.places_on_globe(std::move(nodes));
    std::vector<double> lon;
    std::vector<double> lat;
    for (const Vec3& node : nodes) {
        if (!is_finite(node)) {
            return {};
        }
        lon.push_back(std::round(node.x * 1e9) / 1e9);
        lat.push_back(std::round(node.y * 1e9) / 1e9);
    }
    return lon.empty() ? Json()
                       : Json{{"count", count}, {"lo", {lo.x, lo.y}}, {"hi", {hi.x, hi.y}}, {"lon", lon}, {"lat", lat}};
}

Json info_of(const Scene& scene, const Model& model, const ExportOptions& options) {
    const double cubic_metres = std::pow(model.frame.metres_per_unit, 3);
    Json info{{"property", scene.coloring.has_property() ? static_cast<int>(scene.coloring.index()) : -1},
              {"properties", properties_of(model)},
              {"map", scene.coloring.map_name()},
              {"sections", sections_of(model, options)},
              {"reach", std::min(options.max_extrapolation.value_or(1), 1.0)},
              {"stretch", height_stretch(model)},
              {"azimuth", default_azimuth_deg},
              {"unit", model.frame.unit},
              {"unitShort", short_unit(model.frame)},
              {"holes", holes_of(model)},
              {"barriers", barriers_of(model)}};
    std::vector<double> levels;
    for (const IsoLevels& iso : options.iso) {
        if (scene.coloring.has_property() && iso.property == scene.coloring.property().name) {
            levels.insert(levels.end(), iso.values.begin(), iso.values.end());
        }
    }
    info["iso"] = levels;
    info["isoOn"] = true;
    for (const std::string& name : ColorMap::names()) {
        const ColorMap map = ColorMap::named(name);
        for (const Color& color : map.anchors()) {
            info["maps"][name].push_back(hex(color));
        }
    }
    info["blocks"] = classes_of(scene.cells.region_names);
    for (std::size_t b = 0; b < scene.block_volume.size(); ++b) {
        info["blocks"][b]["volume"] = scene.block_volume[b] * cubic_metres;
    }
    if (const auto& globe = scene.frame.globe()) {
        info["convergence"] = globe->convergence_deg;
        if (Json grid = globe_of(scene, model); !grid.is_null()) {
            info["globe"] = std::move(grid);
        }
    }
    return info;
}

/// The legend as text, which the page draws over with colours.
std::string legend_text(const Scene& scene) {
    const Coloring& coloring = scene.coloring;
    std::string items;
    const auto add = [&](const std::string& text) { items += "<li>" + markup_text(text) + "</li>"; };
    if (!coloring.has_property()) {
        std::ranges::for_each(scene.cells.region_names, add);
        return "<h2>fault blocks</h2><ol>" + items + "</ol>";
    }
    if (coloring.categorical()) {
        std::ranges::for_each(coloring.property().classes, add);
    } else {
        const std::vector<LegendTick> ticks = legend_ticks(coloring.property(), coloring.range());
        std::for_each(ticks.rbegin(), ticks.rend(), [&](const LegendTick& tick) { add(tick.label); });
    }
    return "<h2>" + markup_text(property_title(coloring.property())) + "</h2><ol>" + items + "</ol>";
}

std::string filled(std::string_view page, const std::map<std::string, std::string, std::less<>>& fields) {
    std::string out;
    while (true) {
        const std::size_t begin = page.find("@@");
        const std::size_t end = begin == std::string_view::npos ? begin : page.find("@@", begin + 2);
        if (end == std::string_view::npos) {
            return out += page;
        }
        out += page.substr(0, begin);
        const auto found = fields.find(page.substr(begin + 2, end - begin - 2));
        if (found != fields.end()) {
            out += found->second;
            page.remove_prefix(end + 2);
        } else {
            out += "@@";
            page.remove_prefix(begin + 2);
        }
    }
}

}  // namespace

OutputRecord write_html(const ModelView& view, const std::string& path, const ExportOptions& options) {
    OutputFile file(path, options.overwrite);
    ExportOptions own = options;
    own.enu = false;  // the page speaks of grid coordinates
    own.title = scene_title(options, path);
    own.picture_size = {std::min(options.picture_size[0], 1120U), std::min(options.picture_size[1], 700U)};
    const Scene scene = make_scene(view, own, ClippedCells::as_cut);
    report_progress(options.progress, "write html", 0.5);
    std::string holes;
    for (const Borehole& hole : view.model.boreholes) {
        holes += "<li>" + markup_text(hole.id) + "</li>";
    }
    std::string said = honesty(scene, view);
    if (!options.made_by.empty()) {
        said += " · " + options.made_by;
    }
    const std::string glb = to_glb(gltf_document(scene, view.model, true, true));
    file.write(
        filled(scene_page(), {{"TITLE", markup_text(own.title)},
                              {"CRS", markup_text(crs_title(view.model.frame) + ", unit " + view.model.frame.unit)},
                              {"LEGEND", legend_text(scene)},
                              {"HONESTY", markup_text(said)},
                              {"HOLE_COUNT", std::to_string(view.model.boreholes.size()) + " boreholes"},
                              {"HOLES", holes},
                              {"PICTURE", "data:image/png;base64," + base64(picture_png(scene, view, own))},
                              {"INFO", script_json(info_of(scene, view.model, own))},
                              {"DATA", base64(gzipped(glb))}}));
    report_progress(options.progress, "write html", 1);
    return {path, file.commit()};
}

}  // namespace terratet
