// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// What the numbers and texts of terratet_meta may be.

#include <string>
#include <vector>

#include "tess/model.hpp"

namespace terratet {

/// Throws InputError, naming `file`, the key and what was found, unless a model can have been built with these: a
/// frame whose CRS PROJ reads, lengths that are lengths, boxes that are boxes within 1e9, properties with distinct
/// names and columns, classes that are distinct, an estimator that there is. \pre One column of each kind a property.
void require_ranges(const Model& model, const std::vector<std::string>& columns,
                    const std::vector<std::string>& censored_columns, const std::string& file);

}  // namespace terratet
