// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The index of nothing.

#include <cstdint>
#include <limits>

namespace terratet {

/// Where a table of indices holds none. Numbers that are stored or that a user sees are signed, and −1 there.
inline constexpr std::uint32_t no_index = std::numeric_limits<std::uint32_t>::max();

}  // namespace terratet
