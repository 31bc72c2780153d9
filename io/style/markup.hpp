// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace terratet {

/// For text and for attributes between double quotes, in XML, SVG and HTML. Control characters become blanks: XML
/// allows none.
std::string markup_text(std::string_view text);

}  // namespace terratet
