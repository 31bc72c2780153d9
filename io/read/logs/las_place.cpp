// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read/logs/las_place.hpp"

#include <cpl_conv.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/base/parse_number.hpp"
#include "io/read/logs/well_words.hpp"
#include "tess/samples.hpp"

namespace terratet {

namespace {

std::string value_of(const LasItem* item) {
    return item ? item->value : "";
}

/// The names that tables may know the hole by, surest first; the one it is called by comes first.
std::vector<std::string> hole_names(const LasHeader& header, const std::string& path) {
    std::vector<std::string> names;
    const auto add = [&](const std::string& name) {
        if (!name.empty() && std::ranges::find(names, name) == names.end()) {
            names.push_back(name);
        }
    };
    add(value_of(header.find({"UWI"})));
    add(value_of(header.find({"API", "APIN", "APINO", "APINUM"})));
    add(value_of(header.find({"WELL", "WN", "WELLNAME"})));
    add(value_of(header.find({"LOCAID", "BHID", "HOLEID", "HOLE", "BORE"})));
    add(value_of(header.find({"LIC", "LICENCE", "LICENSE"})));
    add(CPLGetBasename(path.c_str()));
    return names;
}

/// A system from what the header calls it: HZCS, with the datum, a UTM zone.
Crs stated_crs(const LasHeader& header) {
    const std::string datum = value_of(header.find({"GDAT", "HZDATUM", "DATUM", "GEODATUM", "HORIZONTALDATUM"}));
    for (const char* key : {"HZCS", "CRS", "COORDSYS", "PROJ", "PROJECTION", "UTM", "ZONE", "UTMZONE"}) {
        const std::string name = value_of(header.find({key}));
        if (name.empty()) {
            continue;
        }
        if (Crs crs = crs_by_name(name); !crs.empty()) {
            return crs;
        }
        const std::string zone_text = bare(name);
        const std::size_t digit = zone_text.find_first_of("0123456789");
        const bool utm = zone_text.find("UTM") != std::string::npos || std::string_view(key).find("UTM") == 0;
        if (utm && digit != std::string::npos) {
            const auto zone =
                parse_number(zone_text.substr(digit, zone_text.find_first_not_of("0123456789", digit) - digit));
            const bool south = zone_text.ends_with('S') || zone_text.ends_with("SOUTH");
            const std::string of = bare(datum) == "NAD27"                            ? "NAD27"
                                   : bare(datum) == "NAD83"                          ? "NAD83"
                                   : bare(datum) == "ETRS89"                         ? "ETRS89"
                                   : bare(datum) == "ED50"                           ? "ED50"
                                   : datum.empty() || bare(datum).starts_with("WGS") ? "WGS 84"
                                                                                     : datum;
            if (Crs crs = crs_by_name(fmt::format("{} / UTM zone {:g}{}", of, zone.value_or(0), south ? "S" : "N"));
                !crs.empty()) {
                return crs;
            }
        }
    }
    return {};
}

/// The height that depths are counted from.
struct Elevation {
    const LasItem* item = nullptr;
    std::string value = "0";
};

Elevation elevation(const LasHeader& header) {
    const auto number = [&](std::initializer_list<const char*> keys) -> const LasItem* {
        const LasItem* const item = header.find(keys);
        return item && parse_number(item->value) ? item : nullptr;
    };
    const LasItem* const ground = number({"EGL", "ELEVGL", "GLELEV", "GL", "GROUNDELEVATION"});
    if (const LasItem* const said = number({"EREF", "EKB", "ELEVKB", "KBELEV", "EDF", "ELEVDF", "ERT"})) {
        return {said, said->value};
    }
    if (const LasItem* const floor = number({"KB", "DF", "RT"})) {
        const double z = *parse_number(floor->value);
        const double below = ground ? *parse_number(ground->value) : z;
        const bool above_ground = z >= 0 && z < 30 && below > z;  // the kelly bushing's own height
        return {floor, above_ground ? fmt::format("{}", below + z) : floor->value};
    }
    const LasItem* const any = ground ? ground : number({"ELEV", "ELEVATION", "ELZ", "EPD", "EL", "Z", "ZCOORD"});
    return any ? Elevation{any, any->value} : Elevation{};
}

}  // namespace

void place_las(const LasHeader& header, const std::string& path, const std::string& file, WellFile& result) {
    const std::vector<std::string> names = hole_names(header, path);
    const std::string well = value_of(header.find({"WELL", "WN", "WELLNAME"}));
    for (auto* tables : {&result.logs, &result.surveys}) {
        for (Table& table : *tables) {
            table.stated.hole_names = names;
        }
    }
    result.collars = collar_table(file);
    const auto tell = [&](const char* fact, std::initializer_list<const char*> keys) {
        if (const LasItem* const item = header.find(keys)) {
            result.facts.emplace_back(fact, item->value);
        }
    };
    tell("well", {"WELL", "WN", "WELLNAME"});
    tell("uwi", {"UWI"});
    tell("api", {"API", "APIN"});
    tell("company", {"COMP"});
    tell("field", {"FLD"});
    tell("country", {"CTRY"});
    tell("date", {"DATE"});
    const LasItem* const x =
        header.find({"X", "XCOORD", "XWELL", "XCRD", "EASTING", "EAST", "UTMX", "UTME", "XUTM", "SURFX", "XLOC"});
    const LasItem* const y =
        header.find({"Y", "YCOORD", "YWELL", "YCRD", "NORTHING", "NORTH", "UTMY", "UTMN", "YUTM", "SURFY", "YLOC"});
    const LasItem* const lat = header.find({"LATI", "LAT", "SLAT", "LATITUDE", "SURFLAT"});
    const LasItem* const lon = header.find({"LONG", "LON", "SLON", "LONGI", "LONGITUDE", "SLONG", "SURFLON"});
    const auto [height, z] = elevation(header);
    const auto number = [](const LasItem* item, auto&& parse) {
        return item ? parse(item->value).value_or(missing) : missing;
    };
    const double east = number(x, parse_number);
    const double north = number(y, parse_number);
    const double longitude = number(lon, degrees);
    const double latitude = number(lat, degrees);
    const bool plane = std::isfinite(east) && std::isfinite(north);
    const bool globe = std::isfinite(longitude) && std::isfinite(latitude);
    const bool in_degrees = plane && globe && std::abs(east) <= 180 && std::abs(north) <= 90;
    Crs crs = stated_crs(header);
    if (plane && !in_degrees) {
        add_collar(result.collars, well.empty() ? names.front() : well, x->value, y->value, z, "", x->line);
        result.collars.crs = crs.geographic ? Crs{} : crs;
    } else if (globe) {
        const std::string datum = value_of(header.find({"GDAT", "HZDATUM", "DATUM", "GEODATUM", "HORIZONTALDATUM"}));
        result.collars.crs = crs.geographic ? crs : crs_of_datum(datum);
        if (result.collars.crs.empty()) {
            result.collars.crs = crs_of_datum("WGS84");
            result.notes.push_back(fmt::format(
                "its latitude and longitude are taken for WGS 84{}",
                datum.empty() ? ", for the header names no datum" : ", for its datum '" + datum + "' is not known"));
        }
        add_collar(result.collars, well.empty() ? names.front() : well, fmt::format("{}", longitude),
                   fmt::format("{}", latitude), z, "", lat->line);
    }
    if (result.collars.rows() == 0) {
        return;
    }
    result.metres_per_height = height ? metres_in_log_unit(height->unit) : 0;
    result.notes.push_back(height
                               ? fmt::format("its depths are counted from height {} ({})", z, height->mnemonic)
                               : "the header gives no elevation (EREF, EKB, EGL, ELEV): its depths hang from height 0");
}

}  // namespace terratet
