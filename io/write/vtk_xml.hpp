// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// A VTK XML file of one piece with its arrays appended raw, or in zlib blocks (VTK file
/// formats, "XML file formats").

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/base/output_file.hpp"
#include "tess/progress.hpp"

namespace terratet {

/// An array whose bytes live elsewhere until the file is written.
struct VtkArray {
    std::string name;
    std::string type;  ///< Float64, Int32, …
    int components = 1;
    std::span<const std::byte> bytes;
};

struct VtkStrings {
    std::string name;
    std::vector<std::string> values;
};

struct VtkPiece {
    enum class Kind : std::uint8_t {
        cells,  ///< an unstructured grid; the topology is connectivity, offsets and types
        lines,  ///< PolyData; connectivity and offsets
        polys,
    };
    Kind kind = Kind::cells;
    std::size_t points = 0;
    std::size_t cells = 0;
    VtkArray coordinates;
    std::vector<VtkArray> topology;
    std::vector<VtkArray> point_data;
    std::vector<VtkArray> cell_data;
    std::vector<VtkStrings> field_data;
    std::string active_scalars;  ///< of the point data; may be empty
};

template <class T>
constexpr const char* vtk_type() {
    if constexpr (std::is_floating_point_v<T>) {
        return sizeof(T) == 8 ? "Float64" : "Float32";
    } else if constexpr (std::is_signed_v<T>) {
        return sizeof(T) == 8 ? "Int64" : sizeof(T) == 4 ? "Int32" : "Int8";
    } else {
        return sizeof(T) == 8 ? "UInt64" : sizeof(T) == 4 ? "UInt32" : "UInt8";
    }
}

template <class T>
VtkArray vtk_array(std::string name, const std::vector<T>& values, int components = 1) {
    return {std::move(name), vtk_type<T>(), components, std::as_bytes(std::span(values))};
}

/// Compression works in parallel; the bytes do not depend on it.
void write_vtk(const VtkPiece& piece, bool compress, OutputFile& file, const Progress& progress);

}  // namespace terratet
