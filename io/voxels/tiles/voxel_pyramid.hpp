// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Voxels at ever coarser levels, whatever format they go to: a voxel of a level is made of eight of the next finer
/// one. What is in memory is a table of the blocks that hold a value; the values are in a spill file.

#include <array>
#include <atomic>
#include <cstdint>
#include <shared_mutex>
#include <string>
#include <vector>

#include "interp/voxels/bricks.hpp"
#include "io/voxels/spill_file.hpp"

namespace terratet {

/// What eight voxels make.
enum class Merging : std::uint8_t {
    mean,      ///< of those with a value, each by the share of finest voxels that have one
    majority,  ///< the class with the largest share, of equal ones the lowest
};

class VoxelPyramid {
  public:
    using Index = std::array<std::int64_t, 3>;

    /// Level 0 is the finest; every further one has half as many voxels along each axis, rounded up.
    /// \param output  in whose folder the spill file lies
    VoxelPyramid(const Index& size, std::vector<Merging> fields, int levels, const std::string& output);

    /// Of level 0, one at a time; a field with no value in the block is empty. \param same  of each field, if not
    /// itself, which one has a value where it has: of the field it is only asked where.
    void put(const Index& block, const std::vector<std::vector<float>>& values, const std::vector<std::size_t>& same);
    /// Makes the other levels; after the last put().
    void coarsen(const Progress& progress);

    [[nodiscard]] int levels() const { return static_cast<int>(levels_.size()); }
    [[nodiscard]] const Index& size(int level) const { return levels_[static_cast<std::size_t>(level)].size; }
    /// Of level 0: whether a field has no value in a block.
    [[nodiscard]] bool is_empty(std::size_t field, const Index& block) const {
        return levels_.front().begin[slot(levels_.front(), block, field)] == none;
    }
    /// Values of a box of voxels, z fastest; NaN where there is none, within the lattice or beyond. From many threads.
    void gather(int level, std::size_t field, const Index& lo, const std::array<int, 3>& count,
                std::vector<float>& out) const;
    /// How many of the finest voxels in each have a value, 0 to 1.
    void gather_shares(int level, std::size_t field, const Index& lo, const std::array<int, 3>& count,
                       std::vector<float>& out) const;

  private:
    static constexpr std::uint64_t none = ~std::uint64_t{0};
    static constexpr std::size_t block_voxels = std::size_t{Brick::edge} * Brick::edge * Brick::edge;
    struct Level {
        Index size{};
        Index blocks{};
        std::vector<std::uint64_t> begin;  ///< [block][field, its shares after all fields]
    };
    [[nodiscard]] std::size_t slots() const { return 2 * fields_.size(); }
    [[nodiscard]] std::size_t slot(const Level& level, const Index& block, std::size_t n) const;
    [[nodiscard]] std::uint64_t store(const std::vector<float>& values);
    [[nodiscard]] std::vector<float> load(std::uint64_t begin) const;
    void gather_slot(const Level& level, std::size_t n, const Index& lo, const std::array<int, 3>& count,
                     std::vector<float>& out) const;
    void merge_block(std::size_t level, const Index& block);

    std::vector<Merging> fields_;
    std::vector<Level> levels_;
    SpillFile spill_;
    mutable std::shared_mutex mutex_;  ///< of spill_, which may move what it holds while it grows
};

}  // namespace terratet
