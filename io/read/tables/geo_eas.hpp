// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// GSLIB's tables (Geo-EAS): a title, the number of columns, a name a line, then rows of numbers.
/// Deutsch and Journel, GSLIB, 1998, II.1.2.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace terratet {

struct GeoEasHeader {
    std::vector<std::string> columns;
    std::int64_t lines = 0;  ///< of the header, the title's included
};

/// \param head  the beginning of a text; nothing where it is no such table
std::optional<GeoEasHeader> geo_eas_header(std::string_view head);

}  // namespace terratet
