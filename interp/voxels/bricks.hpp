// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// A lattice in bricks: several fields at once, from one source to any number of sinks. Memory follows the bricks in
/// flight (a megabyte a field and brick), never the lattice.

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "interp/lattice.hpp"
#include "tess/progress.hpp"

namespace terratet {

class Ranks;

/// A cube of voxels. Its arrays have edge³ values, z fastest: index ((i·edge)+j)·edge+k. Where it reaches beyond the
/// lattice, and where a field has no value, there is NaN.
struct Brick {
    static constexpr int edge = 64;  ///< voxels along each axis: 8 leaves of OpenVDB

    std::array<std::int64_t, 3> lo{};        ///< index of its first voxel, multiples of edge
    std::array<int, 3> size{};               ///< of its part that lies in the lattice
    std::vector<std::vector<float>> values;  ///< one a field; empty where the field has no value in it

    [[nodiscard]] bool empty() const;
    [[nodiscard]] static std::size_t index(int i, int j, int k) {
        return (static_cast<std::size_t>(i) * edge + static_cast<std::size_t>(j)) * edge + static_cast<std::size_t>(k);
    }
};

class BrickSource {
  public:
    virtual ~BrickSource() = default;
    [[nodiscard]] virtual const Lattice& lattice() const = 0;
    [[nodiscard]] virtual std::size_t fields() const = 0;
    /// The values of the brick at `lo`, `size` and `lo` set. Called from many threads at a time.
    virtual void fill(Brick& brick) const = 0;
};

/// What a sink makes of a brick before its turn.
struct BrickPiece {
    virtual ~BrickPiece() = default;
};

class BrickSink {
  public:
    virtual ~BrickSink() = default;
    /// The costly part (compression, text), from many threads at a time. May return nothing.
    [[nodiscard]] virtual std::unique_ptr<BrickPiece> prepare(const Brick& brick) const = 0;
    /// Are its pieces all that it wants of a brick, and can they be sent from one process to another?
    [[nodiscard]] virtual bool portable() const { return false; }
    [[nodiscard]] virtual std::string to_bytes(const BrickPiece&) const { return {}; }
    [[nodiscard]] virtual std::unique_ptr<BrickPiece> from_bytes(std::string_view) const { return nullptr; }
    /// Every brick once, one at a time, in order: z from below, in it y from the north, in it x from the west.
    virtual void put(const Brick& brick, std::unique_ptr<BrickPiece> piece) = 0;
};

/// Each brick is made once, for all sinks, which work side by side. The order that a sink sees does not depend on the
/// number of threads.
///
/// With several ranks (null: alone) each is to call this with the same source and sinks of the same kinds. They make
/// bricks in turn, in the order in which sinks see them, so that no rank holds many that have to wait; all come to the
/// sinks of rank 0. What a sink of another rank prepares is sent there if it is portable, else the brick's values.
void stream_bricks(const BrickSource& source, std::span<BrickSink* const> sinks, const Progress& progress = {},
                   const Ranks* ranks = nullptr);

/// Sets `lo` and `size` of brick n in the order that sinks see.
void place_brick(const Lattice& lattice, std::size_t n, Brick& brick);

/// Bricks along each axis.
std::array<std::int64_t, 3> brick_counts(const Lattice& lattice);

}  // namespace terratet
