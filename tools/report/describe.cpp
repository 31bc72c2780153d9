// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/report/describe.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "tools/options/printable.hpp"
#include "tools/options/text.hpp"
#include "tools/report/describe_parts.hpp"

namespace terratet::tools {
namespace {

using Json = nlohmann::ordered_json;

Json property_json(const Model& model, std::size_t p) {
    const Property& property = model.properties[p];
    Range range;
    for (const double value : model.samples.values[p]) {
        range.add(value);
    }
    Json json{{"name", property.name}};
    if (!property.unit.empty()) {
        json["unit"] = property.unit;
    }
    if (property.hard_horizons) {
        json["horizons"] = "hard";
    }
    if (property.kind == Kind::categorical) {
        json["classes"] = property.classes;
    } else {
        json["scale"] = property.scale == Scale::log10 ? "log10" : "linear";
        if (range.count > 0) {  // none: a property of the vertices alone
            json["min"] = range.lo;
            json["max"] = range.hi;
        }
    }
    json["samples"] = range.count;
    if (const std::size_t censored = model.samples.censored_count(p); censored > 0) {
        json["censored"] = censored;
    }
    return json;
}

Json criteria_json(const Model& model) {
    const Criteria& criteria = model.criteria;
    Json json{{"lmin", criteria.l_min},
              {"lmax", criteria.l_max},
              {"radius-edge", criteria.radius_edge},
              {"aspect", criteria.aspect},
              {"dihedral", criteria.dihedral_deg},
              {"vmin", criteria.v_min},
              {"vmax", criteria.v_max}};
    for (std::size_t p = 0; p < criteria.variation.size(); ++p) {
        const auto& [df_min, df_max, tolerance, residual, trend] = criteria.variation[p];
        static_cast<void>(trend);
        if (df_min > 0) {
            json["df-min " + model.properties[p].name] = df_min;
        }
        if (df_max > 0) {
            json["df-max " + model.properties[p].name] = df_max;
        }
        if (tolerance > 0) {
            json["tolerance " + model.properties[p].name] = tolerance;
        }
        if (residual > tolerance) {
            json["tolerance between samples " + model.properties[p].name] = residual;
        }
    }
    if (criteria.has_tolerance()) {
        json["lmin-between"] = criteria.l_min_between > 0 ? criteria.l_min_between : criteria.l_min;
        json["lmin-floor"] = criteria.l_min_floor;
        json["shape"] = criteria.shape_everywhere ? "everywhere" : "needed";
        json["fine-places"] = criteria.fine.size();
    }
    return json;
}

std::string scalar_text(const Json& value) {
    if (value.is_string()) {
        return printable(value.get<std::string>());
    }
    if (value.is_number_float()) {
        return fmt::format("{:.10g}", value.get<double>());
    }
    if (value.is_number()) {
        return grouped(value.get<std::uint64_t>());
    }
    return value.is_null() ? "none" : value.dump();
}

/// "name K, min 1e-12, max 1e-08".
std::string row_text(const Json& row) {
    std::string out;
    if (row.is_object()) {
        for (const auto& [key, value] : row.items()) {
            const std::string text = value.is_array() ? row_text(value) : scalar_text(value);
            out += out.empty() ? "" : ", ";
            out += key == "name" ? text : fmt::format("{} {}", printable(key), text);
        }
    } else if (row.is_array()) {
        for (const auto& value : row) {
            out += (out.empty() ? "" : " ") + scalar_text(value);
        }
    } else {
        out = scalar_text(row);
    }
    return out;
}

/// A list's, or the lines of a text that has several; none: it stands beside its key.
std::vector<std::string> rows_of(const Json& value) {
    std::vector<std::string> rows;
    if (value.is_array() && !value.empty() && value.front().is_object()) {
        for (const auto& row : value) {
            rows.push_back(row_text(row));
        }
    } else if (value.is_string() && value.get_ref<const std::string&>().find('\n') != std::string::npos) {
        std::istringstream lines(value.get<std::string>());
        for (std::string line; std::getline(lines, line);) {
            rows.push_back(printable(line));
        }
    }
    return rows;
}

}  // namespace

Json describe_model(const Model& model, const std::vector<JournalEntry>& journal) {
    Json json{{"kind", "model"}, {"crs", crs_text(model.frame.crs_name)}, {"unit", model.frame.unit}};
    const Box3& extent = model.domain.extent;
    json["extent"] = box_json({model.frame.to_world(extent.lo), model.frame.to_world(extent.hi)});
    json["boreholes"] = model.boreholes.size();
    json["samples"] = model.samples.size();
    json["properties"] = Json::array();
    for (std::size_t p = 0; p < model.properties.size(); ++p) {
        json["properties"].push_back(property_json(model, p));
    }
    json["faults"] = Json::array();
    for (const auto& fault : model.barriers) {
        json["faults"].push_back(
            {{"name", fault.name}, {"seeds", fault.seeds.size()}, {"spacing", fault.spacing}, {"width", fault.width}});
    }
    if (!model.region_names.empty()) {
        json["regions"] = Json::array();
        for (const auto& named : model.region_names) {
            const Vec3 p = model.frame.to_world(named.point);
            json["regions"].push_back({{"name", named.name}, {"at", {p.x, p.y, p.z}}});
        }
    }
    json["vertices"] = model.vertices.size();
    json["criteria"] = criteria_json(model);
    json["estimator"] = model.estimator;
    json["journal"] = Json::array();
    for (const auto& entry : journal) {
        json["journal"].push_back({{"edit", entry.edit}, {"time", entry.time}, {"command", entry.command}});
    }
    return json;
}

Json describe_surfaces(const RawSurfaces& raw, const Diagnostics& diagnostics) {
    Json json{{"kind", "surfaces"}, {"crs", crs_text(raw.crs.name)}};
    Box3 box;
    Json surfaces = Json::array();
    for (const auto& surface : raw.surfaces) {
        for (const auto& vertex : surface.vertices) {
            box.extend(vertex);
        }
        const SurfaceStatistics numbers = statistics(surface);
        surfaces.push_back({{"name", surface.name},
                            {"vertices", surface.vertices.size()},
                            {"triangles", surface.triangles.size()},
                            {"area", numbers.area},
                            {"dip", numbers.dip_mean_deg},
                            {"dip_direction", numbers.dip_direction_deg}});
    }
    json["extent"] = box_json(box);
    json["surfaces"] = surfaces;
    json["rejected"] = diagnostics.rejected.size();
    return json;
}

std::string as_text(const Json& description) {
    std::string out;
    for (const auto& [key, value] : description.items()) {
        const std::vector<std::string> rows = rows_of(value);
        out += rows.empty() ? fmt::format("{:12}{}\n", key, value.empty() ? "none" : row_text(value)) : key + "\n";
        for (const std::string& row : rows) {
            out += "  " + row + "\n";
        }
    }
    return out;
}

}  // namespace terratet::tools
