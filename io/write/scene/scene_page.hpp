// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The page that io/write/scene_page makes, as it is in the program.

#include <string_view>

namespace terratet {

/// HTML with places to fill in between @@: TITLE, CRS, LEGEND, HONESTY, HOLE_COUNT, HOLES, PICTURE, INFO, DATA.
std::string_view scene_page();

}  // namespace terratet
