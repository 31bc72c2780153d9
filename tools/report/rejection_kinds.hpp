// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Rejected records summed up by reason: a thousand rows that lack a collar are one line.

#include <string>
#include <vector>

#include "tess/diagnostics.hpp"

namespace terratet::tools {

/// Records of one file whose reasons differ in names and numbers only.
struct RejectionKind {
    Rejected first;
    std::size_t count = 0;
};

/// In the order of the first ones.
std::vector<RejectionKind> rejection_kinds(const std::vector<Rejected>& rejected);

}  // namespace terratet::tools
