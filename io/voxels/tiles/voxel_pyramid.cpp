// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/voxels/tiles/voxel_pyramid.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

namespace terratet {
namespace {

constexpr int edge = Brick::edge;
constexpr float no_value = std::numeric_limits<float>::quiet_NaN();

std::int64_t ceil_div(std::int64_t a, std::int64_t b) {
    return (a + b - 1) / b;
}

/// Eight voxels with their shares; an absent one has a share of 0.
struct Eight {
    std::array<float, 8> value{};
    std::array<float, 8> share{};

    [[nodiscard]] float total() const {
        float sum = 0;
        for (const float s : share) {
            sum += s;
        }
        return sum;
    }
    [[nodiscard]] float mean() const {
        double sum = 0;
        double weight = 0;
        for (std::size_t n = 0; n < 8; ++n) {
            if (share[n] > 0) {
                sum += static_cast<double>(share[n]) * static_cast<double>(value[n]);
                weight += static_cast<double>(share[n]);
            }
        }
        return static_cast<float>(sum / weight);
    }
    [[nodiscard]] float majority() const {
        float best = no_value;
        float best_share = 0;
        for (std::size_t n = 0; n < 8; ++n) {
            float of_class = 0;
            for (std::size_t m = 0; m < 8; ++m) {
                of_class += value[m] == value[n] ? share[m] : 0;
            }
            if (share[n] > 0 && (of_class > best_share || (of_class == best_share && value[n] < best))) {
                best = value[n];
                best_share = of_class;
            }
        }
        return best;
    }
};

}  // namespace

VoxelPyramid::VoxelPyramid(const Index& size, std::vector<Merging> fields, int levels, const std::string& output)
    : fields_(std::move(fields)), spill_(output) {
    levels_.resize(static_cast<std::size_t>(levels));
    for (std::size_t l = 0; l < levels_.size(); ++l) {
        Level& level = levels_[l];
        for (std::size_t axis = 0; axis < 3; ++axis) {
            level.size[axis] = ceil_div(size[axis], std::int64_t{1} << l);
            level.blocks[axis] = ceil_div(level.size[axis], edge);
        }
        level.begin.assign(static_cast<std::size_t>(level.blocks[0] * level.blocks[1] * level.blocks[2]) * slots(),
                           none);
    }
}

std::size_t VoxelPyramid::slot(const Level& level, const Index& block, std::size_t n) const {
    return static_cast<std::size_t>((block[0] * level.blocks[1] + block[1]) * level.blocks[2] + block[2]) * slots() + n;
}

std::uint64_t VoxelPyramid::store(const std::vector<float>& values) {
    const std::lock_guard lock(mutex_);
    return spill_.append({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float)});
}

std::vector<float> VoxelPyramid::load(std::uint64_t begin) const {
    std::vector<float> values(block_voxels);
    const std::shared_lock lock(mutex_);
    spill_.read(begin, {reinterpret_cast<char*>(values.data()), values.size() * sizeof(float)});
    return values;
}

void VoxelPyramid::put(const Index& block, const std::vector<std::vector<float>>& values,
                       const std::vector<std::size_t>& same) {
    std::vector<std::uint64_t>& begin = levels_[0].begin;
    for (std::size_t f = 0; f < fields_.size(); ++f) {
        if (!values[f].empty()) {
            begin[slot(levels_[0], block, f)] = store(values[f]);
        } else if (same[f] != f) {
            begin[slot(levels_[0], block, f)] = begin[slot(levels_[0], block, same[f])];
        }
    }
}

void VoxelPyramid::coarsen(const Progress& progress) {
    for (std::size_t l = 1; l < levels_.size(); ++l) {
        const Index& n = levels_[l].blocks;
        tbb::parallel_for(std::int64_t{0}, n[0] * n[1] * n[2], [&](std::int64_t b) {
            merge_block(l, {b / (n[1] * n[2]), b / n[2] % n[1], b % n[2]});
        });
        report_progress(progress, "coarsen", static_cast<double>(l) / static_cast<double>(levels_.size() - 1));
    }
}

void VoxelPyramid::merge_block(std::size_t l, const Index& block) {
    const Level& fine = levels_[l - 1];
    for (std::size_t f = 0; f < fields_.size(); ++f) {
        std::vector<float> merged;
        std::vector<float> shares;
        for (int octant = 0; octant < 8; ++octant) {
            const Index child{2 * block[0] + octant / 4, 2 * block[1] + octant / 2 % 2, 2 * block[2] + octant % 2};
            if (child[0] >= fine.blocks[0] || child[1] >= fine.blocks[1] || child[2] >= fine.blocks[2] ||
                fine.begin[slot(fine, child, f)] == none) {
                continue;
            }
            if (merged.empty()) {
                merged.assign(block_voxels, no_value);
                shares.assign(block_voxels, 0);
            }
            const std::vector<float> values = load(fine.begin[slot(fine, child, f)]);
            const std::uint64_t of_shares = fine.begin[slot(fine, child, fields_.size() + f)];
            const std::vector<float> finer = of_shares == none ? std::vector<float>() : load(of_shares);
            constexpr int half = edge / 2;
            for (int i = 0; i < half; ++i) {
                for (int j = 0; j < half; ++j) {
                    for (int k = 0; k < half; ++k) {
                        Eight eight;
                        for (int n = 0; n < 8; ++n) {
                            const std::size_t at = Brick::index(2 * i + n / 4, 2 * j + n / 2 % 2, 2 * k + n % 2);
                            const bool has = !std::isnan(values[at]);
                            eight.value[static_cast<std::size_t>(n)] = has ? values[at] : 0;
                            eight.share[static_cast<std::size_t>(n)] = !has ? 0 : finer.empty() ? 1 : finer[at];
                        }
                        const float total = eight.total();
                        if (total > 0) {
                            const std::size_t to =
                                Brick::index(i + octant / 4 * half, j + octant / 2 % 2 * half, k + octant % 2 * half);
                            shares[to] = total / 8;
                            merged[to] = fields_[f] == Merging::mean ? eight.mean() : eight.majority();
                        }
                    }
                }
            }
        }
        if (!merged.empty()) {
            levels_[l].begin[slot(levels_[l], block, f)] = store(merged);
            levels_[l].begin[slot(levels_[l], block, fields_.size() + f)] = store(shares);
        }
    }
}

void VoxelPyramid::gather(int level, std::size_t field, const Index& lo, const std::array<int, 3>& count,
                          std::vector<float>& out) const {
    gather_slot(levels_[static_cast<std::size_t>(level)], field, lo, count, out);
}

void VoxelPyramid::gather_shares(int level, std::size_t field, const Index& lo, const std::array<int, 3>& count,
                                 std::vector<float>& out) const {
    const bool finest = level == 0;
    gather_slot(levels_[static_cast<std::size_t>(level)], finest ? field : fields_.size() + field, lo, count, out);
    for (float& share : out) {
        share = std::isnan(share) ? 0 : finest ? 1 : share;
    }
}

void VoxelPyramid::gather_slot(const Level& level, std::size_t n, const Index& lo, const std::array<int, 3>& count,
                               std::vector<float>& out) const {
    out.assign(
        static_cast<std::size_t>(count[0]) * static_cast<std::size_t>(count[1]) * static_cast<std::size_t>(count[2]),
        no_value);
    Index first{};
    Index last{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        first[axis] = std::max<std::int64_t>(lo[axis], 0) / edge;
        last[axis] = (std::min(lo[axis] + count[axis], level.size[axis]) - 1) / edge;
    }
    std::vector<float> rows(static_cast<std::size_t>(edge) * edge);
    for (Index b = first; b[0] <= last[0]; ++b[0]) {
        for (b[1] = first[1]; b[1] <= last[1]; ++b[1]) {
            for (b[2] = first[2]; b[2] <= last[2]; ++b[2]) {
                const std::uint64_t begin = level.begin[slot(level, b, n)];
                if (begin == none) {
                    continue;
                }
                std::array<int, 3> from{};  // within the block
                std::array<int, 3> to{};
                std::array<std::int64_t, 3> shift{};  // from the block's voxels to the box's
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    shift[axis] = b[axis] * edge - lo[axis];
                    from[axis] = static_cast<int>(std::max<std::int64_t>(0, -shift[axis]));
                    to[axis] = static_cast<int>(std::min<std::int64_t>(edge, count[axis] - shift[axis]));
                }
                const auto wanted = static_cast<std::size_t>(to[1] - from[1]) * edge;
                for (int i = from[0]; i < to[0]; ++i) {
                    {
                        const std::shared_lock lock(mutex_);
                        spill_.read(begin + Brick::index(i, from[1], 0) * sizeof(float),
                                    {reinterpret_cast<char*>(rows.data()), wanted * sizeof(float)});
                    }
                    for (int j = from[1]; j < to[1]; ++j) {
                        const auto place = ((i + shift[0]) * count[1] + j + shift[1]) * count[2] + from[2] + shift[2];
                        std::copy_n(rows.data() + static_cast<std::ptrdiff_t>(j - from[1]) * edge + from[2],
                                    to[2] - from[2], out.data() + place);
                    }
                }
            }
        }
    }
}

}  // namespace terratet
