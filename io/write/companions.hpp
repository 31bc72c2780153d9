// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Files that belong to an output: they lie in a folder beside it that has its name.

#include <cstdint>
#include <filesystem>
#include <set>
#include <string>

namespace terratet {

class Companions {
  public:
    /// Makes the folder unless it is there. Throws Error where it cannot.
    explicit Companions(const std::string& path);
    ~Companions();  ///< a folder without a file goes
    Companions(const Companions&) = delete;
    Companions& operator=(const Companions&) = delete;

    /// A file in it, called after anything: what is no letter, digit, dot, hyphen or low line becomes a low line, and
    /// the second of a name gets a number.
    [[nodiscard]] std::string path_of(const std::string& name, const std::string& extension);

    [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

  private:
    std::filesystem::path folder_;
    std::set<std::string> used_;
};

}  // namespace terratet
