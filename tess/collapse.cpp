// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/collapse.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "tess/box_clip.hpp"
#include "tess/collapse_image.hpp"
#include "tess/fault_proximity.hpp"
#include "tess/quality.hpp"

namespace terratet {
namespace {

using Corner = CollapseImage::Corner;
using Cell = CollapseImage::Cell;

constexpr double on_surface = 1e-3;  ///< a place may be this far from a surface it is on, over the spacing
constexpr double on_sheet = 0.1;     ///< a facet's centre may be this far from the sheet, over its longest edge

/// Where seeds are to meet: each mirrored pair halfway between its seeds; pairs about a junction's point in that point.
std::vector<FaultNode> fault_nodes(const Model& model, const std::vector<char>& selected) {
    std::map<std::pair<std::int32_t, Vec3>, std::uint32_t> vertex_at;
    for (std::uint32_t v = 0; v < model.vertices.size(); ++v) {
        if (model.vertices[v].role == Role::seed) {
            vertex_at.try_emplace({model.vertices[v].owner, model.vertices[v].position}, v);
        }
    }
    std::map<Vec3, std::set<std::size_t>> sheets_at;
    for (std::size_t f = 0; f < model.faults.size(); ++f) {
        for (std::size_t v = 0; selected[f] != 0 && v < model.faults[f].sheet.vertices.size(); ++v) {
            const Vec3& p = model.faults[f].sheet.vertices[v];
            sheets_at[p].insert(f);
        }
    }
    std::erase_if(sheets_at, [](const auto& at) { return at.second.size() < 2; });

    std::vector<FaultNode> nodes;
    std::map<Vec3, std::size_t> node_at;  // by base
    for (std::size_t f = 0; f < model.faults.size(); ++f) {
        const Fault& fault = model.faults[f];
        for (std::size_t k = 0; selected[f] != 0 && k + 1 < fault.seeds.size(); k += 2) {
            const auto plus = vertex_at.find({static_cast<std::int32_t>(f), fault.seeds[k].position});
            const auto minus = vertex_at.find({static_cast<std::int32_t>(f), fault.seeds[k + 1].position});
            if (plus == vertex_at.end() || minus == vertex_at.end()) {
                continue;
            }
            Vec3 base = model.frame.snapped(0.5 * (fault.seeds[k].position + fault.seeds[k + 1].position));
            double nearest = 0.5 * fault.width * (1 + 1e-6);
            const Vec3 middle = base;
            for (auto at = sheets_at.lower_bound({middle.x - nearest, -max_coordinate, -max_coordinate});
                 at != sheets_at.end() && at->first.x <= middle.x + nearest; ++at) {
                if (at->second.contains(f) && distance(at->first, middle) <= nearest) {
                    nearest = distance(at->first, middle);
                    base = at->first;
                }
            }
            const auto [entry, fresh] = node_at.try_emplace(base, nodes.size());
            if (fresh) {
                nodes.push_back({base, {}});
            }
            std::vector<std::uint32_t>& seeds = nodes[entry->second].seeds;
            seeds.insert(seeds.end(), {plus->second, minus->second});
        }
    }
    return nodes;
}

/// Joins what can be joined: where a cell would lose its volume, its seeds give up, until none does. Every round takes
/// something back for good, so it ends.
CollapseImage collapsed_image(const TetMesh& mesh, std::vector<FaultNode>& nodes) {
    for (;;) {
        CollapseImage image(mesh, nodes);
        image.remove_flat_cells();
        const std::vector<std::uint32_t> culprits = image.culprits();
        if (culprits.empty()) {
            return image;
        }
        for (const std::uint32_t node : culprits) {
            nodes[node].retreat();
        }
    }
}

/// Corners of facet k as seen from outside the cell.
constexpr std::size_t outward[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

/// Neighbours across facets by sorting; −1 where there is none.
std::vector<std::array<std::int32_t, 4>> neighbours_of(const std::vector<std::array<std::uint32_t, 4>>& cells) {
    struct Side {
        Triangle key;
        std::uint32_t cell;
        std::uint32_t facet;
    };
    std::vector<Side> sides;
    sides.reserve(4 * cells.size());
    for (std::uint32_t c = 0; c < cells.size(); ++c) {
        for (std::uint32_t k = 0; k < 4; ++k) {
            Triangle key{cells[c][(k + 1) % 4], cells[c][(k + 2) % 4], cells[c][(k + 3) % 4]};
            std::ranges::sort(key);
            sides.push_back({key, c, k});
        }
    }
    std::ranges::sort(sides, [](const Side& a, const Side& b) {
        return std::tie(a.key, a.cell, a.facet) < std::tie(b.key, b.cell, b.facet);
    });
    std::vector<std::array<std::int32_t, 4>> neighbours(cells.size(), {-1, -1, -1, -1});
    for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
        const Side& a = sides[i];
        const Side& b = sides[i + 1];
        if (a.key == b.key) {
            neighbours[a.cell][a.facet] = static_cast<std::int32_t>(b.cell);
            neighbours[b.cell][b.facet] = static_cast<std::int32_t>(a.cell);
        }
    }
    return neighbours;
}

double area(const std::vector<Vec3>& polygon) {
    Vec3 sum;
    for (std::size_t i = 2; i < polygon.size(); ++i) {
        sum = sum + cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
    }
    return 0.5 * length(sum);
}

/// What is known of the image's cells before nodes are split: columns of the cell table to be.
struct CellStates {
    std::vector<std::int32_t> fault;      ///< whose gap it fills, of those that keep theirs
    std::vector<std::uint8_t> above;      ///< the topography
    std::vector<std::uint8_t> in_extent;  ///< and not above
    std::vector<std::int32_t> region;     ///< as before
};

CellStates cell_states(const Model& model, const CellTable& before, const std::vector<char>& selected,
                       const CollapseImage& image) {
    CellStates states;
    for (const Cell& cell : image.cells()) {
        Vec3 sum;
        for (const Corner& corner : cell.corners) {
            sum = sum + image.position(corner.node);
        }
        const std::int32_t gap = before.fault[cell.parent];
        const bool collapsed = gap >= 0 && selected[static_cast<std::size_t>(gap)] != 0;
        states.fault.push_back(collapsed ? -1 : gap);
        states.above.push_back(collapsed ? 0 : before.above[cell.parent]);  // what is left of a gap is on the − side
        states.in_extent.push_back(states.above.back() == 0 && model.domain.extent.contains(0.25 * sum) ? 1 : 0);
        states.region.push_back(before.region[cell.parent]);
    }
    return states;
}

/// Which facets of the image are the faults, and the nodes split along them.
class NodeSplitter {
  public:
    NodeSplitter(const Model& model, const std::vector<char>& selected, const CollapseImage& image,
                 const std::vector<FaultNode>& nodes, const CellStates& states)
        : model_(model),
          selected_(selected),
          image_(image),
          nodes_(nodes),
          states_(states),
          proximity_(model.faults),
          region_(states.region) {
        for (const Cell& cell : image.cells()) {
            cells_.push_back({cell.corners[0].node, cell.corners[1].node, cell.corners[2].node, cell.corners[3].node});
        }
        neighbours_ = neighbours_of(cells_);
        find_faults_at_nodes();
    }

    /// A node of the result: some of the image's cells round one of its nodes.
    struct Part {
        std::uint32_t node = 0;
        std::vector<std::uint32_t> vertices;  ///< of the model, whose value it has: ascending
    };

    /// Splits. Parts are in the order of their nodes, so that twins are ordered alike on both sides of a fault.
    void run() {
        cut_ = std::vector<std::array<bool, 4>>(cells_.size());
        std::vector<char> touched(image_.node_count(), 0);
        std::vector<char> continued(image_.node_count(), 0);
        for_each_divider([&](std::uint32_t c, std::size_t k, std::int32_t fault) {
            if (lies_on(fault, c, k)) {
                cut(c, k, touched);
                split_area_ += area(inside_extent(c, k));
            } else if (!inside_extent(c, k).empty() || !in_extent(c) ||
                       !in_extent(static_cast<std::size_t>(neighbours_[c][k]))) {
                return;
            }
            for (const std::size_t corner : outward[k]) {
                const std::uint32_t node = cells_[c][corner];
                continued[node] = model_.domain.extent.contains(base_[node]) ? 0 : 1;
            }
        });
        // Where the margin continues the fault beyond the extent, it is cut on by a row of facets: those that straddle
        // the extent's face could not be parted otherwise, nor those just outside between cells that count as inside.
        for_each_divider([&](std::uint32_t c, std::size_t k, std::int32_t) {
            if (std::ranges::any_of(outward[k], [&](std::size_t i) { return continued[cells_[c][i]] != 0; }) &&
                inside_extent(c, k).empty()) {
                cut(c, k, touched);
            }
        });
        spread_regions();
        part_regions(touched);
        split(touched);
    }

    [[nodiscard]] const std::vector<Part>& parts() const { return parts_; }
    [[nodiscard]] const std::vector<std::int32_t>& regions() const { return region_; }
    [[nodiscard]] std::size_t split_places() const { return split_places_; }
    [[nodiscard]] double split_area() const { return split_area_; }

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
        for (const Fault& fault : model_.faults) {
            boxes.push_back(bounding_box(fault.sheet.vertices).grown(on_surface * fault.spacing));
        }
        for (std::uint32_t n = 0; n < image_.node_count(); ++n) {
            const auto at = image_.fault_nodes_at(n);
            base_[n] = at.size() == 1 ? nodes_[at[0]].base : image_.position(n);
            for (const std::uint32_t node : at) {
                for (const std::uint32_t seed : nodes_[node].seeds) {
                    faults_at_[n].push_back(model_.vertices[seed].owner);
                }
            }
            for (std::size_t f = 0; f < boxes.size() && !at.empty(); ++f) {
                const auto fault = static_cast<std::int32_t>(f);
                if (selected_[f] != 0 && boxes[f].contains(base_[n]) &&
                    proximity_.distance_to_sheet(fault, base_[n]) <= on_surface * model_.faults[f].spacing) {
                    faults_at_[n].push_back(fault);
                }
            }
            std::ranges::sort(faults_at_[n]);
            faults_at_[n].erase(std::ranges::unique(faults_at_[n]).begin(), faults_at_[n].end());
        }
    }

    /// Of a fault: +1 when all its seeds among the cell's corners are on the + side; −1 when any is on the other: what
    /// is left of a gap lies on the − side. 0 without a seed.
    [[nodiscard]] int side(std::uint32_t c, std::int32_t fault) const {
        int result = 0;
        for (const Corner& corner : image_.cells()[c].corners) {
            for (const std::uint32_t v : image_.vertices_behind(corner.origin)) {
                const Vertex& vertex = model_.vertices[v];
                if (vertex.role == Role::seed && vertex.owner == fault && vertex.side != 0) {
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
        for (std::uint32_t c = 0; c < cells_.size(); ++c) {
            for (std::size_t k = 0; k < 4; ++k) {
                if (neighbours_[c][k] <= static_cast<std::int32_t>(c)) {
                    continue;
                }
                const auto& v = cells_[c];
                const auto& o = outward[k];
                for (const std::int32_t fault : faults_at_[v[o[0]]]) {
                    if (std::ranges::binary_search(faults_at_[v[o[1]]], fault) &&
                        std::ranges::binary_search(faults_at_[v[o[2]]], fault) &&
                        side(c, fault) * side(static_cast<std::uint32_t>(neighbours_[c][k]), fault) <= 0) {
                        visit(c, k, fault);
                    }
                }
            }
        }
    }

    void cut(std::uint32_t c, std::size_t k, std::vector<char>& touched) {
        const auto beyond = static_cast<std::uint32_t>(neighbours_[c][k]);
        cut_[c][k] = cut_[beyond][facet_towards(beyond, c)] = true;
        for (const std::size_t corner : outward[k]) {
            touched[cells_[c][corner]] = 1;
        }
    }

    /// The part of a facet, at the bases of its nodes, that lies in the extent.
    [[nodiscard]] std::vector<Vec3> inside_extent(std::uint32_t c, std::size_t k) const {
        const auto& v = cells_[c];
        const auto& o = outward[k];
        return clipped({base_[v[o[0]]], base_[v[o[1]]], base_[v[o[2]]]}, model_.domain.extent);
    }

    [[nodiscard]] bool lies_on(std::int32_t fault, std::uint32_t c, std::size_t k) const {
        const std::vector<Vec3> inside = inside_extent(c, k);
        if (inside.empty()) {
            return false;
        }
        const Vec3 middle = std::accumulate(inside.begin(), inside.end(), Vec3{}) / static_cast<double>(inside.size());
        double longest = 0;
        for (const Vec3& p : inside) {
            longest = std::max({longest, distance(p, inside[0]), distance(p, inside[inside.size() / 2])});
        }
        return proximity_.distance_to_sheet(fault, middle) <= on_sheet * longest;
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
        return region_[c] < 0 && states_.fault[c] < 0 && states_.above[c] == 0;
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
                    split_area_ += area(inside_extent(c, k));
                }
            }
        }
    }

    void split(const std::vector<char>& touched) {
        std::vector<std::vector<std::array<std::uint32_t, 2>>> star(touched.size());  // cell, corner
        for (std::uint32_t c = 0; c < cells_.size(); ++c) {
            for (std::uint32_t k = 0; k < 4; ++k) {
                star[cells_[c][k]].push_back({c, k});
            }
        }
        const auto image_cells = cells_;
        for (std::uint32_t node = 0; node < touched.size(); ++node) {
            if (star[node].empty()) {
                continue;
            }
            using Groups = std::vector<std::vector<Incidence>>;
            const std::size_t parts_before = parts_.size();
            for (const auto& group :
                 touched[node] != 0 ? components(node, star[node], image_cells) : Groups{star[node]}) {
                Part part{node, {}};
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

    using Incidence = std::array<std::uint32_t, 2>;

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
    const std::vector<FaultNode>& nodes_;
    const CellStates& states_;
    FaultProximity proximity_;
    std::vector<std::int32_t> region_;
    std::vector<std::array<std::uint32_t, 4>> cells_;  ///< over the image's nodes, then over parts
    std::vector<std::array<std::int32_t, 4>> neighbours_;
    std::vector<std::array<bool, 4>> cut_;  ///< by cell and facet: is it a fault's?
    std::vector<std::vector<std::int32_t>> faults_at_;
    std::vector<Vec3> base_;
    std::vector<Part> parts_;
    std::size_t split_places_ = 0;
    double split_area_ = 0;
};

/// The mean in the property's scale; of a category the first value. Missing values do not count.
double mean(const Property& property, const std::vector<double>& values, const std::vector<std::uint32_t>& vertices) {
    if (vertices.size() == 1) {
        return values[vertices[0]];
    }
    double sum = 0;
    int count = 0;
    for (const std::uint32_t v : vertices) {
        if (std::isnan(values[v])) {
            continue;
        }
        if (property.kind == Kind::categorical) {
            return values[v];
        }
        sum += to_scale(property, values[v]);
        ++count;
    }
    return count == 0 ? missing : from_scale(property, sum / count);
}

/// Nodes as vertices, with their values.
void fill_vertices(const Model& model, const CollapseImage& image, const std::vector<NodeSplitter::Part>& parts,
                   CollapsedModel& result) {
    result.model.vertices.clear();
    result.model.vertex_values = {};
    result.model.vertex_values.values.resize(model.properties.size());
    std::uint64_t next_id = model.vertices.empty() ? 0 : model.vertices.back().id + 1;
    std::set<std::uint32_t> taken;
    for (const NodeSplitter::Part& part : parts) {
        Vertex vertex = model.vertices[part.vertices.front()];
        for (const std::uint32_t v : part.vertices) {
            const Vertex& other = model.vertices[v];
            if (other.owner == vertex.owner && other.side != vertex.side) {
                vertex.side = 0;
            }
        }
        if (part.node >= model.vertices.size() || !taken.insert(part.vertices.front()).second) {
            vertex.id = next_id++;
        }
        vertex.position = image.position(part.node);
        result.mesh.points.push_back(vertex.position);
        result.model.vertices.push_back(vertex);
        for (std::size_t p = 0; p < model.properties.size(); ++p) {
            result.model.vertex_values.values[p].push_back(
                mean(model.properties[p], model.vertex_values.values[p], part.vertices));
        }
        result.model.vertex_values.extrapolation.push_back(mean({}, model.vertex_values.extrapolation, part.vertices));
    }
}

void fill_cells(const CellTable& before, const CollapseImage& image, CellStates states, CollapsedModel& result) {
    CellTable& table = result.cells;
    const TetMesh& mesh = result.mesh;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
        const auto& v = mesh.cells[c];
        const CellQuality quality =
            cell_quality({mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]], mesh.points[v[3]]});
        table.reason.push_back(before.reason[image.cells()[c].parent]);
        table.radius_edge.push_back(static_cast<float>(quality.radius_edge));
        table.aspect.push_back(static_cast<float>(quality.aspect));
        table.dihedral_min_deg.push_back(static_cast<float>(quality.dihedral_min_deg));
    }
    table.fault = std::move(states.fault);
    table.above = std::move(states.above);
    table.in_extent = std::move(states.in_extent);
    table.region_count = before.region_count;
    table.region_name = before.region_name;
}

template <class T>
void keep(std::vector<T>& column, const std::vector<char>& kept) {
    std::size_t next = 0;
    for (std::size_t i = 0; i < column.size(); ++i) {
        if (kept[i] != 0) {
            column[next++] = column[i];
        }
    }
    column.resize(next);
}

/// The cells above the topography, and the nodes that only they have, are taken out.
void drop_above(CollapsedModel& result) {
    CellTable& table = result.cells;
    TetMesh& mesh = result.mesh;
    std::vector<char> kept_cell;
    std::vector<std::int32_t> cell_number;
    std::vector<char> kept_node(mesh.points.size(), 0);
    std::int32_t cells = 0;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
        kept_cell.push_back(table.above[c] == 0 ? 1 : 0);
        cell_number.push_back(table.above[c] == 0 ? cells++ : -1);
        for (const std::uint32_t node : mesh.cells[c]) {
            kept_node[node] = kept_node[node] != 0 || table.above[c] == 0 ? 1 : 0;
        }
    }
    std::vector<std::uint32_t> node_number;
    std::uint32_t nodes = 0;
    for (const char kept : kept_node) {
        node_number.push_back(nodes);
        nodes += kept != 0 ? 1 : 0;
    }
    keep(mesh.points, kept_node);
    keep(result.model.vertices, kept_node);
    for (std::vector<double>& values : result.model.vertex_values.values) {
        keep(values, kept_node);
    }
    keep(result.model.vertex_values.extrapolation, kept_node);
    keep(mesh.cells, kept_cell);
    keep(mesh.neighbours, kept_cell);
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
        for (std::size_t k = 0; k < 4; ++k) {
            mesh.cells[c][k] = node_number[mesh.cells[c][k]];
            const std::int32_t beyond = mesh.neighbours[c][k];
            mesh.neighbours[c][k] = beyond < 0 ? -1 : cell_number[static_cast<std::size_t>(beyond)];
        }
    }
    keep(table.region, kept_cell);
    keep(table.fault, kept_cell);
    keep(table.in_extent, kept_cell);
    keep(table.reason, kept_cell);
    keep(table.radius_edge, kept_cell);
    keep(table.aspect, kept_cell);
    keep(table.dihedral_min_deg, kept_cell);
    keep(table.above, kept_cell);
}

}  // namespace

bool has_ground(const Model& model) {
    return std::ranges::any_of(model.faults,
                               [](const Fault& fault) { return fault.sheet.kind == SurfaceKind::topography; });
}

CollapsedModel collapse_faults(const Model& model, const TetMesh& mesh, const CellTable& cells, Collapsing which) {
    std::vector<char> selected;
    for (const Fault& fault : model.faults) {
        selected.push_back(which == Collapsing::all || fault.sheet.kind == SurfaceKind::topography ? 1 : 0);
    }
    std::vector<FaultNode> nodes = fault_nodes(model, selected);
    const CollapseImage image = collapsed_image(mesh, nodes);
    CellStates states = cell_states(model, cells, selected, image);
    NodeSplitter splitter(model, selected, image, nodes, states);
    splitter.run();

    CollapsedModel result{model, {}, {}, {}};
    fill_vertices(model, image, splitter.parts(), result);
    result.mesh.cells = splitter.cells();
    result.mesh.neighbours = splitter.neighbours();
    result.cells.region = splitter.regions();
    fill_cells(cells, image, std::move(states), result);

    CollapseReport& report = result.report;
    report.dropped_cells =
        static_cast<std::size_t>(std::ranges::count_if(cells.fault, [](std::int32_t fault) { return fault >= 0; })) -
        static_cast<std::size_t>(
            std::ranges::count_if(image.cells(), [&](const Cell& cell) { return cells.fault[cell.parent] >= 0; }));
    report.added_places = image.added_nodes();
    report.split_places = splitter.split_places();
    report.split_area = splitter.split_area();
    const FaultProximity proximity(model.faults);
    for (const FaultNode& node : nodes) {
        const std::int32_t fault = model.vertices[node.seeds[0]].owner;
        const double spacing = model.faults[static_cast<std::size_t>(fault)].spacing;
        if (node.state != FaultNode::State::joined && model.domain.extent.contains(node.base) &&
            proximity.distance_to_sheet(fault, node.base) < 1e-3 * spacing) {
            (node.state == FaultNode::State::apart ? report.apart : report.aside).push_back(node.base);
        }
    }
    for (std::size_t f = 0; f < model.faults.size(); ++f) {
        report.sheet_area += selected[f] != 0 ? statistics(model.faults[f].sheet).area : 0;
    }
    report.conformity = check_conformity(result.mesh, result.cells.region, model.domain.hull);
    drop_above(result);
    return result;
}

}  // namespace terratet
