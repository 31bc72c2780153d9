// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/write/scene/scene_page.hpp"

// The file as it is, by the assembler: compilers take long over text of this size. CMake says where it lies.
asm(R"(
    .section .rodata
    .balign 16
terratet_scene_page_begin:
    .incbin ")" TERRATET_SCENE_PAGE R"("
terratet_scene_page_end:
    .byte 0
    .text
)");

extern "C" {
extern const char scene_page_begin[] asm("terratet_scene_page_begin");
extern const char scene_page_end[] asm("terratet_scene_page_end");
}

namespace terratet {

std::string_view scene_page() {
    return {scene_page_begin, static_cast<std::size_t>(scene_page_end - scene_page_begin)};
}

}  // namespace terratet
