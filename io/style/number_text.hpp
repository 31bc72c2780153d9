// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace terratet {

/// As a person writes it: four digits, no exponent between 0.001 and 100 000, and a minus that is one.
std::string number_text(double value, int digits = 4);

}  // namespace terratet
