// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/voxels/cell_scan.hpp"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "interp/voxels/scan_conversion.hpp"

namespace terratet {
namespace {

constexpr float no_value = std::numeric_limits<float>::quiet_NaN();
constexpr std::size_t brick_voxels = std::size_t{Brick::edge} * Brick::edge * Brick::edge;

/// The bricks that cover a lattice, x slowest.
struct TileGrid {
    std::array<std::int64_t, 3> count;

    explicit TileGrid(const Lattice& lattice) {
        for (std::size_t k = 0; k < 3; ++k) {
            count[k] = (lattice.size[k] + Brick::edge - 1) / Brick::edge;
        }
    }
    [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(count[0] * count[1] * count[2]); }
    [[nodiscard]] std::size_t index(std::int64_t x, std::int64_t y, std::int64_t z) const {
        return static_cast<std::size_t>((x * count[1] + y) * count[2] + z);
    }
    [[nodiscard]] std::array<std::int64_t, 3> first_voxel(std::size_t tile) const {
        const auto t = static_cast<std::int64_t>(tile);
        return {t / (count[1] * count[2]) * Brick::edge, t / count[2] % count[1] * Brick::edge,
                t % count[2] * Brick::edge};
    }
};

/// For each tile the cells whose bounding boxes hold one of its voxels, ascending.
struct Bins {
    std::vector<std::size_t> begin;  ///< of each tile, and the end
    std::vector<std::uint32_t> cells;
};

/// Everything that does not depend on the tile.
struct Job {
    const TetMesh& mesh;
    std::span<const std::uint8_t> use_cell;
    std::vector<ScanField> fields;
    Lattice lattice;
    TileGrid tiles;
    std::vector<Vec3> points;             ///< in voxel indices
    std::array<std::int64_t, 3> first{};  ///< voxels that may have values, along each axis
    std::array<std::int64_t, 3> last{};
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
bool has_value(const Job& job, const ScanField& field, std::uint32_t cell) {
    if (!field.cell_values.empty() && field.cell_values[cell] >= 0) {
        return true;
    }
    const auto valued = [&](std::uint32_t v) { return !std::isnan(field.vertex_values[v]); };
    const auto& corners = job.mesh.cells[cell];
    return field.sides != nullptr && field.sides->concerns(cell) ? std::ranges::any_of(corners, valued)
                                                                 : std::ranges::all_of(corners, valued);
}

/// Tiles along each axis that a cell's bounding box has voxels in; empty when lo > hi.
struct TileRange {
    std::array<std::int32_t, 3> lo{0, 0, 0};
    std::array<std::int32_t, 3> hi{-1, -1, -1};
};

TileRange tiles_of(const Job& job, std::uint32_t cell) {
    if ((!job.use_cell.empty() && job.use_cell[cell] == 0) ||
        std::ranges::none_of(job.fields, [&](const ScanField& field) { return has_value(job, field, cell); })) {
        return {};
    }
    TileRange range;
    const auto& c = job.mesh.cells[cell];
    for (std::size_t k = 0; k < 3; ++k) {
        const int axis = static_cast<int>(k);
        int first = 0;
        int last = 0;
        if (!detail::voxels_between(job.points[c[0]][axis], job.points[c[1]][axis], job.points[c[2]][axis],
                                    job.points[c[3]][axis], static_cast<int>(job.lattice.size[k]), first, last)) {
            return {};
        }
        range.lo[k] = first / Brick::edge;
        range.hi[k] = last / Brick::edge;
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
    const std::size_t n = job.mesh.cells.size();
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

/// A cell as a brick sees it: corners in ascending order of index.
struct PlacedCell {
    ScanCell shape;
    std::array<std::uint32_t, 4> vertex;
};

/// A row of voxels in a cell.
struct Span {
    int x, y, za, zb;
};

/// λ₁, λ₂, λ₃ at p; λ₀ is the rest.
std::array<double, 4> barycentric(const ScanCell& shape, const Vec3& p) {
    const Vec3 d = p - shape.corner[0];
    const double l1 = dot(shape.normal[1], d) / shape.determinant;
    const double l2 = -dot(shape.normal[2], d) / shape.determinant;
    const double l3 = dot(shape.normal[3], d) / shape.determinant;
    return {1 - l1 - l2 - l3, l1, l2, l3};
}

/// The cell's linear function along its rows, within the range of its corners' values.
void fill_linear(const ScanCell& shape, std::span<const Span> rows, const std::array<double, 4>& f, float* brick) {
    const double scale = 1 / shape.determinant;
    const Vec3 gradient =
        scale * ((f[1] - f[0]) * shape.normal[1] - (f[2] - f[0]) * shape.normal[2] + (f[3] - f[0]) * shape.normal[3]);
    const Vec3 foot = shape.corner[0];
    const auto least = static_cast<float>(std::min(std::min(f[0], f[1]), std::min(f[2], f[3])));
    const auto most = static_cast<float>(std::max(std::max(f[0], f[1]), std::max(f[2], f[3])));
    const auto step = static_cast<float>(gradient.z);
    for (const auto& [x, y, za, zb] : rows) {
        const auto start = static_cast<float>(f[0] + gradient.x * (x - foot.x) + gradient.y * (y - foot.y) +
                                              gradient.z * (za - foot.z));
        float* row = brick + Brick::index(x, y, za);
        for (int k = 0; k <= zb - za; ++k) {
            const float value = start + step * static_cast<float>(k);
            row[k] = value < least ? least : value > most ? most : value;
        }
    }
}

/// Voxel by voxel, for what is not one linear function: categories, and gap cells. Where there is no value, what
/// another cell gave stays.
template <class Value>
void fill_voxels(std::span<const Span> rows, float* brick, Value&& value) {
    for (const auto& [x, y, za, zb] : rows) {
        float* row = brick + Brick::index(x, y, 0);
        for (int z = za; z <= zb; ++z) {
            const double found = value(Vec3{double(x), double(y), double(z)});
            row[z] = std::isnan(found) ? row[z] : static_cast<float>(found);
        }
    }
}

void fill_constant(std::span<const Span> rows, float value, float* brick) {
    for (const auto& [x, y, za, zb] : rows) {
        std::fill_n(brick + Brick::index(x, y, za), zb - za + 1, value);
    }
}

/// A gap cell: each voxel from the vertices that it sees.
void fill_own_sides(const Job& job, const ScanField& field, std::uint32_t number, const PlacedCell& cell,
                    std::span<const Span> rows, const std::array<std::int64_t, 3>& first_voxel, float* brick) {
    const auto& corners = job.mesh.cells[number];
    std::array<std::size_t, 4> sorted{};  // where the mesh's corners are among the placed cell's
    for (std::size_t k = 0; k < 4; ++k) {
        sorted[k] = static_cast<std::size_t>(std::find(cell.vertex.begin(), cell.vertex.end(), corners[k]) -
                                             cell.vertex.begin());
    }
    fill_voxels(rows, brick, [&](const Vec3& voxel) {
        Vec3 p;
        for (std::size_t k = 0; k < 3; ++k) {
            const int axis = static_cast<int>(k);
            p[axis] = job.lattice.origin[axis] +
                      job.lattice.spacing[axis] * (voxel[axis] + static_cast<double>(first_voxel[k]));
        }
        const std::array<double, 4> plain = barycentric(cell.shape, voxel);
        const VertexWeights own =
            field.sides->weights(number, p, {plain[sorted[0]], plain[sorted[1]], plain[sorted[2]], plain[sorted[3]]});
        std::array<double, 4> value{};
        for (std::size_t k = 0; k < 4; ++k) {
            value[k] = field.vertex_values[own.vertices[k]];
        }
        return mixed(own.weights, value, field.categorical);
    });
}

/// The cell in voxels from the brick's first, its rows within the voxels that may have values.
PlacedCell place(const Job& job, std::uint32_t cell, const Brick& brick) {
    PlacedCell placed;
    placed.vertex = job.mesh.cells[cell];
    auto& v = placed.vertex;
    const auto order = [&](std::size_t a, std::size_t b) {
        if (v[b] < v[a]) {
            std::swap(v[a], v[b]);
        }
    };
    order(0, 1), order(2, 3), order(0, 2), order(1, 3), order(1, 2);
    const Vec3 shift{static_cast<double>(brick.lo[0]), static_cast<double>(brick.lo[1]),
                     static_cast<double>(brick.lo[2])};
    std::array<Vec3, 4> corner;
    for (std::size_t k = 0; k < 4; ++k) {
        corner[k] = job.points[v[k]] - shift;
    }
    placed.shape = make_scan_cell(corner, brick.size);
    for (std::size_t k = 0; k < 3; ++k) {
        constexpr std::int64_t edge = Brick::edge;
        placed.shape.lo[k] = std::max(placed.shape.lo[k],
                                      static_cast<int>(std::clamp<std::int64_t>(job.first[k] - brick.lo[k], 0, edge)));
        placed.shape.hi[k] = std::min(placed.shape.hi[k],
                                      static_cast<int>(std::clamp<std::int64_t>(job.last[k] - brick.lo[k], -1, edge)));
    }
    return placed;
}

/// One field's values in one cell.
void fill_field(const Job& job, const ScanField& field, std::uint32_t number, const PlacedCell& cell,
                std::span<const Span> rows, const Brick& brick, float* values) {
    if (!field.cell_values.empty() && field.cell_values[number] >= 0) {
        fill_constant(rows, static_cast<float>(field.cell_values[number]), values);
        return;
    }
    if (field.sides != nullptr && field.sides->concerns(number)) {
        fill_own_sides(job, field, number, cell, rows, brick.lo, values);
        return;
    }
    std::array<double, 4> f{};
    for (std::size_t k = 0; k < 4; ++k) {
        f[k] = field.vertex_values[cell.vertex[k]];
    }
    if (field.categorical) {
        fill_voxels(rows, values, [&](const Vec3& p) { return mixed(barycentric(cell.shape, p), f, true); });
    } else {
        fill_linear(cell.shape, rows, f, values);
    }
}

/// To measured values where the field is in log10; nothing at all when the brick has no value.
void finish(const ScanField& field, std::vector<float>& values) {
    bool any = false;
    for (float& value : values) {
        if (!std::isnan(value)) {
            any = true;
            if (field.log10) {
                value = static_cast<float>(std::pow(10.0, static_cast<double>(value)));
            }
        }
    }
    if (!any) {
        values.clear();
    }
}

}  // namespace

struct CellScan::Impl {
    Job job;
    Bins bins;
    mutable tbb::enumerable_thread_specific<std::vector<Span>> rows;
};

CellScan::CellScan(const TetMesh& mesh, std::span<const std::uint8_t> use_cell, std::vector<ScanField> fields,
                   const Lattice& lattice, const std::optional<Box3>& within)
    : impl_(new Impl{
          {mesh, use_cell, std::move(fields), lattice, TileGrid(lattice), to_voxel_indices(mesh.points, lattice)},
          {},
          {}}) {
    Job& job = impl_->job;
    assert(use_cell.empty() || use_cell.size() == mesh.cells.size());
    assert(
        std::ranges::all_of(job.fields, [&](const auto& f) { return f.vertex_values.size() == mesh.points.size(); }));
    for (std::size_t k = 0; k < 3; ++k) {
        job.last[k] = lattice.size[k] - 1;
        if (within) {
            const int axis = static_cast<int>(k);
            const auto voxel = [&](double x) { return (x - lattice.origin[axis]) / lattice.spacing[axis]; };
            const auto ends = static_cast<double>(lattice.size[k]);
            job.first[k] =
                static_cast<std::int64_t>(std::ceil(std::clamp(voxel(within->lo[axis]) - scan_tolerance, 0., ends)));
            job.last[k] = static_cast<std::int64_t>(
                std::floor(std::clamp(voxel(within->hi[axis]) + scan_tolerance, -1., ends - 1)));
        }
    }
    impl_->bins = bin_cells(job);
}

CellScan::~CellScan() = default;

const Lattice& CellScan::lattice() const {
    return impl_->job.lattice;
}

std::size_t CellScan::fields() const {
    return impl_->job.fields.size();
}

/// Cells in descending order, each overwriting: so the smallest index owns a voxel that several cells claim, and no
/// voxel is ever asked who owns it.
void CellScan::fill(Brick& brick) const {
    const Job& job = impl_->job;
    const std::size_t tile =
        job.tiles.index(brick.lo[0] / Brick::edge, brick.lo[1] / Brick::edge, brick.lo[2] / Brick::edge);
    std::vector<Span>& rows = impl_->rows.local();
    brick.values.resize(job.fields.size());
    for (auto& values : brick.values) {
        values.clear();
    }
    for (std::size_t n = impl_->bins.begin[tile + 1]; n-- > impl_->bins.begin[tile];) {
        const std::uint32_t number = impl_->bins.cells[n];
        const PlacedCell cell = place(job, number, brick);
        if (cell.shape.empty()) {
            continue;
        }
        rows.clear();
        scan(cell.shape, [&](int x, int y, int za, int zb) { rows.push_back({x, y, za, zb}); });
        if (rows.empty()) {
            continue;
        }
        for (std::size_t f = 0; f < job.fields.size(); ++f) {
            if (has_value(job, job.fields[f], number)) {
                auto& values = brick.values[f];
                if (values.empty()) {
                    values.assign(brick_voxels, no_value);
                }
                fill_field(job, job.fields[f], number, cell, rows, brick, values.data());
            }
        }
    }
    for (std::size_t f = 0; f < job.fields.size(); ++f) {
        finish(job.fields[f], brick.values[f]);
    }
}

}  // namespace terratet
