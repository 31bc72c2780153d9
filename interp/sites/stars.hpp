// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// For each vertex of the sites' tessellation its cells, ascending. 16 bytes a cell.

#include <cstdint>
#include <span>
#include <vector>

#include "interp/sites/compact_delaunay.hpp"

namespace terratet {

class Stars {
  public:
    /// O(cells).
    explicit Stars(const CompactDelaunay& mesh);

    [[nodiscard]] std::span<const std::int32_t> of(std::int32_t vertex) const {
        const auto i = static_cast<std::size_t>(vertex);
        return std::span(cells_).subspan(begin_[i], begin_[i + 1] - begin_[i]);
    }

  private:
    std::vector<std::size_t> begin_;
    std::vector<std::int32_t> cells_;
};

}  // namespace terratet
