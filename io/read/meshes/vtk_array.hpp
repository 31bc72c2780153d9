// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Arrays of VTK's XML files as numbers.

#include <bit>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace terratet {

using XmlAttributes = std::map<std::string, std::string, std::less<>>;

/// What the file says of all its arrays.
struct VtkEncoding {
    std::endian order = std::endian::little;
    bool long_headers = false;  ///< UInt64 instead of UInt32
    bool zlib = false;          ///< else not compressed
    std::string_view appended;  ///< behind the underscore
    bool appended_base64 = false;
};

/// The numbers of a DataArray with these attributes and this text between its tags. Sizes are checked against `limit`
/// bytes before memory is taken. Throws InputError: damaged, of an unknown type, more than the limit.
std::vector<double> vtk_array(const XmlAttributes& attributes, std::string_view text, const VtkEncoding& encoding,
                              std::size_t limit);

}  // namespace terratet
