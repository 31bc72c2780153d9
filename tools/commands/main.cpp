// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/commands/session.hpp"

int main(int argc, char** argv) {
    return terratet::tools::run_terratet({argv + 1, argv + argc});
}
