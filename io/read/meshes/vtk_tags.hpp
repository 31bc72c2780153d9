// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Tags of VTK's XML files.

#include <string_view>

#include "io/read/meshes/vtk_array.hpp"

namespace terratet {

/// A tag of the file: its name (with / where it closes something) and attributes.
struct VtkTag {
    std::string_view name;
    XmlAttributes attributes;
    bool empty = false;  ///< <Tag/>

    /// Empty where it has none of that name.
    [[nodiscard]] std::string_view value(std::string_view attribute) const;
};

/// Reads tags one after the other; no entities, since VTK needs none.
class VtkTags {
  public:
    explicit VtkTags(std::string_view text) : rest_(text) {}

    bool next(VtkTag& tag);
    [[nodiscard]] std::string_view until_next() const { return rest_.substr(0, rest_.find('<')); }

  private:
    std::string_view rest_;
};

/// What the first tags say of all arrays, and where the appended data begin. Throws InputError: another kind of data
/// than `type` (PolyData, UnstructuredGrid), or compressed by something else than zlib.
VtkEncoding vtk_encoding(std::string_view bytes, std::string_view type);

}  // namespace terratet
