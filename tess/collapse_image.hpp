// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Internal: the tessellation while it is being collapsed, as the image of a simplicial map.

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "tess/tessellation.hpp"

namespace terratet {

/// A place of a fault that seeds are to meet at.
struct FaultNode {
    enum class State : std::uint8_t {
        joined,  ///< all seeds at the base
        apart,   ///< + seed at the base, − seed where it was; of single pairs only
        aside    ///< all where they were
    };
    Vec3 base;
    std::vector<std::uint32_t> seeds;  ///< vertices: + and − in turn
    State state = State::joined;

    /// Gives up one thing more; false when there is nothing left to give up.
    bool retreat();
};

/// Cells with their corners' images.
class CollapseImage {
  public:
    static constexpr std::uint32_t none = 0xffffffffU;

    /// Where a corner is (its node) and which value it has there (its origin: a vertex of the model, or a cut).
    struct Corner {
        std::uint32_t node = 0;
        std::uint32_t origin = 0;
    };
    struct Cell {
        std::array<Corner, 4> corners;
        std::uint32_t parent = 0;  ///< of the tessellation
    };
    /// Origin vertices.size() + i is halfway between two earlier ones.
    struct Cut {
        std::uint32_t a = 0;
        std::uint32_t b = 0;
    };

    CollapseImage(const TetMesh& mesh, std::span<const FaultNode> fault_nodes);

    /// Cells without volume between four places of a fault stand where the two sheets are triangulated differently
    /// (cocircular points): an edge of one sheet crosses one of the other. Both get a new node where they cross; then
    /// the cell is gone and the sheets agree.
    void remove_flat_cells();

    /// Fault nodes to retreat for the cells to keep a volume, ascending; none when all is well.
    [[nodiscard]] std::vector<std::uint32_t> culprits() const;

    /// Without those that are gone.
    [[nodiscard]] const std::vector<Cell>& cells() const { return cells_; }
    [[nodiscard]] const std::vector<Cut>& cuts() const { return cuts_; }
    [[nodiscard]] const Vec3& position(std::uint32_t node) const { return positions_[node]; }
    [[nodiscard]] std::size_t node_count() const { return positions_.size(); }
    [[nodiscard]] std::size_t added_nodes() const { return positions_.size() - mesh_.points.size(); }

    /// The two model vertices or cuts that an origin stands for in the end: all vertices behind it, each once.
    [[nodiscard]] std::vector<std::uint32_t> vertices_behind(std::uint32_t origin) const;

    /// The fault nodes that a node stands for: one, or for an added one those of the crossing edges; none off faults.
    [[nodiscard]] std::vector<std::uint32_t> fault_nodes_at(std::uint32_t node) const;

  private:
    template <class EndsOf>
    std::vector<std::uint32_t> origins(std::uint32_t node, const EndsOf& ends_of) const;
    [[nodiscard]] bool degenerate(const Cell& cell) const;
    [[nodiscard]] double height(const Cell& cell) const;
    [[nodiscard]] double longest_edge(const Cell& cell) const;
    [[nodiscard]] bool is_flat(const Cell& cell) const;
    void index_stars();
    bool cross_edges(std::uint32_t cell);
    void split_edge(std::uint32_t a, std::uint32_t b, std::uint32_t middle);
    std::uint32_t cut(std::uint32_t a, std::uint32_t b);

    const TetMesh& mesh_;
    std::span<const FaultNode> fault_nodes_;
    std::vector<Vec3> positions_;
    std::vector<std::uint32_t> fault_node_;              ///< of a vertex that has one at a base; none
    std::vector<std::array<std::uint32_t, 4>> crossed_;  ///< of added nodes: the ends of the crossing edges
    std::vector<Cell> cells_;
    std::vector<std::vector<std::uint32_t>> star_;  ///< cells at a node, some of them gone
    std::vector<Cut> cuts_;
    std::map<std::array<std::uint32_t, 2>, std::uint32_t> cut_of_;
};

}  // namespace terratet
