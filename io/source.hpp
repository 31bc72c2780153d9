// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// How an input is named: `FILE[,layer=L][,srs=CRS][,where=…][,sql=…][,oo=KEY=VALUE]…`. FILE is anything GDAL opens,
/// /vsizip/, /vsicurl/, /vsistdin/ and PG: connection strings included.

#include <string>
#include <vector>

namespace terratet {

struct Source {
    std::string path = {};
    std::string layer = {};                      ///< empty: the first
    std::string srs = {};                        ///< empty: what the file says, then the general -s_srs
    std::string where = {};                      ///< attribute filter in OGR SQL
    std::string sql = {};                        ///< a statement instead of a layer
    std::vector<std::string> open_options = {};  ///< KEY=VALUE, handed to the driver

    /// For messages: the path and the layer. A password in a connection string is masked.
    [[nodiscard]] std::string describe() const;

    friend bool operator==(const Source&, const Source&) = default;
};

/// A connection string of PostgreSQL, "PG:…", instead of a file?
bool is_connection(const std::string& path);

/// Splits at commas that precede a known key (layer, srs, where, sql, oo), so that file names, statements and CRS may
/// hold commas. Throws UsageError on an unknown key after a file name, a key given twice, or without a file name.
Source parse_source(const std::string& text);

/// A length in its own unit, or in one that is known later: the model's.
struct Length {
    double value = 0;
    double metres = 0;   ///< in its unit; 0: it has none of its own
    std::string text{};  ///< as given, for messages

    [[nodiscard]] bool has_unit() const { return metres > 0; }

    /// In units of `metres_per_unit`.
    [[nodiscard]] double in(double metres_per_unit) const {
        return has_unit() ? value * metres / metres_per_unit : value;
    }
};

/// A finite number with an optional unit (mm, cm, m, km, ft, usft, in, yd, mi): `20`, `20m`, `65ft`. Throws UsageError.
Length parse_length(const std::string& text);

/// Metres in a unit as parse_length knows it. Throws UsageError naming those there are.
double metres_in_unit(const std::string& unit);

}  // namespace terratet
