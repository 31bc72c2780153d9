// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Which of many things that exclude each other in pairs may be there together.

#include <cstdint>
#include <vector>

namespace terratet {

/// \param conflicts  by thing: those it can't be there with, in any order, some doubly; both are told of each pair
/// \returns by thing: may it be there? No two in conflict are, and none is left out that could be added: those with
/// most conflicts go first (a greedy maximal independent set). Deterministic. O(n log n) for n pairs.
std::vector<char> compatible(std::vector<std::vector<std::uint32_t>> conflicts);

}  // namespace terratet
