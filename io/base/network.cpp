// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/network.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace terratet {

bool names_network(const std::string& text) {
    constexpr std::array<std::string_view, 9> file_systems{
        "/vsicurl", "/vsis3", "/vsigs", "/vsiaz", "/vsiadls", "/vsioss", "/vsiswift", "/vsiwebhdfs", "/vsihdfs"};
    return text.find("PG:") != std::string::npos ||
           std::any_of(file_systems.begin(), file_systems.end(),
                       [&](std::string_view name) { return text.find(name) != std::string::npos; });
}

}  // namespace terratet
