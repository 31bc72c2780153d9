// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/voxels/tiles/tiles_folder.hpp"

#include <filesystem>

#include "tess/error.hpp"

namespace terratet {

namespace fs = std::filesystem;

std::string tiles_folder(const std::string& path) {
    const fs::path file(path);
    return file.has_extension() ? fs::path(file).replace_extension().string() : path + "_tiles";
}

bool holds_only_tiles(const std::string& path) {
    const std::string folder = tiles_folder(path);
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
        const std::string name = entry.path().filename().string();
        if (name != "content" && name != "subtrees" && !fs::exists(entry.path() / "tileset.json")) {
            throw Error("cannot write " + path + ": its tiles go into the folder " + folder + ", where there is '" +
                        name + "', which is no tileset's; choose another name");
        }
    }
    return true;
}

}  // namespace terratet
