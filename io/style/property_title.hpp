// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// A property as a title says it.

#include <string>

#include "tess/site.hpp"

namespace terratet {

/// "CU [%]"; the name alone where there is no unit, or where it says the unit itself, as a header does: "As (ug/L)".
std::string property_title(const Property& property);

}  // namespace terratet
