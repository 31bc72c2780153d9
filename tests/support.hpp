// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// What tests share: where data is, temporary folders, seeded random numbers.

#include <unistd.h>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <random>
#include <string>

#include "source_dir.hpp"
#include "tess/geometry.hpp"

namespace terratet::testing {

/// A file or folder of the project's own data.
inline std::filesystem::path project_data(const std::string& relative) {
    return source_dir() / "data" / relative;
}

/// A file or folder of the public data sets, which are not part of the project: the folder TERRATET_PUBLIC_DATA names,
/// or shared/data beside the checkout. Nothing when absent: the test then says so (WARN) and returns.
inline std::optional<std::filesystem::path> public_data(const std::string& relative) {
    const char* named = std::getenv("TERRATET_PUBLIC_DATA");
    const auto root = named ? std::filesystem::path(named) : source_dir() / ".." / "shared" / "data";
    std::error_code error;
    const auto path = root / relative;
    return std::filesystem::exists(path, error) ? std::optional(path) : std::nullopt;
}

/// A fresh folder, removed with everything in it at the end of the scope.
class TemporaryFolder {
  public:
    TemporaryFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "terratet-XXXXXX").string();
        path_ = mkdtemp(name.data());
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    [[nodiscard]] std::string operator/(const std::string& name) const { return (path_ / name).string(); }
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

/// Uniform doubles from a fixed seed. Not std::uniform_real_distribution: its values differ between libraries.
class Random {
  public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}
    double operator()(double lo = 0, double hi = 1) {
        return lo + (hi - lo) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
    }
    Vec3 in(const Box3& box) {
        return {(*this)(box.lo.x, box.hi.x), (*this)(box.lo.y, box.hi.y), (*this)(box.lo.z, box.hi.z)};
    }
    std::uint64_t below(std::uint64_t n) { return engine_() % n; }

  private:
    std::mt19937_64 engine_;
};

}  // namespace terratet::testing
