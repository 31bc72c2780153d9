// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/voxels/tiles/subtrees.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace terratet {
namespace {

using Json = nlohmann::ordered_json;

constexpr int most_levels = 6;

std::uint64_t part_of_code(std::uint64_t code, int axis) {
    std::uint64_t value = 0;
    for (int bit = 0; bit < 21; ++bit) {
        value |= (code >> (3 * bit + axis) & 1U) << bit;
    }
    return value;
}

/// Which of the tiles `depth` levels below a subtree's root there are, a bit each.
std::vector<bool> descendants(const TileTree& tree, std::size_t level, std::uint64_t root, int depth) {
    const std::size_t count = std::size_t{1} << (3 * depth);
    std::vector<bool> there(count);
    const std::size_t below = level + static_cast<std::size_t>(depth);
    if (below < tree.size()) {
        const auto& codes = tree[below];
        auto code = std::ranges::lower_bound(codes, root << (3 * depth));
        for (; code != codes.end() && *code >> (3 * depth) == root; ++code) {
            there[*code & (count - 1)] = true;
        }
    }
    return there;
}

class Availability {
  public:
    Json add(const std::vector<bool>& bits) {
        const auto count = std::ranges::count(bits, true);
        if (count == 0 || count == static_cast<std::ptrdiff_t>(bits.size())) {
            return {{"constant", count == 0 ? 0 : 1}};
        }
        const std::size_t begin = bytes_.size();
        const std::size_t length = (bits.size() + 7) / 8;
        bytes_.resize((begin + length + 7) / 8 * 8);
        for (std::size_t n = 0; n < bits.size(); ++n) {
            if (bits[n]) {
                bytes_[begin + n / 8] = static_cast<char>(static_cast<unsigned char>(bytes_[begin + n / 8]) |
                                                          static_cast<unsigned char>(1U << n % 8));
            }
        }
        views_.push_back({{"buffer", 0}, {"byteOffset", begin}, {"byteLength", length}});
        return {{"bitstream", views_.size() - 1}, {"availableCount", count}};
    }

    std::string finish(Json document) {
        if (!views_.empty()) {
            document["buffers"] = Json::array({{{"byteLength", bytes_.size()}}});
            document["bufferViews"] = views_;
        }
        std::string text = document.dump();
        text.resize((text.size() + 7) / 8 * 8, ' ');
        std::string file = "subt";
        append(file, std::uint32_t{1});
        append(file, static_cast<std::uint64_t>(text.size()));
        append(file, static_cast<std::uint64_t>(bytes_.size()));
        return file + text + bytes_;
    }

  private:
    template <class T>
    static void append(std::string& file, T number) {
        for (std::size_t byte = 0; byte < sizeof(T); ++byte) {
            file += static_cast<char>(number >> (8 * byte) & 0xff);
        }
    }
    std::string bytes_;
    Json views_ = Json::array();
};

}  // namespace

std::uint64_t tile_code(std::uint64_t x, std::uint64_t y, std::uint64_t z) {
    std::uint64_t code = 0;
    for (int bit = 0; bit < 21; ++bit) {
        code |= (x >> bit & 1U) << (3 * bit) | (y >> bit & 1U) << (3 * bit + 1) | (z >> bit & 1U) << (3 * bit + 2);
    }
    return code;
}

int subtree_levels(const TileTree& tree) {
    return std::min(most_levels, static_cast<int>(tree.size()));
}

void write_subtrees(const TileTree& tree, const std::function<void(const std::string&, std::string_view)>& write) {
    const int levels = subtree_levels(tree);
    for (std::size_t level = 0; level < tree.size(); level += static_cast<std::size_t>(levels)) {
        for (const std::uint64_t root : tree[level]) {
            std::vector<bool> tiles;
            for (int depth = 0; depth < levels; ++depth) {
                const std::vector<bool> there = descendants(tree, level, root, depth);
                tiles.insert(tiles.end(), there.begin(), there.end());
            }
            Availability availability;
            Json document;
            document["tileAvailability"] = availability.add(tiles);
            document["contentAvailability"] = Json::array({document["tileAvailability"]});
            document["childSubtreeAvailability"] = availability.add(descendants(tree, level, root, levels));
            std::string name = std::to_string(level);
            for (int axis = 0; axis < 3; ++axis) {
                name += "_" + std::to_string(part_of_code(root, axis));
            }
            write(name, availability.finish(document));
        }
    }
}

}  // namespace terratet
