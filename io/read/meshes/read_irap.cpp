// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Irap classic grid in text, as RMS exports it:
//
//     -996 rows dx dy
//     x0 x1 y0 y1
//     columns angle xr yr          turned counter-clockwise about (xr, yr)
//     0 0 0 0 0 0 0
//     heights, x fastest, from (x0, y0); 9999900 and more: none
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "io/read/meshes/mesh_readers.hpp"
#include "io/read/meshes/text_cursor.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

constexpr double undefined = 9999900;
constexpr std::int64_t none = -1;

double header_number(TextCursor& text) {
    const auto value = text.number<double>();
    if (!value || !std::isfinite(*value)) {
        throw InputError("line " + std::to_string(text.line()) + ": a number of the grid's header is missing");
    }
    return *value;
}

}  // namespace

void read_irap(std::string_view bytes, MeshBuilder& mesh) {
    TextCursor text(bytes);
    header_number(text);
    const double rows = header_number(text);
    const double dx = header_number(text);
    const double dy = header_number(text);
    const double x0 = header_number(text);
    header_number(text);
    const double y0 = header_number(text);
    header_number(text);
    const double columns = header_number(text);
    const double angle = header_number(text) * std::numbers::pi / 180;
    const double xr = header_number(text);
    const double yr = header_number(text);
    for (int i = 0; i < 7; ++i) {
        header_number(text);
    }
    const auto most = static_cast<double>(bytes.size());
    if (!(rows >= 2 && columns >= 2 && rows * columns <= most) || rows != std::floor(rows) ||
        columns != std::floor(columns) || !(dx > 0) || !(dy > 0)) {
        throw InputError("an Irap grid of " + std::to_string(columns) + " x " + std::to_string(rows) +
                         " nodes is more than the file can hold, or none");
    }
    const auto wide = static_cast<std::size_t>(columns);
    std::vector<std::int64_t> before;
    for (std::size_t row = 0; row < static_cast<std::size_t>(rows); ++row) {
        std::vector<std::int64_t> line;
        for (std::size_t column = 0; column < wide; ++column) {
            const auto z = text.number<double>();
            if (!z) {
                throw InputError("line " + std::to_string(text.line()) + ": node " + std::to_string(column + 1) +
                                 " of row " + std::to_string(row + 1) + " is missing or no number");
            }
            if (!(*z < undefined)) {
                line.push_back(none);
                continue;
            }
            const double u = x0 + static_cast<double>(column) * dx - xr;
            const double v = y0 + static_cast<double>(row) * dy - yr;
            line.push_back(static_cast<std::int64_t>(mesh.vertices()));
            mesh.vertex({angle == 0 ? u + xr : xr + u * std::cos(angle) - v * std::sin(angle),
                         angle == 0 ? v + yr : yr + u * std::sin(angle) + v * std::cos(angle), *z},
                        text.line());
        }
        for (std::size_t k = 1; !before.empty() && k < wide; ++k) {
            for (const std::array<std::int64_t, 3>& t :
                 {std::array{before[k - 1], before[k], line[k]}, std::array{before[k - 1], line[k], line[k - 1]}}) {
                if (std::ranges::find(t, none) == t.end()) {
                    mesh.face(t, text.line());
                }
            }
        }
        before = std::move(line);
    }
}

}  // namespace terratet
