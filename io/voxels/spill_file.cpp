// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/voxels/spill_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>

#include "io/base/output_file.hpp"

namespace terratet {

namespace {

constexpr std::uint64_t kept_in_memory = 64 << 20;

}  // namespace

void SpillFile::open() {
    const std::filesystem::path parent = std::filesystem::path(output_).parent_path();
    std::string name = ((parent.empty() ? std::filesystem::path(".") : parent) / ".terratet-XXXXXX").string();
    file_ = mkostemp(name.data(), O_CLOEXEC);
    if (file_ < 0) {
        fail_writing(output_, errno);
    }
    unlink(name.c_str());
    size_ = 0;
    append(std::exchange(memory_, {}));
}

SpillFile::~SpillFile() {
    if (file_ >= 0) {
        close(file_);
    }
}

std::uint64_t SpillFile::append(std::span<const char> bytes) {
    if (file_ < 0 && size_ + bytes.size() > kept_in_memory) {
        open();
    }
    const std::uint64_t begin = size_;
    if (file_ < 0) {
        memory_.append(bytes.data(), bytes.size());
        size_ += bytes.size();
        return begin;
    }
    while (!bytes.empty()) {
        const ssize_t written = pwrite(file_, bytes.data(), bytes.size(), static_cast<off_t>(size_));
        if (written < 0 && errno == EINTR) {
            continue;
        }
        if (written <= 0) {
            fail_writing(output_, written < 0 ? errno : ENOSPC);
        }
        size_ += static_cast<std::uint64_t>(written);
        bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
    return begin;
}

void SpillFile::read(std::uint64_t begin, std::span<char> bytes) const {
    if (file_ < 0) {
        memory_.copy(bytes.data(), bytes.size(), begin);
        return;
    }
    while (!bytes.empty()) {
        const ssize_t got = pread(file_, bytes.data(), bytes.size(), static_cast<off_t>(begin));
        if (got < 0 && errno == EINTR) {
            continue;
        }
        if (got <= 0) {
            fail_writing(output_, got < 0 ? errno : EIO);
        }
        begin += static_cast<std::uint64_t>(got);
        bytes = bytes.subspan(static_cast<std::size_t>(got));
    }
}

void SpillFile::clear() {
    memory_.clear();
    if (file_ >= 0 && ftruncate(file_, 0) != 0) {
        fail_writing(output_, errno);
    }
    size_ = 0;
}

}  // namespace terratet
