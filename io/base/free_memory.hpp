// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Memory that a big input no longer needs, for what is made of it.

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace terratet {

/// Returns freed pieces to the system: glibc keeps those among others that are in use. Some milliseconds a gigabyte.
inline void give_back_memory() {
#ifdef __GLIBC__
    malloc_trim(0);
#endif
}

}  // namespace terratet
