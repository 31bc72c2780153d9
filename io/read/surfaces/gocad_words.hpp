// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The vocabulary of GOCAD files: vertex ids, units, keywords that do not matter.

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

#include "tess/base/no_index.hpp"

namespace terratet {

using VertexId = std::uint64_t;

/// Vertex index by id. Ids nearly always count up, so a plain array holds them; others go to a tree, whose cost no
/// choice of ids can make quadratic.
class VertexIds {
  public:
    void set(VertexId id, std::uint32_t index) {
        ++count_;
        if (id >= 2 * count_ + 1024) {
            sparse_[id] = index;
            return;
        }
        if (id >= dense_.size()) {
            dense_.resize(id + 1, no_index);
        }
        dense_[id] = index;
    }

    [[nodiscard]] std::optional<std::uint32_t> find(VertexId id) const {
        if (id < dense_.size() && dense_[id] != no_index) {
            return dense_[id];
        }
        const auto found = sparse_.find(id);
        return found == sparse_.end() ? std::nullopt : std::optional(found->second);
    }

  private:
    std::vector<std::uint32_t> dense_;
    std::map<VertexId, std::uint32_t> sparse_;
    std::size_t count_ = 0;
};

/// Metres of a unit by its names in GOCAD files; nullopt for "unitless", "none" and what is not known.
std::optional<double> metres_per(std::string_view unit);

/// What a file says that is neither needed nor a sign of damage.
bool is_ignorable(std::string_view keyword);

}  // namespace terratet
