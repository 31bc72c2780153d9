// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Floats of 113 bits: in software, some thirty times as slow as doubles.

namespace terratet {

#if defined(__SIZEOF_FLOAT128__)
__extension__ using Wide = __float128;
#else
using Wide = long double;  // 113 bits where there is no __float128 (ARM, POWER)
#endif

inline constexpr Wide wide_epsilon = Wide(1.0 / (1ull << 56)) / Wide(1ull << 56);  ///< 2⁻¹¹²

}  // namespace terratet
