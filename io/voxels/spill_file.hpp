// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Bytes kept until their turn comes: in memory as long as they are few, then on disk, in a file without a name, so
/// that nothing of it can remain.

#include <cstdint>
#include <span>
#include <string>
#include <utility>

namespace terratet {

class SpillFile {
  public:
    /// The file is made in the folder of the output that it is for.
    explicit SpillFile(std::string output) : output_(std::move(output)) {}
    ~SpillFile();
    SpillFile(const SpillFile&) = delete;
    SpillFile& operator=(const SpillFile&) = delete;

    /// Returns where they begin. Throws Error with the system's reason (disk full).
    std::uint64_t append(std::span<const char> bytes);
    void read(std::uint64_t begin, std::span<char> bytes) const;
    [[nodiscard]] std::uint64_t size() const { return size_; }
    /// Forgets all.
    void clear();

  private:
    void open();

    std::string output_;
    std::string memory_;  ///< all of them, as long as there is no file
    int file_ = -1;
    std::uint64_t size_ = 0;
};

}  // namespace terratet
