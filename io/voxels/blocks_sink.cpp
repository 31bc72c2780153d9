// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// A block model as text: a row a block that has a value, its centre, its sizes, its values. x runs fastest, then y,
/// then z upwards, as in GSLIB; Leapfrog, Surpac, Datamine and Vulcan read such tables.

#include <charconv>
#include <cmath>

#include "interp/ranks/bytes.hpp"
#include "io/base/csv_text.hpp"
#include "io/base/output_file.hpp"
#include "io/read/column_names.hpp"
#include "io/voxels/spill_file.hpp"
#include "io/voxels/voxel_sink.hpp"

namespace terratet {
namespace {

constexpr const char* own_columns[] = {"X", "Y", "Z", "DX", "DY", "DZ"};

/// The rows of one line of a brick, x ascending.
struct Line {
    int j, k;
    std::uint64_t begin, size;
};

struct Piece final : BrickPiece {
    std::string text;
    std::vector<Line> lines;
};

class BlocksSink final : public VoxelSink {
  public:
    BlocksSink(const VoxelGrid& grid, const std::string& path, const ExportOptions& options)
        : grid_(grid), path_(path), file_(path, options.overwrite), spill_(path) {
        std::vector<std::string> names;
        for (const VoxelLayer& layer : grid.layers) {
            names.push_back(layer.property.name);
        }
        std::string header = "X,Y,Z,DX,DY,DZ";
        for (const std::string& name : distinct_names(std::move(names), own_columns)) {
            header += ',';
            append_csv_text(header, name);
        }
        file_.write(header + "\n");
        for (int axis = 0; axis < 3; ++axis) {
            sizes_ += ',';
            append_csv_number(sizes_, grid.spacing[axis]);
        }
    }

    [[nodiscard]] std::unique_ptr<BrickPiece> prepare(const Brick& brick) const override {
        auto piece = std::make_unique<Piece>();
        for (int k = 0; k < brick.size[2]; ++k) {
            for (int j = 0; j < brick.size[1]; ++j) {
                const std::uint64_t begin = piece->text.size();
                for (int i = 0; i < brick.size[0]; ++i) {
                    append_block(brick, i, j, k, piece->text);
                }
                if (piece->text.size() > begin) {
                    piece->lines.push_back({j, k, begin, piece->text.size() - begin});
                }
            }
        }
        return piece;
    }

    [[nodiscard]] bool portable() const override { return true; }

    [[nodiscard]] std::string to_bytes(const BrickPiece& made) const override {
        const auto& piece = static_cast<const Piece&>(made);
        ByteWriter out;
        out.put(std::string_view(piece.text));
        out.put(piece.lines);
        return out.take();
    }

    [[nodiscard]] std::unique_ptr<BrickPiece> from_bytes(std::string_view bytes) const override {
        auto piece = std::make_unique<Piece>();
        ByteReader in(bytes);
        piece->text = in.text();
        piece->lines = in.list<Line>();
        return piece;
    }

    void put(const Brick& brick, std::unique_ptr<BrickPiece> made) override {
        if (brick.lo[2] != layer_) {
            flush();
            layer_ = brick.lo[2];
        }
        const auto& piece = static_cast<const Piece&>(*made);
        const std::uint64_t begin = spill_.append(piece.text);
        for (Line line : piece.lines) {
            line.begin += begin;
            lines_.push_back({{brick.lo[2] + line.k, brick.lo[1] + line.j, brick.lo[0]}, line.begin, line.size});
        }
    }

    void close() override { flush(); }
    [[nodiscard]] OutputRecord commit() override { return {path_, file_.commit()}; }

  private:
    void append_block(const Brick& brick, int i, int j, int k, std::string& text) const {
        const std::size_t voxel = Brick::index(i, j, k);
        bool any = false;
        for (std::size_t f = 0; f < grid_.layers.size(); ++f) {
            any |= counts(grid_.layers[f]) && !brick.values[f].empty() && !std::isnan(brick.values[f][voxel]);
        }
        if (!any) {
            return;
        }
        const Vec3 center = grid_.center(brick.lo[0] + i, brick.lo[1] + j, brick.lo[2] + k);
        for (int axis = 0; axis < 3; ++axis) {
            text += axis == 0 ? "" : ",";
            append_csv_number(text, center[axis]);
        }
        text += sizes_;
        for (std::size_t f = 0; f < grid_.layers.size(); ++f) {
            text += ',';
            const auto& values = brick.values[f];
            if (values.empty() || std::isnan(values[voxel])) {
                continue;
            }
            if (grid_.layers[f].is_class()) {
                append_csv_value(text, grid_.layers[f].property, static_cast<double>(values[voxel]));
            } else {
                append_csv_number(text, values[voxel]);
            }
        }
        text += '\n';
    }

    /// A block is one that has a property's value; in a model of faults alone, one of a region.
    [[nodiscard]] bool counts(const VoxelLayer& layer) const {
        return layer.role == VoxelLayer::Role::property ||
               (layer.role == VoxelLayer::Role::region && grid_.layers.size() == 2);
    }

    /// The rows of a layer of bricks in their final order.
    void flush() {
        std::ranges::sort(lines_, {}, &Placed::place);
        std::string rows;
        for (const Placed& line : lines_) {
            const std::size_t begin = rows.size();
            rows.resize(begin + line.size);
            spill_.read(line.begin, std::span(rows).subspan(begin));
            if (rows.size() > 1 << 20) {
                file_.write(rows);
                rows.clear();
            }
        }
        file_.write(rows);
        lines_.clear();
        spill_.clear();
    }

    struct Placed {
        std::array<std::int64_t, 3> place;  ///< z, y, x
        std::uint64_t begin, size;
    };

    const VoxelGrid& grid_;
    std::string path_;
    OutputFile file_;
    SpillFile spill_;
    std::string sizes_;
    std::int64_t layer_ = 0;
    std::vector<Placed> lines_;
};

}  // namespace

std::unique_ptr<VoxelSink> make_blocks_sink(const VoxelGrid& grid, const std::string& path,
                                            const ExportOptions& options) {
    return std::make_unique<BlocksSink>(grid, path, options);
}

}  // namespace terratet
