// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/file_bytes.hpp"

#include <cpl_vsi.h>

#include <algorithm>

#include "io/base/gdal_scope.hpp"

namespace terratet {

std::string file_bytes(const std::string& path, std::size_t offset, std::size_t count) {
    constexpr std::size_t chunk = 1 << 20;
    const GdalScope quiet(path);
    VSIStatBufL status;
    if (VSIStatExL(path.c_str(), &status, VSI_STAT_EXISTS_FLAG | VSI_STAT_NATURE_FLAG) == 0 &&
        VSI_ISDIR(status.st_mode)) {
        return {};
    }
    VSILFILE* const file = VSIFOpenL(path.c_str(), "rb");
    if (file == nullptr) {
        return {};
    }
    std::string bytes;
    if (offset == 0 || VSIFSeekL(file, offset, SEEK_SET) == 0) {
        for (std::size_t got = chunk; got == chunk && bytes.size() < count;) {
            const std::size_t before = bytes.size();
            const std::size_t wanted = std::min(chunk, count - before);
            bytes.resize(before + wanted);
            got = VSIFReadL(bytes.data() + before, 1, wanted, file);
            bytes.resize(before + got);
        }
    }
    VSIFCloseL(file);
    return bytes;
}

}  // namespace terratet
