// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Which hole a log belongs to, by the names that files have for it.

#include <map>
#include <string>
#include <vector>

#include "io/read/tables/read_table.hpp"
#include "tess/diagnostics.hpp"

namespace terratet {

/// The names that collar tables have for holes: the id, and every other column that can be an id.
class HoleNames {
  public:
    void add(const Table& table, const ColumnNames& names);
    void add_aliases(const std::vector<std::string>& names, const std::string& hole);

    /// The hole known by the first of these names that one is known by; by nearly that name (noted) where none is.
    /// Empty: none. A name of two holes is none.
    [[nodiscard]] std::string find(const std::vector<std::string>& names, const std::string& file,
                                   Diagnostics& diagnostics) const;

  private:
    using Known = std::map<std::string, std::string>;
    static void enter(Known& known, const std::string& name, const std::string& hole);

    Known ids_;
    Known exact_;
    Known loose_;
};

}  // namespace terratet
