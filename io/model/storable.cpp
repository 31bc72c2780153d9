// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/model/storable.hpp"

#include <nlohmann/json.hpp>

namespace terratet {

bool is_storable(const std::string& text) {
    if (text.find('\0') != std::string::npos) {
        return false;
    }
    try {
        return !nlohmann::json(text).dump().empty();
    } catch (const nlohmann::json::type_error&) {  // not UTF-8
        return false;
    }
}

}  // namespace terratet
