// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/sites/stars.hpp"

namespace terratet {

Stars::Stars(const CompactDelaunay& mesh) : begin_(mesh.points().size() + 1, 0), cells_(4 * mesh.cells().size()) {
    for (const auto& cell : mesh.cells()) {
        for (const std::int32_t v : cell.vertex) {
            ++begin_[static_cast<std::size_t>(v) + 1];
        }
    }
    for (std::size_t v = 1; v < begin_.size(); ++v) {
        begin_[v] += begin_[v - 1];
    }
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    for (std::size_t i = 0; i < mesh.cells().size(); ++i) {
        for (const std::int32_t v : mesh.cells()[i].vertex) {
            cells_[next[static_cast<std::size_t>(v)]++] = static_cast<std::int32_t>(i);
        }
    }
}

}  // namespace terratet
