// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/needed_drivers.hpp"

#include <gdal_priv.h>

#include <algorithm>
#include <array>
#include <vector>

#include "io/base/gdal_drivers.hpp"
#include "io/base/gdal_scope.hpp"

namespace terratet {

void keep_needed_gdal_drivers() {
    const GdalScope registered;
    const auto needed = [](const char* name) {
        constexpr std::array inner{"MEM", "Memory"};  // what GDAL itself works with
        const auto is_name = [&](const char* known) { return known && EQUAL(known, name); };
        return std::any_of(vector_drivers.begin(), vector_drivers.end(), is_name) ||
               std::any_of(raster_drivers.begin(), raster_drivers.end(), is_name) ||
               std::any_of(writing_drivers.begin(), writing_drivers.end(), is_name) ||
               std::any_of(inner.begin(), inner.end(), is_name);
    };
    GDALDriverManager& manager = *GetGDALDriverManager();
    std::vector<GDALDriver*> others;
    for (int i = 0; i < manager.GetDriverCount(); ++i) {
        if (!needed(manager.GetDriver(i)->GetDescription())) {
            others.push_back(manager.GetDriver(i));
        }
    }
    for (GDALDriver* const driver : others) {
        manager.DeregisterDriver(driver);
    }
}

}  // namespace terratet
