// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Where the checkout is: compiled into one small file, so that all other objects are the same in every checkout.

#include <filesystem>

namespace terratet::testing {

std::filesystem::path source_dir();

}  // namespace terratet::testing
