// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The formats of read_place_mesh(): a file's bytes to a mesh whose numbers are not checked yet.

#include <string_view>

#include "io/onto/place_mesh.hpp"

namespace terratet {

PlaceMesh read_vtu_mesh(std::string_view bytes);
PlaceMesh read_msh_mesh(std::string_view bytes);

}  // namespace terratet
