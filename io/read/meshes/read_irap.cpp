// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Irap classic grid, as RMS exports it, in text:
//
//     -996 rows dx dy
//     x0 x1 y0 y1
//     columns angle xr yr          turned counter-clockwise about (xr, yr)
//     0 0 0 0 0 0 0
//     heights, x fastest, from (x0, y0); 9999900 and more: none
//
// or binary: the same as records of Fortran, each between its length in bytes twice, big-endian, singles.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "io/read/meshes/byte_cursor.hpp"
#include "io/read/meshes/mesh_readers.hpp"
#include "io/read/meshes/text_cursor.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

constexpr double undefined = 9999900;
constexpr std::int64_t none = -1;

struct Grid {
    double rows = 0;
    double columns = 0;
    double dx = 0;
    double dy = 0;
    double x0 = 0;
    double y0 = 0;
    double angle = 0;  ///< in degrees
    double xr = 0;
    double yr = 0;
};

double header_number(TextCursor& text) {
    const auto value = text.number<double>();
    if (!value || !std::isfinite(*value)) {
        throw InputError("line " + std::to_string(text.line()) + ": a number of the grid's header is missing");
    }
    return *value;
}

Grid text_header(TextCursor& text) {
    Grid grid;
    header_number(text);
    grid.rows = header_number(text);
    grid.dx = header_number(text);
    grid.dy = header_number(text);
    grid.x0 = header_number(text);
    header_number(text);
    grid.y0 = header_number(text);
    header_number(text);
    grid.columns = header_number(text);
    grid.angle = header_number(text);
    grid.xr = header_number(text);
    grid.yr = header_number(text);
    for (int i = 0; i < 7; ++i) {
        header_number(text);
    }
    return grid;
}

Grid binary_header(ByteCursor& bytes) {
    Grid grid;
    bytes.skip(8);
    grid.rows = bytes.take<std::int32_t>();
    grid.x0 = bytes.take<float>();
    bytes.skip(4);
    grid.y0 = bytes.take<float>();
    bytes.skip(4);
    grid.dx = bytes.take<float>();
    grid.dy = bytes.take<float>();
    bytes.skip(8);
    grid.columns = bytes.take<std::int32_t>();
    grid.angle = bytes.take<float>();
    grid.xr = bytes.take<float>();
    grid.yr = bytes.take<float>();
    bytes.skip(10 * 4);
    return grid;
}

void require_sound(const Grid& grid, double most) {
    const auto whole = [](double number) { return number >= 2 && number == std::floor(number); };
    if (!whole(grid.rows) || !whole(grid.columns) || !(grid.rows * grid.columns <= most) || !(grid.dx > 0) ||
        !(grid.dy > 0)) {
        throw InputError("an Irap grid of " + std::to_string(grid.columns) + " x " + std::to_string(grid.rows) +
                         " nodes is more than the file can hold, or none");
    }
    if (!std::isfinite(grid.dx + grid.dy + grid.x0 + grid.y0 + grid.angle + grid.xr + grid.yr)) {
        throw InputError("a number of the grid's header is not finite");
    }
}

/// \param height  gives the next node's; `line` where it stands
template <typename Height, typename Line>
void add_grid(const Grid& grid, MeshBuilder& mesh, const Height& height, const Line& line_of) {
    const double angle = grid.angle * std::numbers::pi / 180;
    const auto wide = static_cast<std::size_t>(grid.columns);
    std::vector<std::int64_t> before;
    for (std::size_t row = 0; row < static_cast<std::size_t>(grid.rows); ++row) {
        std::vector<std::int64_t> line;
        for (std::size_t column = 0; column < wide; ++column) {
            const double z = height(row, column);
            if (!(z < undefined)) {
                line.push_back(none);
                continue;
            }
            const double u = grid.x0 + static_cast<double>(column) * grid.dx - grid.xr;
            const double v = grid.y0 + static_cast<double>(row) * grid.dy - grid.yr;
            line.push_back(static_cast<std::int64_t>(mesh.vertices()));
            mesh.vertex({angle == 0 ? u + grid.xr : grid.xr + u * std::cos(angle) - v * std::sin(angle),
                         angle == 0 ? v + grid.yr : grid.yr + u * std::sin(angle) + v * std::cos(angle), z},
                        line_of());
        }
        for (std::size_t k = 1; !before.empty() && k < wide; ++k) {
            for (const std::array<std::int64_t, 3>& t :
                 {std::array{before[k - 1], before[k], line[k]}, std::array{before[k - 1], line[k], line[k - 1]}}) {
                if (std::ranges::find(t, none) == t.end()) {
                    mesh.face(t, line_of());
                }
            }
        }
        before = std::move(line);
    }
}

/// Heights in records of any length, each between its length twice.
class BinaryHeights {
  public:
    explicit BinaryHeights(ByteCursor& bytes) : bytes_(bytes) {}

    double next() {
        while (left_ == 0) {
            bytes_.skip(begun_ ? 4 : 0);
            begun_ = true;
            const auto length = bytes_.take<std::int32_t>();
            if (length <= 0 || length % 4 != 0) {
                throw InputError("a record of " + std::to_string(length) + " bytes among the heights");
            }
            left_ = length / 4;
        }
        --left_;
        return bytes_.take<float>();
    }

  private:
    ByteCursor& bytes_;
    std::int32_t left_ = 0;
    bool begun_ = false;
};

}  // namespace

bool is_binary_irap(std::string_view bytes) {
    using std::string_view_literals::operator""sv;
    return bytes.size() >= 44 && bytes.starts_with("\0\0\0\x20\xFF\xFF\xFC\x1C"sv) &&
           bytes.substr(36, 8) == "\0\0\0\x20\0\0\0\x10"sv;
}

void read_irap(std::string_view bytes, MeshBuilder& mesh) {
    if (is_binary_irap(bytes)) {
        ByteCursor cursor(bytes, std::endian::big);
        const Grid grid = binary_header(cursor);
        require_sound(grid, static_cast<double>(bytes.size()) / 4);
        BinaryHeights heights(cursor);
        std::int64_t node = 0;
        add_grid(
            grid, mesh,
            [&](std::size_t, std::size_t) {
                ++node;
                return heights.next();
            },
            [&] { return node; });
        return;
    }
    TextCursor text(bytes);
    const Grid grid = text_header(text);
    require_sound(grid, static_cast<double>(bytes.size()));
    add_grid(
        grid, mesh,
        [&](std::size_t row, std::size_t column) {
            const auto z = text.number<double>();
            if (!z) {
                throw InputError("line " + std::to_string(text.line()) + ": node " + std::to_string(column + 1) +
                                 " of row " + std::to_string(row + 1) + " is missing or no number");
            }
            return *z;
        },
        [&] { return text.line(); });
}

}  // namespace terratet
