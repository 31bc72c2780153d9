// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/options/printable.hpp"

#include <array>
#include <cstdint>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace terratet::tools {
namespace {

constexpr std::uint32_t no_character = 0xFFFFFFFF;

/// One character and its length in bytes; no_character and 1 for a byte that begins none.
struct Decoded {
    std::uint32_t character = no_character;
    std::size_t length = 1;
};

/// UTF-8 as RFC 3629 has it: no overlong forms, no surrogates.
Decoded decoded(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<std::uint32_t>(static_cast<unsigned char>(text[i])); };
    const std::uint32_t first = byte(0);
    if (first < 0x80) {
        return {first, 1};
    }
    const std::size_t length = first >= 0xC2 && first < 0xE0   ? 2
                               : first >= 0xE0 && first < 0xF0 ? 3
                               : first >= 0xF0 && first < 0xF5 ? 4
                                                               : 0;
    if (length == 0 || text.size() < length) {
        return {};
    }
    std::uint32_t character = first & (0x7FU >> length);
    for (std::size_t i = 1; i < length; ++i) {
        if ((byte(i) & 0xC0U) != 0x80) {
            return {};
        }
        character = character << 6U | (byte(i) & 0x3FU);
    }
    constexpr std::array<std::uint32_t, 5> smallest{0, 0, 0x80, 0x800, 0x10000};
    const bool surrogate = character >= 0xD800 && character < 0xE000;
    return character < smallest[length] || surrogate || character > 0x10FFFF ? Decoded{} : Decoded{character, length};
}

/// Controls, of which C1's are as good as escapes to some terminals; marks and overrides of direction; separators of
/// lines; characters without width, but for the joiners that scripts need; tags.
bool is_harmful(std::uint32_t c) {
    return c < 0x20 || (c >= 0x7F && c < 0xA0) || c == 0x61C || c == 0x200B || c == 0x200E || c == 0x200F ||
           (c >= 0x2028 && c <= 0x202E) || (c >= 0x2060 && c <= 0x206F) || c == 0xFEFF ||
           (c >= 0xFFF9 && c <= 0xFFFB) || (c >= 0xE0000 && c < 0xE0080);
}

}  // namespace

std::string printable(std::string_view text, bool keep_lines) {
    std::string out;
    while (!text.empty()) {
        const auto [character, length] = decoded(text);
        const bool kept = keep_lines && (text[0] == '\n' || text[0] == '\t');
        if (character == no_character) {
            out += fmt::format("\\x{:02x}", static_cast<unsigned char>(text[0]));
        } else if (!is_harmful(character) || kept) {
            out += text.substr(0, length);
        } else {
            out += character < 0x80 ? fmt::format("\\x{:02x}", character) : fmt::format("\\u{:04x}", character);
        }
        text.remove_prefix(length);
    }
    return out;
}

std::string json_text(const nlohmann::ordered_json& json) {
    // Bytes that are no UTF-8 become U+FFFD: paths and cells may hold them, and must not cost the text.
    const std::string dumped = json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
    std::string out;
    for (std::string_view rest = dumped; !rest.empty();) {
        const auto [character, length] = decoded(rest);
        if (character < 0x7F || !is_harmful(character)) {  // JSON has the controls below escaped, and its own line ends
            out += rest.substr(0, length);
        } else if (character < 0x10000) {
            out += fmt::format("\\u{:04x}", character);
        } else {
            out += fmt::format("\\u{:04x}\\u{:04x}", 0xD800 + ((character - 0x10000) >> 10U),
                               0xDC00 + ((character - 0x10000) & 0x3FFU));
        }
        rest.remove_prefix(length);
    }
    return out + "\n";
}

}  // namespace terratet::tools
