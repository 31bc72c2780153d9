// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/model/model_schema.hpp"

#include <string_view>

#include "io/base/lower_case.hpp"

namespace terratet {
namespace {

/// Without what needs quoting twice somewhere, and short enough for PostgreSQL with a number behind.
std::string fit_column(const std::string& name) {
    constexpr std::size_t longest = 50;
    std::string result = name.substr(0, longest);
    while (!result.empty() && name.size() > longest &&
           (static_cast<unsigned char>(name[result.size()]) & 0xC0) == 0x80) {
        result.pop_back();  // no half characters
    }
    for (char& c : result) {
        const bool odd = static_cast<unsigned char>(c) < ' ' || c == 0x7F ||
                         std::string_view("\"'`\\;%,=").find(c) != std::string_view::npos;
        c = odd ? '_' : c;
    }
    const std::size_t first = result.find_first_not_of(' ');
    return first == std::string::npos ? "property" : result.substr(first, result.find_last_not_of(' ') - first + 1);
}

/// With a number behind where it is taken, in any case; taken from now on.
std::string distinct_column(const std::string& wanted, std::set<std::string>& taken) {
    std::string column = wanted;
    for (int n = 2; !taken.insert(lower_case(column)).second; ++n) {
        column = wanted + "_" + std::to_string(n);
    }
    return column;
}

}  // namespace

const std::set<std::string>& schema::reserved_columns() {
    static const std::set<std::string> names = {
        "fid",   "geom", "id",      "borehole", "hole",     "depth", "length", "role", "owner", "side", "extrapolation",
        "rowid", "oid",  "_rowid_", "ogc_fid",  "tableoid", "xmin",  "cmin",   "xmax", "cmax",  "ctid"};
    return names;
}

std::vector<std::string> schema::property_columns(const std::vector<Property>& properties) {
    std::set<std::string> taken = schema::reserved_columns();
    std::vector<std::string> columns;
    for (const Property& property : properties) {
        columns.push_back(distinct_column(fit_column(property.name), taken));
    }
    return columns;
}

std::vector<std::string> schema::censored_columns(const std::vector<std::string>& property_columns,
                                                  const Samples& measured) {
    std::set<std::string> taken = schema::reserved_columns();
    for (const std::string& column : property_columns) {
        taken.insert(lower_case(column));
    }
    std::vector<std::string> columns(property_columns.size());
    for (std::size_t p = 0; p < columns.size(); ++p) {
        if (measured.censored_count(p) > 0) {
            columns[p] = distinct_column(property_columns[p] + "_censored", taken);
        }
    }
    return columns;
}

}  // namespace terratet
