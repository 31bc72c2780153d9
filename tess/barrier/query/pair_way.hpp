// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// How far the middle of a pair of seeds may stand from the vertex of its sheet that it belongs to.

namespace terratet {

/// In lengths of the edges there: pairs are moved so far to mend slivers.
inline constexpr double pair_way = 0.04;

/// Within it a pair is a vertex's own: with some slack, for edges differ.
inline constexpr double own_pair = 1.3 * pair_way;

}  // namespace terratet
