// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/collapse/collapse_image.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "tess/base/tetrahedron.hpp"
#include "tess/collapse/collapse_fill.hpp"

namespace terratet {
namespace {

constexpr double flat_height = 0.05;   ///< over the longest edge: flatter cells between fault nodes are taken out
constexpr double least_height = 0.02;  ///< over the longest edge: what a moved cell must keep,
constexpr double height_share = 0.1;   ///< or this share of the height it had
constexpr double rounding = 1e-6;      ///< over the longest edge: no less whatever it had
constexpr std::size_t max_growth = 4;  ///< crossings resolved, over the flat cells there were

}  // namespace

CollapseImage::CollapseImage(const TetMesh& mesh, std::span<const FaultNode> fault_nodes)
    : mesh_(mesh), fault_nodes_(fault_nodes), positions_(mesh.points) {
    const Filling filling = fill_gaps(mesh, fault_nodes);
    place_nodes();
    faults_on_.resize(positions_.size());
    const auto vertex_count = static_cast<std::uint32_t>(mesh.points.size());
    const auto add = [this](const Cell& cell) {
        if (!degenerate(cell)) {
            cells_.push_back(cell);
        }
    };
    for (std::uint32_t c = 0; c < mesh.cells.size(); ++c) {
        Cell cell;
        cell.parent = c;
        for (std::size_t k = 0; k < 4; ++k) {
            const std::uint32_t v = mesh.cells[c][k];
            cell.corners[k] = {node_of_[v], v};
        }
        if (filling.replaced[c] == 0) {
            add(cell);
        }
    }
    for (const Filling::Cell& filled : filling.cells) {
        Cell cell;
        cell.parent = filled.parent;
        cell.made = true;
        std::vector<std::uint32_t> seeds;
        std::ranges::copy_if(filled.corners, std::back_inserter(seeds),
                             [&](std::uint32_t v) { return v < vertex_count; });
        const std::uint32_t mean = mean_of(std::move(seeds));
        for (std::size_t k = 0; k < 4; ++k) {
            const std::uint32_t v = filled.corners[k];
            cell.corners[k] = v < vertex_count ? Corner{node_of_[v], v} : Corner{v, mean};
        }
        add(cell);
    }
}

void CollapseImage::place_nodes() {
    fault_node_.assign(positions_.size(), no_index);
    for (std::uint32_t v = 0; v < positions_.size(); ++v) {
        node_of_.push_back(v);
    }
    for (std::uint32_t f = 0; f < fault_nodes_.size(); ++f) {
        const FaultNode& at = fault_nodes_[f];
        if (at.is_vertex()) {
            positions_.push_back(at.base);
            fault_node_.push_back(f);
            continue;
        }
        const std::uint32_t first = *std::ranges::min_element(at.seeds);
        for (std::size_t k = 0; k < at.seeds.size(); ++k) {
            fault_node_[at.seeds[k]] = f;
            if (at.state == FaultNode::State::joined) {
                node_of_[at.seeds[k]] = first;
            }
            if (at.state == FaultNode::State::joined || (at.state == FaultNode::State::apart && k == 0)) {
                positions_[at.seeds[k]] = at.base;
            }
        }
    }
}

bool CollapseImage::degenerate(const Cell& cell) const {
    return std::ranges::any_of(cell_edges,
                               [&](const auto& e) { return cell.corners[e[0]].node == cell.corners[e[1]].node; });
}

double CollapseImage::height(const Cell& cell) const {
    const auto& c = cell.corners;
    return signed_height({positions_[c[0].node], positions_[c[1].node], positions_[c[2].node], positions_[c[3].node]});
}

double CollapseImage::longest_edge(const Cell& cell) const {
    double longest = 0;
    for (const auto& [i, j] : cell_edges) {
        longest =
            std::max(longest, squared_distance(positions_[cell.corners[i].node], positions_[cell.corners[j].node]));
    }
    return std::sqrt(longest);
}

bool CollapseImage::is_flat(const Cell& cell) const {
    const bool on_barrier = std::ranges::all_of(cell.corners, [&](const Corner& corner) {
        if (corner.node >= fault_node_.size()) {
            return true;
        }
        const std::uint32_t at = fault_node_[corner.node];
        return at != no_index && fault_nodes_[at].state != FaultNode::State::aside &&
               positions_[corner.node] == fault_nodes_[at].base;
    });
    return on_barrier && height(cell) < flat_height * longest_edge(cell);
}

void CollapseImage::index_stars() {
    star_.assign(positions_.size(), {});
    for (std::uint32_t c = 0; c < cells_.size(); ++c) {
        for (const Corner& corner : cells_[c].corners) {
            star_[corner.node].push_back(c);
        }
    }
}

void CollapseImage::remove_flat_cells() {
    std::vector<std::uint32_t> flat;
    for (std::uint32_t c = 0; c < cells_.size(); ++c) {
        if (is_flat(cells_[c])) {
            flat.push_back(c);
        }
    }
    if (flat.empty()) {
        return;
    }
    index_stars();
    const std::size_t most = max_growth * flat.size();
    std::size_t crossings = 0;
    for (std::size_t i = 0; i < flat.size() && crossings < most; ++i) {
        if (degenerate(cells_[flat[i]]) || !is_flat(cells_[flat[i]])) {
            continue;  // gone with an earlier one, or mended by it
        }
        const std::size_t before = cells_.size();
        crossings += cross_edges(flat[i]) ? 1 : 0;
        for (auto c = static_cast<std::uint32_t>(before); c < cells_.size(); ++c) {
            if (!degenerate(cells_[c]) && is_flat(cells_[c])) {
                flat.push_back(c);
            }
        }
    }
    std::erase_if(cells_, [this](const Cell& cell) { return degenerate(cell); });
}

/// Of the three pairs of opposite edges one crosses, seen across the flat cell; none does when a corner lies within the
/// triangle of the others.
bool CollapseImage::cross_edges(std::uint32_t cell) {
    const std::array<Corner, 4> v = cells_[cell].corners;
    for (const auto& [i, j, k, l] : opposite_edges) {
        const auto crossing =
            edge_crossing({positions_[v[i].node], positions_[v[j].node], positions_[v[k].node], positions_[v[l].node]});
        if (!crossing) {
            continue;
        }
        const std::uint32_t middle = add_node(crossing->middle, {v[i].node, v[j].node, v[k].node, v[l].node});
        split_edge(v[i].node, v[j].node, middle, Values::of_ends);
        split_edge(v[k].node, v[l].node, middle, Values::of_ends);
        return true;
    }
    return false;
}

std::uint32_t CollapseImage::add_node(const Vec3& at, std::vector<std::uint32_t> made_of) {
    positions_.push_back(at);
    crossed_.push_back(std::move(made_of));
    star_.emplace_back();
    faults_on_.emplace_back();
    return static_cast<std::uint32_t>(positions_.size() - 1);
}

/// Each cell round the edge becomes two new ones.
void CollapseImage::split_edge(std::uint32_t a, std::uint32_t b, std::uint32_t middle, Values values) {
    const std::vector<std::uint32_t> round = star_[a];
    for (const std::uint32_t c : round) {
        const Cell whole = cells_[c];
        const auto corner_at = [&](std::uint32_t node) {
            return static_cast<std::size_t>(std::ranges::find(whole.corners, node, &Corner::node) -
                                            whole.corners.begin());
        };
        const std::size_t at_a = corner_at(a);
        const std::size_t at_b = corner_at(b);
        if (at_a == 4 || at_b == 4 || degenerate(whole)) {
            continue;
        }
        const std::array<std::uint32_t, 2> ends{whole.corners[at_a].origin, whole.corners[at_b].origin};
        cells_[c].corners.fill(whole.corners[0]);
        for (const std::size_t replaced : {at_a, at_b}) {
            Cell half = whole;
            half.made = whole.made || values == Values::of_sides;
            half.corners[replaced] = {
                middle, values == Values::of_ends ? mean_of({ends[0], ends[1]}) : ends[replaced == at_a ? 1 : 0]};
            for (const Corner& corner : half.corners) {
                star_[corner.node].push_back(static_cast<std::uint32_t>(cells_.size()));
            }
            cells_.push_back(half);
        }
    }
}

std::uint32_t CollapseImage::mean_of(std::vector<std::uint32_t> origins) {
    std::ranges::sort(origins);
    const auto next = static_cast<std::uint32_t>(mesh_.points.size() + means_.size());
    const auto [entry, is_new] = mean_number_.try_emplace(origins, next);
    if (is_new) {
        means_.push_back(std::move(origins));
    }
    return entry->second;
}

bool CollapseImage::moved(const Cell& cell) const {
    return std::ranges::any_of(cell.corners, [&](const Corner& corner) {
        return corner.origin >= mesh_.points.size() ? corner.node >= fault_node_.size()
                                                    : positions_[corner.node] != mesh_.points[corner.origin];
    });
}

/// The fault node to retreat for a cell without volume: of those that have given up least the last one.
std::uint32_t CollapseImage::culprit_of(const Cell& cell) const {
    std::uint32_t culprit = no_index;
    for (const Corner& corner : cell.corners) {
        for (const std::uint32_t f : fault_nodes_at(corner.node)) {
            if (fault_nodes_[f].state != FaultNode::State::aside &&
                (culprit == no_index || fault_nodes_[f].state < fault_nodes_[culprit].state ||
                 (fault_nodes_[f].state == fault_nodes_[culprit].state && f > culprit))) {
                culprit = f;
            }
        }
    }
    return culprit;
}

std::vector<std::uint32_t> CollapseImage::culprits() const {
    std::vector<std::uint32_t> result;
    for (const Cell& cell : cells_) {
        if (!cell.made && !moved(cell)) {
            continue;
        }
        const auto& parent = mesh_.cells[cell.parent];
        const double longest = longest_edge(cell);
        const double before = signed_height(
            {mesh_.points[parent[0]], mesh_.points[parent[1]], mesh_.points[parent[2]], mesh_.points[parent[3]]});
        const double least = std::max(std::min(least_height * longest, height_share * before), rounding * longest);
        if (height(cell) >= least) {
            continue;
        }
        if (const std::uint32_t culprit = culprit_of(cell); culprit != no_index) {  // one at a time is often enough
            result.push_back(culprit);
        }
    }
    std::ranges::sort(result);
    result.erase(std::ranges::unique(result).begin(), result.end());
    return result;
}

namespace {

/// What a number was made of, and that of what: each once, since what is cut again and again has the same ends many
/// times over. Numbers from `first` on are made of earlier ones.
template <class EndsOf>
std::vector<std::uint32_t> ends_behind(std::uint32_t number, std::size_t first, const EndsOf& ends_of) {
    std::set<std::uint32_t> open{number};
    std::vector<std::uint32_t> result;
    while (!open.empty()) {
        const std::uint32_t next = *open.rbegin();
        open.erase(next);
        if (next < first) {
            result.push_back(next);
        } else {
            const auto& ends = ends_of[next - first];
            open.insert(ends.begin(), ends.end());
        }
    }
    std::ranges::reverse(result);
    return result;
}

}  // namespace

std::vector<std::uint32_t> CollapseImage::vertices_behind(std::uint32_t origin) const {
    return ends_behind(origin, mesh_.points.size(), means_);
}

std::vector<std::uint32_t> CollapseImage::fault_nodes_at(std::uint32_t node) const {
    std::vector<std::uint32_t> result;
    for (const std::uint32_t v : ends_behind(node, fault_node_.size(), crossed_)) {
        if (fault_node_[v] != no_index) {
            result.push_back(fault_node_[v]);
        }
    }
    std::ranges::sort(result);
    result.erase(std::ranges::unique(result).begin(), result.end());
    return result;
}

}  // namespace terratet
