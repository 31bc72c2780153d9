// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/style/property_title.hpp"

namespace terratet {

std::string property_title(const Property& property) {
    const std::string& name = property.name;
    const std::string& unit = property.unit;
    const bool says_itself = name.ends_with("(" + unit + ")") || name.ends_with("[" + unit + "]");
    return unit.empty() || says_itself ? name : name + " [" + unit + "]";
}

}  // namespace terratet
