// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>

#include "io/read/meshes/mesh_readers.hpp"
#include "io/read/meshes/text_cursor.hpp"
#include "io/read/meshes/vtk_array.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

/// A tag of the file: its name (with / where it closes something) and attributes.
struct Tag {
    std::string_view name;
    XmlAttributes attributes;
    bool empty = false;  ///< <Tag/>
};

bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

/// Reads tags one after the other; no entities, since VTK needs none.
class Tags {
  public:
    explicit Tags(std::string_view text) : rest_(text) {}

    bool next(Tag& tag) {
        const std::size_t open = rest_.find('<');
        const std::size_t close = open == std::string_view::npos ? open : rest_.find('>', open);
        if (close == std::string_view::npos) {
            return false;
        }
        std::string_view inside = rest_.substr(open + 1, close - open - 1);
        rest_.remove_prefix(close + 1);
        tag = {};
        tag.empty = inside.ends_with('/');
        const auto end = std::ranges::find_if(inside, is_blank);
        tag.name = inside.substr(0, static_cast<std::size_t>(end - inside.begin()));
        if (tag.name.size() > 1 && tag.name.ends_with('/')) {
            tag.name.remove_suffix(1);
        }
        inside.remove_prefix(std::min(tag.name.size(), inside.size()));
        for (std::size_t equals = inside.find('='); equals != std::string_view::npos; equals = inside.find('=')) {
            const std::string key(trim(inside.substr(0, equals)));
            inside = inside.substr(equals + 1);
            const std::size_t quote = inside.find_first_of("\"'");
            const std::size_t last = quote == std::string_view::npos ? quote : inside.find(inside[quote], quote + 1);
            if (last == std::string_view::npos) {
                break;
            }
            tag.attributes[key] = std::string(inside.substr(quote + 1, last - quote - 1));
            inside = inside.substr(last + 1);
        }
        return true;
    }

    [[nodiscard]] std::string_view until_next() const { return rest_.substr(0, rest_.find('<')); }

  private:
    static std::string_view trim(std::string_view text) {
        while (!text.empty() && is_blank(text.front())) {
            text.remove_prefix(1);
        }
        while (!text.empty() && is_blank(text.back())) {
            text.remove_suffix(1);
        }
        return text;
    }
    std::string_view rest_;
};

std::string_view value(const Tag& tag, std::string_view name) {
    const auto found = tag.attributes.find(name);
    return found == tag.attributes.end() ? std::string_view{} : std::string_view(found->second);
}

/// What the first tags say of all arrays, and where the appended data begin.
VtkEncoding encoding_of(std::string_view bytes) {
    VtkEncoding encoding;
    const std::size_t appended = bytes.find("<AppendedData");
    Tags tags(bytes.substr(0, appended));
    Tag tag;
    while (tags.next(tag) && tag.name != "VTKFile") {
    }
    if (tag.name != "VTKFile" || value(tag, "type") != "PolyData") {
        throw InputError("no PolyData of VTK, but " +
                         (tag.name == "VTKFile" ? excerpt(value(tag, "type")) : std::string("something else")));
    }
    encoding.order = value(tag, "byte_order") == "BigEndian" ? std::endian::big : std::endian::little;
    encoding.long_headers = value(tag, "header_type") == "UInt64";
    const std::string_view compressor = value(tag, "compressor");
    encoding.zlib = compressor == "vtkZLibDataCompressor";
    if (!compressor.empty() && !encoding.zlib) {
        throw InputError("compressed by " + excerpt(compressor) + ", which is not read; zlib is");
    }
    if (appended != std::string_view::npos) {
        Tags behind(bytes.substr(appended));
        behind.next(tag);
        encoding.appended_base64 = value(tag, "encoding") == "base64";
        const std::size_t underscore = bytes.find('_', bytes.find('>', appended));
        encoding.appended = underscore == std::string_view::npos ? std::string_view{} : bytes.substr(underscore + 1);
    }
    return encoding;
}

/// One Piece: its points, and polygons or strips as corners and where each ends.
struct Piece {
    std::vector<double> points;
    std::vector<double> polygons, polygon_ends;
    std::vector<double> strips, strip_ends;
};

std::int64_t whole(double number) {
    return number >= 0 && number < 1e15 ? static_cast<std::int64_t>(number) : -1;
}

/// Calls `use` with the corners of each cell.
template <typename Use>
void for_each_cell(const std::vector<double>& corners, const std::vector<double>& ends, const Use& use) {
    std::size_t begin = 0;
    for (const double end_number : ends) {
        const std::int64_t end = whole(end_number);
        if (end < static_cast<std::int64_t>(begin) || end > static_cast<std::int64_t>(corners.size())) {
            throw InputError("the offsets of its cells do not suit their connectivity");
        }
        std::vector<std::int64_t> cell;
        for (; begin < static_cast<std::size_t>(end); ++begin) {
            cell.push_back(whole(corners[begin]));
        }
        use(cell);
    }
}

void add(const Piece& piece, MeshBuilder& mesh) {
    const auto first = static_cast<std::int64_t>(mesh.vertices());
    const auto count = static_cast<std::int64_t>(piece.points.size() / 3);
    for (std::size_t i = 0; i + 2 < piece.points.size(); i += 3) {
        mesh.vertex({piece.points[i], piece.points[i + 1], piece.points[i + 2]}, static_cast<std::int64_t>(i / 3) + 1);
    }
    std::int64_t number = 0;
    const auto in_mesh = [&](std::int64_t corner) { return corner >= 0 && corner < count ? first + corner : -1; };
    for_each_cell(piece.polygons, piece.polygon_ends, [&](std::vector<std::int64_t> cell) {
        std::ranges::transform(cell, cell.begin(), in_mesh);
        mesh.face(cell, ++number);
    });
    for_each_cell(piece.strips, piece.strip_ends, [&](const std::vector<std::int64_t>& cell) {
        ++number;
        for (std::size_t k = 0; k + 2 < cell.size(); ++k) {
            const std::size_t odd = k % 2;
            mesh.face(std::array{in_mesh(cell[k + odd]), in_mesh(cell[k + 1 - odd]), in_mesh(cell[k + 2])}, number);
        }
    });
}

}  // namespace

void read_vtp(std::string_view bytes, MeshBuilder& mesh) {
    const VtkEncoding encoding = encoding_of(bytes);
    const std::size_t appended = bytes.find("<AppendedData");
    Tags tags(bytes.substr(0, appended));
    Tag tag;
    std::string section;
    Piece piece;
    while (tags.next(tag)) {
        if (tag.name == "Piece") {
            piece = {};
        } else if (tag.name == "/Piece") {
            add(piece, mesh);
        } else if (tag.name == "Points" || tag.name == "Polys" || tag.name == "Strips") {
            section = std::string(tag.name);
        } else if (tag.name.starts_with('/') && tag.name.substr(1) == section) {
            section.clear();
        } else if (tag.name == "DataArray" && !section.empty()) {
            const bool ends = value(tag, "Name") == "offsets";
            std::vector<double>& target = section == "Points"  ? piece.points
                                          : section == "Polys" ? (ends ? piece.polygon_ends : piece.polygons)
                                                               : (ends ? piece.strip_ends : piece.strips);
            target = vtk_array(tag.attributes, tags.until_next(), encoding, bytes.size());
        }
    }
}

}  // namespace terratet
