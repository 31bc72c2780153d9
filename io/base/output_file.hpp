// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Output whole or not at all: bytes go to a temporary file in the same folder; commit() syncs and renames it.
/// Destroyed without commit, nothing remains. (A killed process leaves its temporary file, `.terratet-*`, and what was
/// there before.) A limit on the size of files (ulimit -f) is an error like a full disk where SIGXFSZ is ignored, as
/// the command does; else the system kills the process.

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace terratet {

class OutputFile {
  public:
    /// Throws Error: the folder is missing or not writable, `path` is a folder or a device, or it exists and
    /// `overwrite` is false. A symbolic link is followed: the link stays, its target is replaced.
    OutputFile(std::string path, bool overwrite);
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    /// Throws Error with the system's reason (disk full).
    void write(std::span<const std::byte> bytes);
    void write(std::string_view text);

    /// For libraries that open files themselves; close() must be called before they do. It ends in the extension of the
    /// path, since such libraries go by it.
    [[nodiscard]] const std::string& temporary_path() const { return temporary_; }
    void close();

    /// fsync, rename, fsync of the folder. Returns the file's size. Without `overwrite`, a file that came to be at the
    /// path meanwhile is refused, not replaced. Throws Error; nothing of this output remains then.
    std::uint64_t commit();

  private:
    std::string path_;    ///< as given, for messages
    std::string target_;  ///< symbolic links resolved
    std::string temporary_;
    std::FILE* file_ = nullptr;
    bool overwrite_ = false;
    bool committed_ = false;
};

/// A folder of files, whole or not at all: they go into a temporary folder beside it, which commit() renames.
class OutputFolder {
  public:
    /// Throws Error: the parent is missing or not writable, or the folder exists and `overwrite` is false.
    OutputFolder(std::string path, bool overwrite);
    ~OutputFolder();
    OutputFolder(const OutputFolder&) = delete;
    OutputFolder& operator=(const OutputFolder&) = delete;

    [[nodiscard]] const std::string& temporary_path() const { return temporary_; }
    /// A file in it, its folders made as needed; for many threads at a time. Throws Error with the system's reason.
    void write(const std::string& name, std::span<const std::string_view> parts) const;
    /// On the disk, in place; a folder that was there before is gone with all in it.
    void commit();

  private:
    std::string path_;
    std::string temporary_;
    bool overwrite_ = false;
    bool committed_ = false;
};

/// For a program that has to end at once: removes the temporary files of all outputs not committed, and returns the
/// paths of those that were. From then on whoever begins or commits one waits for the end.
std::vector<std::string> abandon_outputs();

/// Throws Error: cannot write `path`, for the reason that `error` (an errno) stands for, and what to do about it.
[[noreturn]] void fail_writing(const std::string& path, int error);

/// Refuses an existing output early, before hours of work; also a missing or read-only folder. Throws Error, naming
/// --overwrite for an existing file.
void require_writable(const std::string& path, bool overwrite);

}  // namespace terratet
