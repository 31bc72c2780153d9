// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The library's messages name its own fields, in backticks, as "`l_min` must be a positive length"; whoever reads them
/// at a terminal knows the options that set them.

#include <string>
#include <string_view>

namespace terratet::tools {

/// Each field in backticks as the option that sets it: "--lmin must be a positive length". By rule its name with
/// dashes, with a few exceptions; what no command declares stays as it is, and so do the names of records ("layer
/// `samples`", "column `fid`").
std::string with_options(std::string_view text);

}  // namespace terratet::tools
