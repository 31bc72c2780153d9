// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/collapse_image.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace terratet {
namespace {

constexpr double flat_height = 0.05;   ///< over the longest edge: flatter cells between fault nodes are taken out
constexpr double least_height = 0.02;  ///< over the longest edge: what a moved cell must keep,
constexpr double height_share = 0.1;   ///< or this share of the height it had
constexpr double rounding = 1e-6;      ///< over the longest edge: no less whatever it had
constexpr double inner = 0.02;         ///< crossings nearer to an end of an edge, relative, are none
constexpr std::size_t max_growth = 4;  ///< crossings resolved, over the flat cells there were

constexpr std::array<std::array<std::size_t, 2>, 6> cell_edges{{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

double signed_height(const std::array<Vec3, 4>& p) {
    const double six_volumes = dot(cross(p[1] - p[0], p[2] - p[0]), p[3] - p[0]);
    double largest = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        const Vec3& a = p[(k + 1) % 4];
        largest = std::max(largest, length(cross(p[(k + 2) % 4] - a, p[(k + 3) % 4] - a)));
    }
    return largest > 0 ? six_volumes / largest : 0;
}

}  // namespace

bool FaultNode::retreat() {
    if (state == State::aside) {
        return false;
    }
    state = state == State::joined && seeds.size() == 2 ? State::apart : State::aside;
    return true;
}

CollapseImage::CollapseImage(const TetMesh& mesh, std::span<const FaultNode> fault_nodes)
    : mesh_(mesh), fault_nodes_(fault_nodes), positions_(mesh.points), fault_node_(mesh.points.size(), none) {
    std::vector<std::uint32_t> node(mesh.points.size());
    for (std::uint32_t v = 0; v < node.size(); ++v) {
        node[v] = v;
    }
    for (std::uint32_t f = 0; f < fault_nodes.size(); ++f) {
        const FaultNode& at = fault_nodes[f];
        const std::uint32_t first = *std::ranges::min_element(at.seeds);
        for (std::size_t k = 0; k < at.seeds.size(); ++k) {
            fault_node_[at.seeds[k]] = f;
            if (at.state == FaultNode::State::joined) {
                node[at.seeds[k]] = first;
            }
            if (at.state == FaultNode::State::joined || (at.state == FaultNode::State::apart && k == 0)) {
                positions_[at.seeds[k]] = at.base;
            }
        }
    }
    for (std::uint32_t c = 0; c < mesh.cells.size(); ++c) {
        Cell cell;
        cell.parent = c;
        for (std::size_t k = 0; k < 4; ++k) {
            const std::uint32_t v = mesh.cells[c][k];
            cell.corners[k] = {node[v], v};
        }
        if (!degenerate(cell)) {
            cells_.push_back(cell);
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
    const bool on_fault = std::ranges::all_of(cell.corners, [&](const Corner& corner) {
        if (corner.node >= mesh_.points.size()) {
            return true;
        }
        const std::uint32_t at = fault_node_[corner.node];
        return at != none && fault_nodes_[at].state != FaultNode::State::aside &&
               positions_[corner.node] == fault_nodes_[at].base;
    });
    return on_fault && height(cell) < flat_height * longest_edge(cell);
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
    for (const auto& [i, j, k, l] : {std::array{0U, 1U, 2U, 3U}, {0U, 2U, 1U, 3U}, {0U, 3U, 1U, 2U}}) {
        const Vec3& a = positions_[v[i].node];
        const Vec3& c = positions_[v[k].node];
        const Vec3 u = positions_[v[j].node] - a;
        const Vec3 w = positions_[v[l].node] - c;
        const Vec3 normal = cross(u, w);
        const double square = squared_length(normal);
        if (!(square > 0)) {
            continue;
        }
        const double s = dot(cross(c - a, w), normal) / square;
        const double t = dot(cross(c - a, u), normal) / square;
        if (std::min({s, 1 - s, t, 1 - t}) < inner) {
            continue;
        }
        const auto middle = static_cast<std::uint32_t>(positions_.size());
        positions_.push_back(0.5 * (a + s * u + c + t * w));
        crossed_.push_back({v[i].node, v[j].node, v[k].node, v[l].node});
        star_.emplace_back();
        split_edge(v[i].node, v[j].node, middle);
        split_edge(v[k].node, v[l].node, middle);
        return true;
    }
    return false;
}

/// Each cell round the edge becomes two new ones.
void CollapseImage::split_edge(std::uint32_t a, std::uint32_t b, std::uint32_t middle) {
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
        const Corner between{middle, cut(whole.corners[at_a].origin, whole.corners[at_b].origin)};
        cells_[c].corners.fill(whole.corners[0]);
        for (const std::size_t replaced : {at_a, at_b}) {
            Cell half = whole;
            half.corners[replaced] = between;
            for (const Corner& corner : half.corners) {
                star_[corner.node].push_back(static_cast<std::uint32_t>(cells_.size()));
            }
            cells_.push_back(half);
        }
    }
}

std::uint32_t CollapseImage::cut(std::uint32_t a, std::uint32_t b) {
    const std::array<std::uint32_t, 2> key{std::min(a, b), std::max(a, b)};
    const auto [entry, is_new] =
        cut_of_.try_emplace(key, static_cast<std::uint32_t>(mesh_.points.size() + cuts_.size()));
    if (is_new) {
        cuts_.push_back({key[0], key[1]});
    }
    return entry->second;
}

std::vector<std::uint32_t> CollapseImage::culprits() const {
    std::vector<std::uint32_t> result;
    for (const Cell& cell : cells_) {
        const auto& parent = mesh_.cells[cell.parent];
        bool moved = false;
        for (std::size_t k = 0; k < 4; ++k) {
            moved = moved || positions_[cell.corners[k].node] != mesh_.points[parent[k]];
        }
        if (!moved) {
            continue;
        }
        const double longest = longest_edge(cell);
        const double before = signed_height(
            {mesh_.points[parent[0]], mesh_.points[parent[1]], mesh_.points[parent[2]], mesh_.points[parent[3]]});
        const double least = std::max(std::min(least_height * longest, height_share * before), rounding * longest);
        if (height(cell) >= least) {
            continue;
        }
        // One at a time, the one that has given up least, is often enough.
        std::uint32_t culprit = none;
        for (const Corner& corner : cell.corners) {
            for (const std::uint32_t f : fault_nodes_at(corner.node)) {
                if (fault_nodes_[f].state != FaultNode::State::aside &&
                    (culprit == none || fault_nodes_[f].state < fault_nodes_[culprit].state ||
                     (fault_nodes_[f].state == fault_nodes_[culprit].state && f > culprit))) {
                    culprit = f;
                }
            }
        }
        if (culprit != none) {
            result.push_back(culprit);
        }
    }
    std::ranges::sort(result);
    result.erase(std::ranges::unique(result).begin(), result.end());
    return result;
}

/// What the node was made of, and that of what: each node once, since what is cut again and again has the same ends
/// many times over. Later nodes lie between earlier ones.
template <class EndsOf>
std::vector<std::uint32_t> CollapseImage::origins(std::uint32_t node, const EndsOf& ends_of) const {
    std::set<std::uint32_t> open{node};
    std::vector<std::uint32_t> result;
    while (!open.empty()) {
        const std::uint32_t next = *open.rbegin();
        open.erase(next);
        if (next < mesh_.points.size()) {
            result.push_back(next);
        } else {
            const auto ends = ends_of(next - mesh_.points.size());
            open.insert(ends.begin(), ends.end());
        }
    }
    std::ranges::reverse(result);
    return result;
}

std::vector<std::uint32_t> CollapseImage::vertices_behind(std::uint32_t origin) const {
    return origins(origin, [this](std::size_t k) { return std::array{cuts_[k].a, cuts_[k].b}; });
}

std::vector<std::uint32_t> CollapseImage::fault_nodes_at(std::uint32_t node) const {
    std::vector<std::uint32_t> result;
    for (const std::uint32_t v : origins(node, [this](std::size_t k) { return crossed_[k]; })) {
        if (fault_node_[v] != none) {
            result.push_back(fault_node_[v]);
        }
    }
    std::ranges::sort(result);
    result.erase(std::ranges::unique(result).begin(), result.end());
    return result;
}

}  // namespace terratet
