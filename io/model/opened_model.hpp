// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// A model's dataset, opened so that nothing in it can run.

#include <string>

#include "io/base/gdal_scope.hpp"
#include "io/model/model_layer.hpp"

namespace terratet {

/// Throws InputError as load_model does, of what shows before a row is read.
Dataset open_model(const std::string& path, GdalScope& scope);

}  // namespace terratet
