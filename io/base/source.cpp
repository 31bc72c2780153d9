// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/source.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "tess/base/words.hpp"
#include "tess/error.hpp"

namespace terratet {

namespace {

constexpr std::array keys{"layer", "srs", "where", "sql", "oo"};

bool is_known(const std::string& key) {
    return std::ranges::find(keys, key) != keys.end();
}

/// The key when a comma at `comma` is followed by `key=`.
std::optional<std::string> key_after(const std::string& text, std::size_t comma) {
    std::size_t end = comma + 1;
    while (end < text.size() && (std::isalnum(static_cast<unsigned char>(text[end])) != 0 || text[end] == '_')) {
        ++end;
    }
    if (end == comma + 1 || end == text.size() || text[end] != '=') {
        return std::nullopt;
    }
    return text.substr(comma + 1, end - comma - 1);
}

/// The comma that ends the part beginning at `begin`. In a file name `,word=` can only be a mistyped key; elsewhere
/// (statements, filters, connection strings) it is text.
std::size_t end_of_part(const std::string& text, std::size_t begin, bool file_name) {
    for (std::size_t comma = text.find(',', begin); comma != std::string::npos; comma = text.find(',', comma + 1)) {
        const std::optional<std::string> key = key_after(text, comma);
        if (key && is_known(*key)) {
            return comma;
        }
        if (key && file_name) {
            throw UsageError("unknown key '" + *key + "' in '" + text +
                             "': after the file come layer=, srs=, where=, sql=, oo=" +
                             did_you_mean(*key, names_of(keys, std::identity())));
        }
    }
    return text.size();
}

void assign(Source& source, const std::string& key, std::string value, const std::string& text) {
    if (value.empty()) {
        throw UsageError("'" + key + "=' has no value in '" + text + "'");
    }
    if (key == "oo") {
        if (value.find('=') == std::string::npos) {
            throw UsageError("oo=" + value + " in '" + text + "' is not KEY=VALUE");
        }
        source.open_options.push_back(std::move(value));
        return;
    }
    std::string& field = key == "layer"   ? source.layer
                         : key == "srs"   ? source.srs
                         : key == "where" ? source.where
                                          : source.sql;
    if (!field.empty()) {
        throw UsageError("'" + key + "=' is given twice in '" + text + "'");
    }
    field = std::move(value);
}

/// A connection string with `password=…` masked, quoted or not.
std::string without_password(std::string text) {
    const std::string key = "password=";
    const std::size_t begin = text.find(key);
    if (begin == std::string::npos) {
        return text;
    }
    const std::size_t value = begin + key.size();
    const bool quoted = value < text.size() && text[value] == '\'';
    const std::size_t end = text.find(quoted ? '\'' : ' ', value + (quoted ? 1 : 0));
    const std::size_t last = end == std::string::npos ? text.size() : end + (quoted ? 1 : 0);
    return text.replace(value, last - value, "***");
}

struct Unit {
    const char* name;
    double metres;
};

constexpr std::array<Unit, 9> units{{{"mm", 0.001},
                                     {"cm", 0.01},
                                     {"m", 1},
                                     {"km", 1000},
                                     {"ft", 0.3048},
                                     {"usft", 1200.0 / 3937.0},
                                     {"in", 0.0254},
                                     {"yd", 0.9144},
                                     {"mi", 1609.344}}};

}  // namespace

bool is_connection(const std::string& path) {
    return path.starts_with("PG:");
}

std::string Source::describe() const {
    const std::string shown = is_connection(path) ? without_password(path) : path;
    return layer.empty() ? shown : shown + " (layer " + layer + ")";
}

Source parse_source(const std::string& text) {
    Source source;
    std::size_t end = end_of_part(text, 0, !is_connection(text));
    source.path = text.substr(0, end);
    if (source.path.empty()) {
        throw UsageError("no file name in '" + text + "'");
    }
    while (end < text.size()) {
        const std::string key = *key_after(text, end);
        const std::size_t begin = end + key.size() + 2;
        end = end_of_part(text, begin, false);
        assign(source, key, text.substr(begin, end - begin), text);
    }
    if (!source.sql.empty() && !source.layer.empty()) {
        throw UsageError("both layer= and sql= in '" + text + "': a statement names its layer itself");
    }
    return source;
}

double metres_in_unit(const std::string& unit) {
    const auto* found = std::ranges::find_if(units, [&](const Unit& known) { return unit == known.name; });
    if (found == units.end()) {
        const auto known = names_of(units, &Unit::name);
        throw UsageError("unknown unit of length '" + unit + "': one of " + listed(known) + did_you_mean(unit, known));
    }
    return found->metres;
}

Length parse_length(const std::string& text) {
    double value = 0;
    const char* const last = text.data() + text.size();
    const auto [end, error] = std::from_chars(text.data(), last, value);
    if (error != std::errc() || !std::isfinite(value)) {
        throw UsageError("'" + text + "' is not a length: a number with or without a unit, as in 20, 20m or 65ft");
    }
    const std::string unit(end, last);
    return {value, unit.empty() ? 0 : metres_in_unit(unit), text};
}

}  // namespace terratet
