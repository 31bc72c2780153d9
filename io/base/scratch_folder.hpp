// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// A folder of its own among the temporary ones, gone with all in it at the end.

#include <stdlib.h>

#include <filesystem>
#include <string>

#include "tess/error.hpp"

namespace terratet {

class ScratchFolder {
  public:
    ScratchFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "terratet-XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr) {
            throw Error("cannot make a temporary folder in " + std::filesystem::temp_directory_path().string());
        }
        path_ = name;
    }
    ~ScratchFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

}  // namespace terratet
