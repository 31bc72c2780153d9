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

namespace terratet {

void resample(const LinearField& field, const Lattice& lattice, TileSink& sink, const Progress& progress) {
    assert(field.mesh != nullptr);
    const CellScan cells(*field.mesh, field.use_cell,
                         {{field.vertex_values, field.sides, field.log10, field.categorical}}, lattice);
    const auto counts = brick_counts(lattice);
    const auto total = static_cast<std::size_t>(counts[0] * counts[1] * counts[2]);
    tbb::enumerable_thread_specific<Brick> bricks;
    std::mutex progress_mutex;
    std::size_t done = 0;
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, total, 1),
        [&](const auto& part) {
            for (std::size_t n = part.begin(); n != part.end(); ++n) {
                Brick& brick = bricks.local();
                place_brick(lattice, n, brick);
                cells.fill(brick);
                if (!brick.empty()) {
                    sink.tile({brick.lo, brick.values.front()});
                }
                if (progress) {
                    const std::lock_guard lock(progress_mutex);
                    report_progress(progress, "resample", static_cast<double>(++done) / static_cast<double>(total));
                }
            }
        },
        tbb::simple_partitioner());
}

namespace {

constexpr float no_value = std::numeric_limits<float>::quiet_NaN();

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
