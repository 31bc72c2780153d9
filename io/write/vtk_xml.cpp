// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/write/vtk_xml.hpp"

#include <libdeflate.h>
#include <tbb/parallel_for.h>

#include <bit>
#include <cstring>
#include <memory>

#include "io/style/markup.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

/// Uncompressed bytes of a block: large enough that its own header does not count, small enough to read a part quickly.
constexpr std::size_t block_size = 1 << 16;

using Bytes = std::vector<std::byte>;

/// What stands in the file for one array: its length, or its block table, then its bytes.
struct Encoded {
    std::vector<std::uint64_t> head;
    std::vector<Bytes> blocks;  ///< compressed; none when the array goes in as it is
    std::span<const std::byte> plain;

    [[nodiscard]] std::uint64_t size() const {
        std::uint64_t bytes = head.size() * sizeof(std::uint64_t) + plain.size();
        for (const Bytes& block : blocks) {
            bytes += block.size();
        }
        return bytes;
    }
};

struct CompressorDeleter {
    void operator()(libdeflate_compressor* compressor) const { libdeflate_free_compressor(compressor); }
};

/// As zlib does, several times faster. Level 1: on these arrays as small as level 6, give or take a few percent.
Bytes deflated(std::span<const std::byte> plain) {
    thread_local const std::unique_ptr<libdeflate_compressor, CompressorDeleter> compressor(
        libdeflate_alloc_compressor(1));
    if (!compressor) {
        throw Error("libdeflate failed to compress: out of memory");
    }
    Bytes result(libdeflate_zlib_compress_bound(compressor.get(), plain.size()));
    result.resize(libdeflate_zlib_compress(compressor.get(), plain.data(), plain.size(), result.data(), result.size()));
    return result;
}

Encoded encode(std::span<const std::byte> bytes, bool compress) {
    Encoded encoded;
    if (!compress) {
        encoded.head = {bytes.size()};
        encoded.plain = bytes;
        return encoded;
    }
    const std::size_t count = (bytes.size() + block_size - 1) / block_size;
    encoded.blocks.resize(count);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
        const std::size_t begin = i * block_size;
        encoded.blocks[i] = deflated(bytes.subspan(begin, std::min(block_size, bytes.size() - begin)));
    });
    encoded.head = {count, block_size, bytes.size() % block_size};
    for (const Bytes& block : encoded.blocks) {
        encoded.head.push_back(block.size());
    }
    return encoded;
}

/// The document's elements; arrays are encoded as they are named, in the order of their bytes in the file.
class Document {
  public:
    Document(const VtkPiece& piece, bool compress, const Progress& progress)
        : piece_(piece), compress_(compress), progress_(progress) {
        arrays_ = 1 + piece.topology.size() + piece.point_data.size() + piece.cell_data.size();
    }

    void write(OutputFile& file) {
        header();
        field_data();
        text_ += "<Piece NumberOfPoints=\"" + std::to_string(piece_.points) + "\" NumberOf" + cells_section() + "=\"" +
                 std::to_string(piece_.cells) + "\">\n";
        section("Points", {piece_.coordinates});
        section(cells_section(), piece_.topology);
        section("PointData", piece_.point_data, piece_.active_scalars);
        section("CellData", piece_.cell_data);
        text_ += std::string("</Piece>\n</") + type() + ">\n<AppendedData encoding=\"raw\">\n_";
        file.write(text_);
        for (const Encoded& encoded : encoded_) {
            file.write(std::as_bytes(std::span(encoded.head)));
            file.write(encoded.plain);
            for (const Bytes& block : encoded.blocks) {
                file.write(block);
            }
        }
        file.write("\n</AppendedData>\n</VTKFile>\n");
    }

  private:
    [[nodiscard]] const char* type() const {
        return piece_.kind == VtkPiece::Kind::cells ? "UnstructuredGrid" : "PolyData";
    }
    [[nodiscard]] const char* cells_section() const {
        return piece_.kind == VtkPiece::Kind::cells   ? "Cells"
               : piece_.kind == VtkPiece::Kind::lines ? "Lines"
                                                      : "Polys";
    }

    void header() {
        text_ = std::string("<?xml version=\"1.0\"?>\n<VTKFile type=\"") + type() + "\" version=\"1.0\" byte_order=\"";
        text_ += std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";
        text_ += "\" header_type=\"UInt64\"";
        text_ += compress_ ? " compressor=\"vtkZLibDataCompressor\"" : "";
        text_ += std::string(">\n<") + type() + ">\n";
    }

    /// Strings as VTK keeps them: the codes of their bytes, each string ended by 0.
    void field_data() {
        text_ += "<FieldData>\n";
        for (const VtkStrings& strings : piece_.field_data) {
            text_ += "<DataArray type=\"String\" Name=\"" + markup_text(strings.name) + "\" NumberOfTuples=\"" +
                     std::to_string(strings.values.size()) + "\" format=\"ascii\">\n";
            for (const std::string& value : strings.values) {
                for (const char c : value) {
                    text_ += std::to_string(static_cast<unsigned char>(c)) + ' ';
                }
                text_ += "0\n";
            }
            text_ += "</DataArray>\n";
        }
        text_ += "</FieldData>\n";
    }

    void section(const char* name, const std::vector<VtkArray>& arrays, const std::string& scalars = {}) {
        text_ += std::string("<") + name + (scalars.empty() ? "" : " Scalars=\"" + markup_text(scalars) + "\"") + ">\n";
        for (const VtkArray& array : arrays) {
            text_ += "<DataArray type=\"" + array.type + "\" Name=\"" + markup_text(array.name) +
                     "\" NumberOfComponents=\"" + std::to_string(array.components) +
                     "\" format=\"appended\" offset=\"" + std::to_string(offset_) + "\"/>\n";
            encoded_.push_back(encode(array.bytes, compress_));
            offset_ += encoded_.back().size();
            report_progress(progress_, "write vtu",
                            static_cast<double>(encoded_.size()) / static_cast<double>(arrays_));
        }
        text_ += std::string("</") + name + ">\n";
    }

    const VtkPiece& piece_;
    bool compress_;
    const Progress& progress_;
    std::size_t arrays_ = 0;
    std::string text_;
    std::vector<Encoded> encoded_;
    std::uint64_t offset_ = 0;
};

}  // namespace

void write_vtk(const VtkPiece& piece, bool compress, OutputFile& file, const Progress& progress) {
    Document(piece, compress, progress).write(file);
}

}  // namespace terratet
