// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/collapse/node_splitter.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "tess/barrier_query.hpp"
#include "tess/base/box_clip.hpp"
#include "tess/base/poll.hpp"
#include "tess/base/tetrahedron.hpp"
#include "tess/collapse/facet_neighbours.hpp"

namespace terratet {
namespace {

using Corner = CollapseImage::Corner;
using Cell = CollapseImage::Cell;

constexpr double on_surface = 1e-3;  ///< a place may be this far from a surface it is on, over the spacing
constexpr double on_sheet = 0.1;     ///< a facet's centre may be this far from the sheet, over its longest edge

double area(const std::vector<Vec3>& polygon) {
    Vec3 sum;
    for (std::size_t i = 2; i < polygon.size(); ++i) {
        sum = sum + cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
    }
    return 0.5 * length(sum);
}

/// Which facets of the image are the faults, and the nodes split along them.
class NodeSplitter {
  public:
    NodeSplitter(const Model& model, const std::vector<char>& selected, const CollapseImage& image,
                 std::span<const FaultNode> nodes, const CellStates& states, const Poll& poll)
        : model_(model),
          selected_(selected),
          image_(image),
          nodes_(nodes),
          states_(states),
          poll_(poll),
          proximity_(model.barriers),
          region_(states.region) {
        for (const Cell& cell : image.cells()) {
            cells_.push_back({cell.corners[0].node, cell.corners[1].node, cell.corners[2].node, cell.corners[3].node});
        }
        neighbours_ = neighbours_of(cells_);
        find_faults_at_nodes();
    }

    /// Splits. Parts are in the order of their nodes, so that twins are ordered alike on both sides of a fault.
    void run() {
        cut_ = std::vector<std::array<bool, 4>>(cells_.size());
        std::vector<char> touched(image_.node_count(), 0);
        std::vector<char> continued(image_.node_count(), 0);
        for_each_divider([&](std::uint32_t c, std::size_t k, std::int32_t barrier) {
            if (lies_on(barrier, c, k)) {
                cut(c, k, touched);
                split_area_ += area(inside_extent(c, k));
            } else if (!inside_extent(c, k).empty() || !in_extent(c) ||
                       !in_extent(static_cast<std::size_t>(neighbours_[c][k]))) {
                return;
            }
            for (const std::size_t corner : facet_corners[k]) {
                const std::uint32_t node = cells_[c][corner];
                continued[node] = model_.domain.extent.contains(base_[node]) ? 0 : 1;
            }
        });
        // Where the margin continues the fault beyond the extent, it is cut on by a row of facets: those that straddle
        // the extent's face could not be parted otherwise, nor those just outside between cells that count as inside.
        for_each_divider([&](std::uint32_t c, std::size_t k, std::int32_t) {
            if (std::ranges::any_of(facet_corners[k], [&](std::size_t i) { return continued[cells_[c][i]] != 0; }) &&
                inside_extent(c, k).empty()) {
                cut(c, k, touched);
            }
        });
        spread_regions();
        part_regions(touched);
        split(touched);
    }

    [[nodiscard]] const std::vector<NodePart>& parts() const { return parts_; }
    [[nodiscard]] const std::vector<std::int32_t>& regions() const { return region_; }
    [[nodiscard]] std::size_t split_places() const { return split_places_; }
    [[nodiscard]] double split_area() const { return split_area_; }
    [[nodiscard]] std::vector<Vec3> off_barriers_of() const { return {off_faults_.begin(), off_faults_.end()}; }

    /// Cells over parts, and their neighbours; none across faults.
    [[nodiscard]] const std::vector<std::array<std::uint32_t, 4>>& cells() const { return cells_; }
    [[nodiscard]] std::vector<std::array<std::int32_t, 4>> neighbours() const {
        std::vector<std::array<std::int32_t, 4>> result = neighbours_;
        for (std::size_t c = 0; c < result.size(); ++c) {
            for (std::size_t k = 0; k < 4; ++k) {
                result[c][k] = cut_[c][k] ? -1 : result[c][k];
            }
        }
        return result;
    }

  private:
    [[nodiscard]] std::size_t facet_towards(std::uint32_t from, std::uint32_t to) const {
        return static_cast<std::size_t>(std::ranges::find(neighbours_[from], static_cast<std::int32_t>(to)) -
                                        neighbours_[from].begin());
    }

    /// Whose surface a node is on: its seeds' own, and others that run through its place. Where the margin of one fault
    /// meets another fault there is no junction that they share.
    void find_faults_at_nodes() {
        faults_at_.resize(image_.node_count());
        base_.resize(image_.node_count());
        std::vector<Box3> boxes;
        for (const Barrier& barrier : model_.barriers) {
            boxes.push_back(bounding_box(barrier.sheet.vertices).grown(on_surface * barrier.spacing));
        }
        PatientPoll go_on(poll_);
        for (std::uint32_t n = 0; n < image_.node_count(); ++n) {
            go_on();
            const auto at = image_.fault_nodes_at(n);
            faults_at_[n] = image_.faults_on(n);
            base_[n] = at.size() == 1 ? nodes_[at[0]].base : image_.position(n);
            for (const std::uint32_t node : at) {
                faults_at_[n].insert(faults_at_[n].end(), nodes_[node].barriers.begin(), nodes_[node].barriers.end());
            }
            for (std::size_t f = 0; f < boxes.size() && !(at.empty() && faults_at_[n].empty()); ++f) {
                const auto barrier = static_cast<std::int32_t>(f);
                if (selected_[f] != 0 && boxes[f].contains(base_[n]) &&
                    proximity_.distance_to_sheet(barrier, base_[n]) <= on_surface * model_.barriers[f].spacing) {
                    faults_at_[n].push_back(barrier);
                }
            }
            std::ranges::sort(faults_at_[n]);
            faults_at_[n].erase(std::ranges::unique(faults_at_[n]).begin(), faults_at_[n].end());
        }
    }

    /// Of a fault: +1 when all its seeds among the cell's corners are on the + side; −1 when any is on the other: what
    /// is left of a gap lies on the − side. 0 without a seed.
    [[nodiscard]] int side(std::uint32_t c, std::int32_t barrier) const {
        int result = 0;
        for (const Corner& corner : image_.cells()[c].corners) {
            for (const std::uint32_t v : image_.vertices_behind(corner.origin)) {
                const Vertex& vertex = model_.vertices[v];
                if (vertex.role == Role::seed && vertex.owner == barrier && vertex.side != 0) {
                    result = vertex.side < 0 ? -1 : result == 0 ? 1 : result;
                }
            }
        }
        return result;
    }

    /// Calls visit(cell, facet, fault) for each facet with its corners on a fault's surface, once, that is not between
    /// cells of the same side: on the sheet, or on the margin.
    template <class Visit>
    void for_each_divider(Visit&& visit) const {
        PatientPoll go_on(poll_);
        for (std::uint32_t c = 0; c < cells_.size(); ++c) {
            go_on();
            for (std::size_t k = 0; k < 4; ++k) {
                if (neighbours_[c][k] <= static_cast<std::int32_t>(c)) {
                    continue;
                }
                const auto& v = cells_[c];
                const auto& o = facet_corners[k];
                for (const std::int32_t barrier : faults_at_[v[o[0]]]) {
                    if (selected_[static_cast<std::size_t>(barrier)] != 0 &&
                        std::ranges::binary_search(faults_at_[v[o[1]]], barrier) &&
                        std::ranges::binary_search(faults_at_[v[o[2]]], barrier) &&
                        side(c, barrier) * side(static_cast<std::uint32_t>(neighbours_[c][k]), barrier) <= 0) {
                        visit(c, k, barrier);
                    }
                }
            }
        }
    }

    void cut(std::uint32_t c, std::size_t k, std::vector<char>& touched) {
        const auto beyond = static_cast<std::uint32_t>(neighbours_[c][k]);
        cut_[c][k] = cut_[beyond][facet_towards(beyond, c)] = true;
        for (const std::size_t corner : facet_corners[k]) {
            touched[cells_[c][corner]] = 1;
        }
    }

    /// The part of a facet, at the bases of its nodes, that lies in the extent.
    [[nodiscard]] std::vector<Vec3> inside_extent(std::uint32_t c, std::size_t k) const {
        const auto& v = cells_[c];
        const auto& o = facet_corners[k];
        return clipped({base_[v[o[0]]], base_[v[o[1]]], base_[v[o[2]]]}, model_.domain.extent);
    }

    [[nodiscard]] bool lies_on(std::int32_t barrier, std::uint32_t c, std::size_t k) const {
        const std::vector<Vec3> inside = inside_extent(c, k);
        if (inside.empty()) {
            return false;
        }
        const Vec3 middle = std::accumulate(inside.begin(), inside.end(), Vec3{}) / static_cast<double>(inside.size());
        double longest = 0;
        for (const Vec3& p : inside) {
            longest = std::max({longest, distance(p, inside[0]), distance(p, inside[inside.size() / 2])});
        }
        return proximity_.distance_to_sheet(barrier, middle) <= on_sheet * longest;
    }

    [[nodiscard]] bool in_extent(std::size_t c) const { return states_.in_extent[c] != 0; }

    /// Cells within the extent keep their region. Those that had none, of a gap or from beyond the extent, take that of
    /// the nearest cells they hang together with. Where faults meet, some of a gap may hang together with none: they
    /// join a neighbour.
    void spread_regions() {
        std::vector<std::uint32_t> open;
        for (std::uint32_t c = 0; c < cells_.size(); ++c) {
            if (region_[c] >= 0) {
                open.push_back(c);
            }
        }
        spread_from(open);
        for (std::uint32_t c = 0; c < cells_.size(); ++c) {
            for (std::size_t k = 0; k < 4 && lacks_region(c); ++k) {
                const std::int32_t beyond = neighbours_[c][k];
                if (in_extent(c) && beyond >= 0 && region_[static_cast<std::size_t>(beyond)] >= 0) {
                    const auto neighbour = static_cast<std::uint32_t>(beyond);
                    region_[c] = region_[neighbour];
                    cut_[c][k] = cut_[neighbour][facet_towards(neighbour, c)] = false;
                    open.assign(1, c);
                    spread_from(open);
                }
            }
        }
        for (std::size_t c = 0; c < cells_.size(); ++c) {
            region_[c] = in_extent(c) ? region_[c] : -1;
        }
    }

    [[nodiscard]] bool lacks_region(std::size_t c) const {
        return region_[c] < 0 && states_.barrier[c] < 0 && states_.beyond[c] == 0;
    }

    void spread_from(std::vector<std::uint32_t>& open) {
        for (std::size_t i = 0; i < open.size(); ++i) {
            for (std::size_t k = 0; k < 4; ++k) {
                const std::int32_t next = neighbours_[open[i]][k];
                if (next >= 0 && !cut_[open[i]][k] && lacks_region(static_cast<std::size_t>(next))) {
                    region_[static_cast<std::size_t>(next)] = region_[open[i]];
                    open.push_back(static_cast<std::uint32_t>(next));
                }
            }
        }
    }

    /// Regions meet at split facets alone, also where these are a little off the surface: where the margin of one fault
    /// runs through another, and no cell's facets follow the latter.
    void part_regions(std::vector<char>& touched) {
        for (std::uint32_t c = 0; c < cells_.size(); ++c) {
            for (std::size_t k = 0; k < 4; ++k) {
                const std::int32_t next = neighbours_[c][k];
                if (next > static_cast<std::int32_t>(c) && !cut_[c][k] && region_[c] >= 0 &&
                    region_[static_cast<std::size_t>(next)] >= 0 &&
                    region_[c] != region_[static_cast<std::size_t>(next)]) {
                    cut(c, k, touched);
                    const std::vector<Vec3> inside = inside_extent(c, k);
                    split_area_ += area(inside);
                    for (const std::size_t corner : facet_corners[k]) {
                        if (const std::uint32_t node = cells_[c][corner]; !inside.empty() && faults_at_[node].empty()) {
                            off_faults_.insert(image_.position(node));
                        }
                    }
                }
            }
        }
    }

    using Incidence = std::array<std::uint32_t, 2>;

    void split(const std::vector<char>& touched) {
        std::vector<std::vector<std::array<std::uint32_t, 2>>> star(touched.size());  // cell, corner
        for (std::uint32_t c = 0; c < cells_.size(); ++c) {
            for (std::uint32_t k = 0; k < 4; ++k) {
                star[cells_[c][k]].push_back({c, k});
            }
        }
        const auto image_cells = cells_;
        PatientPoll go_on(poll_);
        for (std::uint32_t node = 0; node < touched.size(); ++node) {
            go_on();
            if (star[node].empty()) {
                continue;
            }
            using Groups = std::vector<std::vector<Incidence>>;
            const std::size_t parts_before = parts_.size();
            if (touched[node] != 0) {
                separate_regions(node, star[node], image_cells);
            }
            for (const auto& group :
                 touched[node] != 0 ? components(node, star[node], image_cells) : Groups{star[node]}) {
                NodePart part{node, {}};
                for (const auto& [c, k] : group) {
                    cells_[c][k] = static_cast<std::uint32_t>(parts_.size());
                    const auto behind = image_.vertices_behind(image_.cells()[c].corners[k].origin);
                    part.vertices.insert(part.vertices.end(), behind.begin(), behind.end());
                }
                std::ranges::sort(part.vertices);
                part.vertices.erase(std::ranges::unique(part.vertices).begin(), part.vertices.end());
                parts_.push_back(std::move(part));
            }
            split_places_ += parts_.size() > parts_before + 1 ? 1 : 0;
        }
    }

    /// Where two regions are joined round the end of a fault outside the extent, the cells there take sides, and facets
    /// between them are cut: no region shares a node with another across a fault.
    void separate_regions(std::uint32_t node, const std::vector<Incidence>& star,
                          const std::vector<std::array<std::uint32_t, 4>>& cells) {
        std::map<std::uint32_t, std::int32_t> label;
        std::vector<std::uint32_t> open;
        for (const auto& [c, corner] : star) {
            label[c] = region_[c];
            if (region_[c] >= 0) {
                open.push_back(c);
            }
        }
        if (std::ranges::all_of(open, [&](std::uint32_t c) { return region_[c] == region_[open[0]]; })) {
            return;
        }
        const auto visit_joined = [&](std::uint32_t c, const auto& visit) {
            for (std::size_t k = 0; k < 4; ++k) {
                if (cells[c][k] != node && !cut_[c][k] && neighbours_[c][k] >= 0) {
                    visit(static_cast<std::uint32_t>(neighbours_[c][k]), k);
                }
            }
        };
        for (std::size_t i = 0; i < open.size(); ++i) {
            visit_joined(open[i], [&](std::uint32_t next, std::size_t) {
                if (label[next] < 0) {
                    label[next] = label[open[i]];
                    open.push_back(next);
                }
            });
        }
        for (const std::uint32_t c : open) {
            visit_joined(c, [&](std::uint32_t next, std::size_t k) {
                if (label[next] != label[c]) {
                    cut_[c][k] = cut_[next][facet_towards(next, c)] = true;
                }
            });
        }
    }

    /// Cells round a node that hang together over facets at the node that are no faults; by their first cell.
    [[nodiscard]] std::vector<std::vector<Incidence>> components(
        std::uint32_t node, const std::vector<Incidence>& star,
        const std::vector<std::array<std::uint32_t, 4>>& cells) const {
        std::map<std::uint32_t, std::size_t> index;
        for (std::size_t i = 0; i < star.size(); ++i) {
            index[star[i][0]] = i;
        }
        std::vector<char> seen(star.size(), 0);
        std::vector<std::vector<Incidence>> result;
        for (std::size_t first = 0; first < star.size(); ++first) {
            if (seen[first] != 0) {
                continue;
            }
            result.emplace_back();
            std::vector<std::size_t> open{first};
            seen[first] = 1;
            while (!open.empty()) {
                const auto [c, corner] = star[open.back()];
                open.pop_back();
                result.back().push_back({c, corner});
                for (std::size_t k = 0; k < 4; ++k) {
                    if (cells[c][k] == node || cut_[c][k] || neighbours_[c][k] < 0) {
                        continue;
                    }
                    const std::size_t next = index.at(static_cast<std::uint32_t>(neighbours_[c][k]));
                    if (seen[next] == 0) {
                        seen[next] = 1;
                        open.push_back(next);
                    }
                }
            }
        }
        return result;
    }

    const Model& model_;
    const std::vector<char>& selected_;
    const CollapseImage& image_;
    std::span<const FaultNode> nodes_;
    const CellStates& states_;
    const Poll& poll_;
    BarrierQuery proximity_;
    std::vector<std::int32_t> region_;
    std::vector<std::array<std::uint32_t, 4>> cells_;  ///< over the image's nodes, then over parts
    std::vector<std::array<std::int32_t, 4>> neighbours_;
    std::vector<std::array<bool, 4>> cut_;  ///< by cell and facet: is it a fault's?
    std::vector<std::vector<std::int32_t>> faults_at_;
    std::vector<Vec3> base_;
    std::vector<NodePart> parts_;
    std::size_t split_places_ = 0;
    double split_area_ = 0;
    std::set<Vec3> off_faults_;
};

}  // namespace

SplitImage split_nodes(const Model& model, const std::vector<char>& selected, const CollapseImage& image,
                       std::span<const FaultNode> nodes, const CellStates& states, const Poll& poll) {
    NodeSplitter splitter(model, selected, image, nodes, states, poll);
    splitter.run();
    return {splitter.parts(),        splitter.regions(),    splitter.cells(),          splitter.neighbours(),
            splitter.split_places(), splitter.split_area(), splitter.off_barriers_of()};
}

}  // namespace terratet
