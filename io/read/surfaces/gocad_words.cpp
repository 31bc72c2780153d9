// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read/surfaces/gocad_words.hpp"

#include <set>
#include <string>

namespace terratet {

std::optional<double> metres_per(std::string_view unit) {
    static const std::map<std::string, double, std::less<>> known = {{"m", 1},
                                                                     {"meter", 1},
                                                                     {"meters", 1},
                                                                     {"metre", 1},
                                                                     {"metres", 1},
                                                                     {"km", 1000},
                                                                     {"kilometer", 1000},
                                                                     {"kilometers", 1000},
                                                                     {"kilometre", 1000},
                                                                     {"kilometres", 1000},
                                                                     {"cm", 0.01},
                                                                     {"mm", 0.001},
                                                                     {"in", 0.0254},
                                                                     {"inch", 0.0254},
                                                                     {"inches", 0.0254},
                                                                     {"ft", 0.3048},
                                                                     {"feet", 0.3048},
                                                                     {"foot", 0.3048},
                                                                     {"yd", 0.9144},
                                                                     {"ftus", 1200.0 / 3937},
                                                                     {"us-ft", 1200.0 / 3937}};
    std::string lower(unit);
    for (char& c : lower) {
        c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    }
    const auto found = known.find(lower);
    return found == known.end() ? std::nullopt : std::optional(found->second);
}

bool is_ignorable(std::string_view keyword) {
    static const std::set<std::string_view> known = {"BSTONE",
                                                     "BORDER",
                                                     "PROPERTIES",
                                                     "PROP_LEGAL_RANGES",
                                                     "NO_DATA_VALUES",
                                                     "PROPERTY_CLASSES",
                                                     "PROPERTY_KINDS",
                                                     "PROPERTY_SUBCLASSES",
                                                     "ESIZES",
                                                     "UNITS",
                                                     "GEOLOGICAL_TYPE",
                                                     "GEOLOGICAL_FEATURE",
                                                     "STRATIGRAPHIC_POSITION",
                                                     "}"};
    return keyword.empty() || keyword.front() == '#' || known.contains(keyword);
}

}  // namespace terratet
