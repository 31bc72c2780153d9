// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// A grid whose leaves' values are on disk: OpenVDB writes the tree, and the values go in from there, as they were
/// compressed when their brick came. In memory a leaf takes some 100 bytes instead of 2 000.

#include <openvdb/io/Compression.h>
#include <openvdb/io/io.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "interp/ranks/bytes.hpp"
#include "interp/voxels/bricks.hpp"
#include "io/voxels/spill_file.hpp"

namespace terratet {

/// How leaves are compressed, and so the whole file.
std::uint32_t vdb_compression();

/// The leaves of one brick that have an active voxel.
template <class TreeT>
struct LeafBlock {
    using Leaf = typename TreeT::LeafNodeType;
    struct Entry {
        openvdb::Coord origin;
        typename Leaf::NodeMaskType mask;
        std::uint64_t begin = 0;  ///< of its values among the block's bytes
        std::uint64_t size = 0;
    };
    std::vector<Entry> leaves;
    std::string bytes;
};

/// Voxels with a NaN are inactive. \param value  what to store for a voxel's number
template <class TreeT, class ToValue>
LeafBlock<TreeT> pack_leaves(const Brick& brick, const std::vector<float>& values, bool half, const ToValue& value) {
    using Block = LeafBlock<TreeT>;
    using Leaf = typename Block::Leaf;
    using Value = typename TreeT::ValueType;
    Block block;
    if (values.empty()) {
        return block;
    }
    static const Value background{0};
    std::ostringstream out(std::ios::binary);
    openvdb::io::setDataCompression(out, vdb_compression());
    openvdb::io::setGridBackgroundValuePtr(out, &background);
    constexpr int step = static_cast<int>(Leaf::DIM);
    for (int x = 0; x < brick.size[0]; x += step) {
        for (int y = 0; y < brick.size[1]; y += step) {
            for (int z = 0; z < brick.size[2]; z += step) {
                const openvdb::Coord origin(static_cast<int>(brick.lo[0]) + x, static_cast<int>(brick.lo[1]) + y,
                                            static_cast<int>(brick.lo[2]) + z);
                Leaf leaf(origin, background, false);
                for (int n = 0; n < static_cast<int>(Leaf::SIZE); ++n) {
                    const float number = values[Brick::index(x + n / 64, y + n / 8 % 8, z + n % 8)];
                    if (!std::isnan(number)) {
                        leaf.setValueOn(static_cast<openvdb::Index>(n), value(number));
                    }
                }
                if (!leaf.isEmpty()) {
                    const auto begin = static_cast<std::uint64_t>(out.tellp());
                    leaf.writeBuffers(out, half);
                    block.leaves.push_back(
                        {origin, leaf.getValueMask(), begin, static_cast<std::uint64_t>(out.tellp()) - begin});
                }
            }
        }
    }
    block.bytes = out.str();
    return block;
}

template <class TreeT>
void put_leaves(const LeafBlock<TreeT>& block, ByteWriter& out) {
    out.put(static_cast<std::uint64_t>(block.leaves.size()));
    for (const auto& entry : block.leaves) {
        out.put(std::array{entry.origin.x(), entry.origin.y(), entry.origin.z()});
        for (openvdb::Index n = 0; n < entry.mask.WORD_COUNT; ++n) {
            out.put(entry.mask.template getWord<std::uint64_t>(n));
        }
        out.put(entry.begin);
        out.put(entry.size);
    }
    out.put(std::string_view(block.bytes));
}

template <class Block>
Block get_leaves(ByteReader& in) {
    Block block;
    block.leaves.resize(in.get<std::uint64_t>());
    for (auto& entry : block.leaves) {
        const auto [x, y, z] = in.get<std::array<std::int32_t, 3>>();
        entry.origin = {x, y, z};
        for (openvdb::Index n = 0; n < entry.mask.WORD_COUNT; ++n) {
            entry.mask.template getWord<std::uint64_t>(n) = in.get<std::uint64_t>();
        }
        entry.begin = in.get<std::uint64_t>();
        entry.size = in.get<std::uint64_t>();
    }
    block.bytes = in.text();
    return block;
}

template <class TreeT>
class SpilledGrid final : public openvdb::Grid<TreeT> {
  public:
    using Block = LeafBlock<TreeT>;
    using Leaf = typename Block::Leaf;
    using Ptr = openvdb::SharedPtr<SpilledGrid>;

    explicit SpilledGrid(SpillFile& spill) : openvdb::Grid<TreeT>(typename TreeT::ValueType{0}), spill_(spill) {}

    void add(const Block& block) {
        const std::uint64_t begin = spill_.append(block.bytes);
        for (const auto& entry : block.leaves) {
            auto* leaf = new Leaf(openvdb::PartialCreate(), entry.origin, typename TreeT::ValueType{0}, false);
            leaf->setValueMask(entry.mask);
            this->tree().addLeaf(leaf);
            places_.push_back({entry.origin, begin + entry.begin, entry.size});
        }
    }

    /// In the order of the tree, as it would write them itself.
    void writeBuffers(std::ostream& out) const override {
        std::ranges::sort(places_, {}, &Place::origin);
        std::string bytes;
        for (auto leaf = this->tree().cbeginLeaf(); leaf; ++leaf) {
            const auto place = std::ranges::lower_bound(places_, leaf->origin(), {}, &Place::origin);
            bytes.resize(place->size);
            spill_.read(place->begin, bytes);
            out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        }
    }

  private:
    struct Place {
        openvdb::Coord origin;
        std::uint64_t begin;
        std::uint64_t size;
    };
    SpillFile& spill_;
    mutable std::vector<Place> places_;
};

}  // namespace terratet
