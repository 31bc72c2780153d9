// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <set>

#include "tess/barrier/query/sheet_crossings.hpp"
#include "tess/base/poll.hpp"
#include "tess/base/tetrahedron.hpp"
#include "tess/collapse/collapse_image.hpp"

namespace terratet {
namespace {

constexpr double near_end = 0.02;      ///< a node this near to another fault, over the edge's length,
constexpr double near_fault = 0.01;    ///< or over the fault's spacing, is on it as well
constexpr double crossed = 1e-3;       ///< edges that pass each other nearer than that, over the length, cross
constexpr double least_height = 1e-6;  ///< of what is left of a cell, over its longest edge,
constexpr double height_share = 1e-3;  ///< or over the height it had
constexpr double rounding = 1e-9;      ///< over the longest edge: no less whatever it had
constexpr std::size_t max_growth = 4;  ///< edges looked at, over those there were

using Edge = std::array<std::uint32_t, 2>;

Edge edge_of(std::uint32_t a, std::uint32_t b) {
    return {std::min(a, b), std::max(a, b)};
}

}  // namespace

/// Splits the edges that faults part, one after the other, and the new ones that then cross another fault.
class CollapseImage::Cutter {
  public:
    Cutter(CollapseImage& image, const Model& model, const std::vector<char>& selected)
        : image_(image), model_(model), crossings_(model.barriers, model.domain.extent, selected, collect_edges()) {
        image_.index_stars();
        find_faults();
    }

    std::vector<Vec3> run(const Poll& poll) {
        PatientPoll go_on(poll);
        const std::size_t most = max_growth * open_.size();
        for (std::size_t next = 0; next < open_.size(); ++next) {
            go_on();
            const Edge edge = open_[next];
            if (!exists(edge)) {
                continue;
            }
            const std::vector<SheetCrossings::Crossing> met = faults_between(edge);
            if (met.empty()) {
                continue;
            }
            const auto& [a, b] = edge;
            const Vec3 at = position(a) + met[0].at * (position(b) - position(a));
            const std::uint32_t passed = node_at(edge, at);
            if (next < most && passed != no_index && led_through_.insert(edge).second) {
                cut(edge, passed, met);
            } else if (next < most && passed == no_index && stays_positive(edge, at, no_index)) {
                const std::uint32_t middle = image_.add_node(at, {});
                on_.emplace_back();
                cut(edge, middle, met);
            } else {
                left_.push_back(at);
            }
        }
        image_.faults_on_ = std::move(on_);
        std::erase_if(image_.cells_, [this](const Cell& cell) { return image_.degenerate(cell); });
        std::ranges::for_each(image_.cells_, [this](Cell& cell) { take_value_of_seeds(cell); });
        return std::move(left_);
    }

  private:
    [[nodiscard]] const Vec3& position(std::uint32_t node) const { return image_.positions_[node]; }
    [[nodiscard]] bool is_made(std::uint32_t node) const { return node >= model_.vertices.size(); }

    static bool has(const Cell& cell, std::uint32_t node) {
        return std::ranges::find(cell.corners, node, &Corner::node) != cell.corners.end();
    }

    [[nodiscard]] bool is_on(std::uint32_t node, std::int32_t barrier) const {
        return std::ranges::find(on_[node], barrier) != on_[node].end();
    }

    void add_edge(std::uint32_t a, std::uint32_t b) {
        const auto of_barrier = [&](std::uint32_t node) {
            return is_made(node) || model_.vertices[node].role == Role::seed;
        };
        if (a != b && of_barrier(a) && of_barrier(b)) {
            open_.push_back(edge_of(a, b));
        }
    }

    /// All between seeds and what is on faults; first those that run through each other in a flat cell: another cut
    /// would take them apart. Returns the longest one's length.
    double collect_edges() {
        std::set<Edge> first;
        for (const Cell& cell : image_.cells_) {
            const auto& c = cell.corners;
            for (const auto& [i, j] : cell_edges) {
                add_edge(c[i].node, c[j].node);
            }
            for (const auto& [i, j, k, l] : opposite_edges) {
                const auto crossing =
                    edge_crossing({position(c[i].node), position(c[j].node), position(c[k].node), position(c[l].node)});
                if (crossing && crossing->apart < crossed * image_.longest_edge(cell)) {
                    first.insert(edge_of(c[i].node, c[j].node));
                    first.insert(edge_of(c[k].node, c[l].node));
                }
            }
        }
        std::ranges::sort(open_);
        open_.erase(std::ranges::unique(open_).begin(), open_.end());
        std::ranges::stable_partition(open_, [&](const Edge& edge) { return first.contains(edge); });
        double longest = 0;
        for (const auto& [a, b] : open_) {
            longest = std::max(longest, distance(position(a), position(b)));
        }
        return longest;
    }

    void find_faults() {
        on_.resize(image_.positions_.size());
        for (std::uint32_t node = 0; node < on_.size(); ++node) {
            if (is_made(node)) {
                on_[node] = image_.fault_nodes_[image_.fault_node_[node]].barriers;
            }
        }
    }

    [[nodiscard]] bool exists(const Edge& edge) const {
        return std::ranges::any_of(image_.star_[edge[0]], [&](std::uint32_t c) {
            return !image_.degenerate(image_.cells_[c]) && has(image_.cells_[c], edge[1]);
        });
    }

    /// The faults that part its ends, ascending from the first: none that an end is on, or as good as on.
    std::vector<SheetCrossings::Crossing> faults_between(const Edge& edge) {
        const auto [a, b] = edge;
        std::vector<SheetCrossings::Crossing> met = crossings_(position(a), position(b));
        const double length = distance(position(a), position(b));
        for (const auto& [at, barrier] : met) {
            const double near =
                std::max(near_end, near_fault * model_.barriers[static_cast<std::size_t>(barrier)].spacing / length);
            if (is_made(a) && at < near && !is_on(a, barrier)) {
                on_[a].push_back(barrier);
            }
            if (is_made(b) && 1 - at < near && !is_on(b, barrier)) {
                on_[b].push_back(barrier);
            }
        }
        std::erase_if(met,
                      [&](const auto& crossing) { return is_on(a, crossing.barrier) || is_on(b, crossing.barrier); });
        return met;
    }

    /// The node of a flat cell round the edge that it runs through just there.
    [[nodiscard]] std::uint32_t node_at(const Edge& edge, const Vec3& at) const {
        const double most = crossed * distance(position(edge[0]), position(edge[1]));
        for (const std::uint32_t c : image_.star_[edge[0]]) {
            const Cell& cell = image_.cells_[c];
            if (image_.degenerate(cell) || !has(cell, edge[1])) {
                continue;
            }
            for (const Corner& corner : cell.corners) {
                if (is_made(corner.node) && distance(position(corner.node), at) < most && corner.node != edge[0] &&
                    corner.node != edge[1] && runs_through(edge, position(corner.node)) &&
                    stays_positive(edge, position(corner.node), corner.node)) {
                    return corner.node;
                }
            }
        }
        return no_index;
    }

    void cut(const Edge& edge, std::uint32_t middle, const std::vector<SheetCrossings::Crossing>& met) {
        for (const auto& crossing : met) {
            if (crossing.at - met[0].at < near_end && !is_on(middle, crossing.barrier)) {
                on_[middle].push_back(crossing.barrier);
            }
        }
        image_.split_edge(edge[0], edge[1], middle, Values::of_sides);
        cut_crossed(middle);
        std::set<std::uint32_t> round;
        for (const std::uint32_t c : image_.star_[middle]) {
            for (const Corner& corner : image_.cells_[c].corners) {
                round.insert(corner.node);
            }
        }
        for (const std::uint32_t node : round) {
            add_edge(middle, node);
        }
    }

    /// Where a cell round the edge that was cut is flat, and its opposite edge runs through the same place, that gets
    /// the same node, not another one next to it: then the flat cell is gone.
    void cut_crossed(std::uint32_t middle) {
        const std::vector<std::uint32_t> round = image_.star_[middle];
        for (const std::uint32_t c : round) {
            const Cell& cell = image_.cells_[c];
            for (std::size_t k = 0; k < cell_edges.size() && !image_.degenerate(cell); ++k) {
                const Edge opposite{cell.corners[cell_edges[k][0]].node, cell.corners[cell_edges[k][1]].node};
                if (opposite[0] != middle && opposite[1] != middle && runs_through(opposite, position(middle)) &&
                    stays_positive(opposite, position(middle), middle)) {
                    image_.split_edge(opposite[0], opposite[1], middle, Values::of_sides);
                    break;
                }
            }
        }
    }

    [[nodiscard]] bool runs_through(const Edge& edge, const Vec3& at) const {
        const Vec3& from = position(edge[0]);
        const Vec3 along = position(edge[1]) - from;
        const double share = dot(at - from, along) / squared_length(along);
        return std::min(share, 1 - share) > near_end && distance(from + share * along, at) < crossed * length(along);
    }

    /// Will all cells round the edge keep a volume when it is cut there? But for those that will be gone: with the node
    /// already, with the edge that is cut in the same place, or with an opposite one that can be.
    [[nodiscard]] bool stays_positive(const Edge& edge, const Vec3& at, std::uint32_t node,
                                      const Edge& cut_too = {no_index, no_index}) const {
        return std::ranges::all_of(image_.star_[edge[0]], [&](std::uint32_t c) {
            const Cell& cell = image_.cells_[c];
            if (image_.degenerate(cell) || !has(cell, edge[1]) || has(cell, node) ||
                (has(cell, cut_too[0]) && has(cell, cut_too[1]))) {
                return true;
            }
            const Edge opposite = opposite_edge(cell, edge);
            if (cut_too[0] == no_index && runs_through(opposite, at)) {
                return stays_positive(opposite, at, node, edge);
            }
            return std::ranges::all_of(edge, [&](std::uint32_t replaced) { return keeps_height(cell, replaced, at); });
        });
    }

    static Edge opposite_edge(const Cell& cell, const Edge& edge) {
        Edge result{};
        std::size_t next = 0;
        for (const Corner& corner : cell.corners) {
            if (corner.node != edge[0] && corner.node != edge[1]) {
                result[next++] = corner.node;
            }
        }
        return result;
    }

    [[nodiscard]] bool keeps_height(const Cell& cell, std::uint32_t replaced, const Vec3& at) const {
        std::array<Vec3, 4> whole{};
        std::array<Vec3, 4> half{};
        for (std::size_t k = 0; k < 4; ++k) {
            whole[k] = position(cell.corners[k].node);
            half[k] = cell.corners[k].node == replaced ? at : whole[k];
        }
        const double longest = image_.longest_edge(cell);
        return signed_height(half) >
               std::max(std::min(least_height * longest, height_share * signed_height(whole)), rounding * longest);
    }

    /// What was put on a fault has in each cell the mean of the seeds there: of its side, now that none has both.
    void take_value_of_seeds(Cell& cell) {
        std::vector<std::uint32_t> seeds;
        for (const Corner& corner : cell.corners) {
            if (!is_made(corner.node)) {
                seeds.push_back(corner.origin);
            }
        }
        if (seeds.empty()) {
            return;
        }
        const std::uint32_t mean = image_.mean_of(std::move(seeds));
        for (Corner& corner : cell.corners) {
            corner.origin = is_made(corner.node) ? mean : corner.origin;
        }
    }

    CollapseImage& image_;
    const Model& model_;
    std::vector<Edge> open_;
    SheetCrossings crossings_;
    std::vector<std::vector<std::int32_t>> on_;  ///< faults that a node is on
    std::set<Edge> led_through_;  ///< edges that got a node which was there: once, as flat cells may turn in circles
    std::vector<Vec3> left_;
};

std::vector<Vec3> CollapseImage::cut_edges(const Model& model, const std::vector<char>& selected, const Poll& poll) {
    return Cutter(*this, model, selected).run(poll);
}

}  // namespace terratet
