// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "source_dir.hpp"

namespace terratet::testing {

std::filesystem::path source_dir() {
    return TERRATET_SOURCE_DIR;
}

}  // namespace terratet::testing
