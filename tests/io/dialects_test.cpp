// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sites written as people in different places write them, read back to the same.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <functional>

#include "interp/live_model.hpp"
#include "io/model_store.hpp"
#include "site_case.hpp"
#include "stored_models.hpp"

using namespace terratet;
using namespace terratet::testing;

namespace {

struct Dialect {
    const char* name;
    std::string separator;  ///< of cells
    std::string group;      ///< of thousands
    std::string decimal;
    std::vector<std::string> collar;  ///< id, x, y, z, length
    std::vector<std::string> log;     ///< id, from, to, two properties
    bool elevations = false;
    bool qualifier = false;  ///< bounds in a column of their own
    bool down = false;       ///< loose samples by depth below zero
    bool near_ids = false;
    bool wide = false;       ///< UTF-16
    std::string above = {};  ///< the header
    bool units_row = false;
    bool blank_rows = false;  ///< of empty cells, and a total's at the end
};

/// Thousands parted and a decimal sign; quoted where the cells' separator is in it.
std::string number(double value, const Dialect& d) {
    std::string text = fmt::format("{:.3f}", value);
    std::string whole = text.substr(0, text.find('.'));
    const std::string part = text.substr(text.find('.') + 1);
    const int first = whole.front() == '-' ? 1 : 0;
    for (int k = static_cast<int>(whole.size()) - 3; k > first; k -= 3) {
        whole.insert(static_cast<std::size_t>(k), d.group);
    }
    const std::string result = whole + d.decimal + part;
    return result.find(d.separator) == std::string::npos ? result : "\"" + result + "\"";
}

std::string row(const std::vector<std::string>& cells, const Dialect& d) {
    return fmt::format("{}\r\n", fmt::join(cells, d.separator));
}

struct RandomHole {
    std::string id;
    Vec3 collar;
    std::vector<std::array<double, 3>> rows;  ///< length of the interval, value, bound or not
};

/// Eighths, so that sums of intervals are exact whichever way they are written.
double eighths(Random& random, int below) {
    return static_cast<double>(1 + random.below(static_cast<std::size_t>(below))) / 8;
}

std::vector<RandomHole> random_site(Random& random) {
    std::vector<RandomHole> holes(2 + random.below(4));
    for (std::size_t h = 0; h < holes.size(); ++h) {
        holes[h].id = fmt::format("KR-{:03}", h + 1);
        holes[h].collar = {2600000 + eighths(random, 80000), 1200000 + eighths(random, 80000),
                           1000 + eighths(random, 9000)};
        for (std::size_t k = 0; k < 3 + random.below(5); ++k) {
            holes[h].rows.push_back(
                {eighths(random, 80), 1000 + eighths(random, 100000), random.below(4) == 0 ? 1.0 : 0.0});
        }
    }
    return holes;
}

/// As a spreadsheet writes it.
std::string as_file(const std::string& table, const Dialect& d, bool units) {
    std::string text = d.above + table;
    const std::size_t header = text.find("\r\n", d.above.size()) + 2;
    const auto columns =
        static_cast<std::size_t>(std::ranges::count(table.substr(0, table.find('\r')), d.separator[0]));
    std::string commas;
    for (std::size_t k = 0; k < columns; ++k) {
        commas += d.separator;
    }
    if (d.blank_rows) {
        text += commas + "\r\n" + commas + "\r\n";
        text.insert(header, commas + "\r\n");
    }
    if (d.units_row && units) {
        text.insert(header, row({"", "m", "[m]", "m", "m"}, d));
    }
    if (!d.wide) {
        return text;
    }
    std::string wide = "\xFF\xFE";
    for (const char c : text) {
        wide += {c, '\0'};
    }
    return wide;
}

Site site_in(const std::vector<RandomHole>& holes, const Dialect& d) {
    std::string collars = row(d.collar, d);
    std::vector<std::string> header = d.log;
    if (d.qualifier) {
        header.insert(header.begin() + 3, d.log[3] + "_QUAL");
    }
    std::string log = row(header, d);
    std::string samples = row({"X", "Y", d.down ? "Z_TVDSS" : "Z", d.log[3], d.log[4]}, d);
    for (const RandomHole& hole : holes) {
        collars += row(
            {hole.id, number(hole.collar.x, d), number(hole.collar.y, d), number(hole.collar.z, d), number(500, d)}, d);
        double depth = 0;
        for (const auto& [length, value, bound] : hole.rows) {
            const auto at = [&](double here) { return number(d.elevations ? hole.collar.z - here : here, d); };
            const std::string sign = bound > 0 ? "<" : "";
            const std::string text = number(value, d);
            const std::string bounded = sign.empty() || d.qualifier ? text
                                        : text.starts_with('"')     ? "\"<" + text.substr(1)
                                                                    : sign + text;
            const std::string id = d.near_ids ? fmt::format("kr {}", std::stoi(hole.id.substr(3))) : hole.id;
            std::vector<std::string> cells{id, at(depth), at(depth + length), bounded, number(-value / 4, d)};
            if (d.qualifier) {
                cells.insert(cells.begin() + 3, sign);
            }
            log += row(cells, d);
            depth += length;
        }
        samples += row({number(hole.collar.x + 5, d), number(hole.collar.y + 5, d),
                        number(d.down ? 2000.125 : -2000.125, d), number(1500.5, d), number(-7, d)},
                       d);
    }
    Case site;
    site.inputs.source_crs = "EPSG:2056";
    site.collars(as_file(collars, d, true)).log(as_file(log, d, false)).samples(as_file(samples, d, false));
    return read(site.inputs).site;
}

const std::vector<std::string> usual_collar{"BHID", "X", "Y", "Z", "LENGTH"};
const std::vector<std::string> usual_log{"BHID", "FROM", "TO", "AU", "CU"};
const std::vector<std::string> german_collar{"Bohrung", "Rechtswert", "Hochwert", "Höhe [m]", "Endteufe"};
const std::vector<std::string> german_log{"Bohrung", "von", "bis", "AU", "CU"};

const std::vector<Dialect> dialects{
    {"Swiss", ";", "'", ".", usual_collar, usual_log},
    {"Swiss typography", ";", "’", ".", {"Bohrung", "Ost", "Nord", "Hoehe", "Endteufe"}, german_log},
    {"Swiss French", "\t", "'", ",", usual_collar, usual_log},
    {"German", ";", ".", ",", german_collar, german_log},
    {"comma", ";", "", ",", german_collar, german_log},
    {"French", ";", "\xC2\xA0", ",", usual_collar, usual_log},
    {"narrow", ";", "\xE2\x80\xAF", ",", usual_collar, usual_log},
    {"blanks", ";", " ", ",", usual_collar, usual_log},
    {"blanks and points", ",", " ", ".", usual_collar, usual_log},
    {"American", ",", ",", ".", {"Hole-ID", "X_UTME", "Y_UTMN", "RL", "EOH"}, usual_log},
    {"bars", "|", "", ".", {"well", "xloc", "yloc", "zloc", "TD"}, usual_log},
    {"elevations", ",", "", ".", usual_collar, {"BHID", "Top", "Bottom", "AU", "CU"}, true},
    {"qualifiers", ",", "", ".", usual_collar, usual_log, false, true},
    {"depth below zero", ",", "", ".", usual_collar, usual_log, false, false, true},
    {"near ids", ",", "", ".", usual_collar, usual_log, false, false, false, true},
    {"all at once", ";", ".", ",", german_collar, {"Bohrung", "Top", "Bottom", "AU", "CU"}, true, true, true, true},
    {"Unicode text", "\t", "", ",", usual_collar, usual_log, false, false, false, false, true},
    {"said separator", ";", "", ",", usual_collar, usual_log, false, false, false, false, false, "sep=;\r\n"},
    {"notes above", ",", "", ".", usual_collar, usual_log, false, false, false, false, false,
     "Project Alpha\r\nprinted 2024-01-01\r\n\r\n"},
    {"groups above", ";", "", ".", usual_collar, usual_log, false, false, false, false, false, "Hole;Place;;;\r\n"},
    {"units below", ",", "", ".", usual_collar, usual_log, false, false, false, false, false, "", true},
    {"blank rows", ",", "", ".", usual_collar, usual_log, false, false, false, false, false, "", false, true},
    {"a sheet as it is",
     "\t",
     "",
     ",",
     {"Bohrung", "Rechtswert", "Hochwert", "Hoehe [m]", "Endteufe"},
     german_log,
     false,
     false,
     false,
     false,
     true,
     "Bericht\r\n\t\t\r\n",
     true,
     true},
};

}  // namespace

TEST_CASE("D3: fifty random sites read back to the same from every dialect") {
    const Dialect plain{"plain", ",", "", ".", usual_collar, usual_log};
    Random random(2056);
    for (int n = 0; n < 50; ++n) {
        const std::vector<RandomHole> holes = random_site(random);
        const Site expected = site_in(holes, plain);
        REQUIRE(expected.boreholes.size() == holes.size());
        REQUIRE(expected.samples.size() > holes.size());
        for (const Dialect& dialect : dialects) {
            INFO(dialect.name << ", site " << n);
            CHECK(same(expected, site_in(holes, dialect)));
        }
    }
}

TEST_CASE("D3: the model file of a site is the same to the byte from every dialect") {
    const Environment epoch("SOURCE_DATE_EPOCH", "1000000000");
    const testing::TemporaryFolder folder;
    const Dialect plain{"plain", ",", "", ".", usual_collar, usual_log};
    const auto stored = [&](Site site) {
        BuildOptions options;
        options.criteria.l_min = 4000;
        options.estimator = "nearest";
        save_model(folder / "model.gpkg", LiveModel(std::move(site), options).model(), {1, "", "build", "{}"}, true);
        return content(folder / "model.gpkg");
    };
    Random random(3067);
    for (std::size_t n = 0; n < 50; ++n) {
        const std::vector<RandomHole> holes = random_site(random);
        const std::string expected = stored(site_in(holes, plain));
        REQUIRE(expected.size() > 10000);
        for (std::size_t k = n % 6; k < dialects.size(); k += 6) {  // each dialect with every sixth site
            INFO(dialects[k].name << ", site " << n);
            CHECK(stored(site_in(holes, dialects[k])) == expected);
        }
    }
}
