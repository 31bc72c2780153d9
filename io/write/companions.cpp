// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/write/companions.hpp"

#include <system_error>

#include "io/base/output_file.hpp"

namespace terratet {

Companions::Companions(const std::string& path) : folder_(std::filesystem::path(path).replace_extension()) {
    std::error_code error;
    std::filesystem::create_directory(folder_, error);
    if (error) {
        fail_writing(folder_.string(), error.value());
    }
}

Companions::~Companions() {
    std::error_code not_empty;
    std::filesystem::remove(folder_, not_empty);
}

std::string Companions::path_of(const std::string& name, const std::string& extension) {
    std::string stem = name;
    for (char& c : stem) {
        const bool plain = (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '.' ||
                           c == '-' || c == '_';
        c = plain ? c : '_';
    }
    if (stem.empty() || stem[0] == '.') {
        stem = "_" + stem;
    }
    std::string file = stem + extension;
    for (int n = 2; !used_.insert(file).second; ++n) {
        file = stem + "_" + std::to_string(n) + extension;
    }
    return (folder_ / file).string();
}

}  // namespace terratet
