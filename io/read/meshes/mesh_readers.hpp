// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The readers behind read_mesh: from the bytes of a file into a builder.

#include <string>
#include <string_view>

#include "io/read/meshes/mesh_builder.hpp"

namespace terratet {

/// All throw InputError, its message without the file's name, for what cannot be read on.
void read_obj(std::string_view bytes, MeshBuilder& mesh);
void read_ply(std::string_view bytes, MeshBuilder& mesh);
void read_stl(std::string_view bytes, MeshBuilder& mesh);
void read_off(std::string_view bytes, MeshBuilder& mesh);
void read_vtp(std::string_view bytes, MeshBuilder& mesh);
void read_dxf(std::string_view bytes, MeshBuilder& mesh);
void read_irap(std::string_view bytes, MeshBuilder& mesh);

/// A binary STL says how many triangles it has, and is exactly that long.
bool is_binary_stl(std::string_view bytes, std::size_t file_size);

/// An Irap classic grid in binary begins with two records of known lengths, the first with -996.
bool is_binary_irap(std::string_view bytes);

}  // namespace terratet
