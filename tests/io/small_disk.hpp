// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// A disk that is soon full.

#include <sys/mount.h>
#include <sys/stat.h>

#include <string>

#include "support.hpp"

namespace terratet::testing {

/// A file system of the given size on a fresh folder until the end of the scope. Needs the right to mount.
class SmallDisk {
  public:
    explicit SmallDisk(std::size_t bytes) : path_(folder_ / "disk") {
        ::mkdir(path_.c_str(), 0777);
        const std::string options = "size=" + std::to_string(bytes);
        mounted_ = ::mount("tmpfs", path_.c_str(), "tmpfs", 0, options.c_str()) == 0;
    }
    ~SmallDisk() {
        if (mounted_) {
            ::umount2(path_.c_str(), MNT_DETACH);
        }
    }
    SmallDisk(const SmallDisk&) = delete;
    SmallDisk& operator=(const SmallDisk&) = delete;

    [[nodiscard]] bool mounted() const { return mounted_; }
    [[nodiscard]] const std::string& path() const { return path_; }

  private:
    TemporaryFolder folder_;
    std::string path_;
    bool mounted_ = false;
};

}  // namespace terratet::testing
