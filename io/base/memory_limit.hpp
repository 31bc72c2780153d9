// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// How much memory there is to use.

#include <cstdint>

namespace terratet {

/// In bytes: the machine's, or what its control group (cgroup v2 or v1) allows where that is less.
std::uint64_t memory_limit();

}  // namespace terratet
