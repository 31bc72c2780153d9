// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// What texts a model file can hold.

#include <string>

namespace terratet {

/// Text the model file can hold: UTF-8 without NUL.
bool is_storable(const std::string& text);

}  // namespace terratet
