// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/current_time.hpp"

#include <cstdlib>
#include <ctime>

namespace terratet {

std::string current_time_text(const char* format) {
    const char* const epoch = std::getenv("SOURCE_DATE_EPOCH");
    char* end = nullptr;
    const long long seconds = epoch ? std::strtoll(epoch, &end, 10) : 0;
    const std::time_t time =
        epoch && end != epoch && *end == '\0' ? static_cast<std::time_t>(seconds) : std::time(nullptr);
    std::tm parts{};
    gmtime_r(&time, &parts);
    char text[40];
    std::strftime(text, sizeof text, format, &parts);
    return text;
}

}  // namespace terratet
