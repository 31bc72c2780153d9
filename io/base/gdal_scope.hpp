// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// GDAL's global state within a scope: its messages, its options and what it may call, of this thread
/// only.

#include <string>

namespace terratet {

/// An option's value in this thread until the end of the scope, whatever the environment says.
class GdalOption {
  public:
    GdalOption(const char* key, const char* value);  ///< a null `value`: as the environment says
    ~GdalOption();
    GdalOption(const GdalOption&) = delete;
    GdalOption& operator=(const GdalOption&) = delete;

  private:
    const char* key_;
    std::string before_;
    bool had_ = false;
};

/// Registers GDAL's drivers (once a process) and, while alive, keeps its messages off stderr and GDAL off the network:
/// a file may name an address (the link of a GeoJSON's coordinate system, say), but nobody is called. Scopes nest;
/// messages go to the innermost.
class GdalScope {
  public:
    GdalScope() : GdalScope(std::string()) {}
    /// \param source  what will be opened: where that itself is on a network (network.hpp), its own file system may
    /// work
    explicit GdalScope(const std::string& source);
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
    bool on_network_;
    bool in_cloud_;
    GdalOption remote_files_;
    std::string failure_;
};

/// SQLite as GDAL opens it for reading: what a file's schema holds may call nothing that reaches outside it (a view
/// that asks a server for an address, say), whatever the environment says.
struct SafeSqlite {
    GdalOption pragma{"OGR_SQLITE_PRAGMA", "trusted_schema=OFF,cell_size_check=ON,query_only=ON"};
    GdalOption virtual_tables{"OGR_SQLITE_LIST_VIRTUAL_OGR", "NO"};
};

}  // namespace terratet
