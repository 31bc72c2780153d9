// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Numbers in bytes, of either end.

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <string_view>

#include "tess/error.hpp"

namespace terratet {

class ByteCursor {
  public:
    explicit ByteCursor(std::string_view bytes, std::endian order = std::endian::little)
        : rest_(bytes), order_(order) {}

    /// Throws InputError when the bytes end before.
    template <typename Number>
    Number take() {
        if (rest_.size() < sizeof(Number)) {
            throw InputError("the file is cut off: bytes are missing at its end");
        }
        std::array<char, sizeof(Number)> bytes{};
        std::memcpy(bytes.data(), rest_.data(), sizeof(Number));
        rest_.remove_prefix(sizeof(Number));
        if (order_ != std::endian::native) {
            std::ranges::reverse(bytes);
        }
        return std::bit_cast<Number>(bytes);
    }

    [[nodiscard]] std::size_t left() const { return rest_.size(); }
    void skip(std::size_t bytes) { rest_.remove_prefix(std::min(bytes, rest_.size())); }

  private:
    std::string_view rest_;
    std::endian order_;
};

}  // namespace terratet
