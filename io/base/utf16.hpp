// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// UTF-16 as UTF-8.

#include <string>
#include <vector>

namespace terratet {

/// Takes whole characters off the front of the bytes; what is left waits for the next ones. Byte order marks are
/// dropped, halves of pairs become U+FFFD. UTF-8 is at most half as long again.
std::string utf16_text(std::vector<unsigned char>& bytes, bool little_endian);

}  // namespace terratet
