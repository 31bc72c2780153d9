// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read/tables/columns.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <functional>
#include <string_view>

#include "io/base/lower_case.hpp"
#include "tess/base/words.hpp"
#include "tess/error.hpp"

namespace terratet {

namespace {

constexpr std::array<const char*, 14> meaning_names{"id",           "x",         "y",   "z",      "from", "to",
                                                    "depth",        "azimuth",   "dip", "length", "name", "qualifier",
                                                    "dipdirection", "lowerdepth"};

constexpr std::array<std::string_view, 18> unit_words{"m",     "ft",     "feet", "foot", "metre",  "metres",
                                                      "meter", "meters", "km",   "deg",  "degree", "degrees",
                                                      "dd",    "masl",   "mbgl", "msl",  "usft",   "amsl"};

/// Without a trailing bracket: "Easting [m]", "Cu (%)".
std::string_view without_bracket(std::string_view header) {
    const std::size_t open = header.find_first_of("([{");
    return open == std::string_view::npos || open == 0 ? header : header.substr(0, open);
}

/// ä, ö and ü as German writes them without their letters.
std::string transliterated(std::string_view text) {
    static constexpr std::array<std::pair<std::string_view, std::string_view>, 7> letters{
        {{"ä", "ae"}, {"ö", "oe"}, {"ü", "ue"}, {"Ä", "ae"}, {"Ö", "oe"}, {"Ü", "ue"}, {"ß", "ss"}}};
    std::string result;
    while (!text.empty()) {
        const auto* const found =
            std::ranges::find_if(letters, [&](const auto& letter) { return text.starts_with(letter.first); });
        const bool plain = found == letters.end();
        result += plain ? text.substr(0, 1) : found->second;
        text.remove_prefix(plain ? 1 : found->first.size());
    }
    return result;
}

std::vector<std::string> words_of(std::string_view text) {
    std::vector<std::string> words(1);
    for (const unsigned char c : transliterated(text)) {
        if (std::isalnum(c) != 0 || c >= 0x80) {
            words.back() += static_cast<char>(std::tolower(c));
        } else if (!words.back().empty()) {
            words.emplace_back();
        }
    }
    if (words.back().empty()) {
        words.pop_back();
    }
    return words;
}

std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) {
        text += word;
    }
    return text;
}

void require_known_meanings(const ColumnNames& overrides) {
    for (const auto& [meaning, column] : overrides) {
        if (std::ranges::find(meaning_names, joined(words_of(meaning))) == meaning_names.end()) {
            const auto known = names_of(meaning_names, std::identity());
            throw UsageError(std::string("`columns` ").append(meaning).append("=").append(column) +
                             ": no such meaning; there are " + listed(known) + did_you_mean(meaning, known));
        }
    }
}

int column_of_alias(const Table& table, Meaning meaning) {
    std::vector<std::string> headers;
    for (const std::string& column : table.columns) {
        headers.push_back(normal_header(column));
    }
    for (const std::string& alias : aliases(meaning)) {
        const auto found = std::ranges::find(headers, alias);
        if (found != headers.end()) {
            return static_cast<int>(found - headers.begin());
        }
    }
    // E and N by themselves are elements and blow counts; together they are a place.
    const auto east = std::ranges::find(headers, "e");
    const auto north = std::ranges::find(headers, "n");
    if ((meaning == Meaning::x || meaning == Meaning::y) && east != headers.end() && north != headers.end()) {
        return static_cast<int>((meaning == Meaning::x ? east : north) - headers.begin());
    }
    return -1;
}

}  // namespace

const char* to_string(Meaning meaning) {
    return meaning_names[static_cast<std::size_t>(meaning)];
}

const std::vector<std::string>& aliases(Meaning meaning) {
    static const std::array<std::vector<std::string>, 14> all{{
        // id
        {"bhid",         "holeid",   "dhid",       "ddhid",        "drillholeid", "boreholeid",   "boreid",
         "wellid",       "siteid",   "collarid",   "locaid",       "locationid",  "pointid",      "hole",
         "holename",     "holeno",   "holenumber", "drillhole",    "borehole",    "boreholename", "bore",
         "boreno",       "borename", "well",       "wellname",     "uwi",         "api",          "idcode",
         "originalname", "bohrung",  "bohrloch",   "bohrungsname", "sondage",     "forage",       "sondeo",
         "pozo",         "borrhal",  "boorgat",    "boornummer",   "borrhål",     "boring",       "id",
         "name"},
        // x
        {"xcollar",  "collarx",     "x",          "xcoord",      "xcoordinate", "coordx",       "east",   "easting",
         "eastings", "eastcollar",  "collareast", "utme",        "utmx",        "utmeast",      "xutm",   "xutme",
         "gridx",    "locationx",   "xloc",       "xlocation",   "locx",        "rechtswert",   "rechts", "ostwert",
         "ost",      "este",        "xrd",        "lon",         "long",        "longitude",    "xlong",  "longdd",
         "londd",    "longitudedd", "laenge",     "xcoordinaat", "xkoordinate", "xkoordinaatti"},
        // y
        {"ycollar",    "collary", "y",           "ycoord",      "ycoordinate",  "coordy",   "north",    "northing",
         "northings",  "nort",    "northcollar", "collarnorth", "utmn",         "utmy",     "utmnorth", "yutm",
         "yutmn",      "gridy",   "locationy",   "yloc",        "ylocation",    "locy",     "hochwert", "hoch",
         "nordwert",   "nord",    "norte",       "yrd",         "lat",          "latitude", "ylat",     "latdd",
         "latitudedd", "breite",  "ycoordinaat", "ykoordinate", "ykoordinaatti"},
        // z
        {"zcollar",
         "collarz",
         "z",
         "zcoord",
         "zcoordinate",
         "coordz",
         "elev",
         "elevation",
         "elevationz",
         "collarelev",
         "collarelevation",
         "rl",
         "collarrl",
         "altitude",
         "groundlevel",
         "groundelevation",
         "locagl",
         "height",
         "masl",
         "amsl",
         "zloc",
         "zlocation",
         "locz",
         "hoehe",

         "ansatzhoehe",

         "gok",
         "maaiveld",
         "maaiveldhoogte",
         "cota",
         "altitud",
         "tvdss",
         "ztvdss",
         "tvdmsl",
         "ztvd",
         "tvdsubsea",
         "zdepth",
         "depthss",
         "subseadepth"},
        // from
        {"from",         "depthfrom",    "fromdepth",    "mfrom",   "frommd",   "mdfrom",   "secup", "defr",
         "sampfrom",     "samplefrom",   "intervalfrom", "top",     "depthtop", "topdepth", "mdtop", "geoltop",
         "topelevation", "elevationtop", "topelev",      "elevtop", "von",      "desde",    "depuis"},
        // to
        {"to",
         "depthto",
         "todepth",
         "mto",
         "tomd",
         "mdto",
         "seclow",
         "deto",
         "sampto",
         "sampleto",
         "intervalto",
         "bottom",
         "depthbottom",
         "bottomdepth",
         "base",
         "depthbase",
         "basedepth",
         "mdbase",
         "geolbase",
         "bottomelevation",
         "elevationbottom",
         "bottomelev",
         "elevbottom",
         "baseelevation",
         "bis",
         "hasta",
         "jusqua"},
        // depth
        {"at", "deat", "md", "measureddepth", "mdepth", "depthmd", "surveydepth", "surveyat", "depth", "dept",
         "distance", "teufe", "tiefe", "profondeur", "profundidad", "diepte"},
        // azimuth
        {"az", "azi", "azim", "azimuth", "brg", "bearing", "direction", "dir", "hazi", "trend", "surveyazimuth",
         "azimuthgrid", "gridazimuth"},
        // dip
        {"dip", "inclination", "incl", "inc", "plunge", "devi", "surveydip", "dippref", "preferreddip", "averagedip",
         "avgdip", "meandip", "dipangle", "neigung", "inclinacion", "buzamiento"},
        // length
        {"length", "len", "eoh", "eodh", "td", "totaldepth", "maxdepth", "depthmax", "enddepth", "finaldepth",
         "holelength", "holedepth", "endofhole", "endteufe", "eoddepth", "profondeurtotale", "einddiepte",
         "profundidadtotal"},
        // name
        {"name", "fault", "faultname", "featurename", "faultid", "surface", "surfacename", "horizon", "structure",
         "object", "group", "id"},
        // qualifier: by its name only when named, else by what it holds
        {},
        // dip direction
        {"dipdir", "dipdirection", "dipdirectiondeg", "dipazimuth", "dipaz", "azimuthofdip", "averagedipdirection",
         "averagedipdir", "dipdirn", "downdip", "downdipdir", "downdipdirection", "fallrichtung"},
        // lower depth of a trace
        {"lowerdepth", "lowerseisdepth", "d90", "depthlower", "bottomdepth", "basedepth", "maxdepth",
         "lowerseismogenicdepth", "depthtobottom", "seismodepth"},
    }};
    return all[static_cast<std::size_t>(meaning)];
}

std::string normal_header(const std::string& header) {
    std::vector<std::string> words = words_of(without_bracket(header));
    while (words.size() > 1 && std::ranges::find(unit_words, words.back()) != unit_words.end()) {
        words.pop_back();
    }
    return joined(words);
}

bool names_depth(const std::string& header) {
    const std::string name = normal_header(header);
    return name.find("tvd") != std::string::npos || name.find("depth") != std::string::npos || name == "subsea";
}

int column_named(const Table& table, const std::string& name) {
    const auto found =
        std::ranges::find(table.columns, lower_case(name), [](const auto& column) { return lower_case(column); });
    return found == table.columns.end() ? -1 : static_cast<int>(found - table.columns.begin());
}

int find_optional_column(const Table& table, Meaning meaning, const ColumnNames& overrides) {
    require_known_meanings(overrides);
    for (const auto& [key, name] : overrides) {
        if (joined(words_of(key)) == to_string(meaning)) {
            if (const int column = column_named(table, name); column >= 0) {
                return column;
            }
        }
    }
    return table.stated.meanings.empty() ? column_of_alias(table, meaning) : table.stated.column(meaning);
}

int find_column(const Table& table, Meaning meaning, const ColumnNames& overrides) {
    const int column = find_optional_column(table, meaning, overrides);
    const auto named = std::ranges::find(overrides, to_string(meaning), &ColumnNames::value_type::first);
    if (column < 0 && named != overrides.end()) {
        throw UsageError("`columns` " + named->first + "=" + named->second + ": " + table.file +
                         " has no such column; it has " + listed(table.columns) +
                         did_you_mean(named->second, table.columns));
    }
    return column;
}

}  // namespace terratet
