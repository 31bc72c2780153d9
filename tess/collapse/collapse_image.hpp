// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The tessellation while it is being collapsed: its gaps filled from the faults' own vertices where these
/// have their node, then as the image of a simplicial map.

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "tess/base/no_index.hpp"
#include "tess/collapse/collapse_nodes.hpp"
#include "tess/progress.hpp"

namespace terratet {

/// Cells with their corners' images.
class CollapseImage {
  public:
    /// Where a corner is (its node) and which value it has there (its origin: a vertex of the model, or a mean).
    struct Corner {
        std::uint32_t node = 0;
        std::uint32_t origin = 0;
    };
    struct Cell {
        std::array<Corner, 4> corners;
        std::uint32_t parent = 0;  ///< of the tessellation
        bool made = false;         ///< in place of it and others, or a part of it that a fault cuts off
    };

    /// Nodes are the tessellation's vertices, those of the faults, and what is added where edges cross.
    CollapseImage(const TetMesh& mesh, std::span<const FaultNode> fault_nodes);

    /// Cells without volume between four places of a fault stand where the two sheets are triangulated differently
    /// (cocircular points): an edge of one sheet crosses one of the other. Both get a new node where they cross; then
    /// the cell is gone and the sheets agree.
    void remove_flat_cells();

    /// Edges between seeds that a fault parts get a node where it crosses them, as do the new ones that then cross
    /// another. Returns the crossings that are left: where a cut would leave a cell without volume, or one cut leads to
    /// the next without end.
    std::vector<Vec3> cut_edges(const Model& model, const std::vector<char>& selected, const Poll& poll = {});

    /// Barrier nodes to retreat for the cells to keep a volume, ascending; none when all is well.
    [[nodiscard]] std::vector<std::uint32_t> culprits() const;

    /// Without those that are gone.
    [[nodiscard]] const std::vector<Cell>& cells() const { return cells_; }
    [[nodiscard]] const Vec3& position(std::uint32_t node) const { return positions_[node]; }
    [[nodiscard]] std::size_t node_count() const { return positions_.size(); }
    [[nodiscard]] std::size_t added_nodes() const { return crossed_.size(); }

    /// The model's vertices that an origin stands for in the end, each once, ascending.
    [[nodiscard]] std::vector<std::uint32_t> vertices_behind(std::uint32_t origin) const;

    /// The fault nodes that a node stands for: one, or for an added one those of the crossing edges; none off faults.
    [[nodiscard]] std::vector<std::uint32_t> fault_nodes_at(std::uint32_t node) const;

    /// The faults that a node is on once edges are cut: of the faults' vertices and of added nodes.
    [[nodiscard]] const std::vector<std::int32_t>& faults_on(std::uint32_t node) const { return faults_on_[node]; }

  private:
    class Cutter;
    void place_nodes();
    [[nodiscard]] std::uint32_t culprit_of(const Cell& cell) const;
    [[nodiscard]] bool degenerate(const Cell& cell) const;
    [[nodiscard]] double height(const Cell& cell) const;
    [[nodiscard]] double longest_edge(const Cell& cell) const;
    [[nodiscard]] bool is_flat(const Cell& cell) const;
    void index_stars();
    bool cross_edges(std::uint32_t cell);
    /// A new node's value: that of both ends between which it is, or on each side that of the end there.
    enum class Values : std::uint8_t { of_ends, of_sides };
    void split_edge(std::uint32_t a, std::uint32_t b, std::uint32_t middle, Values values);
    std::uint32_t add_node(const Vec3& at, std::vector<std::uint32_t> made_of);
    std::uint32_t mean_of(std::vector<std::uint32_t> origins);
    [[nodiscard]] bool moved(const Cell& cell) const;

    const TetMesh& mesh_;
    std::span<const FaultNode> fault_nodes_;
    std::vector<Vec3> positions_;
    std::vector<std::uint32_t> node_of_;               ///< of the tessellation's vertices
    std::vector<std::uint32_t> fault_node_;            ///< of a node that stands for one; none
    std::vector<std::vector<std::uint32_t>> crossed_;  ///< of added nodes: the ends of the edges that cross in them
    std::vector<std::vector<std::int32_t>> faults_on_;
    std::vector<Cell> cells_;
    std::vector<std::vector<std::uint32_t>> star_;   ///< cells at a node, some of them gone
    std::vector<std::vector<std::uint32_t>> means_;  ///< origin vertices.size() + k is the mean of these earlier ones
    std::map<std::vector<std::uint32_t>, std::uint32_t> mean_number_;
};

}  // namespace terratet
