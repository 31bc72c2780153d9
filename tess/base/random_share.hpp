// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Numbers as if by chance, the same each time.

#include <cstdint>

namespace terratet {

/// The finaliser of SplitMix64 (Steele, Lea, Flood 2014): neighbouring keys give unrelated ones.
inline std::uint64_t mixed_key(std::uint64_t key) {
    key += 0x9e3779b97f4a7c15ULL;
    key = (key ^ (key >> 30U)) * 0xbf58476d1ce4e5b9ULL;
    key = (key ^ (key >> 27U)) * 0x94d049bb133111ebULL;
    return key ^ (key >> 31U);
}

/// From 0 to below 1.
inline double random_share(std::uint64_t key) {
    return static_cast<double>(mixed_key(key) >> 11U) * 0x1p-53;
}

}  // namespace terratet
