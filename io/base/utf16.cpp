// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/utf16.hpp"

#include <cstddef>

namespace terratet {

std::string utf16_text(std::vector<unsigned char>& bytes, bool little_endian) {
    std::string text;
    std::size_t used = 0;
    const auto unit = [&](std::size_t at) {
        const unsigned lo = bytes[little_endian ? at : at + 1];
        const unsigned hi = bytes[little_endian ? at + 1 : at];
        return hi << 8U | lo;
    };
    for (; used + 1 < bytes.size(); used += 2) {
        unsigned code = unit(used);
        if (code >= 0xD800 && code < 0xDC00) {
            if (used + 3 >= bytes.size()) {
                break;  // its second half comes with the next bytes
            }
            const unsigned low = unit(used + 2);
            const bool pair = low >= 0xDC00 && low < 0xE000;
            code = pair ? 0x10000 + ((code - 0xD800) << 10U) + (low - 0xDC00) : 0xFFFD;
            used += pair ? 2 : 0;
        }
        if (code == 0xFEFF) {
            continue;  // the byte order mark
        }
        const auto put = [&](unsigned byte) { text += static_cast<char>(byte); };
        if (code < 0x80) {
            put(code);
        } else if (code < 0x800) {
            put(0xC0 | code >> 6U);
            put(0x80 | (code & 0x3FU));
        } else if (code < 0x10000) {
            put(0xE0 | code >> 12U);
            put(0x80 | (code >> 6U & 0x3FU));
            put(0x80 | (code & 0x3FU));
        } else {
            put(0xF0 | code >> 18U);
            put(0x80 | (code >> 12U & 0x3FU));
            put(0x80 | (code >> 6U & 0x3FU));
            put(0x80 | (code & 0x3FU));
        }
    }
    bytes.erase(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(used));
    return text;
}

}  // namespace terratet
