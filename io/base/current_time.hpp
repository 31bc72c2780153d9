// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The time that goes into files.

#include <string>

#include "io/base/gdal_scope.hpp"

namespace terratet {

/// SOURCE_DATE_EPOCH (seconds since 1970) when set, so that equal runs give equal files; in UTC.
std::string current_time_text(const char* format = "%Y-%m-%dT%H:%M:%SZ");

/// As long as it lives, GDAL writes that time into GeoPackages, in this thread.
class GeoPackageTime {
  public:
    [[nodiscard]] const std::string& text() const { return text_; }

  private:
    std::string text_ = current_time_text("%Y-%m-%dT%H:%M:%S.000Z");
    GdalOption option_{"OGR_CURRENT_DATE", text_.c_str()};
};

}  // namespace terratet
