// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// GDAL's global state within a scope: its messages and its options, of this thread only. Private to this floor.

#include <string>

namespace terratet {

/// Registers GDAL's drivers (once a process) and, while alive, keeps its messages off stderr. Scopes nest; messages go
/// to the innermost.
class GdalScope {
  public:
    GdalScope();
    ~GdalScope();
    GdalScope(const GdalScope&) = delete;
    GdalScope& operator=(const GdalScope&) = delete;

    /// The first failure since construction or the last clear(), empty when there was none. The first, since what GDAL
    /// says afterwards is often a consequence.
    [[nodiscard]] const std::string& failure() const { return failure_; }
    [[nodiscard]] bool failed() const { return !failure_.empty(); }
    void clear() { failure_.clear(); }

    /// Called by the handler.
    void take(const char* message);

  private:
    std::string failure_;
};

/// An option's value in this thread until the end of the scope, whatever the environment says.
class GdalOption {
  public:
    GdalOption(const char* key, const char* value);
    ~GdalOption();
    GdalOption(const GdalOption&) = delete;
    GdalOption& operator=(const GdalOption&) = delete;

  private:
    const char* key_;
    std::string before_;
    bool had_ = false;
};

}  // namespace terratet
