// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/memory_limit.hpp"

#include <unistd.h>
#include <algorithm>
#include <fstream>

namespace terratet {

std::uint64_t memory_limit() {
    std::uint64_t limit =
        static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
    for (const char* path : {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"}) {
        std::uint64_t allowed = 0;
        if (std::ifstream file(path); file >> allowed && allowed > 0) {  // "max" is no number
            limit = std::min(limit, allowed);
        }
    }
    return limit;
}

}  // namespace terratet
