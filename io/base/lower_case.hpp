// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Names that differ by the case of ASCII letters alone, as databases and people take them for the same.

#include <string>
#include <string_view>

namespace terratet {

/// A to Z as a to z; other letters stay.
inline std::string lower_case(std::string_view text) {
    std::string result(text);
    for (char& c : result) {
        c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    }
    return result;
}

}  // namespace terratet
