// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Text from files on a terminal. Names of columns, holes, surfaces and files may hold anything: what would move the
/// cursor, colour the screen, turn the direction of writing or hide itself is shown instead of done.

#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

namespace terratet::tools {

/// Control characters and bytes that are no UTF-8 as `\x1b`; invisible characters and those that turn the direction of
/// writing as `\u202e`. Line ends and tabs are kept, or escaped as well.
std::string printable(std::string_view text, bool keep_lines = false);

/// JSON on several lines with a line end behind, with `\u009b` inside texts for what printable() would escape.
std::string json_text(const nlohmann::ordered_json& json);

}  // namespace terratet::tools
