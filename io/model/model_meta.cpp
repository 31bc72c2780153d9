// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/model/model_meta.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "io/base/lower_case.hpp"
#include "io/model/model_ranges.hpp"
#include "io/model/model_schema.hpp"
#include "io/model_store.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

using nlohmann::json;

// JSON has no infinities (an empty box is made of them) and no NaN.
json number(double value) {
    return std::isfinite(value) ? json(value) : std::isnan(value) ? json("nan") : json(value > 0 ? "inf" : "-inf");
}

double number(const json& value) {
    if (value.is_number()) {
        return value.get<double>();
    }
    const auto text = value.get<std::string>();
    if (text == "inf" || text == "-inf") {
        return text == "inf" ? std::numeric_limits<double>::infinity() : -std::numeric_limits<double>::infinity();
    }
    if (text != "nan") {
        throw json::other_error::create(501, "\"" + text + "\" is no number", nullptr);
    }
    return missing;
}

std::uint64_t count(const json& value) {
    if (!value.is_number_unsigned()) {
        throw json::other_error::create(
            501, value.dump(-1, ' ', false, json::error_handler_t::replace) + " is no count", nullptr);
    }
    return value.get<std::uint64_t>();
}

json vector(const Vec3& v) {
    return json::array({number(v.x), number(v.y), number(v.z)});
}
Vec3 vector(const json& v) {
    return {number(v.at(0)), number(v.at(1)), number(v.at(2))};
}

json box(const Box3& b) {
    return {{"lo", vector(b.lo)}, {"hi", vector(b.hi)}};
}
Box3 box(const json& b) {
    return {vector(b.at("lo")), vector(b.at("hi"))};
}

json domain_json(const Domain& domain) {
    json rings = json::array();
    for (const auto& ring : domain.outline) {
        json& points = rings.emplace_back(json::array());
        for (const Vec3& p : ring) {
            points.push_back(vector(p));
        }
    }
    return {{"extent", box(domain.extent)}, {"hull", box(domain.hull)}, {"outline", rings}};
}

Domain domain_of(const json& j) {
    Domain domain{box(j.at("extent")), box(j.at("hull")), {}};
    for (const json& ring : j.at("outline")) {
        auto& points = domain.outline.emplace_back();
        for (const json& p : ring) {
            points.push_back(vector(p));
        }
    }
    return domain;
}

json frame_json(const Frame& frame) {
    return {{"crs_wkt", frame.crs_wkt},
            {"crs_name", frame.crs_name},
            {"unit", frame.unit},
            {"metres_per_unit", number(frame.metres_per_unit)},
            {"origin", vector(frame.origin)},
            {"z_scale", number(frame.z_scale)}};
}

Frame frame_of(const json& j) {
    return {j.at("crs_wkt").get<std::string>(),
            j.at("crs_name").get<std::string>(),
            j.at("unit").get<std::string>(),
            number(j.at("metres_per_unit")),
            vector(j.at("origin")),
            number(j.at("z_scale"))};
}

json properties_json(const std::vector<Property>& properties, const std::vector<std::string>& columns,
                     const std::vector<std::string>& censored_columns) {
    json result = json::array();
    for (std::size_t i = 0; i < properties.size(); ++i) {
        const Property& p = properties[i];
        result.push_back({{"name", p.name},
                          {"column", columns[i]},
                          {"unit", p.unit},
                          {"scale", p.scale == Scale::log10 ? "log10" : "linear"},
                          {"kind", p.kind == Kind::categorical ? "categorical" : "continuous"},
                          {"classes", p.classes}});
        if (p.hard_horizons) {
            result.back()["horizons"] = "hard";
        }
        if (!censored_columns[i].empty()) {
            result.back()["censored_column"] = censored_columns[i];
        }
    }
    return result;
}

/// One of two words.
bool is_second(const json& j, const char* first, const char* second) {
    const auto word = j.get<std::string>();
    if (word != first && word != second) {
        throw json::other_error::create(501, "\"" + word + "\" is neither " + first + " nor " + second, nullptr);
    }
    return word == second;
}

Property property_of(const json& j) {
    Property p;
    p.name = j.at("name").get<std::string>();
    p.unit = j.at("unit").get<std::string>();
    p.scale = is_second(j.at("scale"), "linear", "log10") ? Scale::log10 : Scale::linear;
    p.kind = is_second(j.at("kind"), "continuous", "categorical") ? Kind::categorical : Kind::continuous;
    p.classes = j.at("classes").get<std::vector<std::string>>();
    p.hard_horizons = is_second(j.value("horizons", json("soft")), "soft", "hard");
    return p;
}

json criteria_json(const Criteria& c) {
    json variation = json::array();
    for (const VariationLimits& limits : c.variation) {
        variation.push_back({{"df_min", number(limits.df_min)}, {"df_max", number(limits.df_max)}});
        if (limits.tolerance > 0) {
            variation.back()["tolerance"] = number(limits.tolerance);
            variation.back()["residual"] = number(limits.residual);
            variation.back()["trend"] = vector(limits.trend);
        }
    }
    json overrides = json::array();
    for (const ResolutionOverride& part : c.overrides) {
        const json where = part.where == ResolutionOverride::Where::box ? json{{"box", box(part.box)}}
                                                                        : json{{"block_at", vector(part.point)}};
        overrides.push_back({{"where", where}, {"l_min", number(part.l_min)}, {"l_max", number(part.l_max)}});
    }
    json fine = json::array();  // four numbers a place: there may be as many as samples
    for (const FinePlace& place : c.fine) {
        for (const double value : {place.position.x, place.position.y, place.position.z, place.l_min}) {
            fine.push_back(number(value));
        }
    }
    json result{{"l_min", number(c.l_min)},
                {"l_max", number(c.l_max)},
                {"radius_edge", number(c.radius_edge)},
                {"aspect", number(c.aspect)},
                {"v_min", number(c.v_min)},
                {"v_max", number(c.v_max)},
                {"dihedral_deg", number(c.dihedral_deg)},
                {"variation", variation},
                {"overrides", overrides}};
    if (c.has_tolerance()) {
        result["l_min_between"] = number(c.l_min_between);
        result["l_min_floor"] = number(c.l_min_floor);
        result["shape"] = c.shape_everywhere ? "everywhere" : "needed";
        result["fine"] = std::move(fine);
    }
    return result;
}

/// Absent from models without a tolerance.
void read_tolerance(const json& j, Criteria& c) {
    if (!j.contains("fine")) {
        return;
    }
    c.l_min_between = number(j.at("l_min_between"));
    c.l_min_floor = number(j.at("l_min_floor"));
    c.shape_everywhere = is_second(j.at("shape"), "needed", "everywhere");
    const json& fine = j.at("fine");
    if (fine.size() % 4 != 0) {
        throw json::other_error::create(501, "fine places are not four numbers each", nullptr);
    }
    for (std::size_t i = 0; i < fine.size(); i += 4) {
        c.fine.push_back({{number(fine[i]), number(fine[i + 1]), number(fine[i + 2])}, number(fine[i + 3])});
    }
}

Criteria criteria_of(const json& j) {
    Criteria c;
    c.l_min = number(j.at("l_min"));
    c.l_max = number(j.at("l_max"));
    c.radius_edge = number(j.at("radius_edge"));
    c.aspect = number(j.at("aspect"));
    c.v_min = number(j.at("v_min"));
    c.v_max = number(j.at("v_max"));
    c.dihedral_deg = number(j.at("dihedral_deg"));
    for (const json& limits : j.at("variation")) {
        VariationLimits& read = c.variation.emplace_back();
        read.df_min = number(limits.at("df_min"));
        read.df_max = number(limits.at("df_max"));
        if (limits.contains("tolerance")) {
            read.tolerance = number(limits.at("tolerance"));
            read.residual = number(limits.at("residual"));
            read.trend = vector(limits.at("trend"));
        }
    }
    for (const json& part : j.at("overrides")) {
        ResolutionOverride read;
        if (const json& where = part.at("where"); where.contains("box")) {
            read.box = box(where.at("box"));
        } else {
            read.where = ResolutionOverride::Where::block;
            read.point = vector(where.at("block_at"));
        }
        read.l_min = number(part.at("l_min"));
        read.l_max = number(part.at("l_max"));
        c.overrides.push_back(read);
    }
    read_tolerance(j, c);
    return c;
}

json fault_options_json(const BarrierOptions& o) {
    return {{"spacing", number(o.spacing)},
            {"width", number(o.width)},
            {"snap", number(o.snap)},
            {"max_seeds", o.max_seeds},
            {"mode", o.mode == SeedMode::exact ? "exact" : "paired"},
            {"refine", o.refine}};
}

BarrierOptions fault_options_of(const json& j) {
    return {number(j.at("spacing")),
            number(j.at("width")),
            number(j.at("snap")),
            count(j.at("max_seeds")),
            is_second(j.at("mode"), "paired", "exact") ? SeedMode::exact : SeedMode::paired,
            j.at("refine").get<bool>()};
}

json region_names_json(const std::vector<RegionName>& names) {
    json result = json::array();
    for (const RegionName& named : names) {
        result.push_back({{"at", vector(named.point)}, {"name", named.name}});
    }
    return result;
}

std::vector<RegionName> region_names_of(const json& j) {
    std::vector<RegionName> names;
    for (const json& named : j) {
        names.push_back({vector(named.at("at")), named.at("name").get<std::string>()});
    }
    return names;
}

json counts_json(const RowCounts& c) {
    return {{schema::samples, c.samples},
            {schema::boreholes, c.boreholes},
            {schema::surfaces, c.surfaces},
            {schema::vertices, c.vertices}};
}

RowCounts counts_of(const json& j) {
    return {count(j.at(schema::samples)), count(j.at(schema::boreholes)), count(j.at(schema::surfaces)),
            count(j.at(schema::vertices))};
}

}  // namespace

RowCounts row_counts(const Model& model) {
    return {model.samples.size(), model.boreholes.size(), model.surfaces.size() + 2 * model.barriers.size(),
            model.vertices.size()};
}

Meta to_meta(const Model& model, const std::vector<std::string>& property_columns,
             const std::vector<std::string>& censored_columns) {
    return {{"format_version", std::to_string(schema::format_version)},
            {"frame", frame_json(model.frame).dump()},
            {"properties", properties_json(model.properties, property_columns, censored_columns).dump()},
            {"criteria", criteria_json(model.criteria).dump()},
            {"density", model.density == DensityMode::paper ? "paper" : "canonical"},
            {"fault_options", fault_options_json(model.barrier_options).dump()},
            {"regions", region_names_json(model.region_names).dump()},
            {"domain", domain_json(model.domain).dump()},
            {"estimator", model.estimator},
            {"counts", counts_json(row_counts(model)).dump()},
            {"digest", model_digest(model)}};
}

MetaContent from_meta(const Meta& meta, const std::string& file) {
    const auto value = [&](const char* key) -> const std::string& {
        const auto found = meta.find(key);
        if (found == meta.end()) {
            throw InputError(file + ": layer " + schema::meta + ": no key " + key +
                             "; this is no complete Terratet model");
        }
        return found->second;
    };
    const std::string& version = value("format_version");
    if (version != std::to_string(schema::format_version)) {
        throw InputError(file + ": has model format " + version + ", this program reads format " +
                         std::to_string(schema::format_version) +
                         "; use the version of Terratet that wrote it, or a newer one");
    }
    MetaContent content;
    const char* key = "";
    const auto parsed = [&](const char* name) {
        key = name;
        return json::parse(value(name));
    };
    try {
        content.model.frame = frame_of(parsed("frame"));
        for (const json& property : parsed("properties")) {
            content.model.properties.push_back(property_of(property));
            content.property_columns.push_back(property.at("column").get<std::string>());
            content.censored_columns.push_back(property.value("censored_column", ""));
        }
        content.model.criteria = criteria_of(parsed("criteria"));
        content.model.barrier_options = fault_options_of(parsed("fault_options"));
        content.model.region_names = region_names_of(parsed("regions"));
        content.model.domain = domain_of(parsed("domain"));
        content.counts = counts_of(parsed("counts"));
        key = "density";
        content.model.density =
            is_second(json(value("density")), "canonical", "paper") ? DensityMode::paper : DensityMode::canonical;
    } catch (const json::exception& error) {
        throw InputError(file + ": layer " + schema::meta + ", key " + key + " is damaged: " + error.what());
    }
    content.model.estimator = value("estimator");
    require_ranges(content.model, content.property_columns, content.censored_columns, file);
    const auto digest = meta.find("digest");
    content.digest = digest == meta.end() ? "" : digest->second;
    return content;
}

}  // namespace terratet
