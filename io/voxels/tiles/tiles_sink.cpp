// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// 3D Tiles 1.1 of voxels: NAME.json, and a folder NAME beside it with the tiles; categories have tilesets of their own
/// in there, since blending is all or nothing in a viewer. The folder is there first, whole.

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <limits>

#include "io/base/output_file.hpp"
#include "io/voxels/tiles/fill_voids.hpp"
#include "io/voxels/tiles/subtrees.hpp"
#include "io/voxels/tiles/tile_content.hpp"
#include "io/voxels/tiles/tiles_folder.hpp"
#include "io/voxels/tiles/tiles_place.hpp"
#include "io/voxels/tiles/voxel_pyramid.hpp"
#include "io/voxels/voxel_sink.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int largest_tile = 64;  ///< voxels along an axis
constexpr int margin = 3;         ///< of what is looked at for the padding of one: see fill_voids
constexpr double infinity = std::numeric_limits<double>::infinity();

int even(std::int64_t n) {
    return static_cast<int>((n + 1) / 2 * 2);
}

/// Levels and tiles that cover a lattice: the root box has dimensions · 2^(levels − 1) voxels. Numbers along the axes
/// are nearly equal, by which CesiumJS tells how coarse a tile is.
struct Tiling {
    int levels = 1;
    std::array<int, 3> dimensions{};

    explicit Tiling(const std::array<std::int64_t, 3>& size) {
        const std::int64_t longest = std::max({size[0], size[1], size[2]});
        while ((longest + (std::int64_t{1} << (levels - 1)) - 1) >> (levels - 1) > largest_tile) {
            ++levels;
        }
        const std::int64_t parts = std::int64_t{1} << (levels - 1);
        const auto of = [&](std::int64_t n) {
            return levels == 1 ? static_cast<int>(n) : even((n + parts - 1) / parts);
        };
        for (std::size_t axis = 0; axis < 3; ++axis) {
            dimensions[axis] = std::max(of(size[axis]), levels == 1 ? 1 : even(of(longest) / 2));
        }
    }
};

/// A brick's fields in the scale that is stored, and where any property has a value.
struct Piece final : BrickPiece {
    std::vector<std::vector<float>> values;  ///< one a field, then the mask; empty where there is none
    std::size_t same_mask = 0;               ///< the field that has values where the mask has
    std::vector<bool> own_mask;
    std::vector<double> low;
    std::vector<double> high;
};

class TilesSink final : public VoxelSink {
  public:
    TilesSink(const VoxelGrid& grid, const std::string& path, const ExportOptions& options)
        : grid_(grid),
          path_(path),
          file_(path, options.overwrite),
          folder_(tiles_folder(path), options.overwrite && holds_only_tiles(path)),
          compress_(options.compress.value_or(false)),
          place_(place_tiles(grid, options.vertical_crs)),
          tiling_(grid.size),
          pyramid_(grid.size, mergings(grid), tiling_.levels, path),
          low_(grid.layers.size(), infinity),
          high_(grid.layers.size(), -infinity),
          own_mask_(grid.layers.size(), false) {}

    [[nodiscard]] std::unique_ptr<BrickPiece> prepare(const Brick& brick) const override {
        auto piece = std::make_unique<Piece>();
        const std::size_t fields = grid_.layers.size();
        piece->values = brick.values;
        piece->values.emplace_back();
        piece->own_mask.assign(fields, false);
        piece->low.assign(fields, infinity);
        piece->high.assign(fields, -infinity);
        std::vector<std::size_t> counts(fields, 0);
        for (std::size_t f = 0; f < fields; ++f) {
            counts[f] = scale_field(grid_.layers[f], piece->values[f], piece->low[f], piece->high[f]);
        }
        find_mask(counts, *piece);
        return piece;
    }

    void put(const Brick& brick, std::unique_ptr<BrickPiece> made) override {
        const auto& piece = static_cast<const Piece&>(*made);
        const std::size_t fields = grid_.layers.size();
        std::vector<std::size_t> same(fields + 1);
        for (std::size_t f = 0; f <= fields; ++f) {
            same[f] = f;
        }
        same[fields] = piece.same_mask;
        pyramid_.put({brick.lo[0] / Brick::edge, brick.lo[1] / Brick::edge, brick.lo[2] / Brick::edge}, piece.values,
                     same);
        for (std::size_t f = 0; f < fields; ++f) {
            low_[f] = std::min(low_[f], piece.low[f]);
            high_[f] = std::max(high_[f], piece.high[f]);
            own_mask_[f] = own_mask_[f] || piece.own_mask[f];
        }
    }

    void close() override {
        pyramid_.coarsen({});
        const auto classes = tile_classes(grid_.layers, grid_.layers.size(), own_mask_, low_, high_);
        Json others = Json::array();
        const std::string name = fs::path(tiles_folder(path_)).filename().string();
        for (const TileClass& tile_class : classes) {
            const std::string inside = tile_class.folder.empty() ? "" : tile_class.folder + "/";
            const TileTree tree = write_tiles(tile_class, inside);
            write_subtrees(tree, [&](const std::string& place, std::string_view bytes) {
                write(inside + "subtrees/" + place + ".subtree", bytes);
            });
            if (inside.empty()) {
                continue;
            }
            others.push_back({{"property", tile_class.folder}, {"uri", name + "/" + inside + "tileset.json"}});
            write(inside + "tileset.json", tileset(tile_class, "", Json()).dump(1) + "\n");
        }
        file_.write(tileset(classes.front(), name + "/", others).dump(1) + "\n");
    }

    [[nodiscard]] OutputRecord commit() override {
        folder_.commit();
        OutputRecord record{path_, bytes_ + file_.commit()};
        record.remark = place_.remark;
        return record;
    }

  private:
    static std::vector<Merging> mergings(const VoxelGrid& grid) {
        std::vector<Merging> result;
        for (const VoxelLayer& layer : grid.layers) {
            result.push_back(layer.is_class() ? Merging::majority : Merging::mean);
        }
        result.push_back(Merging::mean);
        return result;
    }

    /// Into the scale that is stored; returns how many have a value.
    static std::size_t scale_field(const VoxelLayer& layer, std::vector<float>& values, double& low, double& high) {
        std::size_t count = 0;
        float least = std::numeric_limits<float>::infinity();
        float most = -least;
        for (float& value : values) {
            if (layer.is_log10()) {
                value = value > 0 ? std::log10(value) : std::numeric_limits<float>::quiet_NaN();
            }
            if (!std::isnan(value)) {
                ++count;
                least = std::min(least, value);
                most = std::max(most, value);
            }
        }
        if (count == 0) {
            values.clear();
        } else {
            low = static_cast<double>(least);
            high = static_cast<double>(most);
        }
        return count;
    }

    /// Of properties; of regions where there are none.
    [[nodiscard]] bool counts_for_mask(std::size_t f) const {
        const auto is_property = [](const VoxelLayer& layer) { return layer.role == VoxelLayer::Role::property; };
        const bool any = std::ranges::any_of(grid_.layers, is_property);
        return any ? is_property(grid_.layers[f]) : grid_.layers[f].role == VoxelLayer::Role::region;
    }

    void find_mask(const std::vector<std::size_t>& counts, Piece& piece) const {
        const std::size_t fields = counts.size();
        std::size_t fullest = fields;
        for (std::size_t f = 0; f < fields; ++f) {
            if (counts_for_mask(f) && counts[f] > 0 && (fullest == fields || counts[f] > counts[fullest])) {
                fullest = f;
            }
        }
        piece.same_mask = fullest;
        if (fullest == fields) {
            return;
        }
        std::vector<float> mask = piece.values[fullest];
        std::size_t count = counts[fullest];
        for (std::size_t f = 0; f < fields; ++f) {
            if (f == fullest || !counts_for_mask(f) || counts[f] == 0) {
                continue;
            }
            for (std::size_t n = 0; n < mask.size(); ++n) {
                if (std::isnan(mask[n]) && !std::isnan(piece.values[f][n])) {
                    mask[n] = 1;
                    ++count;
                }
            }
        }
        if (count != counts[fullest]) {
            piece.same_mask = fields;
            piece.values[fields] = std::move(mask);
        }
        for (std::size_t f = 0; f < fields; ++f) {
            piece.own_mask[f] = counts_for_mask(f) && counts[f] != count;
        }
    }

    void write(const std::string& name, std::string_view bytes) {
        folder_.write(name, {&bytes, 1});
        bytes_ += bytes.size();
    }

    [[nodiscard]] Vec3 corner(int level, const std::array<std::int64_t, 3>& tile) const {
        const double scale = static_cast<double>(std::int64_t{1} << (tiling_.levels - 1 - level));
        Vec3 at;
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            const double voxels = scale * static_cast<double>(tile[a]) * static_cast<double>(tiling_.dimensions[a]);
            at[axis] = grid_.origin[axis] + (voxels - 0.5) * grid_.spacing[axis];
        }
        return at;
    }

    /// From the coarsest down: a tile without a value has no children, and is left out, as its parent's mask tells.
    TileTree write_tiles(const TileClass& tile_class, const std::string& inside) {
        TileTree tree(static_cast<std::size_t>(tiling_.levels));
        std::vector<std::array<std::int64_t, 3>> wanted{{0, 0, 0}};
        for (int level = 0; level < tiling_.levels; ++level) {
            std::vector<char> written(wanted.size(), 0);
            tbb::parallel_for(std::size_t{0}, wanted.size(), [&](std::size_t n) {
                written[n] = write_tile(tile_class, inside, level, wanted[n]) ? 1 : 0;
            });
            std::vector<std::array<std::int64_t, 3>> next;
            for (std::size_t n = 0; n < wanted.size(); ++n) {
                const auto [x, y, z] = wanted[n];
                if (written[n] == 0) {
                    continue;
                }
                tree[static_cast<std::size_t>(level)].push_back(tile_code(
                    static_cast<std::uint64_t>(x), static_cast<std::uint64_t>(y), static_cast<std::uint64_t>(z)));
                for (int octant = 0; octant < 8; ++octant) {
                    next.push_back({2 * x + octant % 2, 2 * y + octant / 2 % 2, 2 * z + octant / 4});
                }
            }
            wanted = std::move(next);
            std::ranges::sort(tree[static_cast<std::size_t>(level)]);
        }
        return tree;
    }

    /// False when there is no value in it; the root is written all the same.
    bool write_tile(const TileClass& tile_class, const std::string& inside, int level,
                    const std::array<std::int64_t, 3>& tile) {
        const int fineness = tiling_.levels - 1 - level;
        VoxelPyramid::Index lo{};
        std::array<int, 3> count{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            lo[axis] = tile[axis] * tiling_.dimensions[axis];
            count[axis] = tiling_.dimensions[axis];
            if (lo[axis] >= pyramid_.size(fineness)[axis]) {
                return false;
            }
        }
        std::vector<float> shares;
        pyramid_.gather_shares(fineness, tile_class.properties.back().field, lo, count, shares);
        if (level > 0 && std::ranges::all_of(shares, [](float share) { return share == 0; })) {
            return false;
        }
        std::vector<std::vector<float>> values;
        for (const TileProperty& property : tile_class.properties) {
            values.push_back(padded(property, fineness, lo));
        }
        const TileShape of_tile{tiling_.dimensions, place_.region, compress_};
        const Json shape = place_.shape(corner(level, tile), corner(level, {tile[0] + 1, tile[1] + 1, tile[2] + 1}));
        std::string name = inside + "content/" + std::to_string(level);
        for (const std::int64_t place : tile) {
            name += "_" + std::to_string(place);
        }
        write(name + ".glb", voxel_glb(tile_class, of_tile, shape, values));
        return true;
    }

    [[nodiscard]] std::vector<float> padded(const TileProperty& property, int fineness,
                                            const VoxelPyramid::Index& lo) const {
        const bool mask = property.content == TileProperty::Content::mask;
        const int around = mask ? 1 : margin;
        VoxelPyramid::Index from{};
        std::array<int, 3> count{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            from[axis] = lo[axis] - around;
            count[axis] = tiling_.dimensions[axis] + 2 * around;
        }
        std::vector<float> values;
        if (mask) {
            pyramid_.gather_shares(fineness, property.field, from, count, values);
            for (float& share : values) {
                share *= 255;
            }
            return values;
        }
        pyramid_.gather(fineness, property.field, from, count, values);
        const bool smooth = property.is_float();
        fill_voids(count, smooth, property.low >= 0, values);
        std::vector<float> cropped;
        const int off = margin - 1;
        cropped.reserve(values.size());
        for (int i = off; i < count[0] - off; ++i) {
            for (int j = off; j < count[1] - off; ++j) {
                const float* row = values.data() + (static_cast<std::ptrdiff_t>(i) * count[1] + j) * count[2];
                cropped.insert(cropped.end(), row + off, row + count[2] - off);
            }
        }
        return cropped;
    }

    [[nodiscard]] Json tileset(const TileClass& tile_class, const std::string& folder, const Json& others) const {
        const Vec3 lo = corner(0, {0, 0, 0});
        const Vec3 hi = corner(0, {1, 1, 1});
        const Vec3 voxel = static_cast<double>(std::int64_t{1} << (tiling_.levels - 1)) * grid_.spacing;
        double error = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const double metres = place_.region && axis < 2 ? 111320 : place_.metres[axis];
            error += voxel[axis] * metres * voxel[axis] * metres;
        }
        error = std::sqrt(error);
        Json root{{"boundingVolume", place_.bounding_volume(lo, hi)}};
        if (!place_.region) {
            root["transform"] = place_.transform;
        }
        const std::array<int, 3>& d = tiling_.dimensions;
        root["geometricError"] = error;
        root["refine"] = "REPLACE";
        root["content"] = {
            {"uri", folder + "content/{level}_{x}_{y}_{z}.glb"},
            {"extensions",
             {{"3DTILES_content_voxels",
               {{"dimensions", d}, {"padding", {{"before", {1, 1, 1}}, {"after", {1, 1, 1}}}}, {"class", "voxel"}}}}}};
        root["implicitTiling"] = {{"subdivisionScheme", "OCTREE"},
                                  {"availableLevels", tiling_.levels},
                                  {"subtreeLevels", subtree_levels(TileTree(static_cast<std::size_t>(tiling_.levels)))},
                                  {"subtrees", {{"uri", folder + "subtrees/{level}_{x}_{y}_{z}.subtree"}}}};
        Json document{{"asset", {{"version", "1.1"}, {"generator", "Terratet"}}},
                      {"extensionsUsed", Json::array({"3DTILES_content_voxels"})},
                      {"extensionsRequired", Json::array({"3DTILES_content_voxels"})},
                      {"geometricError", error},
                      {"schema", tile_class.schema()},
                      {"statistics", tile_class.statistics()},
                      {"root", root}};
        Json extras{{"crs", grid_.frame.crs_name},
                    {"origin", {grid_.origin.x, grid_.origin.y, grid_.origin.z}},
                    {"spacing", {grid_.spacing.x, grid_.spacing.y, grid_.spacing.z}},
                    {"size", grid_.size},
                    {"deviation", place_.deviation}};
        if (!others.is_null()) {
            extras["tilesets"] = others;
        }
        document["extras"] = extras;
        return document;
    }

    const VoxelGrid& grid_;
    std::string path_;
    OutputFile file_;
    OutputFolder folder_;
    bool compress_;
    TilesPlace place_;
    Tiling tiling_;
    VoxelPyramid pyramid_;
    std::vector<double> low_;
    std::vector<double> high_;
    std::vector<bool> own_mask_;
    std::atomic<std::uint64_t> bytes_ = 0;
};

}  // namespace

std::unique_ptr<VoxelSink> make_tiles_sink(const VoxelGrid& grid, const std::string& path,
                                           const ExportOptions& options) {
    return std::make_unique<TilesSink>(grid, path, options);
}

}  // namespace terratet
