// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/voxels/resample.hpp"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <mutex>
#include <utility>

#include "interp/voxels/scan_conversion.hpp"

namespace terratet {
namespace {

constexpr float no_value = std::numeric_limits<float>::quiet_NaN();
constexpr std::size_t tile_voxels = std::size_t{Tile::edge} * Tile::edge * Tile::edge;

/// The bricks that cover a lattice, x slowest.
struct TileGrid {
    std::array<std::int64_t, 3> count;

    explicit TileGrid(const Lattice& lattice) {
        for (std::size_t k = 0; k < 3; ++k) {
            count[k] = (lattice.size[k] + Tile::edge - 1) / Tile::edge;
        }
    }
    [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(count[0] * count[1] * count[2]); }
    [[nodiscard]] std::size_t index(std::int64_t x, std::int64_t y, std::int64_t z) const {
        return static_cast<std::size_t>((x * count[1] + y) * count[2] + z);
    }
    [[nodiscard]] std::array<std::int64_t, 3> first_voxel(std::size_t tile) const {
        const auto t = static_cast<std::int64_t>(tile);
        return {t / (count[1] * count[2]) * Tile::edge, t / count[2] % count[1] * Tile::edge,
                t % count[2] * Tile::edge};
    }
};

/// For each tile the cells whose bounding boxes hold one of its voxels, ascending.
struct Bins {
    std::vector<std::size_t> begin;  ///< of each tile, and the end
    std::vector<std::uint32_t> cells;
};

/// Everything that does not depend on the tile.
struct Job {
    const LinearField& field;
    const Lattice& lattice;
    TileGrid tiles;
    std::vector<Vec3> points;  ///< in voxel indices
};

std::vector<Vec3> to_voxel_indices(const std::vector<Vec3>& points, const Lattice& lattice) {
    std::vector<Vec3> result(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            result[i][axis] = (points[i][axis] - lattice.origin[axis]) / lattice.spacing[axis];
        }
    }
    return result;
}

/// Where a cell reaches across a barrier, the side with values is enough.
bool has_value(const LinearField& field, std::uint32_t cell) {
    if (!field.use_cell.empty() && field.use_cell[cell] == 0) {
        return false;
    }
    const auto valued = [&](std::uint32_t v) { return !std::isnan(field.vertex_values[v]); };
    const auto& corners = field.mesh->cells[cell];
    return field.sides != nullptr && field.sides->concerns(cell) ? std::ranges::any_of(corners, valued)
                                                                 : std::ranges::all_of(corners, valued);
}

/// Tiles along each axis that a cell's bounding box has voxels in; empty when lo > hi.
struct TileRange {
    std::array<std::int32_t, 3> lo{0, 0, 0};
    std::array<std::int32_t, 3> hi{-1, -1, -1};
};

TileRange tiles_of(const Job& job, std::uint32_t cell) {
    if (!has_value(job.field, cell)) {
        return {};
    }
    TileRange range;
    const auto& c = job.field.mesh->cells[cell];
    for (std::size_t k = 0; k < 3; ++k) {
        const int axis = static_cast<int>(k);
        int first = 0;
        int last = 0;
        if (!detail::voxels_between(job.points[c[0]][axis], job.points[c[1]][axis], job.points[c[2]][axis],
                                    job.points[c[3]][axis], static_cast<int>(job.lattice.size[k]), first, last)) {
            return {};
        }
        range.lo[k] = first / Tile::edge;
        range.hi[k] = last / Tile::edge;
    }
    return range;
}

template <class Visit>
void for_each_tile(const TileGrid& tiles, const TileRange& range, Visit&& visit) {
    for (std::int64_t x = range.lo[0]; x <= range.hi[0]; ++x) {
        for (std::int64_t y = range.lo[1]; y <= range.hi[1]; ++y) {
            for (std::int64_t z = range.lo[2]; z <= range.hi[2]; ++z) {
                visit(tiles.index(x, y, z));
            }
        }
    }
}

/// A counting sort of cells by tile.
Bins bin_cells(const Job& job) {
    const std::size_t n = job.field.mesh->cells.size();
    std::vector<TileRange> ranges(n);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n, 16384), [&](const auto& part) {
        for (std::size_t c = part.begin(); c != part.end(); ++c) {
            ranges[c] = tiles_of(job, static_cast<std::uint32_t>(c));
        }
    });
    Bins bins;
    bins.begin.assign(job.tiles.size() + 1, 0);
    for (const TileRange& range : ranges) {
        for_each_tile(job.tiles, range, [&](std::size_t tile) { ++bins.begin[tile + 1]; });
    }
    for (std::size_t tile = 0; tile < job.tiles.size(); ++tile) {
        bins.begin[tile + 1] += bins.begin[tile];
    }
    bins.cells.resize(bins.begin.back());
    std::vector<std::size_t> next(bins.begin.begin(), bins.begin.end() - 1);
    for (std::size_t c = 0; c < n; ++c) {
        for_each_tile(job.tiles, ranges[c],
                      [&](std::size_t tile) { bins.cells[next[tile]++] = static_cast<std::uint32_t>(c); });
    }
    return bins;
}

/// A cell as a tile sees it: corners in ascending order of index, with their values.
struct PlacedCell {
    ScanCell shape;
    std::array<std::uint32_t, 4> vertex;
    std::array<double, 4> value;
};

/// λ₁, λ₂, λ₃ at p; λ₀ is the rest.
std::array<double, 4> barycentric(const ScanCell& shape, const Vec3& p) {
    const Vec3 d = p - shape.corner[0];
    const double l1 = dot(shape.normal[1], d) / shape.determinant;
    const double l2 = -dot(shape.normal[2], d) / shape.determinant;
    const double l3 = dot(shape.normal[3], d) / shape.determinant;
    return {1 - l1 - l2 - l3, l1, l2, l3};
}

/// The row's stretch of the cell's linear function, within the range of its corners' values.
void fill_linear(const PlacedCell& cell, float* tile) {
    const auto& f = cell.value;
    const double scale = 1 / cell.shape.determinant;
    const Vec3 gradient = scale * ((f[1] - f[0]) * cell.shape.normal[1] - (f[2] - f[0]) * cell.shape.normal[2] +
                                   (f[3] - f[0]) * cell.shape.normal[3]);
    const Vec3 foot = cell.shape.corner[0];
    const auto least = static_cast<float>(std::min(std::min(f[0], f[1]), std::min(f[2], f[3])));
    const auto most = static_cast<float>(std::max(std::max(f[0], f[1]), std::max(f[2], f[3])));
    const auto step = static_cast<float>(gradient.z);
    scan(cell.shape, [&](int x, int y, int za, int zb) {
        const auto start = static_cast<float>(f[0] + gradient.x * (x - foot.x) + gradient.y * (y - foot.y) +
                                              gradient.z * (za - foot.z));
        float* row = tile + (x * Tile::edge + y) * Tile::edge + za;
        for (int k = 0; k <= zb - za; ++k) {
            const float value = start + step * static_cast<float>(k);
            row[k] = value < least ? least : value > most ? most : value;
        }
    });
}

/// Voxel by voxel, for what is not one linear function: categories, and gap cells. Where there is no value, what
/// another cell gave stays.
template <class Value>
void fill_voxels(const ScanCell& shape, float* tile, Value&& value) {
    scan(shape, [&](int x, int y, int za, int zb) {
        float* row = tile + (x * Tile::edge + y) * Tile::edge;
        for (int z = za; z <= zb; ++z) {
            const double found = value(Vec3{double(x), double(y), double(z)});
            row[z] = std::isnan(found) ? row[z] : static_cast<float>(found);
        }
    });
}

/// A gap cell: each voxel from the vertices that it sees.
void fill_own_sides(const Job& job, std::uint32_t number, const PlacedCell& cell,
                    const std::array<std::int64_t, 3>& first_voxel, float* tile) {
    const auto& corners = job.field.mesh->cells[number];
    std::array<std::size_t, 4> sorted{};  // where the mesh's corners are among the placed cell's
    for (std::size_t k = 0; k < 4; ++k) {
        sorted[k] = static_cast<std::size_t>(std::find(cell.vertex.begin(), cell.vertex.end(), corners[k]) -
                                             cell.vertex.begin());
    }
    fill_voxels(cell.shape, tile, [&](const Vec3& voxel) {
        Vec3 p;
        for (std::size_t k = 0; k < 3; ++k) {
            const int axis = static_cast<int>(k);
            p[axis] = job.lattice.origin[axis] +
                      job.lattice.spacing[axis] * (voxel[axis] + static_cast<double>(first_voxel[k]));
        }
        const std::array<double, 4> plain = barycentric(cell.shape, voxel);
        const VertexWeights own = job.field.sides->weights(
            number, p, {plain[sorted[0]], plain[sorted[1]], plain[sorted[2]], plain[sorted[3]]});
        std::array<double, 4> value{};
        for (std::size_t k = 0; k < 4; ++k) {
            value[k] = job.field.vertex_values[own.vertices[k]];
        }
        return mixed(own.weights, value, job.field.categorical);
    });
}

PlacedCell place(const Job& job, std::uint32_t cell, const std::array<std::int64_t, 3>& first_voxel,
                 const std::array<int, 3>& size) {
    PlacedCell placed;
    placed.vertex = job.field.mesh->cells[cell];
    auto& v = placed.vertex;
    const auto order = [&](std::size_t a, std::size_t b) {
        if (v[b] < v[a]) {
            std::swap(v[a], v[b]);
        }
    };
    order(0, 1), order(2, 3), order(0, 2), order(1, 3), order(1, 2);
    const Vec3 shift{static_cast<double>(first_voxel[0]), static_cast<double>(first_voxel[1]),
                     static_cast<double>(first_voxel[2])};
    std::array<Vec3, 4> corner;
    for (std::size_t k = 0; k < 4; ++k) {
        corner[k] = job.points[v[k]] - shift;
        placed.value[k] = job.field.vertex_values[v[k]];
    }
    placed.shape = make_scan_cell(corner, size);
    return placed;
}

/// Cells in descending order, each overwriting: so the smallest index owns a voxel that several cells claim, and no
/// voxel is ever asked who owns it.
void fill_tile(const Job& job, std::span<const std::uint32_t> cells, const std::array<std::int64_t, 3>& first_voxel,
               std::vector<float>& values) {
    values.assign(tile_voxels, no_value);
    std::array<int, 3> size;
    for (std::size_t k = 0; k < 3; ++k) {
        size[k] = static_cast<int>(std::min<std::int64_t>(Tile::edge, job.lattice.size[k] - first_voxel[k]));
    }
    const LinearField& field = job.field;
    for (auto it = cells.rbegin(); it != cells.rend(); ++it) {
        const PlacedCell cell = place(job, *it, first_voxel, size);
        if (cell.shape.empty()) {
            continue;
        }
        if (field.sides != nullptr && field.sides->concerns(*it)) {
            fill_own_sides(job, *it, cell, first_voxel, values.data());
        } else if (field.categorical) {
            fill_voxels(cell.shape, values.data(),
                        [&](const Vec3& p) { return mixed(barycentric(cell.shape, p), cell.value, true); });
        } else {
            fill_linear(cell, values.data());
        }
    }
}

/// To measured values where the field is in log10. False when the tile has no value at all.
bool finish_tile(const LinearField& field, std::vector<float>& values) {
    bool any = false;
    for (float& value : values) {
        if (!std::isnan(value)) {
            any = true;
            if (field.log10) {
                value = static_cast<float>(std::pow(10.0, static_cast<double>(value)));
            }
        }
    }
    return any;
}

}  // namespace

void resample(const LinearField& field, const Lattice& lattice, TileSink& sink, const Progress& progress) {
    assert(field.mesh != nullptr && field.vertex_values.size() == field.mesh->points.size());
    assert(field.use_cell.empty() || field.use_cell.size() == field.mesh->cells.size());
    const Job job{field, lattice, TileGrid(lattice), to_voxel_indices(field.mesh->points, lattice)};
    const Bins bins = bin_cells(job);

    tbb::enumerable_thread_specific<std::vector<float>> buffers;
    std::mutex progress_mutex;
    std::size_t done = 0;
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, job.tiles.size(), 1),
        [&](const auto& part) {
            for (std::size_t tile = part.begin(); tile != part.end(); ++tile) {
                const std::span cells(bins.cells.data() + bins.begin[tile], bins.begin[tile + 1] - bins.begin[tile]);
                if (!cells.empty()) {
                    auto& values = buffers.local();
                    const auto first_voxel = job.tiles.first_voxel(tile);
                    fill_tile(job, cells, first_voxel, values);
                    if (finish_tile(field, values)) {
                        sink.tile({first_voxel, values});
                    }
                }
                if (progress) {
                    const std::lock_guard lock(progress_mutex);
                    report_progress(progress, "resample",
                                    static_cast<double>(++done) / static_cast<double>(job.tiles.size()));
                }
            }
        },
        tbb::simple_partitioner());
}

namespace {

class DenseSink final : public TileSink {
  public:
    explicit DenseSink(const Lattice& lattice)
        : size_(lattice.size), values_(static_cast<std::size_t>(lattice.count()), no_value) {}

    void tile(const Tile& tile) override {
        std::array<std::int64_t, 3> n;
        for (std::size_t k = 0; k < 3; ++k) {
            n[k] = std::min<std::int64_t>(Tile::edge, size_[k] - tile.lo[k]);
        }
        for (std::int64_t i = 0; i < n[0]; ++i) {
            for (std::int64_t j = 0; j < n[1]; ++j) {
                const float* from = tile.values.data() + (i * Tile::edge + j) * Tile::edge;
                float* to = values_.data() + ((tile.lo[0] + i) * size_[1] + tile.lo[1] + j) * size_[2] + tile.lo[2];
                std::copy(from, from + n[2], to);
            }
        }
    }
    std::vector<float> take() { return std::move(values_); }

  private:
    std::array<std::int64_t, 3> size_;
    std::vector<float> values_;
};

}  // namespace

std::vector<float> resample_dense(const LinearField& field, const Lattice& lattice) {
    DenseSink sink(lattice);
    resample(field, lattice, sink);
    return sink.take();
}

}  // namespace terratet
