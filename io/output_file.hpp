// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Output whole or not at all: bytes go to a temporary file in the same folder; commit() syncs and renames it. Destroyed
/// without commit, nothing remains.

#include <cstdint>
#include <cstdio>
#include <span>
#include <string>
#include <string_view>

namespace terratet {

class OutputFile {
  public:
    /// Throws Error: the folder is missing or not writable, or `path` exists and `overwrite` is false.
    OutputFile(std::string path, bool overwrite);
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    /// Throws Error with the system's reason (disk full).
    void write(std::span<const std::byte> bytes);
    void write(std::string_view text);

    /// For libraries that open files themselves; close() must be called before they do.
    [[nodiscard]] const std::string& temporary_path() const { return temporary_; }
    void close();

    /// fsync, rename, fsync of the folder. Returns the file's size.
    std::uint64_t commit();

  private:
    std::string path_;
    std::string temporary_;
    std::FILE* file_ = nullptr;
    bool committed_ = false;
};

/// Refuses an existing output early, before hours of work. Throws Error naming --overwrite.
void require_writable(const std::string& path, bool overwrite);

}  // namespace terratet
